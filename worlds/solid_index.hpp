// SPDX-License-Identifier: BSD-3-Clause
// Spheres and boxes in space, indexed by a box tree so that a capsule looks only at those near it: its cost grows with
// the logarithm of their number where they are scattered. bench/arm_bench.cpp has it beside a plain loop.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "spatial/box_tree.hpp"
#include "worlds/scene.hpp"
#include "worlds/solid_distance.hpp"

namespace warren {

/// How much room a capsule has.
enum class Room : std::uint8_t { blocked, narrow, clear };

/// Immutable after construction; any number of threads may ask.
class SolidIndex {
 public:
  /// Copies the obstacles. Throws InputError for numbers that are not finite, negative radii and boxes upside down.
  SolidIndex(std::span<const Sphere> spheres, std::span<const SolidBox> boxes);

  std::size_t size() const { return tree_.size(); }
  /// Distance from the segment to the nearest obstacle; anything above `enough` when it is more.
  double distance(const Spine& spine, double enough) const;
  /// blocked: some obstacle is at most `touch` away; clear: all are farther than `enough`, which is >= touch.
  Room room(const Spine& spine, double touch, double enough) const;
  /// The largest coordinate of an obstacle, without sign.
  double extent() const { return extent_; }

 private:
  static constexpr std::int32_t no_box = -1;
  struct Solid {
    Vec3 centre;
    double radius;
    std::int32_t box;  // in boxes_, or no_box
  };
  /// Is the segment at most `reach` from it?
  bool is_within(const Spine& spine, const Solid& solid, double reach) const {
    const double whole = reach + solid.radius;
    return solid.box == no_box ? distance_square(spine, solid.centre) <= whole * whole
                               : distance_square(spine, boxes_[static_cast<std::size_t>(solid.box)]) <= whole * whole;
  }

  std::vector<SolidBox> boxes_;
  std::vector<Solid> solids_;  // in the tree's order
  BoxTree<3> tree_;
  double extent_ = 0.0;
};

}  // namespace warren
