// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/skeleton_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "planners/graph/assemble_graph.hpp"

namespace warren {
namespace {

/// '#' is blocked; the first row is the top.
Bitmap map_of(const std::vector<std::string>& rows) {
  Bitmap map(static_cast<std::uint32_t>(rows[0].size()), static_cast<std::uint32_t>(rows.size()));
  for (std::uint32_t y = 0; y < map.height(); ++y) {
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      if (rows[map.height() - 1 - y][x] == '#') map.set(x, y);
    }
  }
  return map;
}

Bitmap random_rooms(std::uint64_t seed) {
  Bitmap map(40, 30, true);
  for (std::uint32_t room = 0; room < 9; ++room) {
    const auto roll = [&](std::uint32_t axis, double most) {
      return static_cast<std::uint32_t>(most * uniform(seed, room, axis));
    };
    const std::uint32_t width = 1 + roll(0, 16);
    const std::uint32_t height = 1 + roll(1, 12);
    const std::uint32_t x0 = roll(2, 24);
    const std::uint32_t y0 = roll(3, 18);
    for (std::uint32_t y = y0; y < y0 + height; ++y) {
      for (std::uint32_t x = x0; x < x0 + width; ++x) map.clear(x, y);
    }
  }
  return map;
}

/// Every cell on the line is free, and so are both cells beside each corner that it crosses.
void expect_free(const Bitmap& blocked, Cell a, Cell b) {
  const int dx = static_cast<int>(b.x) - static_cast<int>(a.x);
  const int dy = static_cast<int>(b.y) - static_cast<int>(a.y);
  ASSERT_TRUE(dx == 0 || dy == 0 || std::abs(dx) == std::abs(dy));
  const int steps = std::max(std::abs(dx), std::abs(dy));
  for (int i = 0; i <= steps; ++i) {
    const std::int64_t x = std::int64_t{a.x} + dx / steps * i;
    const std::int64_t y = std::int64_t{a.y} + dy / steps * i;
    EXPECT_FALSE(blocked.holds(x, y));
    if (i == steps || dx == 0 || dy == 0) continue;
    EXPECT_FALSE(blocked.holds(x + dx / steps, y));
    EXPECT_FALSE(blocked.holds(x, y + dy / steps));
  }
}

/// Pieces of free cells over sides, by flooding.
std::size_t pieces_of(const Bitmap& blocked) {
  std::vector<Edge> steps;
  std::size_t free = 0;
  const auto number = [&](std::uint32_t x, std::uint32_t y) { return y * blocked.width() + x; };
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    for (std::uint32_t x = 0; x < blocked.width(); ++x) {
      if (blocked.test(x, y)) continue;
      ++free;
      if (x + 1 < blocked.width() && !blocked.test(x + 1, y)) steps.push_back({number(x, y), number(x + 1, y)});
      if (y + 1 < blocked.height() && !blocked.test(x, y + 1)) steps.push_back({number(x, y), number(x, y + 1)});
    }
  }
  const Components all = components(assemble_graph(blocked.size(), steps, {}), {});
  return all.count - (blocked.size() - free);
}

TEST(SkeletonLines, AreFreeAndAsConnectedAsTheMap) {
  std::size_t lines_seen = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE(seed);
    const SkeletonRoadmap map(random_rooms(seed), seed % 2 == 0 ? 0.0 : 1.0, {});
    const SkeletonLines lines = skeleton_lines(map, {});
    for (const Edge& line : lines.edges) {
      ASSERT_LT(line.from, line.to);
      expect_free(map.blocked, lines.cells[line.from], lines.cells[line.to]);
    }
    EXPECT_TRUE(std::is_sorted(lines.edges.begin(), lines.edges.end()));
    const Components parts = components(assemble_graph(lines.cells.size(), lines.edges, {}), {});
    EXPECT_EQ(parts.count, pieces_of(map.blocked));
    lines_seen += lines.edges.size();
  }
  EXPECT_GT(lines_seen, 1000U);
}

TEST(SkeletonLines, LeadToTheEndsOfCorridorsAndNotIntoTheCornersOfRooms) {
  const SkeletonRoadmap map(map_of({"####################",  //
                                    "#.......############",  //
                                    "#.......############",  //
                                    "#..................#",  //
                                    "#..................#",  //
                                    "#..................#",  //
                                    "#.......############",  //
                                    "#.......############",  //
                                    "####################"}),
                            0.0, {});
  const SkeletonLines lines = skeleton_lines(map, {});
  ASSERT_EQ(lines.cells.size(), 2U);
  EXPECT_EQ(lines.cells[0].y, 4U);
  EXPECT_LT(lines.cells[0].x, 6U);
  EXPECT_EQ(lines.cells[1], (Cell{17, 4}));
  EXPECT_EQ(lines.edges, (std::vector<Edge>{{0, 1}}));
}

TEST(SkeletonLines, ARingAroundAnIslandIsClosed) {
  const SkeletonRoadmap map(map_of({".......",  //
                                    ".#####.",  //
                                    ".#####.",  //
                                    ".#####.",  //
                                    "......."}),
                            0.0, {});
  const SkeletonLines lines = skeleton_lines(map, {});
  EXPECT_EQ(lines.edges.size(), lines.cells.size());
  EXPECT_GE(lines.cells.size(), 4U);
}

}  // namespace
}  // namespace warren
