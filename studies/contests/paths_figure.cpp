// SPDX-License-Identifier: BSD-3-Clause
#include "studies/contests/paths_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pictures/formats/write_picture.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "pictures/layers/lines_side_by_side.hpp"
#include "pictures/subtitle.hpp"
#include "solve/answer/world_account.hpp"

namespace warren::studies {
namespace {

/// Some sixty dashes across all that is drawn.
double dash_of(const std::vector<std::vector<Vec2>>& paths) {
  Box box;
  for (const std::vector<Vec2>& path : paths) {
    for (const Vec2 p : path) box.include(p);
  }
  const double extent = box.empty() ? 0.0 : std::max(box.width(), box.height());
  return extent > 0.0 ? extent / 60.0 : 1.0;
}

}  // namespace

std::vector<std::string> write_named(const std::string& folder, const std::string& name, const Picture& picture,
                                     const PictureOptions& look, const Execution& execution) {
  std::vector<std::string> notes = write_picture(folder + "/" + name, picture, look, execution);
  for (std::string& note : notes) note = fmt::format("{}: drawn {}", name, note);
  return notes;
}

std::vector<std::string> draw_paths(const std::string& folder, const std::string& name, const Scene& scene,
                                    const PathsFigure& figure, const PictureOptions& look, const Execution& execution) {
  std::vector<PictureLayer> layers;
  if (scene.map) layers = cells_of_map(*scene.map, execution);
  std::vector<std::vector<Vec2>> points;
  for (const NamedPath& path : figure.paths) points.push_back(path.points);
  std::vector<PolygonSet> lines = lines_side_by_side(points, dash_of(points), execution);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    layers.push_back({.id = fmt::format("path_{}", i + 1),
                      .label = figure.paths[i].label,
                      .part = Part::path,
                      .color = colors::series[i % colors::series.size()],
                      .width = 0.8 * widths::path,
                      .lines = std::move(lines[i])});
  }
  const Picture picture{.scene = scene,
                        .roadmap = figure.roadmap,
                        .layers = layers,
                        .start = figure.start,
                        .goal = figure.goal,
                        .title = title_of(scene),
                        .subtitle = figure.subtitle,
                        .description = description_of(scene)};
  return write_named(folder, name, picture, look, execution);
}

}  // namespace warren::studies
