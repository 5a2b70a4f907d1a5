// SPDX-License-Identifier: BSD-3-Clause
// Spheres and boxes in space: how far is a capsule's spine from them? Up to 32 are looked at one after the other, by
// the balls around them first; more are indexed by a box tree, so that the cost grows with the logarithm of their
// number where they are scattered. bench/arm_bench.cpp has it beside a plain loop.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/whole.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "spatial/obstacles/box_tree.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
// Distances in space between a straight segment, the spine of a capsule, and a point, a box, another segment: exact up
// to rounding, without iteration. A capsule of radius r keeps d from something when its spine keeps d + r.

/// From a over the whole of `way`; may have length zero.
struct Spine {
  Vec3 a;
  Vec3 way;
  double inverse_square;  ///< of its length; 0 where that is too short to divide by

  Spine(const Vec3& from, const Vec3& to) : a(from), way(to - from) {
    constexpr double shortest_square = 1e-200;
    const double square = way.squaredNorm();
    inverse_square = square > shortest_square ? 1.0 / square : 0.0;
  }
  Vec3 nearest(const Vec3& p) const { return a + std::clamp((p - a).dot(way) * inverse_square, 0.0, 1.0) * way; }
};

/// Square of the distance from a point.
inline double distance_square(const Spine& spine, const Vec3& p) {
  const Vec3 to = p - spine.a;
  const double t = std::clamp(to.dot(spine.way) * spine.inverse_square, 0.0, 1.0);
  return (to - t * spine.way).squaredNorm();
}

/// From a closed box with faces square to the axes; 0 where they meet. The square is convex and piecewise quadratic
/// along the segment, with its breaks where a coordinate passes a face: the piece in which its slope turns is solved.
double distance_square(const Spine& spine, const SolidBox& box);

/// From another segment; 0 where they cross.
double distance_square(const Spine& s, const Spine& t);

/// How near a segment comes to an obstacle.
struct Approach {
  double distance;  ///< from surface to segment; below 0 where it enters a ball
  Vec3 outward;     ///< of length 1, from a ball's centre to the segment's nearest point; zero where nobody knows
  Vec3 centre;      ///< of the ball; unused where outward is zero
  double radius;
};

/// Immutable after construction; any number of threads may ask.
class SolidIndex {
 public:
  /// Copies the obstacles. Throws InputError for numbers that are not finite, negative radii and boxes upside down,
  /// Stopped.
  SolidIndex(std::span<const Sphere> spheres, std::span<const SolidBox> boxes, const Execution& execution = {});

  std::size_t size() const { return solids_.size(); }
  /// Distance from the segment to the nearest obstacle; anything above `enough` when it is more.
  double distance(const Spine& spine, double enough) const;
  /// Calls visit(Approach) for the obstacles at most `reach` away from the segment, and maybe some that are farther.
  /// What visit returns is the new reach, not larger than the last one; a negative number ends the search.
  template <class Visit>
  void for_each_within(const Spine& spine, double reach, const Visit& visit) const {
    if (tree_.size() == 0) {
      visit_one_by_one(spine, reach, visit);
      return;
    }
    tree_.search(box_around(spine), reach, [&](std::uint32_t place) { return visit(approach(spine, solids_[place])); });
  }
  /// The largest coordinate of an obstacle, without sign.
  double extent() const { return extent_; }

 private:
  static constexpr std::int32_t no_box = -1;
  static constexpr std::size_t most_without_tree = 32;
  /// Of a box: the ball around it.
  struct Solid {
    Vec3 centre;
    double radius;
    std::int32_t box;  // in boxes_, or no_box
  };
  static BoxOf<3> box_around(const Spine& spine);
  Approach approach(const Spine& spine, const Solid& solid) const {
    if (solid.box != no_box) return box_approach(spine, boxes_[as_whole<std::size_t>(solid.box)]);
    const Vec3 off = spine.nearest(solid.centre) - solid.centre;
    const double length = off.norm();
    return {length - solid.radius, length > 0.0 ? Vec3(off / length) : Vec3::Zero(), solid.centre, solid.radius};
  }
  /// More exactly than by the spine's middle, and for half of what an approach costs.
  static bool is_beyond(const Spine& spine, const Solid& solid, double reach) {
    const double within = reach + solid.radius;
    return distance_square(spine, solid.centre) > within * within;
  }
  static Approach box_approach(const Spine& spine, const SolidBox& box);
  /// A ball is as far from the spine as from its middle, less half its length, at least. The one nearest to the middle
  /// comes first: where its visit leaves less reach, most of the others need none.
  template <class Visit>
  void visit_one_by_one(const Spine& spine, double reach, const Visit& visit) const {
    std::array<double, most_without_tree> squares;
    const std::size_t count = solids_.size();
    const std::size_t first = squares_from(spine.a + 0.5 * spine.way, squares);
    const double half = 0.5 * spine.way.norm();
    for (std::size_t turn = 0; turn < count; ++turn) {
      const std::size_t i = turn == 0 ? first : turn <= first ? turn - 1 : turn;
      const Solid& solid = solids_[i];
      const double within = reach + half + solid.radius;
      if (squares[i] > within * within || is_beyond(spine, solid, reach)) continue;
      reach = visit(approach(spine, solid));
      if (reach < 0.0) return;
    }
  }
  /// Squares of the balls' middles' distances from p; which is the least.
  std::size_t squares_from(const Vec3& p, std::array<double, most_without_tree>& squares) const;

  std::vector<SolidBox> boxes_;
  std::vector<Solid> solids_;                   // in the tree's order, where there is one
  std::array<std::vector<double>, 3> middles_;  // theirs, coordinate by coordinate; only without a tree
  BoxTree<3> tree_;                             // of many
  double extent_ = 0.0;
};

}  // namespace warren
