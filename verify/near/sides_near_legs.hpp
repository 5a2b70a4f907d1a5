// SPDX-License-Identifier: BSD-3-Clause
// Which obstacles come into question for the legs of a path, for its verification: own code, nothing from spatial/ and
// nothing of what planners ask. The path is cut into boxes. Among walls and polygons a coarse grid over the boxes is
// marked where they lie, one pass over all obstacles drops those that meet no mark, and what is left is filed in the
// marked cells: O(obstacles) once, then what lies near a leg. On a map there is nothing to file: the sides of blocked
// cells are read from the bits around a box, 64 columns at a time, so a map is never looked at but near the path.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

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
  /// All sides that meet one of the boxes, and perhaps some others.
  void gather(std::span<const Box> boxes, std::vector<NearSide>& sides, const Execution& execution) const;
  std::string name(std::uint64_t number) const;

 private:
  struct Range {  // of the grid's cells, both ends included; empty where first_x > last_x
    std::uint32_t first_x, first_y, last_x, last_y;
    bool overlaps(const Range& o) const {
      return first_x <= o.last_x && o.first_x <= last_x && first_y <= o.last_y && o.first_y <= last_y;
    }
    friend auto operator<=>(const Range&, const Range&) = default;
    std::uint64_t count() const { return std::uint64_t{last_x - first_x + 1} * (last_y - first_y + 1); }
  };
  void lay_grid(std::span<const Box> boxes, const Execution& execution);
  Range range_of(const Box& box) const;
  bool is_marked(const Range& range) const;
  template <class Visit>
  void for_each_cell(const Range& range, const Visit& visit) const;
  std::optional<std::vector<std::size_t>> may_be_marked(std::span<const Box> boxes, const Execution& execution) const;
  void sift(const std::optional<std::vector<std::size_t>>& numbers, const Execution& execution);
  void file_in_cells(const Execution& execution);
  void gather_from_map(const Box& box, std::vector<NearSide>& sides, const Execution& execution) const;
  void gather_from_word(std::int64_t y, std::int64_t w, std::uint64_t wanted, std::vector<NearSide>& sides,
                        const Execution& execution) const;
  std::uint64_t blocked_word(std::int64_t y, std::int64_t w) const;
  std::uint64_t number_of(std::int64_t x, std::int64_t y) const;

  const Scene& scene_;
  const Obstacles& obstacles_;
  const ObstacleIndex* index_;
  ObstacleExtent extent_;
  Box grid_;  // of the boxes
  double side_ = 1.0;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  std::vector<bool> marked_;
  std::vector<NearSide> near_;
  std::vector<NearSide> long_;          // across many cells: looked at each time
  std::vector<std::uint32_t> begin_;    // by cell, of members_
  std::vector<std::uint32_t> members_;  // of near_
};

}  // namespace warren
