// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/skeleton_planner.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "core/base/rng.hpp"
#include "tests/planners/grid/grid_oracle.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

Bitmap random_map(std::uint64_t seed, std::uint32_t width, std::uint32_t height) {
  Bitmap map(width, height);
  const double share = 0.05 + 0.4 * uniform(seed, 0, 9);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      if (uniform(seed, 1 + x, y) < share) map.set(x, y);
    }
  }
  map.clear(0, 0);
  map.clear(width - 1, height - 1);
  return map;
}

/// Labels of the cells with value `of`, joined over sides or over corners too, by flooding; the ring around the map
/// counts as blocked.
struct Pieces {
  std::vector<int> label;
  int count = 0;
};
Pieces pieces(const Bitmap& map, bool of, bool corners) {
  const int width = static_cast<int>(map.width()) + 2;
  const int height = static_cast<int>(map.height()) + 2;
  const auto value = [&](int x, int y) {
    const bool inside = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
    return inside ? map.holds(x - 1, y - 1) : true;
  };
  Pieces found{std::vector<int>(static_cast<std::size_t>(width * height), -1)};
  for (int i = 0; i < width * height; ++i) {
    if (found.label[static_cast<std::size_t>(i)] >= 0 || value(i % width, i / width) != of) continue;
    std::vector<int> open{i};
    found.label[static_cast<std::size_t>(i)] = found.count;
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = at % width + dx;
          const int y = at / width + dy;
          const auto next = static_cast<std::size_t>(y * width + x);
          if ((dx != 0 && dy != 0 && !corners) || x < 0 || y < 0 || x >= width || y >= height) continue;
          if (value(x, y) != of || found.label[next] >= 0) continue;
          found.label[next] = found.count;
          open.push_back(static_cast<int>(next));
        }
      }
    }
    ++found.count;
  }
  return found;
}

Bitmap complement(const Bitmap& map) {
  Bitmap other(map.width(), map.height(), true);
  for (std::uint32_t y = 0; y < map.height(); ++y) {
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      if (map.test(x, y)) other.clear(x, y);
    }
  }
  return other;
}

struct Topology {
  int free = 0;
  int islands = 0;
  friend bool operator==(const Topology&, const Topology&) = default;
};
Topology topology(const Bitmap& blocked) {
  return {pieces(blocked, false, false).count, pieces(blocked, true, true).count};
}

TEST(MapSkeleton, KeepsTheTopologyAndCannotBeThinner) {
  for (const std::uint64_t seed : test::seeds(30, 3, 0)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed, 30, 22);
    const DistanceField field(map, CellDistance::squares, true, {});
    const std::array<Cell, 2> kept{Cell{0, 0}, Cell{29, 21}};
    const Bitmap skeleton = map_skeleton(map, field, kept, {});
    Bitmap rest = complement(skeleton);
    EXPECT_EQ(topology(rest), topology(map));
    const Pieces whole = pieces(map, false, false);
    const Pieces thin = pieces(rest, false, false);
    std::vector<int> of(static_cast<std::size_t>(thin.count), -1);
    for (std::size_t i = 0; i < thin.label.size(); ++i) {
      if (thin.label[i] < 0) continue;
      ASSERT_GE(whole.label[i], 0) << "a blocked cell in the skeleton";
      int& piece = of[static_cast<std::size_t>(thin.label[i])];
      if (piece < 0) piece = whole.label[i];
      ASSERT_EQ(piece, whole.label[i]);
    }
    for (const Cell k : kept) EXPECT_TRUE(skeleton.test(k.x, k.y));
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        const bool is_kept = Cell{x, y} == kept[0] || Cell{x, y} == kept[1];
        if (!skeleton.test(x, y) || is_kept) continue;
        rest.set(x, y);
        ASSERT_NE(topology(rest), topology(map)) << x << " " << y << " could go";
        rest.clear(x, y);
      }
    }
  }
}

TEST(MapSkeleton, RunsInTheMiddleOfACorridor) {
  Bitmap map(40, 9, true);
  for (std::uint32_t y = 1; y < 8; ++y) {
    for (std::uint32_t x = 1; x < 39; ++x) map.clear(x, y);
  }
  const DistanceField field(map, CellDistance::squares, true, {});
  const std::array<Cell, 2> kept{Cell{1, 1}, Cell{38, 7}};
  const Bitmap skeleton = map_skeleton(map, field, kept, {});
  for (std::uint32_t x = 6; x < 34; ++x) {
    for (std::uint32_t y = 1; y < 8; ++y) EXPECT_EQ(skeleton.test(x, y), y == 4) << x << " " << y;
  }
}

