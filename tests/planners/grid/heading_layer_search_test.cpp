// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/heading_layer_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <set>
#include <tuple>

#include "core/base/error.hpp"
#include "tests/planners/grid/grid_oracle.hpp"
#include "tests/seeds.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/rasters/heading_layers.hpp"

namespace warren {
namespace {

/// From one state to a cell; goal_heading: nullopt for any.
LayerPath layer_search(const HeadingLayers& layers, const LayerState& start, Cell goal,
                       std::optional<std::uint32_t> goal_heading, const LayerSearchOptions& options,
                       const Execution& execution) {
  std::vector<LayerEnd> goals;
  for (std::uint32_t k = 0; k < layers.angles && !goal_heading; ++k) goals.push_back({{goal.x, goal.y, k}});
  if (goal_heading) goals.push_back({{goal.x, goal.y, *goal_heading}});
  const LayerEnd only{start};
  return layer_search(layers, std::span(&only, 1), goals, options, execution);
}

/// The course's scene: a square of 50 in corridors of 50 to 300, y down.
Scene course_scene() {
  Scene scene;
  scene.bounds = Box{{0, 0}, {800, 300}};
  const std::vector<Segment> walls{{{200, 0}, {200, 200}},
                                   {{100, 200}, {300, 200}},
                                   {{400, 100}, {400, 300}},
                                   {{600, 0}, {600, 200}},
                                   {{500, 200}, {700, 200}}};
  scene.walls = WallSet::narrowest(walls);
  return scene;
}

RobotSpec square(double half) {
  RobotSpec robot;
  robot.kind = RobotKind::polygon;
  robot.outline = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  return robot;
}

std::size_t distinct(const std::vector<std::uint32_t>& numbers) {
  return std::set<std::uint32_t>(numbers.begin(), numbers.end()).size();
}

std::vector<Se2> poses_of(const HeadingLayers& layers, const LayerPath& path) {
  std::vector<Se2> poses;
  for (const LayerState& s : path.states) {
    poses.push_back({layers.origin.x + layers.cell * s.i, layers.origin.y + layers.cell * s.j,
                     2.0 * std::numbers::pi * s.k / layers.angles});
  }
  return poses;
}

TEST(LayerSearch, ExactLayersOfTheCourseSceneHaveItsFiguresAndSafePaths) {
  const Scene scene = course_scene();
  const HeadingLayers layers = orientation_layers(scene, square(25), {{2, 72}}, {});
  EXPECT_EQ(layers.states(), 4'320'000U);
  EXPECT_EQ(layers.free_at(0), 34'375U);
  EXPECT_EQ(layers.free_at(9), 26'005U);
  EXPECT_EQ(layers.free_states(), 2'049'072U);
  EXPECT_EQ(distinct(layers.standing), 18U);
  struct Case {
    Diagonal diagonal;
    bool face_motion;
    double cost;
  };
  // 684 is what two independent programs found; the others are ours.
  for (const Case& c :
       {Case{Diagonal::unit, true, 684.0}, Case{Diagonal::sqrt2, true, 684.0 + 120 * (std::sqrt(2.0) - 1)},
        Case{Diagonal::unit, false, 567.0}}) {
    const LayerPath path = layer_search(layers, {25, 25, 0}, {375, 25}, std::nullopt,
                                        {.diagonal = c.diagonal, .face_motion = c.face_motion}, {});
    ASSERT_EQ(path.status, SearchStatus::found);
    EXPECT_NEAR(path.cost, c.cost, 1e-3);
    if (c.face_motion) {
      EXPECT_EQ(path.steps, 558U);
      EXPECT_EQ(path.turns, 126U);
    }
    const Verification verified = verify_se2(scene, square(25).outline, poses_of(layers, path), {}, {});
    EXPECT_TRUE(verified.verified);
  }
}

TEST(LayerSearch, ReportLayersOfTheCourseSceneGiveTheReportsNumbers) {
  const HeadingLayers layers =
      orientation_layers(course_scene(), square(25), {.grid = {2, 72}, .kind = LayerKind::report004}, {});
  EXPECT_EQ(layers.free_states(), 1'821'064U);
  EXPECT_EQ(layers.bitmaps.size(), 6U);
  const LayerPath path =
      layer_search(layers, {25, 25, 0}, {375, 25}, std::nullopt, {.diagonal = Diagonal::unit, .face_motion = true}, {});
  EXPECT_EQ(path.cost, 735.0);
  EXPECT_EQ(path.steps, 609U);
  EXPECT_EQ(path.diagonals, 75U);
  EXPECT_EQ(path.turns, 126U);
  const LayerPath longer = layer_search(layers, {25, 25, 0}, {375, 25}, std::nullopt, {.face_motion = true}, {});
  EXPECT_NEAR(longer.cost, 766.066, 1e-3);
}

TEST(LayerSearch, ReportLayersOfWallsThatLeaveTheGridAreThoseOfTheirPartsInIt) {
  const auto layers_of = [](double beyond) {
    Scene scene = course_scene();
    const std::vector<Segment> walls{{{-beyond, 100}, {800 + beyond, 100}}, {{400, 300 + beyond}, {400, -beyond}}};
    scene.walls = WallSet::narrowest(walls);
    return orientation_layers(scene, square(25), {.grid = {2, 72}, .kind = LayerKind::report004}, {});
  };
  EXPECT_EQ(layers_of(1e15).free_states(), layers_of(10.0).free_states());
}

/// A small scene of random walls and a triangle that does not hold its reference point.
Scene random_scene(std::uint64_t seed) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {24, 18}};
  std::vector<Segment> walls;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Vec2 a{24 * uniform(seed, i, 0), 18 * uniform(seed, i, 1)};
    walls.push_back({a, a + Vec2{8 * uniform(seed, i, 2) - 4, 8 * uniform(seed, i, 3) - 4}});
  }
  scene.walls = WallSet::narrowest(walls);
  return scene;
}

std::vector<Vec2> body_of(std::uint64_t seed) {
  if (seed % 3 == 0) return {{-1.3, -0.4}, {1.1, -0.5}, {0.9, 0.6}, {-1.2, 0.5}};
  if (seed % 3 == 1) return {{0.4, 0.3}, {2.1, 0.2}, {1.0, 1.1}};
  return {{-1, -1}, {1, -1}, {1, 1}, {0.2, -0.6}, {-1, 1}};  // not convex
}

/// Dijkstra over all states with plain arrays; moves are asked of the layers bit by bit.
double plain_cost(const HeadingLayers& layers, const LayerState& start, Cell goal, std::optional<std::uint32_t> heading,
                  const LayerSearchOptions& options) {
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t, std::uint32_t>;
  std::vector<double> cost(layers.states(), std::numeric_limits<double>::infinity());
  const auto at = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) -> double& {
    return cost[(std::size_t{k} * layers.height + j) * layers.width + i];
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, double c) {
    if (!layers.is_free(i, j, k) || c >= at(i, j, k)) return;
    at(i, j, k) = c;
    queue.emplace(c, i, j, k);
  };
  reach(start.i, start.j, start.k, 0.0);
  while (!queue.empty()) {
    const auto [c, i, j, k] = queue.top();
    queue.pop();
    if (c > at(i, j, k)) continue;
    if (i == goal.x && j == goal.y && (!heading || k == *heading)) return c;
    for (int s = 0; s < 4; ++s) {
      const auto [dx, dy] = HeadingLayers::steps[static_cast<std::size_t>(s)];
      const Bitmap& swept = layers.bitmaps[layers.moving[k][static_cast<std::size_t>(s)]];
      const double length = dx * dy != 0 && options.diagonal == Diagonal::sqrt2 ? std::sqrt(2.0) : 1.0;
      for (const int sign : {1, -1}) {
        const std::int64_t to_i = std::int64_t{i} + sign * dx;
        const std::int64_t to_j = std::int64_t{j} + sign * dy;
        if (to_i < 0 || to_j < 0 || to_i >= layers.width || to_j >= layers.height) continue;
        const double angle = std::atan2(sign * dy, sign * dx);
        const double k_angle = 2 * std::numbers::pi * k / layers.angles;
        if (options.face_motion && std::abs(std::remainder(angle - k_angle, 2 * std::numbers::pi)) > 1e-9) continue;
        const auto u = static_cast<std::uint32_t>(to_i);
        const auto v = static_cast<std::uint32_t>(to_j);
        if (!(sign > 0 ? swept.test(i, j) : swept.test(u, v))) reach(u, v, k, c + options.step_cost * length);
      }
    }
    const std::uint32_t next = (k + 1) % layers.angles;
    const std::uint32_t previous = (k + layers.angles - 1) % layers.angles;
    if (!layers.bitmaps[layers.turning[k]].test(i, j)) reach(i, j, next, c + options.turn_cost);
    if (!layers.bitmaps[layers.turning[previous]].test(i, j)) reach(i, j, previous, c + options.turn_cost);
  }
  return std::numeric_limits<double>::infinity();
}

