// SPDX-License-Identifier: BSD-3-Clause
// Randomised Prim, the variant over cells: the maze grows from its middle by a random cell of the frontier, joined to a
// random neighbour that is in the maze already. Short dead ends, direct ways. O(cells); the frontier is a list of
// cells, a few times the longer side.
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

}  // namespace

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

}  // namespace warren::maze