/// The widest way over sides: how near to what is blocked a path must come, by flooding at each distance.
std::uint32_t widest_way(const Bitmap& map, const DistanceField& field, Cell start, Cell goal) {
  std::uint32_t best = 0;
  for (std::uint32_t level = 1; level <= std::min(field.squared(start.x, start.y), field.squared(goal.x, goal.y));
       ++level) {
    Bitmap narrow = map;
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (field.squared(x, y) < level) narrow.set(x, y);
      }
    }
    const Pieces wide = pieces(narrow, false, false);
    const auto label = [&](Cell c) { return wide.label[(c.y + 1) * (map.width() + 2) + c.x + 1]; };
    if (label(start) < 0 || label(start) != label(goal)) break;
    best = level;
  }
  return best;
}

TEST(SkeletonPlan, FindsAPathWhereverTheCellsConnectAndTheWidestIfAsked) {
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed, 26, 20);
    const DistanceField field(map, CellDistance::squares, true, {});
    const Cell start{0, 0};
    const Cell goal{25, 19};
    const bool joined = std::isfinite(grid_oracle::shortest(map, start, goal, Diagonal::none));
    for (const auto objective : {AxisObjective::length, AxisObjective::clearance}) {
      const SkeletonPath path = plan_on_skeleton({map, 0.0, {}}, start, goal, {.objective = objective}, {});
      ASSERT_EQ(path.outcome == Outcome::solved, joined);
      if (!joined) continue;
      ++solved;
      EXPECT_EQ(path.path.front(), start);
      EXPECT_EQ(path.path.back(), goal);
      std::uint32_t least = DistanceField::far;
      for (std::size_t i = 0; i < path.path.size(); ++i) {
        const auto [x, y] = path.path[i];
        least = std::min(least, field.squared(x, y));
        if (i == 0) continue;
        const auto [u, v] = path.path[i - 1];
        const int dx = static_cast<int>(x) - static_cast<int>(u);
        const int dy = static_cast<int>(y) - static_cast<int>(v);
        ASSERT_TRUE(std::abs(dx) <= 1 && std::abs(dy) <= 1 &&
                    grid_oracle::may_step(map, static_cast<int>(u), static_cast<int>(v), dx, dy, Diagonal::sqrt2));
      }
      EXPECT_DOUBLE_EQ(path.clearance, 0.5 * std::sqrt(least));
      if (objective == AxisObjective::clearance) {
        EXPECT_EQ(least, widest_way(map, field, start, goal));
      }
    }
  }
  EXPECT_GT(solved, 30);
}

TEST(SkeletonPlan, GoesRoundTheWideWayForClearanceAndStraightForLength) {
  // A short gap of one cell beside a long way of three.
  Bitmap map(21, 21);
  map.set_run(4, 0, 17);
  map.clear(8, 4);
  const SkeletonPath near = plan_on_skeleton({map, 0.0, {}}, {8, 1}, {8, 8}, {}, {});
  const SkeletonPath wide =
      plan_on_skeleton({map, 0.0, {}}, {8, 1}, {8, 8}, {.objective = AxisObjective::clearance}, {});
  ASSERT_EQ(near.outcome, Outcome::solved);
  ASSERT_EQ(wide.outcome, Outcome::solved);
  EXPECT_EQ(near.clearance, 0.5);
  EXPECT_GE(wide.clearance, 1.5);
  EXPECT_LT(near.path.size(), wide.path.size());
}

TEST(SkeletonPlan, DiscsKeepTheirDistanceAndBlockedEndsAreNamed) {
  Bitmap map(21, 21);
  map.set_run(4, 0, 17);
  map.clear(8, 4);
  const SkeletonPath path = plan_on_skeleton({map, 1.2, {}}, {8, 1}, {8, 8}, {}, {});
  ASSERT_EQ(path.outcome, Outcome::solved);
  EXPECT_GE(path.clearance, 1.2);
  EXPECT_EQ(plan_on_skeleton({map, 2.2, {}}, {8, 1}, {8, 8}, {}, {}).outcome, Outcome::start_blocked);
  EXPECT_EQ(plan_on_skeleton({map, 2.2, {}}, {4, 10}, {8, 5}, {}, {}).outcome, Outcome::goal_blocked);
  for (std::uint32_t x = 17; x < 21; ++x) map.set(x, 4);
  const SkeletonPath sealed = plan_on_skeleton({map, 1.2, {}}, {8, 1}, {8, 8}, {}, {});
  EXPECT_EQ(sealed.outcome, Outcome::not_connected);
  EXPECT_GT(sealed.separation.start_size, 0U);
}

}  // namespace
}  // namespace warren
