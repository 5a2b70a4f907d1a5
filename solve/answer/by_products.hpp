// SPDX-License-Identifier: BSD-3-Clause
// What a planner made on its way to the answer, for pictures and for those who look into a planner: asked for, since it
// costs memory. Plain data; how it is drawn is pictures/'s.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/cell_potential.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {

/// Chains of points, or closed outlines: "cells" the doors between them, "medial_axis", "visibility", "wrong_edges",
/// "blocked": the obstacles of the reference point at a fixed angle.
struct NamedLines {
  std::string name;     ///< what they are
  PolygonSet lines;     ///< a chain or outline each
  bool closed = false;  ///< is the last corner joined to the first?
};

/// Cells where the body's reference point may not be, at one heading of a lattice.
struct HeadingCells {
  double heading_degrees = 0.0;  ///< counter-clockwise from the cells' x axis
  Bitmap blocked;                ///< set: blocked
  Vec2 origin;                   ///< lower left corner of cell (0, 0)
  double cell = 0.0;             ///< side of a cell, world units
  double yaw_rad = 0.0;  ///< the cells are turned about that corner, anticlockwise; the heading is as they see it
};

/// More paths are a smear. Of more, the first and the last are kept, and of the others every second one is dropped when
/// there is no room for the next.
inline constexpr std::size_t most_improved = 32;

/// A path with its arcs: the points where straights and arcs end, and the turn of what leads to each, radians, above 0
/// anticlockwise; 0: a straight.
struct ArcPath {
  std::vector<Vec2> points;   ///< start to goal
  std::vector<double> turns;  ///< as many
};

/// What a planner makes on its way to an answer: what pictures show beside the path.
struct ByProducts {
  PlannedRoadmap<Vec2> roadmap;             ///< of points and discs
  std::vector<PlannedRoadmap<Vec2>> trees;  ///< of points and discs: the trees of each leg of a path
  std::vector<PlannedRoadmap<Se2>>
      pose_roadmaps;                         ///< of turning bodies and cars: the roadmap, or the trees of each leg
  PlannedRoadmap<JointState> joint_roadmap;  ///< of arms
  std::vector<NamedLines> lines;             ///< further lines, by name
  ArcPath arcs;                              ///< of discs: the shortest path, around which the answer's is a polyline
  std::vector<HeadingCells> headings;        ///< of lattices of positions and headings
  /// Of planners that get better with time, in the plane: where the reference point went on paths that were the best so
  /// far, the oldest first, at most most_improved; curves as chords. The planner adds each path before it tells
  /// Execution::on_improvement of it, on the same thread: whoever is told may look at the last.
  PolygonSet improved;
  bool wants_certificate = false;  ///< shall there be the next one? Then the bound is what it proves
  /// Of a bound of all paths on a map, the proof.
  std::optional<CellPotential> certificate;
};

}  // namespace warren
