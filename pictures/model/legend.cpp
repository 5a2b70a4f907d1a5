// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/legend.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/text/human_units.hpp"

namespace warren {
namespace {

class LegendMaker {
 public:
  LegendMaker(const Picture& picture, Parts parts, const Execution& execution)
      : picture_(picture), parts_(parts), execution_(execution) {}

  std::vector<LegendEntry> entries() {
    if (parts_.has(Part::world)) world();
    for (const PictureLayer& layer : picture_.layers) {
      if (layer.part == Part::world) add(layer);
    }
    if (picture_.roadmap != nullptr) roadmap();
    for (const PictureLayer& layer : picture_.layers) {
      if (layer.part != Part::world) add(layer);
    }
    if (parts_.has(Part::path)) path();
    return std::move(entries_);
  }

 private:
  void world();
  void roadmap();
  void path();
  void add(const PictureLayer& layer);

  const Picture& picture_;
  Parts parts_;
  const Execution& execution_;
  std::vector<LegendEntry> entries_;
};

void LegendMaker::world() {
  const Scene& scene = picture_.scene;
  if (!scene.polygons.empty()) {
    entries_.push_back({.label = scene.polygons.size() == 1 ? "obstacle" : "obstacles",
                        .lines = {colors::outline},
                        .width = widths::outline,
                        .fill = colors::polygon});
  }
  // A map's walls are the borders of its cells.
  if (scene.walls.size() > 0) {
    const bool borders = scene.map.has_value();
    entries_.push_back(
        {.label = borders ? "border of blocked cells" : "wall", .lines = {colors::wall}, .width = widths::wall});
  } else if (scene.bounds && picture_.panels.empty()) {
    entries_.push_back({.label = "bounds", .lines = {colors::wall}, .width = widths::wall});
  }
}

void LegendMaker::roadmap() {
  const PlannedRoadmap<Vec2>& roadmap = *picture_.roadmap;
  if (parts_.has(Part::roadmap) && !roadmap.states.empty()) {
    const std::size_t edges = roadmap.graph.edge_count();
    LegendEntry entry{.label = edges > 0 ? "roadmap edge, milestone" : "milestone", .dot = colors::components[0]};
    if (edges > 0) {
      const std::vector<std::uint8_t> color = component_colors(roadmap.graph, execution_);
      // The last colour is for single milestones, too.
      std::size_t used = 1;
      for (std::size_t c = 1; c + 1 < colors::components.size(); ++c) {
        used += std::find(color.begin(), color.end(), c) != color.end() ? 1 : 0;
      }
      constexpr std::size_t most_pieces = 4;
      used = std::min(used, most_pieces);
      entry.lines.assign(colors::components.begin(), colors::components.begin() + static_cast<std::ptrdiff_t>(used));
      if (used > 1) entry.label = "roadmap, a colour a component";
      entry.width = 1.5;
    }
    entries_.push_back(std::move(entry));
  }
  if (parts_.has(Part::search) && !roadmap.search_tree.empty()) {
    entries_.push_back({.label = "search tree", .lines = {colors::search_tree}, .width = widths::search_tree});
  }
}

void LegendMaker::add(const PictureLayer& layer) {
  if (!parts_.has(layer.part) || layer.label.empty() || layer.lines.empty()) return;
  for (const LegendEntry& there : entries_) {
    if (there.label == layer.label) return;
  }
  LegendEntry entry{.label = layer.label, .width = layer.width, .fill = layer.fill, .mark = layer.swatch};
  if (layer.swatch && !layer.fill) entry.fill = layer.color;
  if (layer.width > 0.0) entry.lines = {layer.color};
  entries_.push_back(std::move(entry));
}

void LegendMaker::path() {
  if (!picture_.path.empty()) {
    entries_.push_back({.label = picture_.path_label, .lines = {colors::path}, .width = widths::path});
  }
  if (picture_.start) entries_.push_back({.label = "start", .fill = colors::start, .mark = MarkShape::disc});
  if (picture_.goal) entries_.push_back({.label = "goal", .fill = colors::goal, .mark = MarkShape::star});
}

}  // namespace

std::vector<LegendEntry> legend_of(const Picture& picture, Parts parts, const Execution& execution) {
  return LegendMaker(picture, parts, execution).entries();
}

}  // namespace warren
