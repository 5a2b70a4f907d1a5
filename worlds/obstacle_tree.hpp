// SPDX-License-Identifier: BSD-3-Clause
// How far is a polygon from the obstacles of the plane? Sides of polygons and walls in one box tree, polygons in a
// second one. Distances are those of core/polygon_distance, less a bound of their rounding; only obstacles nearer than
// the best so far are looked at, so the cost grows with their density around the body, not with their number.
// A pair of sides costs 15 ns.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "spatial/box_tree.hpp"
#include "worlds/scene.hpp"

namespace warren {

/// A polygon body where it stands: corners, the vectors to the next ones, and the box.
class Footprint {
 public:
  explicit Footprint(std::size_t corners) : corners_(corners), sides_(corners) {}

  std::span<Vec2> corners() { return corners_; }
  std::span<const Vec2> corners() const { return corners_; }
  std::span<const Vec2> sides() const { return sides_; }
  const Box& box() const { return box_; }
  /// To be called when all corners are set.
  void finish();

 private:
  std::vector<Vec2> corners_;
  std::vector<Vec2> sides_;
  Box box_;
};

/// Immutable after construction; any number of threads may query.
class ObstacleTree {
 public:
  /// Copies walls, polygons and bounds. `reach`: no body will be further than so much outside the world's box.
  ObstacleTree(const Scene& scene, double reach);

  /// A lower bound of the distance between the body and the nearest obstacle, within 1e-13 of the coordinates' size;
  /// <= 0 where they touch or overlap, or the body is not wholly in the bounds. Where the distance exceeds `enough`
  /// (>= 0), any number above `enough`.
  double clearance(const Footprint& body, double enough) const;

  const std::optional<Box>& bounds() const { return bounds_; }
  /// The box of walls and polygons; empty without any.
  const Box& obstacle_box() const { return box_; }
  std::size_t side_count() const { return sides_.size(); }
  std::size_t bytes() const;

 private:
  struct Side {
    Vec2 a;
    Vec2 along;                // to the other end
    double inverse_length_sq;  // 0 for sides of length zero
  };
  static Side side_between(Vec2 a, Vec2 b);
  static double distance_sq(const Footprint& body, const Side& side);
  bool swallows(const Footprint& body) const;
  void file_sides(const std::vector<Segment>& sides);
  void file_polygons(const Scene& scene);

  std::optional<Box> bounds_;
  Box box_;
  double rounding_ = 0.0;  // no distance is computed further than this from the true one
  BoxTree<2> side_tree_;
  std::vector<Side> sides_;  // in the tree's order
  BoxTree<2> polygon_tree_;
  std::vector<std::vector<Vec2>> polygons_;  // in the tree's order
};

}  // namespace warren
