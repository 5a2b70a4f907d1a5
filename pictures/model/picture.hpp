// SPDX-License-Identifier: BSD-3-Clause
// What a picture shows, as data: a world, what planners made in it, paths and marks, and the words around them. How it
// looks on a page is page.hpp's, how it becomes a file formats/'.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/execution.hpp"
#include "pictures/model/colors.hpp"
#include "pictures/model/marks.hpp"
#include "pictures/model/moving_arm.hpp"
#include "pictures/model/moving_body.hpp"
#include "pictures/model/picture_options.hpp"
#include "pictures/model/solids.hpp"
#include "planners/roadmap/planned_roadmap.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Lines or areas of one kind: cells, a visibility graph, a medial axis, bodies along a path.
struct PictureLayer {
  std::string id;                        ///< the SVG group's
  std::string label = {};                ///< in the legend; empty: not there
  std::optional<MarkShape> swatch = {};  ///< in the legend, instead of a line or an area
  Part part = Part::roadmap;
  Rgb color = colors::layer;           ///< of the lines
  double width = widths::edge;         ///< as widths say; 0: no lines
  PolygonSet lines = {};               ///< each a chain of points; a chain of one point twice is a dot
  bool closed = false;                 ///< the chains are outlines
  std::optional<Rgb> fill = {};        ///< of outlines that do not overlap, or may be taken together
  double opacity = 1.0;                ///< 0 .. 1
  bool blocks = true;                  ///< an area of Part::world is an obstacle
  bool over_roadmap = false;           ///< drawn after the roadmap's edges
  std::vector<double> opacities = {};  ///< of each chain, times `opacity`; empty: all 1
  /// The turn of the arc that leads to each corner of `lines`, anticlockwise, at most a half turn; 0: a straight.
  /// Empty: all are straight.
  std::vector<double> turns = {};

  std::span<const double> turns_of(std::size_t line) const {
    if (turns.empty()) return {};
    return std::span(turns).subspan(lines.first[line], lines.first[line + 1] - lines.first[line]);
  }
};

/// The points with arcs cut into chords that turn by some degrees; turns as in PictureLayer.
std::vector<Vec2> without_arcs(std::span<const Vec2> points, std::span<const double> turns);

/// Radius of the arc that turns by `turn` over a chord.
double arc_radius(Vec2 from, Vec2 to, double turn);

/// A part of the picture with axes of its own.
struct AxesPanel {
  Box box = {};      ///< in the picture's world
  Vec2 origin = {};  ///< where the panel's own zero is
  std::string x_label = {};
  std::string y_label = {};
  bool has_ticks = true;  ///< else a frame and the labels alone
};

/// Refers to what it shows; all of it must outlive the picture.
struct Picture {
  const Scene& scene;
  const PlannedRoadmap<Vec2>* roadmap = nullptr;  ///< nullptr: none
  std::span<const PictureLayer> layers = {};      ///< in the order in which they are drawn, over the obstacles
  std::span<const Vec2> path = {};
  std::span<const double> path_turns = {};  ///< as PictureLayer::turns
  std::optional<Vec2> start = {};
  std::optional<Vec2> goal = {};
  std::span<const AxesPanel> panels = {};  ///< empty: one, around all
  const SolidView* solids = nullptr;       ///< seen in perspective in a box of its own; nullptr: none
  std::string path_label = "path";
  std::string title = {};
  std::string subtitle = {};  ///< a line or two below the title: planner, samples, length, seed
  std::string description = {};
  const MovingBody* body = nullptr;  ///< what goes along the path; nullptr: a point. Without poses: the path's points
  const MovingArm* arm = nullptr;    ///< that goes along a path; nullptr: none
  bool moves = false;                ///< SVG: it is seen moving; HTML has a slider always
};

/// The part of the world that is shown, and what counts as one unit there: a maze's cell, else a fortieth of the
/// extent.
struct Canvas {
  Box box;
  double unit = 1.0;
  std::optional<Box> whole = {};  ///< the map that it is the known part of; none: all is shown
};
Canvas canvas_of(const Picture& picture, const Execution& execution);

/// For each vertex the index of its colour in colors::components: the largest components have colours of their own.
/// Throws Stopped.
std::vector<std::uint8_t> component_colors(const Graph& graph, const Execution& execution);

}  // namespace warren
