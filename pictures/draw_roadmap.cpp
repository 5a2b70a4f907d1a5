// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/draw_roadmap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "pictures/layers/draw_arm.hpp"
#include "pictures/layers/draw_bodies.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "solve/question/question_of_arm.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

constexpr Rgb unchecked_color{176, 184, 196};
constexpr Rgb blocked_color{246, 130, 130};
constexpr double thin = 0.5 * widths::edge;  // what can't be driven stands back
constexpr std::size_t most_arrows = 2000;

struct EdgeStyle {
  EdgeState state;
  const char* id;
  const char* label;
  Rgb color;
};
/// Free edges are drawn last, over the others.
constexpr std::array<EdgeStyle, 3> edge_styles{{{EdgeState::unchecked, "unchecked", "unchecked edge", unchecked_color},
                                                {EdgeState::blocked, "blocked", "blocked edge", blocked_color},
                                                {EdgeState::free, "free", "free edge", colors::components[0]}}};

Graph edges_in(EdgeState state, const RoadmapArrays& arrays, const Execution& execution) {
  const Graph& all = arrays.candidates;
  execution.reserve((all.vertex_count() + 1) * sizeof(EdgeEnd) + all.targets().size() * sizeof(VertexId));
  RawVector<EdgeEnd> offsets;
  RawVector<VertexId> targets;
  for (VertexId v = 0; v < all.vertex_count(); ++v) {
    execution.poll(v);
    offsets.push_back(static_cast<EdgeEnd>(targets.size()));
    std::size_t end = all.first_end(v);
    for (const VertexId w : all.neighbours(v)) {
      if (edge_state(arrays.edge_states, end++) == state) targets.push_back(w);
    }
  }
  offsets.push_back(static_cast<EdgeEnd>(targets.size()));
  return {std::move(offsets), std::move(targets)};
}

class RoadmapDrawing {
 public:
  RoadmapDrawing(const Scene& scene, const Roadmap& roadmap, const RoadmapArrays& arrays, const Execution& execution)
      : scene_(scene), roadmap_(roadmap), arrays_(arrays), execution_(execution) {}

  Drawing draw(std::optional<double> heading_rad) const {
    if (heading_rad) check_has_headings(roadmap_.robot);
    if (is_arm(roadmap_.robot)) return draw_arm();
    Drawing drawing;
    drawing.start = plane_point(scene_.start);
    drawing.goal = plane_point(scene_.goal);
    if (scene_.map) drawing.layers = cells_of_map(*scene_.map, execution_);
    if (heading_rad) {
      add_heading(drawing, scene_, roadmap_.robot, roadmap_.clearance, poses(), *heading_rad, execution_);
    }
    const bool drives = roadmap_.robot.kind == RobotKind::car;
    drives ? add_curves(drawing) : add_lines(drawing);
    drawing.roadmap.emplace();
    drawing.roadmap->states = positions();
    drawing.roadmap->graph =
        drives ? Graph(RawVector<EdgeEnd>(vertex_count() + 1, 0), {}) : edges_in(EdgeState::free, arrays_, execution_);
    if (!heading_rad && arrays_.dimension == 3 && vertex_count() <= most_arrows) drawing.layers.push_back(arrows());
    return drawing;
  }

 private:
  std::size_t vertex_count() const { return arrays_.candidates.vertex_count(); }
  Vec2 position(VertexId v) const {
    const std::size_t first = std::size_t{v} * arrays_.dimension;
    return {arrays_.states[first], arrays_.states[first + 1]};
  }
  RawVector<Vec2> positions() const {
    RawVector<Vec2> all;
    all.reserve(vertex_count());
    for (VertexId v = 0; v < vertex_count(); ++v) all.push_back(position(v));
    return all;
  }
  RawVector<Se2> poses() const {
    RawVector<Se2> all;
    for (VertexId v = 0; v < vertex_count(); ++v) {
      all.push_back({position(v).x, position(v).y, arrays_.states[std::size_t{v} * 3 + 2]});
    }
    return all;
  }
  void add_lines(Drawing& drawing) const {
    for (const EdgeStyle& style : edge_styles) {
      if (style.state == EdgeState::free) continue;  // they are the roadmap
      PictureLayer layer{.id = style.id, .label = style.label, .color = style.color, .width = thin};
      const Graph graph = edges_in(style.state, arrays_, execution_);
      for (VertexId v = 0; v < vertex_count(); ++v) {
        execution_.poll(v);
        for (const VertexId w : graph.neighbours(v)) {
          if (v < w || arrays_.directed) layer.lines.add(std::array{position(v), position(w)});
        }
      }
      if (layer.lines.size() > 0) drawing.layers.push_back(std::move(layer));
    }
  }

