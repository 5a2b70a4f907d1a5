// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/verify_car.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "core/polygon_distance.hpp"
#include "tests/worlds/body_scenes.hpp"
#include "worlds/car_world.hpp"

namespace warren {
namespace {

using body_scenes::corners_at;
using body_scenes::hook;
using body_scenes::random_pose;
using body_scenes::scattered;

using std::numbers::pi;

Scene walls(const std::vector<Segment>& segments) {
  Scene scene;
  scene.bounds = Box{{-10, -10}, {10, 10}};
  scene.walls = WallSet::narrowest(segments);
  return scene;
}

const VerifiedCar disc_car{.turning_radius = 1.0, .radius = 0.25};
const VerifiedCar reversing{.turning_radius = 1.0, .reverses = true, .radius = 0.25};

TEST(VerifyCar, MeasuresArcsAndStraightsExactly) {
  // Two ahead, a left half circle of radius 1 around (2, 1), two back; a wall begins 0.5 beyond the arc.
  const Scene scene = walls({{{3.5, 1}, {5, 1}}});
  const std::vector<Se2> path = {{0, 0, 0}, {2, 0, 0}, {3, 1, pi / 2}, {2, 2, pi}, {0, 2, pi}};
  const auto v = verify_car(scene, disc_car, path, {.start = path.front(), .goal = path.back()}, {});
  EXPECT_TRUE(v.verified) << v.first_violation->obstacle;
  EXPECT_NEAR(v.length, 4.0 + pi, 1e-14);
  EXPECT_NEAR(v.turn_rad, pi, 1e-14);
  EXPECT_NEAR(v.min_clearance, 0.25, 1e-12);
  EXPECT_EQ(v.cusps, 0U);
  EXPECT_EQ(v.reversed, 0.0);
  EXPECT_TRUE(verify_car(scene, disc_car, path, {.clearance = 0.2499}, {}).verified);
  const auto tight = verify_car(scene, disc_car, path, {.clearance = 0.2501}, {});
  ASSERT_FALSE(tight.verified);
  EXPECT_EQ(tight.first_violation->leg, 1U);
  EXPECT_NEAR(tight.first_violation->distance, 0.5, 1e-12);
  EXPECT_EQ(tight.first_violation->obstacle.substr(0, 7), "wall 0:");
}

struct Bad {
  const char* name;
  std::vector<Se2> path;
  const char* obstacle;
};

TEST(VerifyCar, RefusesWhatTheCarCannotDrive) {
  const Scene scene = walls({{{3.5, 1}, {5, 1}}});
  const Bad all[] = {
      {"too tight", {{0, 0, 0}, {0.9, 0.9, pi / 2}}, "turning radius: 0.9"},
      {"on the spot", {{0, 0, 0}, {0, 0, 0.1}}, "turning radius: 0 "},
      {"sideways", {{0, 0, 0}, {1, 0.1, 0}}, "leg: slides"},
      {"an arc to the wrong heading", {{0, 0, 0}, {1, 1, pi / 2 + 0.01}}, "leg: slides"},
      {"backwards", {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}, "gear: "},
      {"backwards round", {{0, 0, 0}, {-1, 1, -pi / 2}}, "gear: "},
      {"a long arc told by its ends", {{0, 0, 0}, {-1, 1, -pi / 2 + 2 * pi}}, "gear: "},
  };
  for (const Bad& bad : all) {
    SCOPED_TRACE(bad.name);
    const auto v = verify_car(scene, disc_car, bad.path, {}, {});
    ASSERT_FALSE(v.verified);
    EXPECT_EQ(v.first_violation->leg, bad.path.size() - 2);
    EXPECT_EQ(v.first_violation->obstacle.substr(0, std::string(bad.obstacle).size()), bad.obstacle);
  }
}

TEST(VerifyCar, CountsGearsOfACarThatReverses) {
  // A turn in three moves: left ahead, right back, left ahead.
  const double t = pi / 3;
  std::vector<Se2> path{{0, 0, 0}};
  for (const int gear : {1, -1, 1}) {
    const Se2 a = path.back();
    const double side = gear;  // left ahead, right back: both turn left
    const double theta = a.theta + t;
    path.push_back({a.x + side * (std::sin(theta) - std::sin(a.theta)),
                    a.y + side * (std::cos(a.theta) - std::cos(theta)), theta});
  }
  const auto v = verify_car(walls({}), reversing, path, {}, {});
  EXPECT_TRUE(v.verified);
  EXPECT_EQ(v.cusps, 2U);
  EXPECT_NEAR(v.length, pi, 1e-14);
  EXPECT_NEAR(v.reversed, t, 1e-14);
  EXPECT_FALSE(verify_car(walls({}), disc_car, path, {}, {}).verified);
}

TEST(VerifyCar, RefusesWhatIsInTheWay) {
  const std::vector<Se2> round = {{0, 0, 0}, {1, 1, pi / 2}, {0, 2, pi}};
  const VerifiedCar bar{.turning_radius = 1.0, .outline = {{-0.1, -0.6}, {0.1, -0.6}, {0.1, 0.6}, {-0.1, 0.6}}};
  struct Case {
    const char* name;
    Segment wall;
    VerifiedCar car;
    bool verified;
  };
  const Case all[] = {
      {"the disc hits in the middle of an arc", {{0.6, 0.2}, {0.8, 0.2}}, disc_car, false},
      {"the disc passes inside", {{0, 0.9}, {0, 1.1}}, disc_car, true},
      {"the bar's end sweeps along", {{1.2, 1.2}, {1.3, 1.1}}, bar, false},
      {"the bar's side sweeps along", {{0.55, 1.2}, {0.6, 1.25}}, bar, false},
      {"the bar passes beyond", {{1.7, 1}, {2, 1}}, bar, true},
      {"a wall within the bar at the begin", {{-0.05, 0.5}, {0.05, 0.5}}, bar, false},
  };
  for (const Case& c : all) {
    SCOPED_TRACE(c.name);
    EXPECT_EQ(verify_car(walls({c.wall}), c.car, round, {}, {}).verified, c.verified);
  }
  Scene block;
  block.bounds = Box{{-10, -10}, {10, 10}};
  block.polygons.push_back({{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}});
  EXPECT_FALSE(verify_car(block, disc_car, round, {}, {}).verified);
  Scene small;
  small.bounds = Box{{-1, -1}, {1.2, 3}};
  EXPECT_FALSE(verify_car(small, disc_car, round, {}, {}).verified);
  small.bounds = Box{{-1, -1}, {1.26, 3}};
  EXPECT_TRUE(verify_car(small, disc_car, round, {}, {}).verified);
}

TEST(VerifyCar, WithoutBoundsTheReferencePointStaysInTheObstaclesBox) {
  Scene scene;
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{-2, -1}, {-1.9, -1}}, {{0.9, 3}, {0.9, 2.9}}});
  // The ends are in the box that ends at x = 0.9; the arc goes out to x = 1.
  const double t = pi / 3;
  const std::vector<Se2> out = {{std::sin(t), 1 - std::cos(t), t}, {std::sin(t), 1 + std::cos(t), pi - t}};
  const auto v = verify_car(scene, {.turning_radius = 1.0}, out, {}, {});
  ASSERT_FALSE(v.verified);
  EXPECT_EQ(v.first_violation->obstacle.substr(0, 4), "box:");
  const std::vector<Se2> in = {{0, 0, 0}, {std::sin(t), 1 - std::cos(t), t}};
  EXPECT_TRUE(verify_car(scene, {.turning_radius = 1.0}, in, {}, {}).verified);
}

