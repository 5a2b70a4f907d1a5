// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/car_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/plane/polygon.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"

namespace warren {
namespace {

using body_scenes::corners_at;
using body_scenes::hook;
using body_scenes::random_pose;
using body_scenes::scattered;

CarOptions disc(double radius = 0.3, double turning = 0.8) { return {.turning_radius = turning, .radius = radius}; }
CarOptions hooked() { return {.turning_radius = 0.8, .outline = hook}; }

/// Distance of the body to polygons, walls and bounds; 0 where it is not free. Brute force.
double room(const Scene& scene, const CarOptions& car, const Se2& pose) {
  const bool is_disc = car.outline.empty();
  const std::vector<Vec2> body = is_disc ? std::vector<Vec2>{pose.position()} : corners_at(car.outline, pose);
  double least = std::numeric_limits<double>::infinity();
  std::vector<Segment> sides = bounds_walls(scene);
  scene.walls.visit([&](auto all) {
    for (const auto& wall : all) sides.push_back(wall.segment());
  });
  const auto include = [&](const Segment& s) {
    const double d =
        is_disc ? distance(std::vector<Vec2>{s.a, s.b, s.a}, Segment{body[0], body[0]}) : distance(body, s);
    least = std::min(least, d);
  };
  for (const Segment& s : sides) include(s);
  for (const ScenePolygon& polygon : scene.polygons) {
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) include(polygon_side(polygon.corners, i));
    if (contains(polygon.corners, body[0])) return 0.0;
  }
  if (scene.bounds && !std::all_of(body.begin(), body.end(), [&](Vec2 p) { return scene.bounds->contains(p); })) {
    return 0.0;
  }
  return std::max(0.0, least - (is_disc ? car.radius : 0.0));
}

TEST(CarWorld, ClearanceEqualsBruteForce) {
  std::uint64_t free = 0;
  for (const std::uint64_t seed : test::seeds(25)) {
    SCOPED_TRACE(seed);
    const Scene scene = scattered(seed);
    for (const CarOptions& car : {disc(), hooked()}) {
      const CarWorld<DubinsCurve> world(scene, car);
      auto query = world.make_query();
      for (std::uint64_t i = 0; i < 60; ++i) {
        const Se2 pose = random_pose(seed, i);
        const double expected = room(scene, car, pose);
        const double found = world.clearance(pose, largest_coordinate, query);
        if (expected == 0.0) {
          EXPECT_LE(found, 0.0);
          EXPECT_FALSE(world.is_free(pose, query));
        } else {
          EXPECT_LE(found, expected);
          EXPECT_GE(found, expected - 5e-9);  // what planning keeps on top
          ++free;
        }
      }
    }
  }
  EXPECT_GT(free, test::share(300));
}

/// A certified motion is free wherever one looks; a blocked one is blocked somewhere.
template <class Curve>
void expect_certificates_to_hold(const CarOptions& car) {
  std::uint64_t accepted = 0;
  std::uint64_t blocked = 0;
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    const Scene scene = scattered(seed, 5, 3);
    const CarWorld<Curve> world(scene, car);
    auto query = world.make_query();
    for (std::uint64_t i = 0; i < 12; ++i) {
      const Se2 a = uniform_state(world, seed, 2 * i);
      const Se2 b = uniform_state(world, seed, 2 * i + 1);
      const SteeringCurve curve = world.curve(a, b);
      const MotionVerdict verdict = world.body().judge(curve, query);
      constexpr int looks = 600;
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= looks; ++k) {
        least = std::min(least, room(scene, car, curve.at(curve.length() * k / looks)));
      }
      if (verdict == MotionVerdict::free) {
        ASSERT_GT(least, 0.0);
        ++accepted;
      } else {
        // Not free: what was looked at comes close, as far as the body goes between two looks.
        ASSERT_LT(least, 2.0 * curve.length() / looks + world.body().resolution());
        ++blocked;
      }
      EXPECT_EQ(world.is_free_motion(a, b, query), verdict == MotionVerdict::free);
    }
  }
  EXPECT_GT(accepted, test::share(5));
  EXPECT_GT(blocked, test::share(50));
}