  void add_curves(Drawing& drawing) const {
    std::array<PlannedRoadmap<Se2>, 1> roadmap;
    roadmap[0].states = poses();
    for (const EdgeStyle& style : edge_styles) {
      roadmap[0].graph = edges_in(style.state, arrays_, execution_);
      PictureLayer layer = car_curves(roadmap, roadmap_.robot, execution_).edges;
      layer.id = style.id;
      layer.label = style.label;
      layer.color = style.color;
      if (style.state != EdgeState::free) layer.width = thin;
      if (layer.lines.size() > 0) drawing.layers.push_back(std::move(layer));
    }
  }

  /// Where the states look, in strokes that keep apart from each other.
  PictureLayer arrows() const {
    const Box box = box_around(positions());
    if (box.empty()) return heading_arrows({}, 0.0);
    const double extent = std::max(box.width(), box.height());
    const double length = std::min(extent / 50.0, 0.4 * extent / std::sqrt(static_cast<double>(vertex_count())));
    return heading_arrows(poses(), length);
  }
  Drawing draw_arm() const {
    std::vector<JointState> states;
    const std::size_t n = arrays_.dimension;
    for (std::size_t v = 0; v < vertex_count(); ++v) {
      states.push_back(joint_state(std::span<const double>(arrays_.states).subspan(v * n, n)));
    }
    std::vector<ToolLines> lines;
    for (const EdgeStyle& style : edge_styles) {
      lines.push_back({style.id, style.label, style.color, style.state == EdgeState::free ? widths::edge : thin, {}});
      edges_in(style.state, arrays_, execution_).for_each_edge([&](VertexId v, VertexId w) {
        lines.back().edges.push_back({v, w});
      });
    }
    ArmViews views =
        arm_roadmap_views(scene_, arm_model_of(roadmap_.robot, 0.0, execution_),
                          scene_.start.empty() ? JointState{} : joint_state(scene_.start), states, lines, execution_);
    return {.layers = std::move(views.layers),
            .stage = std::move(views.stage),
            .panels = std::move(views.panels),
            .solids = std::move(views.solids)};
  }

  const Scene& scene_;
  const Roadmap& roadmap_;
  const RoadmapArrays& arrays_;
  const Execution& execution_;
};

Drawing drawing_of_roadmap(const Scene& scene, const Roadmap& roadmap, const EdgeCounts& edges,
                           std::optional<double> heading_rad, const Execution& execution) {
  const bool by_index = roadmap.lattice != nullptr;  // its blocked edges are its walls
  const std::uint64_t drawn = edges.free + (by_index ? 0 : edges.unchecked + edges.blocked);
  if (drawn > most_drawn_edges) {
    throw UsageError(
        fmt::format("this roadmap has {} edges, and a picture of more than {} shows nothing; export it to "
                    ".graphml or .csv and draw a part, or draw its world",
                    grouped(drawn), grouped(most_drawn_edges)));
  }
  if (!by_index) return RoadmapDrawing(scene, roadmap, roadmap.arrays, execution).draw(heading_rad);
  const RoadmapArrays arrays = arrays_of(roadmap.lattice->passages(), execution);
  return RoadmapDrawing(scene, roadmap, arrays, execution).draw(heading_rad);
}

}  // namespace

void draw_roadmap(const Roadmap& roadmap, const std::string& description, std::optional<double> heading_rad,
                  const Execution& execution, const std::function<void(const Picture&)>& draw) {
  const Scene& world = roadmap.world.whole(execution);
  std::optional<Scene> copy;
  const Scene& scene = with_map_walls(world, copy, execution);
  const EdgeCounts edges = count_edges(roadmap, execution);
  const Drawing drawing = drawing_of_roadmap(scene, roadmap, edges, heading_rad, execution);
  Picture picture = picture_of(scene, drawing);
  picture.title = title_of(world);
  picture.subtitle = fmt::format("{}\nroadmap of {}, edges: {} free, {} blocked, {} unchecked",
                                 subtitle_of(world, roadmap.robot), counted(count_states(roadmap), "state", "states"),
                                 grouped(edges.free), grouped(edges.blocked), grouped(edges.unchecked));
  picture.description = fmt::format("{}\n{}", picture.subtitle, description);
  draw(picture);
}

}  // namespace warren
