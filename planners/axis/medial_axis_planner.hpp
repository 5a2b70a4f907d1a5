// SPDX-License-Identifier: BSD-3-Clause
// Plans along the medial axis (planners/axis/medial_axis.hpp): start and goal are joined to it straight away from their
// nearest obstacles, and the path between follows the axis, as far from all obstacles as it can be. By length: the
// shortest way over curves that are wide enough. By clearance: of the ways whose narrowest place on the axis is as wide
// as possible the shortest. Arcs have their exact lengths in the search and become tangents in the path (1e-4 longer).
// Without bounds the sides of the obstacles' box count as obstacles for the axis, though not for the answer's
// clearance.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "planners/axis/medial_axis.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// What a way along the axis shall be: short, or wide at its narrowest place.
enum class AxisObjective : std::uint8_t { length, clearance };
constexpr auto enum_names(AxisObjective) { return std::array<std::string_view, 2>{"length", "clearance"}; }

/// How the axis is searched.
struct MedialAxisOptions {
  double clearance = 0.0;                           ///< a disc of this radius; world units, >= 0 and finite
  AxisObjective objective = AxisObjective::length;  ///< what is best
  SearchKind search = SearchKind::astar;  ///< breadth- and depth-first count links; `objective` then only narrows
  QueueKind queue = QueueKind::heap;      ///< of astar and dijkstra
};

/// What of a plan depends on neither start nor goal. Immutable; any number of threads may plan on it.
struct AxisRoadmap {
  /// Throws as MedialAxis.
  AxisRoadmap(const PlaneObstacles& obstacles, const Execution& execution);

  PolygonSet polygons;  ///< whose insides are blocked
  MedialAxis axis;      ///< of all obstacles
  WallIndex index;      ///< of what paths must keep off: polygons' sides, walls, bounds
};

/// What a plan leaves to be drawn or told.
struct MedialAxisPlan {
  std::optional<AxisRoadmap> made;  ///< none: the plan ended before, or was asked on a roadmap
  double axis_clearance = 0.0;      ///< of the way along the axis, at its narrowest; only if solved
  double axis_length = 0.0;         ///< of that way, arcs as arcs
};

/// Plans from start to goal for a point that touches nothing, or a disc. Outcomes: solved; start_blocked and
/// goal_blocked (inside a polygon, outside the frame, or nearer to an obstacle than the clearance; with clearance 0: on
/// one); not_connected; stopped. `roadmap` counts vertices and links that are wide enough, and their components.
/// InputError for a clearance out of range or a world without an inside, ObstacleClash for overlapping polygons. The
/// same for any number of threads.
Solution<Vec2> plan_on_medial_axis(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal,
                                   const MedialAxisOptions& options, const Execution& execution,
                                   MedialAxisPlan* keep = nullptr);

/// The same plan on an axis that is there already. `keep` receives lengths and clearances alone.
Solution<Vec2> plan_on_medial_axis(const AxisRoadmap& roadmap, Vec2 start, Vec2 goal, const MedialAxisOptions& options,
                                   const Execution& execution, MedialAxisPlan* keep = nullptr);

/// What of a medial axis is wide enough for a clearance, as straight lines: its vertices and between them the corners
/// of its curves' polylines (AxisCurve::append_polyline).
struct StraightLines {
  std::vector<Vec2> points;  ///< vertices, and corners of the curves
  std::vector<Edge> edges;   ///< ascending, each once, from < to
};

/// `clearance` >= 0. Left out is what rounding may keep from having it. O(edges log edges). Throws Stopped.
StraightLines axis_lines(const AxisRoadmap& roadmap, double clearance, const Execution& execution);

/// r > 0: does a leg keep the clearance r beyond doubt of rounding? Yes if it does in doubles with 1e-12 to spare, or
/// if the leg's and the wall's boxes are apart by r on one axis, which is decided exactly: what runs in the middle of a
/// gap along an axis keeps half the gap's width, not a unit in the last place less. r = 0: does it touch no wall?
/// Exact.
bool certainly_keeps_clearance(const WallIndex& walls, const Segment& leg, double r) noexcept;

}  // namespace warren
