// SPDX-License-Identifier: BSD-3-Clause
// The walls of a maze as the judge keeps them when it has seen each of them once: a line of the grid has a bit for each
// unit of it, lines x = 0.5, 1.5, ... by column, and y = 0.5, ... by row. Two bits a cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "parallel/chunks.hpp"
#include "parallel/execution.hpp"
#include "verify/cells/looked_up_walls.hpp"

namespace warren {

class JudgedGridLines : public LookedUpWalls {
 public:
  /// Of walls that are held and may be let go. Throws InputError for those that no such maze has, or that do not reach
  /// to all its sides, for then a path is kept in a smaller box; Stopped.
  JudgedGridLines(const WallSet& walls, std::uint32_t rows, std::uint32_t cols, const Execution& execution);
  unsigned walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const override;

 protected:
  /// No wall yet. held: rows of cells whose walls are kept; no others are asked for, but for the walls above the row
  /// below the first.
  JudgedGridLines(std::uint32_t rows, std::uint32_t cols, unsigned side_log2, Range held, const Execution& execution);
  /// Unit by unit, from one end to the other. Throws InputError naming `where`, Stopped.
  void take(const std::string& where, double x1, double y1, double x2, double y2, const Execution& execution);

 private:
  const Range held_;
  std::uint64_t units_ = 0;  // taken so far
  RawVector<std::uint64_t> upright_;
  RawVector<std::uint64_t> level_;
};

}  // namespace warren
