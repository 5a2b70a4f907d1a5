// SPDX-License-Identifier: BSD-3-Clause
// Turning bodies and cars are judged by the scene's index as by a pass over all obstacles, bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"
#include "tests/verify/judges/same_verdicts.hpp"
#include "verify/judges/verify_turning.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
namespace {

/// Walls and triangles on whole numbers here and there, some far across; some scenes lie far from the origin.
Scene random_scene(std::uint64_t seed) {
  const Vec2 off = seed % 5 == 0 ? Vec2{1e9, -1e9} : Vec2{};
  const auto place = [&](std::uint64_t i, unsigned axis) {
    return off + Vec2{std::floor(40.0 * uniform(seed, i, axis)), std::floor(40.0 * uniform(seed, i, axis + 1))};
  };
  std::vector<Segment> walls;
  const std::uint64_t count = seed % 3 == 0 ? 300 : 20;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec2 a = place(i, 0);
    walls.push_back({a, i % 20 == 0  ? place(i, 2)
                        : i % 9 == 0 ? a
                                     : a + Vec2{uniform(seed, i, 4), uniform(seed, i, 5)}});
  }
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  for (std::uint64_t i = 0; i < seed % 7; ++i) {
    const Vec2 a = place(i, 6);
    scene.polygons.push_back({{a, a + Vec2{3.0, 0.0}, a + Vec2{1.0, 2.0}}, 0});
  }
  if (seed % 2 == 0) scene.bounds = Box{off, off + Vec2{40.0, 40.0}};
  return scene;
}

/// A walk in short legs, sometimes a jump, now and then on the spot.
std::vector<Se2> random_path(std::uint64_t seed, const Scene& scene) {
  const Vec2 origin = scene.walls.segment(0).a;
  Se2 at{origin.x + uniform(seed, 0, 10), origin.y + uniform(seed, 0, 11), 6.0 * uniform(seed, 0, 12)};
  std::vector<Se2> path;
  for (std::uint64_t i = 0; i < 1 + seed % 14; ++i) {
    path.push_back(at);
    const double step = i % 6 == 5 ? 9.0 : i % 6 == 4 ? 0.0 : 0.4;
    at.x += step * (uniform(seed, i, 13) - 0.5);
    at.y += step * (uniform(seed, i, 14) - 0.5);
    at.theta += uniform(seed, i, 15) - 0.5;
  }
  return path;
}

PoseVerifyOptions options_of(std::uint64_t seed) { return {.clearance = seed % 4 == 0 ? 0.01 : 0.0}; }

TEST(BodiesByIndex, TurnAsTheyDoByThePass) {
  int verified = 0;
  for (const std::uint64_t seed : test::seeds(150, 40, 0)) {
    SCOPED_TRACE(seed);
    const Scene scene = random_scene(seed);
    const ObstacleIndex index(scene, {});
    const double size = seed % 2 == 0 ? 0.05 : 0.3;
    const std::vector<Vec2> outline{{-size, -size}, {size, -0.5 * size}, {0.0, size}};
    for (std::uint64_t question = 0; question < 6; ++question) {
      const std::vector<Se2> path = random_path(100 * seed + question, scene);
      const Verification by_pass = verify_se2(scene, outline, path, options_of(question), {.threads = 1});
      expect_same(by_pass, verify_se2(scene, outline, path, options_of(question), {.threads = 2}, &index));
      verified += by_pass.verified ? 1 : 0;
    }
  }
  EXPECT_GT(verified, 20);
}

TEST(BodiesByIndex, DriveAsTheyDoByThePass) {
  int met = 0;
  for (const std::uint64_t seed : test::seeds(150, 40, 0)) {
    SCOPED_TRACE(seed);
    const Scene scene = random_scene(seed);
    const ObstacleIndex index(scene, {});
    const RobotSpec car{.kind = RobotKind::car,
                        .radius = seed % 3 == 0 ? 0.02 : 0.2,
                        .turning_radius = 0.5,
                        .steering = seed % 2 == 0 ? SteeringKind::reeds_shepp : SteeringKind::dubins};
    for (std::uint64_t question = 0; question < 6; ++question) {
      std::vector<Se2> path = random_path(100 * seed + question, scene);
      path.resize(1 + question % 2);  // a pose, or straight on
      if (path.size() == 2)
        path[1] = {path[0].x + std::cos(path[0].theta), path[0].y + std::sin(path[0].theta), path[0].theta};
      const Verification by_pass = verify_car(scene, car, path, options_of(question), {.threads = 1});
      expect_same(by_pass, verify_car(scene, car, path, options_of(question), {.threads = 2}, &index));
      met += by_pass.verified ? 0 : 1;
    }
  }
  EXPECT_GT(met, 20);
}

}  // namespace
}  // namespace warren
