// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/maps/free_cells.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

Bitmap random_cells(std::uint64_t seed) {
  Bitmap blocked(seed % 2 == 0 ? 131 : 64, 41);
  const double share = 0.2 + 0.05 * static_cast<double>(seed % 8);
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    for (std::uint32_t x = 0; x < blocked.width(); ++x) {
      if (uniform(seed, std::uint64_t{y} * blocked.width() + x, 0) < share) blocked.set(x, y);
    }
  }
  return blocked;
}

/// Numbers the cells that steps over common sides join, by plain flooding; 0: blocked.
std::vector<int> regions(const Bitmap& blocked) {
  const auto width = static_cast<std::int64_t>(blocked.width());
  std::vector<int> region(blocked.size(), 0);
  int count = 0;
  for (std::int64_t first = 0; first < static_cast<std::int64_t>(region.size()); ++first) {
    std::vector<std::int64_t> open{first};
    ++count;
    while (!open.empty()) {
      const std::int64_t v = open.back();
      open.pop_back();
      const std::int64_t x = v % width;
      const std::int64_t y = v / width;
      if (blocked.holds(x, y) || region[static_cast<std::size_t>(v)] != 0) continue;
      region[static_cast<std::size_t>(v)] = count;
      if (x > 0) open.push_back(v - 1);
      if (x + 1 < width) open.push_back(v + 1);
      if (y > 0) open.push_back(v - width);
      if (y + 1 < static_cast<std::int64_t>(blocked.height())) open.push_back(v + width);
    }
  }
  return region;
}

TEST(CellMilestones, StraightMotionsOfTwoCellsJoinThemAsStepsJoinTheCells) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    const Bitmap blocked = random_cells(seed);
    const Bitmap kept = cell_milestones(blocked, {.threads = 1 + static_cast<unsigned>(seed % 3)});
    const std::vector<int> region = regions(blocked);
    const auto is_free = [&](std::int64_t x, std::int64_t y) {
      return x >= 0 && y >= 0 && x < blocked.width() && y < blocked.height() && !blocked.holds(x, y);
    };
    // Cells that are left out count as blocked for another flood that may leap over one of them.
    std::vector<std::int64_t> group(blocked.size(), -1);
    const auto number = [&](std::int64_t x, std::int64_t y) {
      return static_cast<std::size_t>(y * blocked.width() + x);
    };
    for (std::int64_t y = 0; y < blocked.height(); ++y) {
      for (std::int64_t x = 0; x < blocked.width(); ++x) {
        ASSERT_TRUE(!kept.holds(x, y) || is_free(x, y));
        if (!kept.holds(x, y) || group[number(x, y)] >= 0) continue;
        std::vector<std::pair<std::int64_t, std::int64_t>> open{{x, y}};
        while (!open.empty()) {
          const auto [u, v] = open.back();
          open.pop_back();
          if (!kept.holds(u, v) || group[number(u, v)] >= 0) continue;
          group[number(u, v)] = static_cast<std::int64_t>(number(x, y));
          for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            if (!is_free(u + dx, v + dy)) continue;
            open.emplace_back(u + dx, v + dy);
            if (is_free(u + 2 * dx, v + 2 * dy)) open.emplace_back(u + 2 * dx, v + 2 * dy);
          }
        }
      }
    }
    std::vector<std::int64_t> group_of(blocked.size() + 2, -1);  // of each region
    for (std::size_t v = 0; v < group.size(); ++v) {
      if (group[v] < 0) continue;
      auto& expected = group_of[static_cast<std::size_t>(region[v])];
      if (expected < 0) expected = group[v];
      EXPECT_EQ(group[v], expected);
    }
    for (std::size_t v = 0; v < region.size(); ++v) {  // no region is without one
      EXPECT_TRUE(region[v] == 0 || group_of[static_cast<std::size_t>(region[v])] >= 0);
    }
  }
}

TEST(CellMilestones, AMazeHasOneACellOfTheMaze) {
  constexpr std::string_view rows[] = {"#######", "#...#.#", "#.#.#.#", "#.#...#", "#.###.#", "#.....#", "#######"};
  Bitmap blocked(7, 7);
  for (std::uint32_t y = 0; y < 7; ++y) {
    for (std::uint32_t x = 0; x < 7; ++x) {
      if (rows[y][x] == '#') blocked.set(x, y);
    }
  }
  const Bitmap kept = cell_milestones(blocked, {});
  EXPECT_EQ(kept.count(), 9U);
  for (std::uint32_t cell = 0; cell < 9; ++cell) EXPECT_TRUE(kept.test(2 * (cell % 3) + 1, 2 * (cell / 3) + 1));
  EXPECT_TRUE(is_narrow(blocked));
}

TEST(CellMilestones, RoomsAreNotNarrow) {
  Bitmap room(100, 70);
  EXPECT_FALSE(is_narrow(room));
  EXPECT_EQ(cell_milestones(room, {}).count(), 7000U);
  Bitmap lane(100, 1);
  EXPECT_TRUE(is_narrow(lane));
  EXPECT_EQ(cell_milestones(lane, {}).count(), 51U);  // every second one, and the last
  EXPECT_FALSE(is_narrow(Bitmap()));
  EXPECT_FALSE(is_narrow(Bitmap(5, 5, true)));
}

}  // namespace
}  // namespace warren
