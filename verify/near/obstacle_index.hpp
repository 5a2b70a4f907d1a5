// SPDX-License-Identifier: BSD-3-Clause
// What the judges of bodies in the plane keep of a scene for which they are asked again and again: walls, sides and
// polygons in blocks of boxes (verify/near/box_blocks), so that a verdict takes as long as its path, however many walls
// there are. The judges' own: nothing of it is shared with planners and their worlds. A verdict is the same bits with
// it and without.
//
// Built in O(n log n), some seconds for 10^7 walls; 9 bytes a wall or side, and the polygons' corners.
#pragma once

#include <cstddef>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/near/box_blocks.hpp"
#include "verify/near/obstacle_sides.hpp"

namespace warren {

/// Refers to the scene, which must outlive it and stay as it is. Immutable: any number of threads may ask.
class ObstacleIndex {
 public:
  /// Throws Stopped, and InputError where there are 2^32 walls and sides or more.
  ObstacleIndex(const Scene& scene, const Execution& execution);

  const Scene& scene() const { return scene_; }
  const Obstacles& obstacles() const { return obstacles_; }
  const BoxBlocks& sides() const { return sides_; }       ///< numbers as obstacles() has them
  const BoxBlocks& rings() const { return rings_; }       ///< numbers of obstacles().rings()
  const Box& box() const { return box_; }                 ///< of walls and polygons, without the bounds
  double largest_coordinate() const { return largest_; }  ///< the largest magnitude, of the bounds too

 private:
  const Scene& scene_;
  Obstacles obstacles_;
  BoxBlocks sides_;
  BoxBlocks rings_;
  Box box_;
  double largest_ = 0.0;
};

}  // namespace warren