TEST(CarWorld, CertificatesHoldForDiscsOnDubinsCurves) { expect_certificates_to_hold<DubinsCurve>(disc()); }
TEST(CarWorld, CertificatesHoldForDiscsOnReedsSheppCurves) { expect_certificates_to_hold<ReedsSheppCurve>(disc()); }
TEST(CarWorld, CertificatesHoldForPolygonsOnDubinsCurves) { expect_certificates_to_hold<DubinsCurve>(hooked()); }
TEST(CarWorld, CertificatesHoldForPolygonsOnReedsSheppCurves) {
  expect_certificates_to_hold<ReedsSheppCurve>(hooked());
}

/// travel() is what the certificates stand on.
TEST(CarWorld, NoPointOfTheBodyGoesFartherThanItsPace) {
  const Scene scene = scattered(1);
  const CarWorld<ReedsSheppCurve> world(scene, hooked());
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    const SteeringCurve curve = world.curve(random_pose(seed, 0), random_pose(seed, 1));
    double begin = 0.0;
    for (std::size_t i = 0; i < curve.piece_count(); ++i) {
      constexpr int steps = 500;
      const double step = curve.piece_length(i) / steps;
      double farthest = 0.0;
      for (const Vec2 p : hook) {
        double gone = 0.0;
        for (int k = 0; k < steps; ++k) {
          gone += distance(placed(curve.at(begin + k * step), p), placed(curve.at(begin + (k + 1) * step), p));
        }
        farthest = std::max(farthest, gone);
      }
      const double bound =
          pace_of(curve.piece(i).steer, world.outline(), world.turning_radius()) * curve.piece_length(i);
      EXPECT_LE(farthest, bound * (1 + 1e-9) + 1e-9);
      EXPECT_GE(farthest, bound * (1 - 1e-3) - 1e-9);
      begin += curve.piece_length(i);
    }
  }
}

TEST(CarWorld, EmbeddingNeverExceedsTheMetric) {
  const Scene scene = scattered(1);
  const CarWorld<DubinsCurve> forwards(scene, disc());
  const CarWorld<ReedsSheppCurve> both(scene, disc());
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Se2 a = random_pose(1, 2 * i);
    Se2 b = random_pose(1, 2 * i + 1);
    if (i % 2 == 0) b = forwards.interpolate(a, b, 0.1);
    const auto p = both.embed(a);
    const auto q = both.embed(b);
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) sum += (p[k] - q[k]) * (p[k] - q[k]);
    EXPECT_LE(std::sqrt(sum), both.distance(a, b) + 1e-9);
    EXPECT_LE(both.distance(a, b), forwards.distance(a, b) + 1e-9);
  }
}

TEST(CarWorld, SamplesKeepTheBodyInTheBoundsWhereItFits) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  const CarWorld<DubinsCurve> world(scene, hooked());
  auto query = world.make_query();
  for (std::uint64_t i = 0; i < 500; ++i) EXPECT_TRUE(world.is_free(uniform_state(world, 3, i), query)) << i;
}

TEST(CarWorld, WithoutBoundsTheWayStaysInTheObstaclesBox) {
  Scene scene;
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{0, 0}, {10, 0}}, {{0, 4}, {10, 4}}});
  const CarWorld<DubinsCurve> world(scene, disc(0.1, 1.0));
  auto query = world.make_query();
  EXPECT_TRUE(world.is_free({10, 2, 0}, query));
  EXPECT_FALSE(world.is_free({10.1, 2, 0}, query));
  EXPECT_TRUE(world.is_free_motion({2, 1, 0}, {10, 1, 0}, query));
  EXPECT_FALSE(world.is_free_motion({9.5, 1, 0}, {9.5, 3, std::numbers::pi}, query));  // out to x = 10.5
  EXPECT_TRUE(world.is_free_motion({8.5, 1, 0}, {8.5, 3, std::numbers::pi}, query));
}

TEST(CarWorld, RefusesBadNumbers) {
  const Scene scene = scattered(1);
  EXPECT_THROW(CarWorld<DubinsCurve>(scene, disc(-1.0)), InputError);
  EXPECT_THROW(CarWorld<DubinsCurve>(scene, disc(1.0, 0.0)), InputError);
  EXPECT_THROW(CarWorld<DubinsCurve>(scene, {.outline = {{0, 0}, {1, 0}}}), InputError);
  EXPECT_THROW(CarWorld<DubinsCurve>(scene, {.clearance = -1.0}), InputError);
  EXPECT_THROW(CarWorld<DubinsCurve>(Scene{}, disc()), InputError);
}

}  // namespace
}  // namespace warren
