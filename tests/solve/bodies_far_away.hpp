// SPDX-License-Identifier: BSD-3-Clause
// Small bodies far from the origin, among walls not much larger than they are: questions whose answers a judge refutes
// if a planner keeps less room than the judge takes for rounding. A seed's question is the same everywhere.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/solve.hpp"

namespace warren::test {

struct FarTally {
  std::uint64_t solved = 0;
  std::uint64_t unsolved = 0;          ///< blocked, not connected, stopped
  std::vector<std::string> refuted{};  ///< what the judge said, seed by seed
};

/// A world sixty times as wide as the body, at the offset: a map or walls.
inline Scene scene_far_away(std::uint64_t seed, Vec2 offset, double size) {
  const double side = 60.0 * size;
  Scene scene;
  if (seed / 12 % 4 == 3) {
    scene.map.emplace().blocked = Bitmap(40, 40);
    scene.map->cell = 1.5 * size;
    scene.map->origin = offset;
    if (seed % 2 == 0) scene.map->yaw_rad = 0.3;
    for (std::uint64_t i = 0; i < 100; ++i) {
      const auto side_cell = [&](std::uint64_t axis) {
        return static_cast<std::uint32_t>(40.0 * uniform(seed, i, axis));
      };
      scene.map->blocked.set(side_cell(1), side_cell(2));
    }
  } else {
    std::vector<Segment> walls;
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Vec2 a = offset + Vec2{side * uniform(seed, i, 1), side * uniform(seed, i, 2)};
      const Vec2 way{0.5 * side * (uniform(seed, i, 3) - 0.5),
                     i % 3 == 0 ? 0.0 : 0.5 * side * (uniform(seed, i, 4) - 0.5)};
      walls.push_back({a, a + way});
    }
    scene.walls = WallSet::narrowest(walls);
    if (seed % 5 == 0) scene.bounds = Box{offset, offset + Vec2{side, side}};
  }
  return scene;
}

/// Bodies of 1 mm to 1 m; UTM, 1e7 and 1e9 away.
inline void solve_far_away(std::uint64_t seed, FarTally& tally) {
  constexpr Vec2 offsets[] = {{450000.0, 5400000.0}, {1e7, -1e7}, {1e9, 1e9}};
  const Vec2 offset = offsets[seed % 3];
  const double size = std::pow(10.0, -3.0 * uniform(seed, 0, 0));
  const double side = 60.0 * size;
  const auto place = [&](std::uint64_t i) {
    return offset + Vec2{side * uniform(seed, i, 1), side * uniform(seed, i, 2)};
  };
  const Scene scene = scene_far_away(seed, offset, size);
  const Vec2 from = place(100);
  const Vec2 to = place(101);
  Question question{.start = {from.x, from.y}, .goal = {to.x, to.y}};
  RobotSpec robot;
  switch (seed / 3 % 4) {
    case 0:
      robot = {.kind = RobotKind::disc, .radius = size};
      break;
    case 1:
      robot = {.kind = RobotKind::car,
               .radius = 0.5 * size,
               .turning_radius = size,
               .steering = seed % 2 == 0 ? SteeringKind::dubins : SteeringKind::reeds_shepp};
      break;
    default:
      robot = {.kind = RobotKind::polygon,
               .outline = {{-size, -0.5 * size}, {size, -0.5 * size}, {size, 0.5 * size}, {-size, 0.5 * size}}};
  }
  question.robot = robot;
  if (seed % 4 == 1) question.clearance = 0.3 * size;
  SolveOptions options{.seed = seed};
  if (robot.kind != RobotKind::disc) {
    for (std::vector<double>* end : {&question.start, &question.goal})
      end->push_back(6.0 * uniform(seed, end == &question.start ? 5 : 6, 7) - 3.0);
    options.planner = seed % 7 == 0 ? PlannerKind::prm : seed % 7 == 1 ? PlannerKind::rrt : PlannerKind::rrt_connect;
    if (options.planner != PlannerKind::prm) options.trees.nodes = 3000;
    options.optimise = seed % 2 == 0;
  } else if (seed % 7 < 3) {
    options.planner = seed % 7 == 0 ? PlannerKind::prm : PlannerKind::voronoi;
  }
  if (options.planner == PlannerKind::prm) options.roadmap.samples = 200;
  try {
    ++(solve(scene, question, options, {.threads = 1, .budget = std::chrono::seconds(5)}).verified ? tally.solved
                                                                                                   : tally.unsolved);
  } catch (const RefutedPathError& error) {
    tally.refuted.push_back(std::to_string(seed) + ": " + error.what());
  }
}

}  // namespace warren::test
