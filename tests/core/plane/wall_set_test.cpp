// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/wall_set.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/base/solution.hpp"

namespace warren {
namespace {

TEST(WallSet, KeepsEveryCoordinateExactlyInTheNarrowestType) {
  struct Case {
    double coordinate;
    bool as_float;
  };
  // 2^24 + 1 is the first whole number that a float can't hold; 2^-149 is the smallest that it can.
  constexpr Case cases[] = {{0.5, true},   {-0.0, true},           {16777216.0, true}, {16777217.0, false},
                            {0.1, false},  {0x1.0p-149, true},     {1e-100, false},    {1e39, false},
                            {1e60, false}, {0x1.fffffep+127, true}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.coordinate);
    for (int place = 0; place < 4; ++place) {
      double xy[4] = {1.0, 2.5, -3.0, 4.0};
      xy[place] = c.coordinate;
      const std::vector<Segment> segments{{{0.0, 0.0}, {1.0, 0.0}}, {{xy[0], xy[1]}, {xy[2], xy[3]}}};
      const WallSet walls = WallSet::narrowest(segments);
      EXPECT_EQ(walls.holds_floats(), c.as_float);
      ASSERT_EQ(walls.size(), 2U);
      EXPECT_EQ(walls.segment(0), segments[0]);
      EXPECT_EQ(walls.segment(1), segments[1]);
      EXPECT_EQ(walls.bytes(), c.as_float ? 32U : 64U);
    }
  }
}

TEST(WallSet, WithoutWallsIsEmpty) {
  EXPECT_EQ(WallSet().size(), 0U);
  EXPECT_EQ(WallSet::narrowest({}).size(), 0U);
  EXPECT_EQ(WallSet().bytes(), 0U);
}

TEST(Errors, AreOneLineThatNamesThePlace) {
  EXPECT_STREQ(InputError("a.scene:3", "expected four numbers", "x").what(),
               "a.scene:3: expected four numbers (found: x)");
  EXPECT_STREQ(InputError("--samples", "must be at least 1").what(), "--samples: must be at least 1");
  EXPECT_STREQ(ReadError("b.npy", "no such file").what(), "b.npy: can't be read: no such file");
  EXPECT_STREQ(WriteError("c.svg", "disk full").what(), "c.svg: can't be written: disk full");
}

TEST(Solution, OutcomesHaveTheNamesOfTheAnswerFormat) {
  EXPECT_EQ(name_of(Outcome::solved), "solved");
  EXPECT_EQ(name_of(Outcome::start_blocked), "start_blocked");
  EXPECT_EQ(name_of(Outcome::goal_blocked), "goal_blocked");
  EXPECT_EQ(name_of(Outcome::not_connected), "not_connected");
  EXPECT_EQ(name_of(Outcome::infeasible), "infeasible");
  EXPECT_EQ(name_of(Outcome::stopped), "stopped");
}

TEST(PathLength, SumsTheMotionsAndIsZeroForOneState) {
  const auto between = [](Vec2 a, Vec2 b) { return distance(a, b); };
  EXPECT_EQ(path_length(std::vector<Vec2>{{0.0, 0.0}, {3.0, 4.0}, {3.0, 5.0}}, between), 6.0);
  EXPECT_EQ(path_length(std::vector<Vec2>{{1.0, 1.0}}, between), 0.0);
  EXPECT_EQ(path_length(std::vector<Vec2>{}, between), 0.0);
}

TEST(Counters, AddUpFieldByField) {
  Counters sum{1, 2, 3, 4, 5};
  sum += Counters{10, 20, 30, 40, 50};
  EXPECT_EQ(sum, (Counters{11, 22, 33, 44, 55}));
}

}  // namespace
}  // namespace warren
