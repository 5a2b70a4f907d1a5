// SPDX-License-Identifier: BSD-3-Clause
// Mazes that grow cell by cell: recursive backtracker, randomised Prim, and Wilson's loop-erased walks.

#include <vector>

#include "scenes/mazes/maze_carving.hpp"

namespace warren::maze {
namespace {

/// Puts cells next to the maze up for a random draw.
class Frontier {
 public:
  Frontier(const Steps& at, const Execution& execution) : at_(at), execution_(execution) {}
  bool empty() const { return cells_.empty(); }

  /// Puts cell i into the maze and its new neighbours into the frontier.
  void add_to_maze(std::size_t i) {
    at_[i] |= in_maze;
    const unsigned fresh = at_.neighbours_with(i, in_maze | in_frontier, 0);
    for (unsigned d = 0; d < 4; ++d) {
      if ((fresh >> d & 1U) != 0) push(at_.neighbour(i, d));
    }
  }
  std::size_t take(SequentialRng& rng) {
    std::size_t& drawn = cells_[rng.below(cells_.size())];
    const std::size_t i = drawn;
    drawn = cells_.back();
    cells_.pop_back();
    return i;
  }

 private:
  void push(std::size_t i) {
    at_[i] |= in_frontier;
    if (cells_.size() == cells_.capacity()) execution_.reserve(2 * cells_.capacity() * sizeof(std::size_t));
    cells_.push_back(i);
  }

  const Steps& at_;
  const Execution& execution_;
  std::vector<std::size_t> cells_;
};

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

class Walker {
 public:
  Walker(MazeCells& cells, std::uint64_t seed, const Execution& execution)
      : at_(cells), directions_(seed), poll_(execution) {}

  /// Walks from i until the tree is met; every cell on the way remembers how it was last left.
  void walk(std::size_t i) {
    while ((at_[i] & in_maze) == 0) {
      poll_.step(carved_);
      const unsigned d = directions_.next();
      const std::size_t to = at_.neighbour(i, d);
      if (!at_.is_index(to) || (at_[to] & outside) != 0) continue;  // draw again: uniform among those that exist
      at_[i] = static_cast<std::uint8_t>((at_[i] & ~direction_bits) | d << direction_shift);
      i = to;
    }
  }
  /// Follows the remembered directions from i and carves them.
  void carve(std::size_t i) {
    while ((at_[i] & in_maze) == 0) {
      const unsigned d = at_[i] >> direction_shift & 3U;
      at_[i] |= in_maze;
      at_.open(i, d);
      i = at_.neighbour(i, d);
      ++carved_;
    }
  }
  void add(std::size_t i) { at_[i] |= in_maze; }
  void skip() { poll_.step(carved_); }

 private:
  Steps at_;
  DirectionBits directions_;
  StepPoll poll_;
  std::uint64_t carved_ = 0;
};

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
  Frontier frontier(at, execution);
  frontier.add_to_maze(cells.index(cells.cols() / 2, cells.rows() / 2));
  for (std::uint64_t carved = 1; !frontier.empty(); ++carved) {
    poll.step(carved);
    const std::size_t i = frontier.take(rng);
    at.open(i, choose_direction(at.neighbours_with(i, in_maze, in_maze), rng));
    frontier.add_to_maze(i);
  }
}

/// Wilson's algorithm (STOC 1996): loop-erased random walks, each from the next cell outside the tree until it meets
/// the tree. Every perfect maze is equally likely: a uniform spanning tree. A walk leaves in each cell the direction in
/// which it was last left, two bits of the cell's byte, so loops erase themselves and 1 byte a cell is all. The root is
/// the middle cell: the tree's law doesn't depend on it, the expected number of steps (4 times the sum of the effective
/// resistances to it, about 10 a cell at 1000 x 1000, growing with the logarithm of the side) is least there.
void carve_wilson(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  mark_gaps(cells, in_maze | outside, execution);
  Walker walker(cells, seed, execution);
  walker.add(cells.index(cells.cols() / 2, cells.rows() / 2));
  for (std::size_t i = 1; i < cells.bytes().size(); ++i) {
    walker.skip();
    walker.walk(i);  // nothing for gap bytes: they count as tree
    walker.carve(i);
  }
}

}  // namespace warren::maze
