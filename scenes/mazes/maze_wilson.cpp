// SPDX-License-Identifier: BSD-3-Clause
// Wilson's algorithm (STOC 1996): loop-erased random walks, each from the next cell outside the tree until it meets the
// tree. Every perfect maze is equally likely: a uniform spanning tree. A walk leaves in each cell the direction in
// which it was last left, two bits of the cell's byte, so loops erase themselves and 1 byte a cell is all. The root is
// the middle cell: the tree's law doesn't depend on it, the expected number of steps (4 times the sum of the effective
// resistances to it, about 10 a cell at 1000 x 1000, growing with the logarithm of the side) is least there.
#include "scenes/mazes/maze_carving.hpp"

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
