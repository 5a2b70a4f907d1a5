// SPDX-License-Identifier: BSD-3-Clause
// Mazes of any size from a seed, the same bits on every machine. Cell (c, r) is the unit square around the integer
// point (c, r), c in 1..cols, r in 1..rows; the outline opens at the left of (1, 1) and at the right of (cols, rows).
// Carving is serial by nature and needs, cells included, 1 byte a cell for backtracker and wilson, 1 and the frontier
// for prim, 13 for kruskal and 5 for course; mst (spanning_maze.hpp) and all else is parallel.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/raw_vector.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// How a maze is made; mst is the one whose walls can be made piece by piece.
enum class MazeAlgorithm : std::uint8_t { backtracker, kruskal, prim, wilson, course, mst };
constexpr auto enum_names(MazeAlgorithm) {
  return std::array<std::string_view, 6>{"backtracker", "kruskal", "prim", "wilson", "course", "mst"};
}
/// Throws InputError naming the known algorithms.
MazeAlgorithm maze_algorithm_named(std::string_view name);

/// Which maze: the same bits for the same options, everywhere.
struct MazeOptions {
  std::uint32_t rows = 41;                               ///< >= 1; rows * cols < 2^32
  std::uint32_t cols = 41;                               ///< >= 1
  std::uint64_t seed = 1;                                ///< any value
  MazeAlgorithm algorithm = MazeAlgorithm::backtracker;  ///< what makes it
  double loops = 0.0;  ///< fraction in [0, 1] of the interior walls left that are taken out, chosen by the seed (mst:
                       ///< each by itself)
};

/// The maze as bits: which walls stand. One byte a cell, column after column, the cells of a column from low to high, a
/// gap byte before each column and after the last; so a neighbour is one index away and every index has a lower and an
/// upper neighbour. The outline counts as standing (its two openings are not cells' business), gap bytes have all
/// walls.
class MazeCells {
 public:
  static constexpr std::uint8_t right_wall = 1;  ///< bit of a cell's byte
  static constexpr std::uint8_t upper_wall = 2;  ///< bit of a cell's byte
  static constexpr std::uint8_t all_walls = 3;   ///< other bits are scratch of the generators, 0 outside them

  /// All walls stand. Throws InputError unless rows, cols >= 1 and rows * cols < 2^32; asks `execution` for the memory,
  /// rows * cols + cols + 1 bytes.
  MazeCells(std::uint32_t rows, std::uint32_t cols, const Execution& execution = {});
  std::uint32_t rows() const { return rows_; }                               ///< of cells
  std::uint32_t cols() const { return cols_; }                               ///< of cells
  std::uint64_t cell_count() const { return std::uint64_t{rows_} * cols_; }  ///< rows() * cols()
  /// Cell numbers are zero-based here: column 0 .. cols - 1, row 0 .. rows - 1 (row 0 is the lowest).
  bool wall_right(std::uint32_t col, std::uint32_t row) const { return (bits_[index(col, row)] & right_wall) != 0; }
  /// As wall_right().
  bool wall_above(std::uint32_t col, std::uint32_t row) const { return (bits_[index(col, row)] & upper_wall) != 0; }
  /// Interior walls only: col + 1 < cols().
  void open_right(std::uint32_t col, std::uint32_t row) {
    assert(col + 1 < cols_);
    open(index(col, row), right_wall);
  }
  /// Interior walls only: row + 1 < rows().
  void open_above(std::uint32_t col, std::uint32_t row) {
    assert(row + 1 < rows_);
    open(index(col, row), upper_wall);
  }

  /// For kernels: the bytes, where a cell's byte lies, and how far apart the bytes of neighbours in a row are.
  std::span<std::uint8_t> bytes() { return bits_; }
  /// The same, to be read.
  std::span<const std::uint8_t> bytes() const { return bits_; }
  /// From a cell's byte to that of the cell on its right.
  std::size_t stride() const { return std::size_t{rows_} + 1; }
  /// Where a cell's byte lies in bytes().
  std::size_t index(std::uint32_t col, std::uint32_t row) const { return 1 + col * stride() + row; }

 private:
  void open(std::size_t i, std::uint8_t wall) { bits_[i] = static_cast<std::uint8_t>(bits_[i] & ~wall); }

  std::uint32_t rows_;
  std::uint32_t cols_;
  RawVector<std::uint8_t> bits_;
};

/// Throws InputError for sizes and loops out of range, Stopped at the deadline or when memory would pass its limit.
MazeCells generate_maze(const MazeOptions& options, const Execution& execution);

/// The walls in the course's order: four outline segments (bottom, top, left from y = 1.5 up, right up to rows - 0.5),
/// then unit walls column by column, a cell's right wall before its upper one, ends in ascending order. merged:
/// interior walls that join in a line become one segment, which stands where its first unit wall stood. Packed below
/// 2^18 rows and columns, floats up to 2^23, doubles beyond.
WallSet maze_walls(const MazeCells& cells, bool merged, const Execution& execution);

/// The outline's walls as maze_walls() has them, open at the two doors. Of sides that a Wall's numbers hold.
template <class Wall>
std::array<Wall, 4> maze_outline(std::uint32_t rows, std::uint32_t cols) {
  const double right = cols + 0.5;
  const double top = rows + 0.5;
  return {Wall::of(0.5, 0.5, right, 0.5), Wall::of(0.5, top, right, top), Wall::of(0.5, 1.5, 0.5, top),
          Wall::of(right, 0.5, right, top - 1.0)};
}

/// Bytes of a wall that maze_walls() makes for so many rows and columns.
std::size_t maze_wall_bytes(std::uint32_t rows, std::uint32_t cols);

