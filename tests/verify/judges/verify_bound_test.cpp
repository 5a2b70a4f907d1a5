// SPDX-License-Identifier: BSD-3-Clause
// The judge's own search agrees with the planner of shortest paths, and refuses what is above it.
#include "verify/judges/verify_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

/// Boxes and walls on whole numbers: they touch at corners, share sides, overlap and cross.
Scene touching_boxes(std::uint64_t seed) {
  std::uint64_t index = 0;
  const auto draw = [&](double n) { return std::floor(n * uniform(seed, index++, 0)); };
  Scene scene;
  std::vector<Segment> walls;
  for (int i = 0; i < 12; ++i) {
    const Vec2 low{2 + draw(11), 1 + draw(13)};
    const Vec2 high = low + Vec2{1 + draw(3), 1 + draw(3)};
    if (i % 3 == 2) {
      walls.push_back({low, {high.x, low.y + draw(3)}});
    } else {
      scene.polygons.push_back({{low, {high.x, low.y}, high, {low.x, high.y}}});
    }
  }
  scene.walls = WallSet::narrowest(walls);
  scene.bounds = Box{{0, 0}, {17, 17}};
  return scene;
}

/// Walls of length 1 on a grid: they go on in one another, branch and end.
Scene walls_in_pieces(std::uint64_t seed) {
  std::vector<Segment> walls;
  for (std::uint64_t i = 0; i < 200; ++i) {
    if (uniform(seed, i, 2) > 0.35) continue;
    const Vec2 at{3.0 + static_cast<double>(i / 2 % 10), 3.0 + static_cast<double>(i / 20)};
    walls.push_back({at, at + (i % 2 == 0 ? Vec2{1, 0} : Vec2{0, 1})});
  }
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  scene.bounds = Box{{0, 0}, {17, 17}};
  return scene;
}

BoundVerdict said_of(const Scene& scene, Vec2 start, Vec2 goal, double bound, double length, double radius = 0.0) {
  const RobotSpec body{.kind = RobotKind::disc, .radius = radius};
  const std::array ends{start.x, start.y, goal.x, goal.y};
  const std::span<const double> all(ends);
  return verify_bound(scene, {body, all.first(2), all.last(2)}, {.lower_bound = bound, .length = length}, {}).verdict;
}

TEST(VerifyBound, TheJudgesSearchIsThePlannersShortestPath) {
  std::size_t around = 0;
  for (const std::uint64_t seed : test::seeds(400, 60)) {
    SCOPED_TRACE(seed);
    const Scene scene = seed % 2 == 0 ? touching_boxes(seed) : walls_in_pieces(seed);
    const Vec2 start{1, 2 + std::floor(13 * uniform(seed, 0, 1))};
    const Vec2 goal{16, 2 + 13 * uniform(seed, 1, 1)};
    const Solution<Vec2> shortest = confined_visibility_path(plane_obstacles(scene, {}), start, goal, {}, {});
    if (shortest.outcome != Outcome::solved) continue;
    const double length = path_length(shortest.path, [](Vec2 a, Vec2 b) { return distance(a, b); });
    if (length > 1.001 * distance(start, goal)) ++around;
    EXPECT_EQ(said_of(scene, start, goal, length, length), BoundVerdict::checked);
    EXPECT_EQ(said_of(scene, start, goal, 0.5 * length, length), BoundVerdict::checked);
    EXPECT_EQ(said_of(scene, start, goal, length * (1.0 + 1e-7), 2.0 * length), BoundVerdict::refuted);
    EXPECT_EQ(said_of(scene, start, goal, length * (1.0 + 1e-7), length), BoundVerdict::refuted);
    EXPECT_EQ(said_of(scene, start, goal, length, 2.0 * length, 0.2), BoundVerdict::checked);
    EXPECT_EQ(said_of(scene, start, goal, length * 1.001, 2.0 * length, 0.2), BoundVerdict::unchecked);
  }
  EXPECT_GT(around, 10U);
}

