// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/planner_contest.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace warren::studies {
namespace {

TEST(CellsPassed, ALegTakesAsManyStepsAsItsLongerSide) {
  const auto count = [](const std::vector<Vec2>& path) { return cells_passed(path, {10.0, 20.0}, 2.0); };
  EXPECT_EQ(count({}), 0U);
  EXPECT_EQ(count({{12, 22}}), 1U);
  EXPECT_EQ(count({{12, 22}, {12.4, 22.4}}), 1U);        // the same cell
  EXPECT_EQ(count({{10, 20}, {20, 20}}), 6U);            // five steps
  EXPECT_EQ(count({{10, 20}, {20, 30}}), 6U);            // five diagonal ones
  EXPECT_EQ(count({{10, 20}, {20, 26}, {20, 20}}), 9U);  // 5 + 3
  EXPECT_EQ(count({{20, 20}, {10, 26}}), 6U);            // backwards
}

TEST(CellsPassed, AMapCountsOnItsOwnCells) {
  OccupancyMap map;
  map.blocked = Bitmap(10, 10);
  map.cell = 0.5;
  map.origin = {-1.0, 4.0};
  map.yaw_rad = 0.7;
  const std::vector<Vec2> path{cell_centre(map, {1, 1}), cell_centre(map, {4, 3}), cell_centre(map, {4, 9})};
  EXPECT_EQ(cells_passed(path, map), 10U);  // 3 + 6 steps
}

}  // namespace
}  // namespace warren::studies
