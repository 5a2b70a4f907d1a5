// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/wall_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(WallSet, PacksLevelAndUprightWallsOfQuarters) {
  constexpr double most = 262143.75;
  struct Case {
    Segment wall;
    bool is_packed;
  };
  const Case cases[] = {{{{0.5, 1.5}, {0.5, 2.5}}, true},           {{{0.5, 2.5}, {0.5, -1.25}}, true},
                        {{{-3.5, 2.5}, {1.25, 2.5}}, true},         {{{-3.5, 2.5}, {-3.5, 2.5}}, true},
                        {{{-most, most}, {0.0, most}}, true},       {{{most, -most}, {most, 0.0}}, true},
                        {{{most, -most}, {most, 0.25}}, false},     {{{most + 0.25, 0.0}, {1.0, 0.0}}, false},
                        {{{0.0, 0.0}, {0.0, -most - 0.25}}, false}, {{{0.5, 0.5}, {1.0, 1.0}}, false},
                        {{{0.125, 0.5}, {1.0, 0.5}}, false},        {{{0.0, 0.5}, {-0.0, 0.75}}, false},
                        {{{-0.0, 0.5}, {1.0, 0.5}}, false}};
  for (const Case& c : cases) {
    const auto& [a, b] = c.wall;
    SCOPED_TRACE(testing::Message() << a.x << " " << a.y << " " << b.x << " " << b.y);
    EXPECT_EQ(PackedWall::fits(a.x, a.y, b.x, b.y), c.is_packed);
    const WallSet walls = WallSet::narrowest(std::vector<Segment>{{{4.0, 4.0}, {4.0, 5.0}}, c.wall});
    EXPECT_EQ(walls.holds_packed(), c.is_packed);
    EXPECT_EQ(walls.bytes(), c.is_packed ? 16U : 32U);
    EXPECT_EQ(walls.segment(1), c.wall);
    EXPECT_EQ(std::signbit(walls.segment(1).b.x), std::signbit(b.x));
    if (!c.is_packed) continue;
    const FloatWall numbers = unpacked(PackedWall::of(a.x, a.y, b.x, b.y));
    EXPECT_EQ(numbers.segment(), c.wall);
  }
  EXPECT_FALSE(PackedWall::fits(0.0, 0.0, 0.0, std::nan("")));
  EXPECT_FALSE(PackedWall::fits(HUGE_VALF, 0.0F, HUGE_VALF, 0.0F));
}

TEST(WallSet, PackedWallsAreReadBackToTheBit) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const auto steps = [&](std::uint64_t axis) {
      return static_cast<std::int32_t>(random_bits(4, i, axis) % 2097151) - PackedWall::most;
    };
    const bool is_upright = i % 2 == 0;
    const PackedWall wall = is_upright ? PackedWall::upright(steps(0), steps(1), steps(2))
                                       : PackedWall::level(steps(0), steps(1), steps(2));
    const PackedWall::Ends e = wall.ends();
    EXPECT_EQ(e.x1, steps(0));
    EXPECT_EQ(e.y1, steps(1));
    EXPECT_EQ(e.x2, is_upright ? steps(0) : steps(0) + steps(2));
    EXPECT_EQ(e.y2, is_upright ? steps(1) + steps(2) : steps(1));
  }
}

TEST(WallSet, AWallOfLengthZeroHasOneWord) {
  for (const std::int32_t x : {-PackedWall::most, -3, 0, 7, PackedWall::most}) {
    for (const std::int32_t y : {-PackedWall::most, 0, 1, PackedWall::most}) {
      EXPECT_EQ(PackedWall::upright(x, y, 0), PackedWall::level(x, y, 0));
      EXPECT_FALSE(PackedWall::upright(x, y, 0).is_upright());
    }
  }
  EXPECT_NE(PackedWall::upright(1, 2, 3), PackedWall::level(1, 2, 3));
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