/// A way around a wall, and beside it sides that are short against what the claim leaves: many walks to and fro and
/// around would be short enough, and all of them would be asked about before the search is over.
TEST(VerifyBound, ShortSidesAreNotWalkedToAndFro) {
  const auto said = [](std::vector<ScenePolygon> polygons, std::vector<Segment> walls) {
    Scene scene;
    walls.push_back({{5, 0}, {5, 8}});
    scene.walls = WallSet::narrowest(walls);
    scene.polygons = std::move(polygons);
    scene.bounds = Box{{0, 0}, {10, 10}};
    const double length = 2.0 * distance(Vec2{1, 1}, Vec2{5, 8});
    EXPECT_EQ(said_of(scene, {1, 1}, {9, 1}, length * (1.0 + 1e-6), 2.0 * length), BoundVerdict::refuted);
    return said_of(scene, {1, 1}, {9, 1}, length, length);
  };
  for (const double side : {0.1, 0.01, 1e-4, 1e-9}) {
    SCOPED_TRACE(side);
    EXPECT_EQ(said({{{{3, 3}, {4, 3 + 0.5 * side}, {3, 3 + side}}}}, {}), BoundVerdict::checked);
    EXPECT_EQ(said({}, {{{3, 3}, {3, 3 + side}}, {{3, 3 + side}, {3, 3 + 2.0 * side}}}), BoundVerdict::checked);
    EXPECT_EQ(said({}, {{{5, 8}, {5, 8 - side}}, {{5, 8 - side}, {5 - 0.5 * side, 8 - side}}}), BoundVerdict::checked);
  }
  for (const int corners : {8, 60}) {
    ScenePolygon round;
    for (int i = 0; i < corners; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / corners;
      round.corners.push_back({3 + 0.4 * std::cos(turn), 3 + 0.4 * std::sin(turn)});
    }
    EXPECT_EQ(said({round}, {}), BoundVerdict::checked);
  }
  std::vector<Segment> pieces;
  for (int i = 0; i < 40; ++i) pieces.push_back({{3, 3 + 0.02 * i}, {3, 3 + 0.02 * (i + 1)}});
  EXPECT_EQ(said({}, pieces), BoundVerdict::checked);
}

TEST(VerifyBound, ACostIsThePathsOwnInTheBodysMetric) {
  const Scene scene = touching_boxes(1);
  const RobotSpec bar{.kind = RobotKind::polygon, .outline = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const std::array<double, 9> states{1, 1, 0, 4, 5, 1, 4, 5, 2};
  const std::span<const double> all(states);
  const double root = std::numbers::sqrt2;
  const double cost = std::sqrt(25.0 + 2.0) + root;
  const double least = std::sqrt(25.0 + 8.0);
  const auto verdict = [&](double bound, double claimed) {
    return verify_bound(scene, {bar, all.first(3), all.last(3)}, {bound, claimed, 5.0, 3, states}, {}).verdict;
  };
  EXPECT_EQ(verdict(least, cost), BoundVerdict::checked);
  EXPECT_EQ(verdict(least * 1.0001, cost), BoundVerdict::unchecked);
  EXPECT_EQ(verdict(cost * 1.0001, cost), BoundVerdict::refuted);
  EXPECT_EQ(verdict(least, cost * 1.0001), BoundVerdict::refuted);
}

TEST(VerifyBound, OfAnArmIsTheWayInJointSpaceAndOfAPlaceNothingIsKnown) {
  const Scene scene;
  const RobotSpec arm{.kind = RobotKind::puma560};
  const std::array<double, 6> start{};
  const std::array<double, 6> goal{3, 4, 0, 0, 0, 0};
  const std::array<double, 3> place{0.1, 0.2, 0.3};
  const auto verdict = [&](std::span<const double> to, double bound) {
    return verify_bound(scene, {arm, start, to}, {.lower_bound = bound, .length = 9.0, .width = 6}, {}).verdict;
  };
  EXPECT_EQ(verdict(goal, 5.0), BoundVerdict::checked);
  EXPECT_EQ(verdict(goal, 5.1), BoundVerdict::unchecked);
  EXPECT_EQ(verdict(place, 0.1), BoundVerdict::unchecked);
  EXPECT_EQ(verdict(place, 9.1), BoundVerdict::refuted);
}

TEST(VerifyBound, AStraightTourIsTheShortestOfAllOrders) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto drawn = [&](std::uint64_t i) { return Vec2{uniform(seed, i, 0), uniform(seed, i, 1)}; };
    std::vector<Vec2> stops;
    for (std::uint64_t i = 0; i < 1 + seed % 5; ++i) stops.push_back(drawn(10 + i));
    for (const std::optional<Vec2>& end : {std::optional<Vec2>(), std::optional(drawn(1)), std::optional(drawn(0))}) {
      std::vector<std::size_t> order(stops.size());
      std::iota(order.begin(), order.end(), 0);
      double least = 1e9;
      do {
        double way = end ? distance(stops[order.back()], *end) : 0.0;
        Vec2 at = drawn(0);
        for (const std::size_t stop : order) way += distance(std::exchange(at, stops[stop]), stops[stop]);
        least = std::min(least, way);
      } while (std::next_permutation(order.begin(), order.end()));
      EXPECT_NEAR(straight_tour(drawn(0), stops, end), least, 1e-12) << seed;
    }
  }
}

}  // namespace
}  // namespace warren
