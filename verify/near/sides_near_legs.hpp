// SPDX-License-Identifier: BSD-3-Clause
// Which obstacles come into question for the legs of a path, for its verification: own code, nothing from spatial/ and
// nothing of what planners ask. The path is cut into boxes. Among walls and polygons one pass over all obstacles drops
// those that meet none, by a tree of these boxes, and what is left is filed in a tree of its own: O(obstacles log legs)
// once, then what lies near a leg. On a map there is nothing to file: the sides of blocked cells are read from the bits
// around a box, 64 columns at a time, so a map is never looked at but near the path.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {

/// A side of an obstacle.
struct NearSide {
  Segment segment;
  std::uint64_t number = 0;  ///< of Obstacles; on a map the blocked cell's, row by row, or `outside`
  static constexpr std::uint64_t outside = ~std::uint64_t{0};
};

/// Refers to scene and obstacles, which must outlive it. Any number of threads may gather.
class PathSurroundings {
 public:
  /// One pass over all obstacles; none with their index, which must outlive it. On a map its walls are not looked at.
  /// Throws Stopped.
  PathSurroundings(const Scene& scene, const Obstacles& obstacles, const ObstacleIndex* index,
                   const Execution& execution);

  /// Of all walls and polygons, or of the map.
  const Box& box() const { return extent_.box; }
  double largest_coordinate() const { return extent_.largest_coordinate(); }

  /// To be called before gather(): with all boxes that it will be asked for, in any number of calls.
  void file(std::span<const Box> boxes, const Execution& execution);
  /// All sides whose boxes meet one of these, by number; on a map perhaps some others.
  void gather(std::span<const Box> boxes, std::vector<NearSide>& sides, const Execution& execution) const;
  std::string name(std::uint64_t number) const;

 private:
  void gather_from_map(const Box& box, std::vector<NearSide>& sides, const Execution& execution) const;
  void gather_from_word(std::int64_t y, std::int64_t w, std::uint64_t wanted, std::vector<NearSide>& sides,
                        const Execution& execution) const;
  std::uint64_t blocked_word(std::int64_t y, std::int64_t w) const;
  std::uint64_t number_of(std::int64_t x, std::int64_t y) const;

  const Scene& scene_;
  const Obstacles& obstacles_;
  const ObstacleIndex* index_;
  ObstacleExtent extent_;
  RawVector<std::size_t> near_;          // numbers of the obstacles that meet one of the filed boxes; without an index
  std::optional<BoxBlocks> near_sides_;  // of near_
};

}  // namespace warren
