// SPDX-License-Identifier: BSD-3-Clause
// The algorithms. Mazes that grow cell by cell: recursive backtracker, randomised Prim, and Wilson's loop-erased walks.
// Mazes that join regions of cells: randomised Kruskal, and the biased one of the course.
#include "scenes/mazes/maze_carving.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/search/union_find.hpp"
#include "parallel/asked_memory.hpp"

namespace warren::maze {
namespace {

/// Directions from 64 random bits, two bits each.
class DirectionBits {
 public:
  explicit DirectionBits(std::uint64_t seed) : rng_(seed) {}
  unsigned next() {
    if (left_ == 0) {
      bits_ = rng_.next();
      left_ = 32;
    }
    const auto d = static_cast<unsigned>(bits_ & 3U);
    bits_ >>= 2;
    --left_;
    return d;
  }

 private:
  SequentialRng rng_;
  std::uint64_t bits_ = 0;
  unsigned left_ = 0;
};

/// Gives the gap bytes further bits, so that no walk enters them.
void mark_gaps(MazeCells& cells, std::uint8_t bits, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 18;
  const auto bytes = cells.bytes();
  for_each_index(cells.cols() + std::size_t{1}, grain, {execution.threads, execution.deadline},
                 [&](std::size_t gap) { bytes[gap * cells.stride()] |= bits; });
}

}  // namespace

/// Recursive backtracker: a depth-first walk that goes to a random neighbour not yet visited and, where there is none,
/// one step back. Long winding corridors, few dead ends. Needs no stack: the way back is a direction of two bits in
/// each cell's own byte, so the whole generator lives in 1 byte a cell. Each cell is entered once and left back once:
/// O(cells), 30 to 60 ns each; the walk is local, so caches serve it at any size.
void carve_backtracker(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  mark_gaps(cells, in_maze, execution);
  const Steps at(cells);
  SequentialRng rng(seed);
  StepPoll poll(execution);
  std::size_t i = cells.index(0, 0);
  at[i] |= in_maze;
  for (std::uint64_t left = cells.cell_count() - 1; left > 0;) {
    poll.step(cells.cell_count() - left);
    const unsigned unvisited = at.neighbours_with(i, in_maze, 0);
    if (unvisited == 0) {
      i = at.neighbour(i, at[i] >> direction_shift & 3U);
      continue;
    }
    const unsigned d = choose_direction(unvisited, rng);
    at.open(i, d);
    i = at.neighbour(i, d);
    at[i] = static_cast<std::uint8_t>(at[i] | in_maze | (d ^ 2U) << direction_shift);
    --left;
  }
}

/// Randomised Prim, the variant over cells: the maze grows from its middle by a random cell of the frontier, joined to
/// a random neighbour that is in the maze already. Short dead ends, direct ways. O(cells); the frontier is a list of
/// cells, a few times the longer side.
void carve_prim(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  mark_gaps(cells, in_frontier, execution);  // never fresh, and never in the maze
  const Steps at(cells);
  SequentialRng rng(seed);
  StepPoll poll(execution);
  std::vector<std::size_t> frontier;
  const auto add_to_maze = [&](std::size_t i) {
    at[i] |= in_maze;
    const unsigned fresh = at.neighbours_with(i, in_maze | in_frontier, 0);
    for (unsigned d = 0; d < 4; ++d) {
      if ((fresh >> d & 1U) == 0) continue;
      const std::size_t to = at.neighbour(i, d);
      at[to] |= in_frontier;
      push_asked(frontier, to, execution);
    }
  };
  add_to_maze(cells.index(cells.cols() / 2, cells.rows() / 2));
  for (std::uint64_t carved = 1; !frontier.empty(); ++carved) {
    poll.step(carved);
    std::size_t& drawn = frontier[rng.below(frontier.size())];
    const std::size_t i = drawn;
    drawn = frontier.back();
    frontier.pop_back();
    at.open(i, choose_direction(at.neighbours_with(i, in_maze, in_maze), rng));
    add_to_maze(i);
  }
}

/// Wilson's algorithm (STOC 1996): loop-erased random walks, each from the next cell outside the tree until it meets
/// the tree. Every perfect maze is equally likely: a uniform spanning tree. A walk leaves in each cell the direction in
/// which it was last left, two bits of the cell's byte, so loops erase themselves and 1 byte a cell is all. The root is
/// the middle cell: the tree's law doesn't depend on it, the expected number of steps (4 times the sum of the effective
/// resistances to it, about 10 a cell at 1000 x 1000, growing with the logarithm of the side) is least there.
void carve_wilson(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  mark_gaps(cells, in_maze | outside, execution);
  const Steps at(cells);
  DirectionBits directions(seed);
  StepPoll poll(execution);
  std::uint64_t carved = 0;
  at[cells.index(cells.cols() / 2, cells.rows() / 2)] |= in_maze;
  for (std::size_t begin = 1; begin < cells.bytes().size(); ++begin) {
    poll.step(carved);
    for (std::size_t i = begin; (at[i] & in_maze) == 0;) {  // no step for gap bytes: they count as tree
      poll.step(carved);
      const unsigned d = directions.next();
      const std::size_t to = at.neighbour(i, d);
      if (!at.is_index(to) || (at[to] & outside) != 0) continue;  // draw again: uniform among those that exist
      at[i] = static_cast<std::uint8_t>((at[i] & ~direction_bits) | d << direction_shift);
      i = to;
    }
    for (std::size_t i = begin; (at[i] & in_maze) == 0; ++carved) {
      const unsigned d = at[i] >> direction_shift & 3U;
      at[i] |= in_maze;
      at.open(i, d);
      i = at.neighbour(i, d);
    }
  }
}

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
  RawVector<Id> regions = single_regions<Id>(cells.bytes().size(), execution);
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
    if (!unite(regions, i, static_cast<Id>(at.neighbour(i, d)))) continue;
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
        regions_(single_regions<std::uint32_t>(cells.cell_count(), execution)),
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
    if (!unite(regions_, cell, neighbour)) return false;
    at_.open(cells_.index(col, row), d);
    return true;
  }

 private:
  static constexpr int draws = 15;

  Place place(std::uint32_t cell) const { return {cell / cells_.rows() + 1U, cell % cells_.rows() + 1U}; }

  std::uint32_t draw_cell() {
    const std::uint32_t home = root_of(regions_, std::uint32_t{0});
    std::uint32_t best = 0;
    std::uint64_t best_key = ~std::uint64_t{0};
    for (int k = 0; k < draws; ++k) {
      const auto cell = static_cast<std::uint32_t>(rng_.below(cells_.cell_count()));
      const Place p = place(cell);
      const std::uint64_t joined = root_of(regions_, cell) == home ? 1 : 0;
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
    return d == 0 ? p.col < cells_.cols() : d == 1 ? p.row < cells_.rows() : d == 2 ? p.col > 1 : p.row > 1;
  }

  const MazeCells& cells_;
  Steps at_;
  RawVector<std::uint32_t> regions_;
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

}  // namespace warren::maze
