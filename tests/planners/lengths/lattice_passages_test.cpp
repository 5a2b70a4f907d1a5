// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "planners/lengths/core_graph.hpp"
#include "tests/planners/lengths/lattice_mazes.hpp"
#include "tests/refusals.hpp"

namespace warren {
namespace {

std::string message_of(LatticeSize size, PassageWords words) {
  return test::refusal<InputError>([&] { const LatticePassages passages(size, std::move(words)); });
}

TEST(LatticePassages, NeighboursAreThoseOfTheMazeInBothDirections) {
  const MazeOptions options{.rows = 7, .cols = 131, .seed = 3, .algorithm = MazeAlgorithm::kruskal, .loops = 0.3};
  const MazeCells cells = generate_maze(options, {});
  const LatticePassages passages = test::maze_passages(options);
  for (CellId cell = 0; cell < passages.cell_count(); ++cell) {
    const std::uint32_t col = cell % options.cols;
    const std::uint32_t row = cell / options.cols;
    std::vector<CellId> expected;
    if (!cells.wall_right(col, row)) expected.push_back(cell + 1);
    if (!cells.wall_above(col, row)) expected.push_back(cell + options.cols);
    if (col > 0 && !cells.wall_right(col - 1, row)) expected.push_back(cell - 1);
    if (row > 0 && !cells.wall_above(col, row - 1)) expected.push_back(cell - options.cols);
    std::vector<CellId> found;
    passages.for_each_neighbour(cell, [&](CellId next) { found.push_back(next); });
    EXPECT_EQ(found, expected) << cell;
  }
}

TEST(LatticePassages, OpenWordsAreTheBitsOfTheCells) {
  const MazeOptions options{.rows = 5, .cols = 200, .seed = 4, .loops = 0.2};
  const LatticePassages passages = test::maze_passages(options);
  for (std::uint32_t row = 0; row < options.rows; ++row) {
    for (std::uint32_t col = 0; col < options.cols; ++col) {
      const auto words = passages.open_words(col / 64 * 64, row);
      unsigned open = 0;
      for (unsigned d = 0; d < 4; ++d) open |= static_cast<unsigned>(words[d] >> col % 64 & 1U) << d;
      EXPECT_EQ(open, passages.open_at(col, row)) << col << ' ' << row;
    }
  }
}

TEST(LatticePassages, WrongPlanesAreRefusedWithTheirPlace) {
  const LatticeSize size{3, 70};
  EXPECT_EQ(message_of(size, LatticePassages::closed(size, {})), "");
  PassageWords out_right = LatticePassages::closed(size, {});
  test::open_right(out_right, size, 69, 1);
  EXPECT_NE(message_of(size, std::move(out_right)).find("leaves the lattice in row (found: 1)"), std::string::npos);
  PassageWords beyond = LatticePassages::closed(size, {});
  test::open_up(beyond, size, 70, 0);
  EXPECT_NE(message_of(size, std::move(beyond)).find("row (found: 0)"), std::string::npos);
  PassageWords out_up = LatticePassages::closed(size, {});
  test::open_up(out_up, size, 5, 2);
  EXPECT_NE(message_of(size, std::move(out_up)).find("last row"), std::string::npos);
  EXPECT_NE(message_of(size, LatticePassages::closed({3, 64}, {})).find("need 6 words"), std::string::npos);
  EXPECT_NE(message_of({0, 64}, {}).find("0 x 64"), std::string::npos);
  EXPECT_NE(message_of({1U << 20, 1U << 20}, {}).find("2^20 tiles"), std::string::npos);
}

TEST(LatticePlaces, StepsAndCellsAgreeWithRowsAndColumns) {
  const LatticeSize size{130, 200};
  const LatticePlaces places(size);
  std::vector<bool> taken(places.place_count());
  for (CellId cell = 0; cell < size.rows * size.cols; ++cell) {
    const LatticePlace p = places.place_of(cell);
    ASSERT_LT(p, places.place_count());
    EXPECT_FALSE(taken[p]);
    taken[p] = true;
    EXPECT_EQ(places.cell_of(p), cell);
    if (places.col(p) + 1 < size.cols) {
      EXPECT_EQ(places.cell_of(places.step(p, 0)), cell + 1);
    }
    if (places.row(p) + 1 < size.rows) {
      EXPECT_EQ(places.cell_of(places.step(p, 1)), cell + size.cols);
    }
    if (places.col(p) > 0) {
      EXPECT_EQ(places.cell_of(places.step(p, 2)), cell - 1);
    }
    if (places.row(p) > 0) {
      EXPECT_EQ(places.cell_of(places.step(p, 3)), cell - size.cols);
    }
  }
}

}  // namespace
}  // namespace warren