/// Are these, to the bit, the walls that maze_walls() makes of the cells, not merged? Makes no more
/// than some thousand of them at once.
bool has_maze_walls(const WallSet& walls, const MazeCells& cells, const Execution& execution);

/// The walls of a maze that nobody holds, in the order of maze_walls(), which is column by column: tiles are made for
/// one column of tiles after the other, twice, since the walls must be counted before the first is written. Cost: twice
/// the tiles. Memory: a byte a cell of a column of tiles, for merged walls two bytes for each row of each column of
/// tiles, and some MiB of walls. Refers to the cells.
class WallStrips {
 public:
  /// merged: as of maze_walls(). Counts the walls. Throws InputError for columns of tiles of 2^32 cells and more,
  /// Stopped.
  WallStrips(const CellWallSource& cells, bool merged, const Execution& execution);

  std::uint64_t wall_count() const { return count_; }  ///< with the outline's four
  bool holds_floats() const;                           ///< else doubles
  /// The walls as they lie in memory, piece by piece. Throws Stopped, and what `take` throws.
  void write(const std::function<void(std::string_view)>& take, const Execution& execution) const;

 private:
  /// Calls take(span of Wall) for the walls, piece by piece.
  template <class Wall, class Take>
  void for_each_piece(const Take& take, const Execution& execution) const;
  /// By row, how far an upper wall goes on right of a strip.
  std::vector<std::uint32_t> beyond(std::size_t strip) const;

  const CellWallSource& cells_;
  const bool merged_;
  std::uint64_t count_ = 4;  // the outline's
  /// By strip and row: cells that an upper wall at the strip's left end runs along in it.
  std::vector<std::uint16_t> runs_;
};

/// Makes the scene one of a maze of this size: its hint, start (0.5, 1) and goal (cols + 0.5, rows).
void set_maze(Scene& scene, MazeHint maze);

/// A scene with the walls, and all that set_maze() sets.
Scene maze_scene(const MazeOptions& options, bool merged, const Execution& execution);

/// The scene of a maze of the algorithm mst with its walls left out: O(1), of any size below 2^27 x 2^27. Throws
/// InputError for sizes and loops out of range.
Scene unmade_maze_scene(const MazeOptions& options);

/// The first wall that a maze of this size can't have (off the unit grid, oblique or outside the box), if any:
/// O(walls), in parallel. Walls of length zero at a grid point are allowed and mean nothing.
std::optional<std::size_t> first_wall_off_grid(const WallSet& walls, MazeHint hint, const Execution& execution);

/// Reads the cells back from walls that lie on the unit grid; nothing is assumed of their order, direction or how they
/// are cut. Throws InputError("maze", ...) if a wall is off the grid or outside the box.
MazeCells cells_of_walls(const WallSet& walls, MazeHint hint, const Execution& execution);

/// Can one walk from cell a to cell b (zero-based {col, row})? Breadth-first flood, O(cells) time, 1 byte a cell: the
/// proof behind Outcome::infeasible. Throws InputError for cells outside the maze.
bool flood_connects(const MazeCells& cells, std::pair<std::uint32_t, std::uint32_t> a,
                    std::pair<std::uint32_t, std::uint32_t> b, const Execution& execution);

/// Tells a maze by its walls alone, in whatever order and direction they come, whole or in pieces: for files that have
/// no place to say what they hold. The size of the maze of the course: all walls on its grid, and its outline closed
/// but for the entrance in the first row of the left side and the exit in the last row of the right one. Nothing for
/// other walls. Two passes over the walls, and a sort of those on the outline. Throws Stopped.
std::optional<MazeHint> maze_of_walls(const WallSet& walls, const Execution& execution);

/// A maze that is held, given tile by tile: what makes every maze of the generators a world whose walls are made when
/// they are asked for. And the way back.
class HeldCells : public CellWallSource {
 public:
  /// Tiles of 2^side_log2 cells a side.
  HeldCells(MazeCells cells, unsigned side_log2)
      : CellWallSource(cells.rows(), cells.cols(), side_log2), cells_(std::move(cells)) {}
  /// Of a thread. The cells must outlive it.
  std::unique_ptr<CellWallReader> reader() const override { return std::make_unique<Reader>(*this); }

 private:
  class Reader : public CellWallReader {
   public:
    explicit Reader(const HeldCells& held) : held_(held) {}
    void read(std::size_t number, CellTile& tile) override {
      held_.place(number, tile);
      const MazeCells& cells = held_.cells_;
      for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile.height}; ++row) {
        for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{tile.width}; ++col) {
          const std::ptrdiff_t c = std::ptrdiff_t{tile.first_col} + col;
          const std::ptrdiff_t r = std::ptrdiff_t{tile.first_row} + row;
          std::uint8_t& walls = tile.walls[tile.index(col, row)];
          walls = c < 0 ? CellTile::right_wall : CellTile::upper_wall;
          if (c < 0 || r < 0) continue;
          walls = cells.bytes()[cells.index(static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(r))];
        }
      }
      // The outline opens left of the first cell and right of the last.
      if (number == 0) tile.walls[tile.index(-1, 0)] = 0;
      if (number + 1 < held_.tile_count()) return;
      tile.walls[tile.index(tile.width - 1, tile.height - 1)] &= CellTile::upper_wall;
    }

   private:
    const HeldCells& held_;
  };

  MazeCells cells_;
};

/// Copies the tiles first, first + step, ... of a source into cells whose column 0 is its column `first_col`; `copied`
/// is told of each cell. Throws Stopped.
void copy_tiles(const CellWallSource& source, std::size_t first, std::size_t step, std::uint32_t first_col,
                MazeCells& cells, const Execution& execution, Progress* copied = nullptr);

/// All cells of a source. Throws InputError for 2^32 cells and more, Stopped.
MazeCells cells_from(const CellWallSource& source, const Execution& execution);

}  // namespace warren
