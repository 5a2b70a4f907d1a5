// SPDX-License-Identifier: BSD-3-Clause
// Randomised Kruskal: the interior walls in random order, each taken out if it parts two regions. Many short dead ends.
// The order is a Fisher-Yates shuffle done as it is consumed, so it ends with the last join. O(cells) in practice,
// about 12 bytes a cell besides the cells (two wall numbers and one parent), 24 from 2^31 bytes of cells on.
#include <limits>

#include "scenes/mazes/disjoint_regions.hpp"
#include "scenes/mazes/maze_carving.hpp"

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

}  // namespace

void carve_kruskal(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  if (cells.bytes().size() <= std::numeric_limits<std::uint32_t>::max() / 2) {
    carve<std::uint32_t>(cells, seed, execution);
  } else {
    carve<std::uint64_t>(cells, seed, execution);
  }
}

}  // namespace warren::maze
