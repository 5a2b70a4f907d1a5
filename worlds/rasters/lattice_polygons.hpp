// SPDX-License-Identifier: BSD-3-Clause
// Convex pieces of bodies and of what bodies sweep: a polygon as the union of convex ones, what a piece covers while it
// goes straight or turns about the origin, and Minkowski sums with a wall. Corners run counter-clockwise; a piece may
// also be one point or two.
//
// Marks lattice points that lie in, or near, convex and simple polygons: row by row, an interval each. Doubt is
// resolved towards marking: a point within a billionth of the lattice's size of an edge counts as in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

using ConvexPiece = std::vector<Vec2>;

/// The convex hull, counter-clockwise, without corners on its sides. O(n log n).
ConvexPiece convex_hull(std::vector<Vec2> points);

/// A simple polygon, either orientation, as convex pieces: itself if it is convex, else triangles. O(n^3).
std::vector<ConvexPiece> outline_pieces(std::span<const Vec2> outline);

/// What a piece covers on its straight way by `step`: exact.
ConvexPiece swept_by_step(const ConvexPiece& piece, Vec2 step);

/// What a piece covers while it turns about the origin by angle_rad (0 < angle_rad <= pi / 2), as a union. Holds all of
/// it; where the piece holds the origin, it is exceeded by less than 1e-4 of the piece's radius for angles up to 15
/// degrees (arcs are replaced by tangents); elsewhere by the hulls of eighths of the turn.
std::vector<ConvexPiece> swept_by_turn(const ConvexPiece& piece, double angle_rad);

/// The positions of the origin at which the piece touches the segment: the segment minus the piece.
ConvexPiece touching_positions(const ConvexPiece& piece, const Segment& wall);

/// The piece turned by angle `k` of n; quarter turns are exact, so bodies with that symmetry keep their corners' bits.
ConvexPiece turned(std::span<const Vec2> outline, std::uint32_t k, std::uint32_t n);

/// Where a convex body that doesn't turn would meet a convex obstacle, marked on a coarse grid of places: the rows of
/// the Minkowski sum of the obstacle and the mirrored body, whose sides are taken in the order of their directions as
/// they are merged. O(n + m + rows) for n and m corners, nothing is allocated. A guide, not a proof: doubles as they
/// come. Takes the bits of places away at which the body comes nearer to the obstacle than `reach` (>= 0), by the
/// larger of the distances in x and y, and maybe of a few more. Both run counter-clockwise, with one corner or more.
void take_blocked_places(std::span<const Vec2> obstacle, std::span<const Vec2> mirrored_body, double reach,
                         PlaceGrid& free);

/// Point (i, j) lies at origin + cell (i, j).
class LatticeMarking {
 public:
  LatticeMarking(Vec2 origin, double cell, std::uint32_t width, std::uint32_t height);

  /// The points nearer than `radius` to a convex polygon (counter-clockwise; a point or two corners too), those on it
  /// included. O(corners * rows).
  void mark_near(std::span<const Vec2> convex, double radius);
  /// The positions at which a piece, widened by `radius`, touches or leaves the bounds.
  void mark_outside(std::span<const Vec2> piece, double radius, const Box& bounds);
  /// The positions p for which p + `offset` lies inside a simple polygon. O(corners * rows that it meets). Throws
  /// Stopped.
  void mark_inside(std::span<const Vec2> polygon, Vec2 offset, const Execution& execution);

  Bitmap take() { return std::move(marked_); }

 private:
  void mark_run(std::int64_t row, double from, double to);
  double row_y(std::int64_t j) const { return origin_.y + static_cast<double>(j) * cell_; }

  Vec2 origin_;
  double cell_;
  double rounding_;  // world units
  Bitmap marked_;
};

// From cells to walls and back: the borders between blocked and free cells as segments, the longest that there are, and
// the cells that walls and polygons touch.

/// In world coordinates, horizontal ones first, row by row; what lies outside of the map is blocked. A point that does
/// not touch them stays among free cells, or among blocked ones. O(cells / 64 + segments). Throws
/// Stopped.
std::vector<Segment> border_walls(const OccupancyMap& map, const Execution& execution);

/// Gives a scene that is a map its border walls, for planners and pictures of walls; does nothing to other scenes.
void add_map_walls(Scene& scene, const Execution& execution);
/// The scene with them: itself where it has walls or is no map, else `copy`.
const Scene& with_map_walls(const Scene& scene, std::optional<Scene>& copy, const Execution& execution);

/// The scene as cells of a given side from the lower corner of its bounds, or of its obstacles' box: a cell is blocked
/// if its closed square touches a wall or a polygon (its inside too). Throws InputError for cells beside 0 or more than
/// 2^32 of them, and for scenes without extent; Stopped.
OccupancyMap map_of_scene(const Scene& scene, double cell, const Execution& execution);

}  // namespace warren
