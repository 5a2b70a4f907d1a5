// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/point_grid.hpp"

#include <gtest/gtest.h>

#include "tests/spatial/points/point_sets.hpp"

namespace warren {
namespace {

TEST(TileOrder, IsAPermutationThatIsSortedByCellAndStable) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const auto& set : test::point_sets<2>(seed, 3000)) {
      SCOPED_TRACE(set.name);
      const std::vector<Vec2>& points = set.points;
      const RawVector<std::uint32_t> order = tile_order(points, {});
      Box box;
      for (const Vec2 p : points) box.include(p);
      const CellFrame frame(box, points.size());
      ASSERT_EQ(order.size(), points.size());
      std::vector<bool> seen(points.size(), false);
      for (const std::uint32_t i : order) seen.at(i) = true;
      EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0);
      for (std::size_t m = 1; m < points.size(); ++m) {
        const auto key = [&](std::uint32_t i) { return std::pair(frame.cell_of(points[i]), i); };
        ASSERT_LT(key(order[m - 1]), key(order[m]));
      }
    }
  }
}

TEST(TileOrder, IsTheSameForAnyThreadCount) {
  std::vector<Vec2> points(200'000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {uniform(3, i, 0), 2.0 * uniform(3, i, 1)};
  const RawVector<std::uint32_t> one = tile_order(points, {.threads = 1});
  for (const unsigned threads : {2U, 3U, 8U}) {
    EXPECT_EQ(one, tile_order(points, {.threads = threads})) << threads;
  }
}

TEST(TileOrder, NumbersNeighboursNear) {
  std::vector<Vec2> points(40'000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {uniform(4, i, 0), uniform(4, i, 1)};
  const RawVector<std::uint32_t> order = tile_order(points, {});
  double steps = 0.0;
  for (std::size_t m = 1; m < points.size(); ++m) {
    steps += distance(points[order[m - 1]], points[order[m]]);
  }
  EXPECT_LT(steps / 40'000.0, 4.0 / 200.0);  // a step is a few cells; unsorted it is half the square
}

TEST(CellFrame, HasFewCellsWhateverTheShape) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const auto& [name, points] : test::point_sets<2>(seed, 500)) {
      Box box;
      for (const Vec2 p : points) box.include(p);
      EXPECT_LE(CellFrame(box, points.size()).cell_count(), 3 * points.size() / 2 + 2) << name;
    }
  }
}

TEST(CellFrame, CellsNeverDecreaseWithTheCoordinate) {
  const CellFrame frame({{1e6, 1e6}, {1e6 + 1e-6, 1e6 + 3e-6}}, 10'000);
  double x = 1e6 - 1e-8;
  for (std::uint32_t last = 0; x < 1e6 + 1.1e-6; x = std::nextafter(x, 2e6)) {
    ASSERT_GE(frame.column(x), last);
    last = frame.column(x);
    ASSERT_LT(last, frame.columns());
  }
  EXPECT_EQ(frame.column(-1e300), 0U);
  EXPECT_EQ(frame.column(1e300), frame.columns() - 1);
}

}  // namespace
}  // namespace warren
