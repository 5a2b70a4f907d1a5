// SPDX-License-Identifier: BSD-3-Clause
// Mazes that join regions of cells: randomised Kruskal, the biased one of the course, and the minimum spanning tree.

#include <algorithm>
#include <limits>

#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_carving.hpp"
#include "scenes/mazes/spanning_maze.hpp"

namespace warren::maze {
namespace {

__extension__ using Wide = unsigned __int128;

/// A number in [0, n); there may be more than 2^32 walls.
std::size_t below(std::size_t n, SequentialRng& rng) {
  return static_cast<std::size_t>(static_cast<Wide>(rng.next()) * n >> 64);
}

/// All interior walls: twice the index of the cell that owns the wall, plus 1 for its upper one.
template <class Id>
RawVector<Id> wall_numbers(const MazeCells& cells, const Execution& execution) {
  const std::uint64_t count = 2 * cells.cell_count() - cells.rows() - cells.cols();
  RawVector<Id> walls(count);
  std::size_t n = 0;
  for (std::uint32_t col = 0; col < cells.cols(); ++col) {
    for (std::uint32_t row = 0; row < cells.rows(); ++row) {
      const std::size_t i = cells.index(col, row);
      if ((i & 0xffffU) == 0) execution.check();
      if (col + 1 < cells.cols()) walls[n++] = static_cast<Id>(2 * i);
      if (row + 1 < cells.rows()) walls[n++] = static_cast<Id>(2 * i + 1);
    }
  }
  return walls;
}

template <class Id>
void carve(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  execution.reserve((2 * cells.cell_count() + cells.bytes().size()) * sizeof(Id));
  RawVector<Id> walls = wall_numbers<Id>(cells, execution);
  Regions<Id> regions(cells.bytes().size(), execution);
  const Steps at(cells);
  SequentialRng rng(seed);
  StepPoll poll(execution);
  std::size_t left = walls.size();
  for (std::uint64_t carved = 1; carved < cells.cell_count();) {
    poll.step(carved);
    const std::size_t drawn = below(left, rng);
    const Id wall = walls[drawn];
    walls[drawn] = walls[--left];
    const auto i = static_cast<Id>(wall / 2);
    const unsigned d = wall % 2;
    if (!regions.join(i, static_cast<Id>(at.neighbour(i, d)))) continue;
    at.open(i, d);
    ++carved;
  }
}

/// Cells, numbered column by column from 0, and their place counted from 1 as the course does.
struct Place {
  std::uint64_t col, row;
};

/// Square blocks of side min(rows, cols) / parts, a rational number: parts is the least odd number >= 3 that makes it
/// 12 at most. Even blocks prefer to open upwards and downwards, odd ones sideways.
class Blocks {
 public:
  Blocks(std::uint64_t rows, std::uint64_t cols) : side_(std::min(rows, cols)) {
    while (side_ > 12 * parts_) parts_ += 2;
    blocks_across_ = block_of(cols);
  }
  bool is_even(Place p) const { return (block_of(p.row) * blocks_across_ + block_of(p.col)) % 2 == 0; }

 private:
  std::uint64_t block_of(std::uint64_t k) const { return (k * parts_ + side_ - 1) / side_; }
  std::uint64_t side_;
  std::uint64_t parts_ = 3;
  std::uint64_t blocks_across_ = 0;
};

class CourseCarver {
 public:
  CourseCarver(MazeCells& cells, std::uint64_t seed, const Execution& execution)
      : cells_(cells),
        at_(cells),
        regions_(cells.cell_count(), execution),
        blocks_(cells.rows(), cells.cols()),
        rng_(seed) {}

  /// Draws a cell and one of its walls; true if that wall was taken out.
  bool try_wall() {
    const std::uint32_t cell = draw_cell();
    const Place p = place(cell);
    const unsigned d = draw_direction(p);
    if (!has_neighbour(p, d)) return false;
    const auto col = static_cast<std::uint32_t>(p.col - 1);
    const auto row = static_cast<std::uint32_t>(p.row - 1);
    const std::uint32_t rows = cells_.rows();
    const std::uint32_t neighbour = d == 0 ? cell + rows : d == 1 ? cell + 1 : d == 2 ? cell - rows : cell - 1;
    if (!regions_.join(cell, neighbour)) return false;
    at_.open(cells_.index(col, row), d);
    return true;
  }

 private:
  static constexpr int draws = 15;

  Place place(std::uint32_t cell) const { return {cell / cells_.rows() + 1U, cell % cells_.rows() + 1U}; }

