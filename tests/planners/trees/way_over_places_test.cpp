// SPDX-License-Identifier: BSD-3-Clause
#include "planners/trees/rrt_connect.hpp"

#include <gtest/gtest.h>

#include <queue>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

PlaceGrid random_grid(std::uint64_t seed, double share) {
  PlaceGrid grid = PlaceGrid::over({{-3, 2}, {-3 + 63 * 0.25, 2 + static_cast<double>(10 + seed % 54) * 0.25}});
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      if (uniform(seed, row, column) < share) grid.bits[row] &= ~(std::uint64_t{1} << column);
    }
  }
  return grid;
}

struct GridCell {
  int x;
  int y;
};

bool is_free(const PlaceGrid& grid, int x, int y) {
  return x >= 0 && y >= 0 && x < static_cast<int>(grid.columns) && y < static_cast<int>(grid.rows) &&
         grid.test(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
}

GridCell cell_at(const PlaceGrid& grid, Vec2 p) {
  return {static_cast<int>(std::lround((p.x - grid.origin.x) / grid.step)),
          static_cast<int>(std::lround((p.y - grid.origin.y) / grid.step))};
}

/// Are free places next to both ends joined, eight neighbours each? One place after the other.
bool is_joined(const PlaceGrid& grid, Vec2 start, Vec2 goal) {
  std::vector<bool> seen(64 * 64);
  std::queue<GridCell> queue;
  const auto push_around = [&](GridCell c) {
    for (int y = c.y - 1; y <= c.y + 1; ++y) {
      for (int x = c.x - 1; x <= c.x + 1; ++x) {
        if (!is_free(grid, x, y) || seen[static_cast<std::size_t>(64 * y + x)]) continue;
        seen[static_cast<std::size_t>(64 * y + x)] = true;
        queue.push({x, y});
      }
    }
  };
  push_around(cell_at(grid, start));
  const GridCell end = cell_at(grid, goal);
  while (!queue.empty()) {
    const GridCell c = queue.front();
    queue.pop();
    if (std::abs(c.x - end.x) <= 1 && std::abs(c.y - end.y) <= 1) return true;
    push_around(c);
  }
  return false;
}

TEST(WayOverPlaces, IsFoundExactlyWhereTheFreePlacesAreJoined) {
  int joined = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const PlaceGrid grid = random_grid(seed, 0.3 + 0.4 * uniform(seed, 1, 100));
    const Vec2 start = grid.at(1, grid.rows - 2);
    const Vec2 goal = grid.at(grid.columns - 2, 1);
    const PlaceWay way = way_over_places(grid, start, goal);
    EXPECT_EQ(!way.corners.empty(), is_joined(grid, start, goal));
    if (way.corners.empty()) continue;
    ++joined;
    ASSERT_GE(way.corners.size(), 2U);
    EXPECT_EQ(way.places.front(), start);
    EXPECT_EQ(way.places.back(), goal);
    EXPECT_EQ(way.corners.front(), 0U);
    EXPECT_EQ(way.corners.back() + 1, way.places.size());
    for (std::size_t i = 1; i < way.corners.size(); ++i) EXPECT_LT(way.corners[i - 1], way.corners[i]);
    for (std::size_t i = 1; i < way.places.size(); ++i) {
      const GridCell a = cell_at(grid, way.places[i - 1]);
      const GridCell b = cell_at(grid, way.places[i]);
      EXPECT_LE(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)), 1);
      if (i + 1 < way.places.size()) {
        EXPECT_TRUE(is_free(grid, b.x, b.y));
      }
    }
  }
  EXPECT_GT(joined, 50);
  EXPECT_LT(joined, 190);
}

TEST(WayOverPlaces, KeepsAPlaceAwayFromObstaclesWhereThatIsPossible) {
  PlaceGrid grid = PlaceGrid::over({{0, 0}, {63, 40}});
  for (std::size_t row = 0; row < 30; ++row) grid.bits[row] &= ~(std::uint64_t{7} << 30);
  const PlaceWay way = way_over_places(grid, grid.at(5, 10), grid.at(60, 10));
  EXPECT_LE(way.corners.size(), 6U);
  for (const Vec2 p : way.places) EXPECT_FALSE(p.x >= 29 && p.x <= 33 && p.y <= 30) << p.x << ' ' << p.y;
}

TEST(WayOverPlaces, IsNoneOnGridsWithoutPlacesOrFarAwayFromThem) {
  EXPECT_TRUE(way_over_places({}, {0, 0}, {1, 1}).corners.empty());
  const PlaceGrid grid = PlaceGrid::over({{0, 0}, {10, 10}});
  EXPECT_TRUE(way_over_places(grid, {-5, 0}, {1, 1}).corners.empty());
  EXPECT_TRUE(way_over_places(grid, {1, 1}, {1e30, 1}).corners.empty());
  EXPECT_FALSE(way_over_places(grid, {1, 1}, {1, 1}).corners.empty());
}

}  // namespace
}  // namespace warren