TEST(LayerSearch, CostsEqualAPlainDijkstraAndPathsAreVerified) {
  std::uint64_t found = 0;
  for (const std::uint64_t seed : test::seeds(30, 8, 0)) {
    SCOPED_TRACE(seed);
    const Scene scene = random_scene(seed);
    RobotSpec robot;
    robot.kind = RobotKind::polygon;
    robot.outline = body_of(seed);
    const HeadingLayers layers = orientation_layers(scene, robot, {{0.75, seed % 2 == 0 ? 16U : 24U}}, {});
    const LayerState start{4, 4, static_cast<std::uint32_t>(seed % 16)};
    const Cell goal{26, 18};
    std::optional<std::uint32_t> heading;
    if (seed % 4 < 2) heading = 5;
    const LayerSearchOptions options{.diagonal = seed % 5 == 0 ? Diagonal::unit : Diagonal::sqrt2,
                                     .step_cost = 0.7,
                                     .turn_cost = 0.3,
                                     .face_motion = seed % 7 == 0};
    const LayerPath path = layer_search(layers, start, goal, heading, options, {});
    const double expected = plain_cost(layers, start, goal, heading, options);
    ASSERT_EQ(path.status == SearchStatus::found, std::isfinite(expected));
    if (path.status != SearchStatus::found) continue;
    ++found;
    EXPECT_NEAR(path.cost, expected, 1e-9);
    EXPECT_EQ(path.states.front(), start);
    const Verification verified = verify_se2(scene, robot.outline, poses_of(layers, path), {}, {});
    EXPECT_TRUE(verified.verified) << verified.first_violation.value_or(Violation{}).obstacle;
  }
  EXPECT_GT(found, test::share(5));
}

