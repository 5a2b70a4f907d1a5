// SPDX-License-Identifier: BSD-3-Clause
// Mazes of any size from a seed, the same bits on every machine. Cell (c, r) is the unit square around the integer
// point (c, r), c in 1..cols, r in 1..rows; the outline opens at the left of (1, 1) and at the right of (cols, rows).
// Serial by nature; scratch is at most 2 bytes a cell for the backtracker.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "worlds/scene.hpp"

namespace warren {

enum class MazeAlgorithm : std::uint8_t { backtracker, kruskal, prim, wilson, course };

std::string_view name_of(MazeAlgorithm algorithm);
/// Throws InputError naming the known algorithms.
MazeAlgorithm maze_algorithm_named(std::string_view name);

struct MazeOptions {
  std::uint32_t rows = 41;  ///< >= 1; rows * cols < 2^32
  std::uint32_t cols = 41;  ///< >= 1
  std::uint64_t seed = 1;
  MazeAlgorithm algorithm = MazeAlgorithm::backtracker;
  double loops = 0.0;  ///< fraction in [0, 1] of the interior walls left that are taken out, chosen by the seed
};

/// The maze as bits: which walls stand. Two bits a cell: wall to the right, wall above.
class MazeCells {
 public:
  MazeCells(std::uint32_t rows, std::uint32_t cols);
  std::uint32_t rows() const { return rows_; }
  std::uint32_t cols() const { return cols_; }
  /// Cell numbers are zero-based here: column 0 .. cols - 1, row 0 .. rows - 1 (row 0 is the lowest).
  bool wall_right(std::uint32_t col, std::uint32_t row) const;
  bool wall_above(std::uint32_t col, std::uint32_t row) const;
  void open_right(std::uint32_t col, std::uint32_t row);
  void open_above(std::uint32_t col, std::uint32_t row);

 private:
  std::uint32_t rows_;
  std::uint32_t cols_;
  RawVector<std::uint8_t> bits_;
};

/// Throws InputError for sizes out of range, Stopped at the deadline or when memory would pass its limit.
MazeCells generate_maze(const MazeOptions& options, const Execution& execution);

/// The walls in the course's order: four outline segments, then unit walls column by column, a cell's right wall before
/// its upper one. merged: interior walls that join in a line become one segment.
WallSet maze_walls(const MazeCells& cells, bool merged, const Execution& execution);

/// A scene with walls, maze hint, start (0.5, 1) and goal (cols + 0.5, rows).
Scene maze_scene(const MazeOptions& options, bool merged, const Execution& execution);

/// Reads the cells back from walls that lie on the unit grid; nothing is assumed of their order or how they are cut.
/// Throws InputError("maze", ...) if a wall is off the grid or outside the box.
MazeCells cells_of_walls(const WallSet& walls, MazeHint hint, const Execution& execution);

/// Can one walk from cell a to cell b (zero-based {col, row})? Breadth-first flood, O(cells): the proof behind
/// Outcome::infeasible.
bool flood_connects(const MazeCells& cells, std::pair<std::uint32_t, std::uint32_t> a,
                    std::pair<std::uint32_t, std::uint32_t> b, const Execution& execution);

}  // namespace warren
