// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/grid_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "tests/planners/grid/grid_oracle.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using grid_oracle::judged;
using grid_oracle::random_cell;
using grid_oracle::random_map;
using grid_oracle::shortest;

TEST(GridSearch, EveryMethodFindsTheOptimumOfAPlainDijkstra) {
  for (const std::uint64_t seed : test::seeds(90, 15, 0)) {
    const Bitmap map = random_map(seed);
    GridSearch search(map);  // one object for all queries: its scratch must be cleared
    for (std::uint64_t query = 0; query < 6; ++query) {
      const Cell start = random_cell(map, seed, 100 + query);
      const Cell goal = random_cell(map, seed, 200 + query);
      for (const Diagonal diagonal : {Diagonal::sqrt2, Diagonal::unit, Diagonal::none}) {
        const double expected = shortest(map, start, goal, diagonal);
        for (const GridMethod method :
             {GridMethod::astar, GridMethod::dijkstra, GridMethod::jump_points, GridMethod::bfs}) {
          if (method == GridMethod::jump_points && diagonal != Diagonal::sqrt2) continue;
          if (method == GridMethod::bfs && diagonal == Diagonal::sqrt2) continue;
          SCOPED_TRACE(testing::Message() << "seed " << seed << " query " << query << " diagonal "
                                          << static_cast<int>(diagonal) << " method " << static_cast<int>(method));
          const GridPath path = search.find(start, goal, {diagonal, method}, {});
          if (std::isinf(expected)) {
            ASSERT_EQ(path.status, SearchStatus::exhausted);
            ASSERT_TRUE(path.cells.empty());
          } else {
            ASSERT_EQ(path.status, SearchStatus::found);
            ASSERT_NEAR(judged(map, path.cells, start, goal, diagonal), expected, 1e-9);
            ASSERT_NEAR(path.cost, expected, 1e-9);
          }
        }
      }
    }
  }
}

TEST(GridSearch, BreadthFirstTakesTheFewestStepsWhateverDiagonalsCost) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed);
    const Cell start = random_cell(map, seed, 1);
    const Cell goal = random_cell(map, seed, 2);
    const double steps = shortest(map, start, goal, Diagonal::unit);
    const GridPath path = GridSearch(map).find(start, goal, {Diagonal::sqrt2, GridMethod::bfs}, {});
    if (std::isinf(steps)) {
      EXPECT_EQ(path.status, SearchStatus::exhausted);
    } else {
      ASSERT_EQ(path.cells.size(), static_cast<std::size_t>(steps) + 1);
      EXPECT_NEAR(path.cost, judged(map, path.cells, start, goal, Diagonal::sqrt2), 1e-9);
    }
  }
}

TEST(GridSearch, DiagonalStepsNeedTwoByTwoFreeCells) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Bitmap map(static_cast<std::uint32_t>(1 + seed * 3), 4, true);
    const auto x = static_cast<std::uint32_t>(random_bits(seed, 1, 0) % map.width());
    for (std::uint32_t y = 1; y < 3; ++y) map.clear(x, y);
    EXPECT_FALSE(has_diagonal_steps(map));
    if (x + 1 == map.width()) continue;
    map.clear(x + 1, 1);
    EXPECT_FALSE(has_diagonal_steps(map));
    map.clear(x + 1, 2);
    EXPECT_TRUE(has_diagonal_steps(map));
  }
}

TEST(GridSearch, LongCorridorsAreCrossedByWordsOfSixtyFour) {
  for (const std::uint32_t length : {62U, 63U, 64U, 65U, 127U, 128U, 129U, 1000U}) {
    SCOPED_TRACE(length);
    for (const bool upright : {false, true}) {
      const Bitmap map(upright ? 1 : length, upright ? length : 1);
      GridSearch search(map);
      const Cell first{0, 0};
      const Cell last = upright ? Cell{0, length - 1} : Cell{length - 1, 0};
      for (const auto& [from, to] : {std::pair{first, last}, {last, first}}) {
        const GridPath path = search.find(from, to, {Diagonal::sqrt2, GridMethod::jump_points}, {});
        EXPECT_EQ(path.cost, length - 1.0);
        EXPECT_EQ(path.expanded, 2U);
        EXPECT_EQ(judged(map, path.cells, from, to, Diagonal::sqrt2), length - 1.0);
      }
    }
  }
}

TEST(GridSearch, AStarExpandsNoMoreThanDijkstraAndJumpPointsFewer) {
  const Bitmap map(300, 200);
  GridSearch search(map);
  const auto expanded = [&](GridMethod method) {
    return search.find({20, 20}, {270, 150}, {Diagonal::sqrt2, method}, {}).expanded;
  };
  EXPECT_LE(expanded(GridMethod::astar), expanded(GridMethod::dijkstra));
  EXPECT_LE(expanded(GridMethod::jump_points), 4U);
}

TEST(GridSearch, BlockedEndsHaveNoPathAndOutsideIsRefused) {
  Bitmap map(10, 10);
  map.set(3, 3);
  GridSearch search(map);
  for (const GridMethod method : {GridMethod::astar, GridMethod::bfs, GridMethod::jump_points}) {
    EXPECT_EQ(search.find({3, 3}, {5, 5}, {Diagonal::sqrt2, method}, {}).status, SearchStatus::exhausted);
    EXPECT_EQ(search.find({5, 5}, {3, 3}, {Diagonal::sqrt2, method}, {}).status, SearchStatus::exhausted);
    const GridPath here = search.find({5, 5}, {5, 5}, {Diagonal::sqrt2, method}, {});
    EXPECT_EQ(here.status, SearchStatus::found);
    EXPECT_EQ(here.cost, 0.0);
    EXPECT_EQ(here.cells.size(), 1U);
    EXPECT_THROW(search.find({10, 0}, {5, 5}, {Diagonal::sqrt2, method}, {}), InputError);
  }
  EXPECT_THROW(search.find({0, 0}, {5, 5}, {Diagonal::unit, GridMethod::jump_points}, {}), InputError);
}

TEST(GridSearch, ADeadlineStopsIt) {
  const Bitmap map(400, 400);
  const Deadline over(0.0);
  for (const GridMethod method : {GridMethod::astar, GridMethod::bfs}) {
    EXPECT_THROW(GridSearch(map).find({0, 0}, {399, 7}, {Diagonal::unit, method}, {.deadline = &over}), Stopped);
  }
}

}  // namespace
}  // namespace warren