TEST(LayerSearch, TheCheapestOfSeveralEndsIsTakenWithWhatItCosts) {
  std::uint64_t found = 0;
  for (const std::uint64_t seed : test::seeds(20, 5, 0)) {
    SCOPED_TRACE(seed);
    RobotSpec robot;
    robot.kind = RobotKind::polygon;
    robot.outline = body_of(seed);
    const HeadingLayers layers = orientation_layers(random_scene(seed), robot, {{1.5, 8}}, {});
    const auto number = [&](std::uint64_t n, std::uint64_t axis, std::uint32_t end) {
      return static_cast<std::uint32_t>(uniform(seed, n, 40 + axis) * end);
    };
    std::vector<LayerEnd> starts;
    std::vector<LayerEnd> goals;
    for (std::uint64_t n = 0; n < 3; ++n) {
      starts.push_back({{number(n, 0, 6), number(n, 1, layers.height), number(n, 2, 8)}, 9 * uniform(seed, n, 50)});
      goals.push_back({{10 + number(n, 3, 6), number(n, 4, layers.height), number(n, 5, 8)}, 9 * uniform(seed, n, 51)});
    }
    for (std::size_t n = 0; n < 3; ++n) {  // each once more, dearer or cheaper
      starts.push_back({starts[n].state, starts[n].cost + (n == 0 ? 1.0 : -0.25 * starts[n].cost)});
      goals.push_back({goals[n].state, goals[n].cost + (n == 1 ? 1.0 : -0.25 * goals[n].cost)});
    }
    const LayerSearchOptions options{.turn_cost = 0.6};
    double expected = std::numeric_limits<double>::infinity();
    for (const LayerEnd& start : starts) {
      for (const LayerEnd& goal : goals) {
        const double way = plain_cost(layers, start.state, {goal.state.i, goal.state.j}, goal.state.k, options);
        expected = std::min(expected, start.cost + way + goal.cost);
      }
    }
    const LayerPath path = layer_search(layers, starts, goals, options, {});
    ASSERT_EQ(path.status == SearchStatus::found, std::isfinite(expected));
    if (path.status != SearchStatus::found) continue;
    ++found;
    EXPECT_NEAR(path.cost, expected, 1e-9);
  }
  EXPECT_GT(found, test::share(5));
}

TEST(LayerSearch, RefusesStatesOutsideAndCostsOutOfRange) {
  const HeadingLayers layers = orientation_layers(course_scene(), square(25), {{10, 4}}, {});
  EXPECT_THROW(layer_search(layers, {80, 0, 0}, {5, 5}, std::nullopt, {}, {}), InputError);
  EXPECT_THROW(layer_search(layers, {5, 5, 4}, {5, 5}, std::nullopt, {}, {}), InputError);
  EXPECT_THROW(layer_search(layers, {5, 5, 0}, {5, 30}, std::nullopt, {}, {}), InputError);
  EXPECT_THROW(layer_search(layers, {5, 5, 0}, {5, 5}, 4, {}, {}), InputError);
  EXPECT_THROW(layer_search(layers, {5, 5, 0}, {5, 5}, std::nullopt, {.turn_cost = 0.0}, {}), InputError);
  const LayerEnd owed{{5, 5, 0}, -1.0};
  EXPECT_THROW(layer_search(layers, std::span(&owed, 1), std::span(&owed, 1), {}, {}), InputError);
  EXPECT_THROW(orientation_layers(course_scene(), square(25), {{0, 4}}, {}), InputError);
  EXPECT_THROW(orientation_layers(Scene{}, square(25), {{1, 4}}, {}), InputError);
}

}  // namespace
}  // namespace warren
