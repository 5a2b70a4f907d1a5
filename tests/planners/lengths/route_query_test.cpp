// SPDX-License-Identifier: BSD-3-Clause
// The oracle is a breadth-first search of the whole lattice.
#include "planners/lengths/route_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/run/execution.hpp"
#include "core/run/trace.hpp"
#include "planners/lengths/tree_routes.hpp"
#include "tests/planners/lengths/lattice_mazes.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using test::flood_lengths;
using test::maze_passages;
using test::not_reached;

constexpr MazeAlgorithm algorithms[] = {MazeAlgorithm::backtracker, MazeAlgorithm::kruskal, MazeAlgorithm::prim,
                                        MazeAlgorithm::wilson, MazeAlgorithm::course};

RouteIndexOptions small_leaves(std::uint32_t leaf) { return {.leaf = leaf, .open_space = true}; }

/// A path of this length, whose cells are neighbours.
void expect_path(const LatticePassages& passages, const RawVector<CellId>& path, CellId start, CellId goal,
                 std::uint32_t length) {
  ASSERT_EQ(path.size(), std::size_t{length} + 1);
  EXPECT_EQ(path.capacity(), path.size()) << "no more memory than is asked for";
  EXPECT_EQ(path.front(), start);
  EXPECT_EQ(path.back(), goal);
  for (std::size_t i = 1; i < path.size(); ++i) {
    bool joined = false;
    passages.for_each_neighbour(path[i - 1], [&](CellId next) { joined |= next == path[i]; });
    ASSERT_TRUE(joined) << "cell " << i << " of the path from " << start << " to " << goal;
  }
}

/// Every `goals`-th goal from every `starts`-th start; every `paths`-th path, too.
void expect_exact(LatticePassages passages, const RouteIndexOptions& options, CellId starts, CellId goals,
                  CellId paths) {
  const RouteIndex index(std::move(passages), options, {});
  RouteQuery query(index);
  const auto cells = static_cast<CellId>(index.passages().cell_count());
  for (CellId start = 0; start < cells; start += starts) {
    const std::vector<std::uint32_t> expected = flood_lengths(index.passages(), start);
    for (CellId goal = 0; goal < cells; goal += goals) {
      const std::uint32_t found = query.length(start, goal).value_or(not_reached);
      ASSERT_EQ(found, expected[goal]) << "from " << start << " to " << goal;
      if ((start * std::uint64_t{cells} + goal) % paths != 0) continue;
      const RawVector<CellId> path = query.path(start, goal);
      if (found == not_reached) {
        EXPECT_TRUE(path.empty());
      } else {
        expect_path(index.passages(), path, start, goal, found);
        EXPECT_EQ(query.path(start, goal, {.threads = 3}), path);
      }
    }
  }
}

TEST(RouteQuery, AllPairsOfSmallMazesOfAllKinds) {
  const std::uint32_t every_start = test::asks_all() ? 1 : 29;
  const std::vector<std::uint64_t> seeds = test::seeds(4);
  for (const MazeAlgorithm algorithm : algorithms) {
    for (const double loops : {0.0, 0.01, 0.1, 0.5, 1.0}) {
      for (const std::uint64_t seed : seeds) {
        SCOPED_TRACE(std::string(name_of(algorithm)) + " " + std::to_string(loops) + " " + std::to_string(seed));
        expect_exact(maze_passages({20, 20, seed, algorithm, loops}), small_leaves(1 + seed % 4),
                     seed == seeds.front() ? every_start : 19, test::asks_all() ? 1 : 2, 37);
      }
    }
  }
}

TEST(RouteQuery, BlockedCellsMakeForestsAndPartsThatDontJoin) {
  for (const MazeAlgorithm algorithm : algorithms) {
    for (const double loops : {0.0, 0.1, 1.0}) {
      for (const std::uint64_t seed : test::seeds(4)) {
        SCOPED_TRACE(std::string(name_of(algorithm)) + " " + std::to_string(loops) + " " + std::to_string(seed));
        const auto blocked = [&](std::uint32_t col, std::uint32_t row) {
          return uniform(seed, row * 20 + col, 9) < 0.15;
        };
        expect_exact(maze_passages({20, 20, seed, algorithm, loops}, blocked), small_leaves(2),
                     test::asks_all() ? 3 : 17, 1, 41);
      }
    }
  }
}

/// Wide enough for trees that cross tiles again and again, and for fronts above fronts.
TEST(RouteQuery, MazesOfManyTiles) {
  constexpr MazeAlgorithm kinds[] = {MazeAlgorithm::backtracker, MazeAlgorithm::kruskal, MazeAlgorithm::wilson};
  constexpr double shares[] = {0.0, 0.001, 0.01, 0.1, 0.5};
  for (const std::uint64_t i :
       test::seeds(60, 6, 0)) {  // one after the other: each of five shares, each of three kinds
    const MazeAlgorithm algorithm = kinds[i % 3];
    const double loops = shares[i % 5];
    const std::uint64_t seed = 1 + i / 15;
    SCOPED_TRACE(std::string(name_of(algorithm)) + " " + std::to_string(loops) + " " + std::to_string(seed));
    expect_exact(maze_passages({150, 210, seed, algorithm, loops}), small_leaves(seed % 2 == 0 ? 3 : 32), 7919, 53,
                 211);
  }
}