  std::uint32_t draw_cell() {
    const std::uint32_t home = regions_.root(0);
    std::uint32_t best = 0;
    std::uint64_t best_key = ~std::uint64_t{0};
    for (int k = 0; k < draws; ++k) {
      const auto cell = static_cast<std::uint32_t>(rng_.below(cells_.cell_count()));
      const Place p = place(cell);
      const std::uint64_t joined = regions_.root(cell) == home ? 1 : 0;
      const std::uint64_t key = joined << 40 | (p.col + p.row);
      if (key < best_key) {
        best_key = key;
        best = cell;
      }
    }
    return best;
  }

  unsigned draw_direction(Place p) {
    constexpr std::array<unsigned, 4> plain{2, 0, 3, 1};  // the course's 1 .. 4: -x, +x, -y, +y
    const std::uint64_t drawn = rng_.below(8);
    if (drawn < 4) return plain[drawn];
    const unsigned backward = blocks_.is_even(p) ? 3 : 2;
    return drawn < 6 ? backward : backward ^ 2U;
  }

  bool has_neighbour(Place p, unsigned d) const {
    switch (d) {
      case 0:
        return p.col < cells_.cols();
      case 1:
        return p.row < cells_.rows();
      case 2:
        return p.col > 1;
      default:
        return p.row > 1;
    }
  }

  const MazeCells& cells_;
  Steps at_;
  Regions<std::uint32_t> regions_;
  Blocks blocks_;
  SequentialRng rng_;
};

}  // namespace

/// Randomised Kruskal: the interior walls in random order, each taken out if it parts two regions. Many short dead
/// ends. The order is a Fisher-Yates shuffle done as it is consumed, so it ends with the last join. O(cells) in
/// practice, about 12 bytes a cell besides the cells (two wall numbers and one parent), 24 from 2^31 bytes of cells on.
void carve_kruskal(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  if (cells.bytes().size() <= std::numeric_limits<std::uint32_t>::max() / 2) {
    carve<std::uint32_t>(cells, seed, execution);
  } else {
    carve<std::uint64_t>(cells, seed, execution);
  }
}

/// The maze generator of the robotics course whose assignment started this project: a biased randomised Kruskal. Of 15
/// cells drawn at random the one is taken that is not yet joined to the first cell, then that nearest to it (col +
/// row), then the first drawn; one of its walls is drawn with a preference that changes from block to block, and goes
/// if it parts two regions. So growth starts near the entrance, and patches of long horizontal and vertical corridors
/// appear. Expected O(cells log cells), 1 to 2 microseconds a cell; 5 bytes a cell.
void carve_course(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  execution.reserve(cells.cell_count() * sizeof(std::uint32_t));
  CourseCarver carver(cells, seed, execution);
  StepPoll poll(execution);
  for (std::uint64_t carved = 1; carved < cells.cell_count();) {
    poll.step(carved);
    if (carver.try_wall()) ++carved;
  }
}

/// The algorithm mst into cells that are held: tile by tile, in parallel. Kruskal's maze with a hash as the shuffle, so
/// it looks as that of kruskal. 15 ns a cell on two cores.
void carve_mst(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  const SpanningMaze maze(cells.rows(), cells.cols(), seed, 0.0, {execution.threads, execution.deadline});
  for_chunks(maze.tile_count(), 16, {execution.threads, execution.deadline}, [&](Range r) {
    const auto reader = maze.reader();
    CellTile tile;
    for (std::size_t t = r.first; t < r.last; ++t) {
      reader->read(t, tile);
      copy_tile(tile, cells, tile.first_col);
      execution.advance(std::uint64_t{tile.width} * tile.height);
      execution.check();
    }
  });
  cells.bytes()[cells.index(cells.cols() - 1, cells.rows() - 1)] |=
      MazeCells::right_wall;  // the exit is no cell's business
}

void open_drawn_loops(MazeCells& cells, double loops, std::uint64_t seed, const Execution& execution) {
  const EdgeWeights weights(seed);
  const LoopDraw falls(loops);
  for_chunks(cells.cols(), 16, execution, [&](Range r) {
    for (std::size_t c = r.first; c < r.last; ++c) {
      const auto col = static_cast<std::uint32_t>(c);
      for (std::uint32_t row = 0; row < cells.rows(); ++row) {
        if ((row & 0xffffU) == 0) execution.check();
        const auto falls_at = [&](unsigned direction) { return falls(weights(edge_number(col, row, direction))); };
        if (col + 1 < cells.cols() && cells.wall_right(col, row) && falls_at(0)) cells.open_right(col, row);
        if (row + 1 < cells.rows() && cells.wall_above(col, row) && falls_at(1)) cells.open_above(col, row);
      }
    }
  });
}

}  // namespace warren::maze