TEST(VerifyCar, RefusesOtherEndsAndBadNumbers) {
  const std::vector<Se2> path = {{0, 0, 0}, {1, 0, 0}};
  const Scene scene = walls({});
  EXPECT_FALSE(verify_car(scene, disc_car, path, {.start = Se2{0, 0, 0.1}}, {}).verified);
  EXPECT_FALSE(verify_car(scene, disc_car, path, {.goal = Se2{1, 0, 0.1}}, {}).verified);
  EXPECT_TRUE(verify_car(scene, disc_car, path, {.goal = Se2{1, 0, 0.1}, .any_heading = true}, {}).verified);
  EXPECT_TRUE(verify_car(scene, disc_car, path, {.goal = Se2{1, 0, 2 * pi}}, {}).verified);
  EXPECT_THROW(verify_car(scene, disc_car, std::vector<Se2>{}, {}, {}), InputError);
  EXPECT_THROW(verify_car(scene, disc_car, std::vector<Se2>{{NAN, 0, 0}}, {}, {}), InputError);
  EXPECT_THROW(verify_car(scene, {.turning_radius = 0.0}, path, {}, {}), InputError);
  EXPECT_THROW(verify_car(scene, disc_car, path, {.clearance = -1.0}, {}), InputError);
}

double sampled_clearance(const Scene& scene, const std::vector<Vec2>& body) {
  double least = std::numeric_limits<double>::infinity();
  for (const ScenePolygon& polygon : scene.polygons) least = std::min(least, distance(polygon.corners, body));
  scene.walls.visit([&](auto all) {
    for (const auto& wall : all) least = std::min(least, distance(body, wall.segment()));
  });
  for (const Segment& s : bounds_walls(scene)) least = std::min(least, distance(body, s));
  return least;
}

/// Poses of random curves, driven step by step by the curve's own word.
TEST(VerifyCar, LeastClearanceIsThatOfManyPosesOnTheWay) {
  int free = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = scattered(seed, 4, 3);
    const Se2 a = random_pose(seed, 5);
    const SteeringPiece piece{static_cast<Steer>(static_cast<int>(seed % 3) - 1), seed % 2 == 0 ? -1.2 : 1.2};
    SteeringWord word;
    word.add(piece.steer, piece.length);
    const Se2 end = after_piece(a, piece);
    const SteeringCurve curve(a, end, word, 1.0);
    const VerifiedCar car{.turning_radius = 1.0, .reverses = true, .outline = hook};
    const auto v = verify_car(scene, car, std::vector<Se2>{a, end}, {}, {});
    double least = std::numeric_limits<double>::infinity();
    constexpr int steps = 3000;
    for (int i = 0; i <= steps; ++i) {
      least = std::min(least, sampled_clearance(scene, corners_at(hook, curve.at(curve.length() * i / steps))));
    }
    const double step = curve.length() / steps * 2.0;
    if (least > step) {
      const bool inside = scene.bounds->contains(a.position());
      EXPECT_EQ(v.verified, inside);
      if (!inside) continue;
      EXPECT_LE(v.min_clearance, least + 1e-12);
      EXPECT_GE(v.min_clearance, least - step);
      ++free;
    } else if (least == 0.0) {
      EXPECT_FALSE(v.verified);
    }
  }
  EXPECT_GT(free, 10);
}

}  // namespace
}  // namespace warren