TEST(RouteQuery, ASingleCellAndSingleRows) {
  expect_exact(maze_passages({1, 1, 1, MazeAlgorithm::kruskal, 0.0}), {}, 1, 1, 1);
  expect_exact(maze_passages({1, 300, 1, MazeAlgorithm::kruskal, 0.0}), {}, 7, 1, 5);
  expect_exact(maze_passages({300, 1, 1, MazeAlgorithm::kruskal, 0.0}), {}, 7, 1, 5);
  expect_exact({{3, 5}, LatticePassages::closed({3, 5}, {})}, {}, 1, 1, 1);
}

/// Two corridors round the rim of a lattice: nothing but a ring, with and without junctions on it.
TEST(RouteQuery, RingsHaveTwoWays) {
  for (const std::uint32_t side : {4U, 14U, 40U, 90U}) {
    SCOPED_TRACE(side);
    const LatticeSize size{side, side};
    PassageWords words = LatticePassages::closed(size, {});
    for (std::uint32_t i = 1; i + 2 < side; ++i) {
      test::open_right(words, size, i, 1);
      test::open_right(words, size, i, side - 2);
      test::open_up(words, size, 1, i);
      test::open_up(words, size, side - 2, i);
    }
    expect_exact({size, std::move(words)}, {}, side, 1, 7);
  }
}

/// One ring through all cells, up and down column pairs and back along the lowest row: half of it is longer than two
/// bytes say.
TEST(RouteQuery, LongWaysBetweenGates) {
  const LatticeSize size{400, 400};
  PassageWords words = LatticePassages::closed(size, {});
  for (std::uint32_t col = 0; col < size.cols; ++col) {
    if (col + 1 < size.cols) test::open_right(words, size, col, 0);
    for (std::uint32_t row = 1; row + 1 < size.rows; ++row) test::open_up(words, size, col, row);
    if (col % 2 == 0) test::open_right(words, size, col, size.rows - 1);
    if (col % 2 == 1 && col + 1 < size.cols) test::open_right(words, size, col, 1);
  }
  test::open_up(words, size, 0, 0);
  test::open_up(words, size, size.cols - 1, 0);
  const RouteIndex index({size, {words.right, words.up}}, small_leaves(1), {});
  EXPECT_FALSE(index.arrays().fronts.lengths.empty());
  EXPECT_FALSE(index.arrays().fronts.short_lengths.empty());
  expect_exact({size, std::move(words)}, small_leaves(1), test::asks_all() ? 39989 : 79979, 211, 4001);
}

/// How many legs a way's climbs are cut into.
std::size_t legs_of(const RouteIndex& index, CellId start, CellId goal) {
  const TreeRoutes trees(index);
  const LatticePlace a = index.places().place_of(start);
  const LatticePlace b = index.places().place_of(goal);
  const TreeJoin join = trees.join(a, b);
  RawVector<CellId> cells(std::size_t{join.start_steps} + join.goal_steps + 1);  // that nobody writes
  std::vector<MarkedWay> legs;
  trees.cut({a, join.start_core, join.start_steps, 1, cells.data()}, legs);
  trees.cut({b, join.goal_core, join.goal_steps, -1, &cells.back()}, legs);
  return legs.size();
}

/// Equal for any number of threads, and stopped between chunks.
void expect_the_same_by_all_threads(const RouteIndex& index, CellId start, CellId goal) {
  RouteQuery query(index);
  const RawVector<CellId> path = query.path(start, goal);
  expect_path(index.passages(), path, start, goal, flood_lengths(index.passages(), start)[goal]);
  const Deadline over(0.0);
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    EXPECT_EQ(query.path(start, goal, {.threads = threads}), path) << threads;
    EXPECT_THROW(query.path(start, goal, {.threads = threads, .deadline = &over}), Stopped);
  }
}

/// A thread writes 16 legs before it takes more.
TEST(RouteQuery, ManyLegsAreWrittenByAnyNumberOfThreads) {
  const RouteIndex index(maze_passages({1000, 1000, 1, MazeAlgorithm::backtracker, 0.0}), {}, {});
  const CellId last = 1000 * 1000 - 1;
  EXPECT_GT(legs_of(index, 0, last), 2 * 16U);
  expect_the_same_by_all_threads(index, 0, last);
}

/// How many chunks of hops a path is written in: all but those of its climbs' legs.
std::size_t hop_chunks_of(const RouteIndex& index, CellId start, CellId goal) {
  constexpr std::size_t legs_a_chunk = 16;
  Trace trace;
  RouteQuery(index).path(start, goal, {.threads = 1, .trace = &trace});
  return trace.events().size() - (legs_of(index, start, goal) + legs_a_chunk - 1) / legs_a_chunk;
}

/// A thread writes 512 hops before it takes more; ways through long mazes with small leaves have that many.
TEST(RouteQuery, ManyHopsAreWrittenByAnyNumberOfThreads) {
  for (const MazeAlgorithm algorithm : {MazeAlgorithm::backtracker, MazeAlgorithm::kruskal}) {
    const RouteIndex index(maze_passages({40, 4000, 3, algorithm, 0.1}), small_leaves(1), {});
    const auto last = static_cast<CellId>(index.passages().cell_count() - 1);
    EXPECT_GE(hop_chunks_of(index, 0, last), 3U);
    expect_the_same_by_all_threads(index, 0, last);
    expect_the_same_by_all_threads(index, last, 0);  // from their hops' other ends
  }
}

TEST(RouteQuery, CellsOutsideTheLatticeAreRefused) {
  const RouteIndex index(maze_passages({4, 5, 1, MazeAlgorithm::kruskal, 0.0}), {}, {});
  RouteQuery query(index);
  EXPECT_EQ(test::refusal<InputError>([&] { query.length(3, 20); }), "cell: must be below 20 (found: 20)");
}

}  // namespace
}  // namespace warren
