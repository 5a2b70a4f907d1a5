// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/kept_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/serve/http/http_message.hpp"
#include "tests/memory_limit.hpp"

namespace warren::serve {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();
constexpr Box everything{{-far_away, -far_away}, {far_away, far_away}};

Path<Vec2> staircase(std::size_t points) {
  Path<Vec2> path;
  for (std::size_t i = 0; i < points; ++i) {
    path.push_back({static_cast<double>(i / 2 + i % 2), static_cast<double>(i / 2)});
  }
  return path;
}

double distance_from(const std::vector<Vec2>& chain, Vec2 p) {
  double least = far_away;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Vec2 along = chain[i + 1] - chain[i];
    const double share = std::clamp(dot(p - chain[i], along) / std::max(dot(along, along), 1e-300), 0.0, 1.0);
    least = std::min(least, distance(p, chain[i] + share * along));
  }
  return least;
}

TEST(PathView, WithoutPixelsItIsThePath) {
  const Path<Vec2> path = staircase(101);
  const auto chains = seen_of(KeptCurve(path, {}), {.box = everything}, {});
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0], std::vector<Vec2>(path.begin(), path.end()));
}

TEST(PathView, PointsOfAPixelAreOneAndNoneIsFartherThanThatFromWhatIsDrawn) {
  const Path<Vec2> path = staircase(10'001);
  for (const double pixel : {0.5, 2.0, 30.0, 1e6}) {
    SCOPED_TRACE(pixel);
    const auto chains = seen_of(KeptCurve(path, {}), {.box = everything, .pixel = pixel}, {});
    ASSERT_EQ(chains.size(), 1U);
    EXPECT_EQ(chains[0].front(), path.front());
    EXPECT_EQ(chains[0].back(), path.back());
    const double of_blocks = static_cast<double>(KeptCurve(path, {}).block_count() - 1);
    EXPECT_LE(static_cast<double>(chains[0].size()) - of_blocks,
              7072.0 / pixel + 10'001.0 * (pixel <= 1.0 ? 1.0 : 0.0) + 3.0);
    double worst = 0.0;
    for (std::size_t i = 0; i < path.size(); i += 77) worst = std::max(worst, distance_from(chains[0], path[i]));
    EXPECT_LE(worst, pixel);
  }
}

TEST(PathView, OnlyLegsThatMeetTheBoxAreThere) {
  // In, out, far round and in again.
  const Path<Vec2> path{{0, 0}, {5, 0}, {20, 0}, {20, 20}, {0, 20}, {0, 8}, {4, 8}};
  const auto chains = seen_of(KeptCurve(path, {}), {.box = {{-1, -1}, {9, 9}}}, {});
  const std::vector<std::vector<Vec2>> expected{{{0, 0}, {5, 0}, {20, 0}}, {{0, 20}, {0, 8}, {4, 8}}};
  EXPECT_EQ(chains, expected);
  EXPECT_TRUE(seen_of(KeptCurve(path, {}), {.box = {{100, 100}, {101, 101}}}, {}).empty());
}

TEST(PathView, AChainEndsWhereThePathLeaves) {
  const Path<Vec2> path{{0, 0}, {1, 0}, {1.1, 0}, {1.2, 0}, {1.2, 50}, {60, 50}, {60, 60}};
  const auto chains = seen_of(KeptCurve(path, {}), {.box = {{-1, -1}, {9, 9}}, .pixel = 1.0}, {});
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].back(), (Vec2{1.2, 50}));
}

/// What is seen, leg by leg, without blocks.
std::vector<std::vector<Vec2>> legs_in(const Path<Vec2>& path, const Box& box) {
  std::vector<std::vector<Vec2>> chains;
  bool is_open = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const bool is_seen = box_of({path[i], path[i + 1]}).meets(box);
    if (is_seen && !is_open) chains.push_back({path[i]});
    if (is_seen) chains.back().push_back(path[i + 1]);
    is_open = is_seen;
  }
  return chains;
}

TEST(PathView, LongPathsAreSeenAsIfTheyHadNoBlocks) {
  const auto side = static_cast<double>(KeptCurve::block_points / 2);
  Path<Vec2> path = staircase(5 * KeptCurve::block_points + 77);
  for (std::size_t i = 0; i < 99; ++i) path.push_back({path.back().x - 1.0, path.back().y});
  for (const Box& box : {everything, Box{{side - 5.0, 0.0}, {side + 5.0, 1e9}}, Box{{side, side}, {side, side}},
                         Box{{2.5 * side, 0.0}, {3.5 * side, 1e9}}, Box{{0.0, 0.0}, {2.0 * side, side}}}) {
    for (const unsigned threads : {1U, 2U, 3U}) {
      EXPECT_EQ(seen_of(KeptCurve(path, {}), {.box = box}, {.threads = threads}), legs_in(path, box));
    }
  }
  const auto alone = seen_of(KeptCurve(path, {}), {.box = everything, .pixel = 9.0}, {.threads = 1});
  EXPECT_EQ(seen_of(KeptCurve(path, {}), {.box = everything, .pixel = 9.0}, {.threads = 3}), alone);
  ASSERT_EQ(alone.size(), 1U);
  for (std::size_t i = 0; i < path.size(); i += 777) EXPECT_LE(distance_from(alone[0], path[i]), 9.0);
}

TEST(PathView, OfALongPathNoMoreIsMadeThanMayBeTold) {
  const KeptCurve curve(staircase(3'000'000), {});
  constexpr double forever = far_away;
  const Deadline enough(forever, resident_bytes() + (std::size_t{128} << 20U));
  EXPECT_THROW(seen_of(curve, {.box = everything, .most_points = 100'000}, {.deadline = &enough}), HttpError);
  const std::size_t few = seen_of(curve, {.box = everything, .pixel = 99.0}, {.deadline = &enough})[0].size();
  EXPECT_EQ(seen_of(curve, {.box = everything, .pixel = 99.0, .most_points = few}, {})[0].size(), few);
  EXPECT_THROW(seen_of(curve, {.box = everything, .pixel = 99.0, .most_points = few - 1}, {}), HttpError);
  const Deadline poor = test::limit_from_here(std::size_t{4} << 20U);
  EXPECT_THROW(seen_of(curve, {.box = everything}, {.deadline = &poor}), Stopped);
}

TEST(PathView, APathOfOnePointIsSeenWhereItIs) {
  EXPECT_EQ(seen_of(KeptCurve({{3, 4}}, {}), {.box = {{0, 0}, {9, 9}}}, {}),
            (std::vector<std::vector<Vec2>>{{{3, 4}}}));
  EXPECT_TRUE(seen_of(KeptCurve({{30, 4}}, {}), {.box = {{0, 0}, {9, 9}}}, {}).empty());
}

TEST(PathView, ArcsOfCarsAreChords) {
  Answer answer;
  answer.problem.robot = {.kind = RobotKind::car, .turning_radius = 2.0};
  const double quarter = std::acos(-1.0) / 2.0;
  answer.states.width = 3;
  answer.states.numbers = {0.0, 0.0, 0.0, 2.0, 2.0, quarter};
  answer.path = {{0, 0}, {2, 2}};
  const Path<Vec2> curve = curve_of(answer, {});
  EXPECT_GT(curve.size(), 15U);
  for (const Vec2 p : curve) EXPECT_NEAR(distance(p, Vec2{0.0, 2.0}), 2.0, 1e-9);
}

}  // namespace
}  // namespace warren::serve
