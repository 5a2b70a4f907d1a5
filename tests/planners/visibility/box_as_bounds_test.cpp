// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/visibility_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/plane/polygon.hpp"

namespace warren {
namespace {

bool is_blocked(const PlaneObstacles& obstacles, Vec2 p) {
  for (std::size_t i = 0; i < obstacles.polygons.size(); ++i) {
    if (strictly_inside(obstacles.polygons[i], p)) return true;
  }
  return false;
}

TEST(ConfinedObstacles, BehindEachWallOnASideOfTheBoxAllIsBlockedUpToTheBounds) {
  PlaneObstacles outline;
  outline.walls = {{{0, 0}, {4, 0}}, {{0, 0}, {0, 2}}, {{4, 0}, {4, 2}}, {{0, 2}, {4, 2}}, {{2, 0}, {2, 1}}};
  const PlaneObstacles closed = confined(outline);
  ASSERT_TRUE(closed.bounds);
  for (const double away : {1e-9, 1.0, 3.9}) {
    SCOPED_TRACE(away);
    EXPECT_TRUE(closed.bounds->contains({-away, -away}) && closed.bounds->contains({4 + away, 2 + away}));
    for (const Vec2 p : {Vec2{1, -away}, {1, 2 + away}, {-away, 1}, {4 + away, 1}}) {
      EXPECT_TRUE(is_blocked(closed, p)) << p.x << " " << p.y;
    }
  }
  EXPECT_FALSE(is_blocked(closed, {1, 1}));
  outline.walls.erase(outline.walls.begin() + 3);  // without the upper one its side is open
  EXPECT_FALSE(is_blocked(confined(outline), {1, 2.1}));
}

}  // namespace
}  // namespace warren
