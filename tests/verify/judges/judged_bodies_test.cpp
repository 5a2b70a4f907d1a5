// SPDX-License-Identifier: BSD-3-Clause
// The judges of cars and turning bodies against dense sampling by plain geometry: random bodies, their reference point
// inside and far outside of them, among walls, polygons, and cells of straight and turned maps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_oracle.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren {
namespace {

using body_scenes::corners_at;

Scene random_map(std::uint64_t seed, double yaw) {
  Scene scene;
  OccupancyMap map;
  map.cell = 0.7;
  map.yaw_rad = yaw;
  map.blocked = Bitmap(14, 13);
  for (std::uint32_t y = 0; y < 13; ++y) {
    for (std::uint32_t x = 0; x < 14; ++x) {
      const bool in_block = x >= 4 && x < 9 && y >= 8 && y < 12;  // large enough to hold a body
      if (in_block || uniform(seed, x, 500 + y) < 0.06) map.blocked.set(x, y);
    }
  }
  scene.map = map;
  return scene;
}

/// Four kinds of scenes, each about 10 wide.
Scene scene_of_seed(std::uint64_t seed) {
  if (seed % 4 == 0) return random_map(seed, 0.0);
  if (seed % 4 == 1) return random_map(seed, 0.4);
  Scene scene = body_scenes::scattered(seed, 3, 3);
  if (seed % 4 == 3) scene.polygons.push_back({{{5.2, 1}, {9, 1}, {9, 9}, {5.2, 9}}});
  return scene;
}

std::vector<Vec2> outline_of(std::uint64_t seed, std::uint64_t index) {
  switch (random_bits(seed, index, 700) % 5) {
    case 0:
      return {{-0.4, -0.2}, {1.2, -0.2}, {1.2, 0.2}, {-0.4, 0.2}};
    case 1:
      return body_scenes::hook;
    case 2:
      return {{1.5, -0.3}, {2.5, -0.3}, {2.5, 0.3}, {1.5, 0.3}};  // the reference point lies outside
    case 3:
      return body_scenes::star(seed, index, {0.3, -0.2}, 0.7);
    default:
      return {{0, 0}, {2.2, -0.9}, {2.2, 0.9}};  // the reference point is a corner
  }
}

/// From `a` on by `length` with the wheel at the curvature; backwards where length is negative.
Se2 driven(const Se2& a, double curvature, double length) {
  if (curvature == 0.0) return {a.x + length * std::cos(a.theta), a.y + length * std::sin(a.theta), a.theta};
  const double theta = a.theta + curvature * length;
  return {a.x + (std::sin(theta) - std::sin(a.theta)) / curvature,
          a.y - (std::cos(theta) - std::cos(a.theta)) / curvature, theta};
}

struct Sampled {
  double least = std::numeric_limits<double>::infinity();
  double step = 0.0;  // how far a point of the body goes from one sample to the next, at most
};

template <class PoseAt>
Sampled sampled(const Scene& scene, const std::vector<Vec2>& outline, double way, const PoseAt& pose_at) {
  constexpr int steps = 400;
  const body_oracle::Obstacles obstacles(scene);
  Sampled result{.step = way / steps};
  for (int i = 0; i <= steps && result.least > 0.0; ++i) {
    const Se2 pose = pose_at(static_cast<double>(i) / steps);
    const auto body = outline.size() == 1 ? outline : corners_at(outline, pose);
    result.least =
        std::min(result.least, obstacles.distance(outline.size() == 1 ? std::vector{pose.position()} : body));
  }
  return result;
}

double extent(const std::vector<Vec2>& outline) {
  double most = 0.0;
  for (const Vec2 p : outline) most = std::max(most, norm(p));
  return most;
}

/// What is verified is free, what is free by more than a step is verified, and the clearance is that of the samples.
void compare(const Verification& v, const Sampled& found, double radius, double sharpness, std::uint64_t& free,
             std::uint64_t& met) {
  if (found.least <= radius) {
    EXPECT_FALSE(v.verified);
    ++met;
  } else if (found.least > radius + found.step) {
    EXPECT_TRUE(v.verified) << (v.first_violation ? v.first_violation->obstacle : "");
    EXPECT_LE(v.min_clearance, found.least - radius + 1e-9);
    EXPECT_GE(v.min_clearance, found.least - radius - found.step - sharpness);
    ++free;
  }
}

TEST(JudgedBodies, CarsOfAnyBodyAreJudgedAsDenseSamplesAre) {
  std::uint64_t free = 0;
  std::uint64_t met = 0;
  for (const std::uint64_t seed : test::seeds(48, 8)) {
    const Scene scene = scene_of_seed(seed);
    for (std::uint64_t i = 0; i < 6; ++i) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " motion " << i);
      const bool is_disc = i == 5;
      const double radius = is_disc && seed % 2 == 0 ? 0.35 : 0.0;
      const std::vector<Vec2> outline = is_disc ? std::vector<Vec2>{{0, 0}} : outline_of(seed, i);
      const double curvature = std::array{0.0, 1.0, -0.5}[random_bits(seed, i, 800) % 3];
      const double length = std::array{1.5, -1.5, 0.1, 3.0}[random_bits(seed, i, 801) % 4];
      const Se2 a = body_scenes::random_pose(seed, i);
      const std::vector<Se2> path{a, driven(a, curvature, length)};
      RobotSpec car{
          .kind = RobotKind::car, .radius = radius, .turning_radius = 1.0, .steering = SteeringKind::reeds_shepp};
      if (!is_disc) car.outline = outline;
      const double way = std::abs(length) * (1.0 + std::abs(curvature) * extent(outline));
      compare(verify_car(scene, car, path, {}, {}),
              sampled(scene, outline, way, [&](double t) { return driven(a, curvature, t * length); }), radius, 1e-9,
              free, met);
    }
  }
  EXPECT_GT(free, test::share(40));
  EXPECT_GT(met, test::share(80));
}

TEST(JudgedBodies, TurningBodiesAreJudgedAsDenseSamplesAre) {
  std::uint64_t free = 0;
  std::uint64_t met = 0;
  for (const std::uint64_t seed : test::seeds(32, 8, 101)) {
    const Scene scene = scene_of_seed(seed);
    for (std::uint64_t i = 0; i < 6; ++i) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " motion " << i);
      const std::vector<Vec2> outline = outline_of(seed, i);
      const Se2 a = body_scenes::random_pose(seed, i);
      const double turn = i % 3 == 0 ? 0.0 : 1.4 * uniform(seed, i, 900) - 0.7;
      const Vec2 go{2.0 * uniform(seed, i, 901) - 1.0, 2.0 * uniform(seed, i, 902) - 1.0};
      const auto at = [&](double t) { return Se2{a.x + t * go.x, a.y + t * go.y, a.theta + t * turn}; };
      compare(verify_se2(scene, outline, std::vector<Se2>{a, at(1.0)}, {}, {}),
              sampled(scene, outline, norm(go) + extent(outline) * std::abs(turn), at), 0.0, 1e-3 * extent(outline),
              free, met);
    }
  }
  EXPECT_GT(free, test::share(30));
  EXPECT_GT(met, test::share(50));
}

}  // namespace
}  // namespace warren
