// SPDX-License-Identifier: BSD-3-Clause
// The walls of a maze that nobody holds, in the order of maze_walls(), which is column by column: tiles are made for
// one column of tiles after the other, twice, since the walls must be counted before the first is written. Cost: twice
// the tiles. Memory: a byte a cell of a column of tiles, for merged walls two bytes for each row of each column of
// tiles, and some MiB of walls.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {

/// Refers to the cells.
class WallStrips {
 public:
  /// merged: as of maze_walls(). Counts the walls. Throws InputError for columns of tiles of 2^32 cells and more,
  /// Stopped.
  WallStrips(const CellWallSource& cells, bool merged, const Execution& execution);

  std::uint64_t wall_count() const { return count_; }
  bool holds_floats() const;
  /// The walls as they lie in memory, piece by piece. Throws Stopped, and what `take` throws.
  void write(const std::function<void(std::string_view)>& take, const Execution& execution) const;

 private:
  /// By row, how far an upper wall goes on right of a strip.
  std::vector<std::uint32_t> beyond(std::size_t strip) const;

  const CellWallSource& cells_;
  const bool merged_;
  std::uint64_t count_ = 4;  // the outline's
  std::vector<std::uint16_t>
      runs_;  // by strip and row: cells that an upper wall at the strip's left end runs along in it
};

}  // namespace warren
