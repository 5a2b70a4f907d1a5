// SPDX-License-Identifier: BSD-3-Clause
// The maze generator of the robotics course whose assignment started this project: a biased randomised Kruskal. Of 15
// cells drawn at random the one is taken that is not yet joined to the first cell, then that nearest to it (col + row),
// then the first drawn; one of its walls is drawn with a preference that changes from block to block, and goes if it
// parts two regions. So growth starts near the entrance, and patches of long horizontal and vertical corridors appear.
// Expected O(cells log cells), 1 to 2 microseconds a cell; 5 bytes a cell.
#include <algorithm>

#include "scenes/mazes/disjoint_regions.hpp"
#include "scenes/mazes/maze_carving.hpp"

namespace warren::maze {
namespace {

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
