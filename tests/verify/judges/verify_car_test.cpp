// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_turning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "core/plane/polygon.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "worlds/poses/car_world.hpp"

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

const RobotSpec disc_car{.kind = RobotKind::car, .radius = 0.25, .turning_radius = 1.0};
const RobotSpec reversing{
    .kind = RobotKind::car, .radius = 0.25, .turning_radius = 1.0, .steering = SteeringKind::reeds_shepp};

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
  EXPECT_EQ(tight.first_violation->kind, ViolationKind::obstacle);
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
    EXPECT_EQ(v.first_violation->kind, ViolationKind::motion);
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
  const RobotSpec bar{
      .kind = RobotKind::car, .turning_radius = 1.0, .outline = {{-0.1, -0.6}, {0.1, -0.6}, {0.1, 0.6}, {-0.1, 0.6}}};
  struct Case {
    const char* name;
    Segment wall;
    RobotSpec car;
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

TEST(VerifyCar, HalfATurnGoesAheadAndMustBeFreeBothWaysForACarThatReverses) {
  for (const double turn : {pi, -pi}) {
    SCOPED_TRACE(turn);
    const std::vector<Se2> half = {{0, 0, 0}, {0, 2, turn}};  // to the left ahead, or to the right backwards
    EXPECT_TRUE(verify_car(walls({}), disc_car, half, {}, {}).verified);
    const Scene right = walls({{{1, 0.9}, {1, 1.1}}});
    EXPECT_FALSE(verify_car(right, disc_car, half, {}, {}).verified);
    const Scene left = walls({{{-1, 0.9}, {-1, 1.1}}});
    EXPECT_TRUE(verify_car(left, disc_car, half, {}, {}).verified);
    EXPECT_FALSE(verify_car(left, reversing, half, {}, {}).verified);
    EXPECT_TRUE(verify_car(walls({}), reversing, half, {}, {}).verified);
  }
}

const std::vector<Vec2> van = {{-1, -0.9}, {3.6, -0.9}, {3.6, 0.9}, {-1, 0.9}};

TEST(VerifyCar, WhatLiesAcrossTheWholeBodyFromTheStartOnIsMet) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {30, 12}};
  const RobotSpec car{.kind = RobotKind::car, .turning_radius = 2.0, .outline = van};
  const std::vector<Se2> straight = {{3, 5, 0}, {20, 5, 0}};
  const std::vector<Se2> round = {{10, 5, 0}, {12, 7, pi / 2}};
  ASSERT_TRUE(verify_car(scene, car, straight, {}, {}).verified);
  ASSERT_TRUE(verify_car(scene, car, round, {}, {}).verified);
  const auto refuted_by = [&](const Scene& blocked, const std::vector<Se2>& path) {
    const auto v = verify_car(blocked, car, path, {}, {});
    return v.first_violation ? v.first_violation->obstacle.substr(0, 6) : "";
  };
  Scene wall = scene;
  wall.walls = WallSet::narrowest(std::vector<Segment>{{{0, 5}, {30, 5}}});
  EXPECT_EQ(refuted_by(wall, straight), "wall 0");
  EXPECT_EQ(refuted_by(wall, round), "wall 0");
  EXPECT_EQ(refuted_by(wall, {straight.front()}), "wall 0");
  Scene spike = scene;  // it reaches 0.4 deep into the body's side, between its corners
  spike.polygons.push_back({{{4, 4.5}, {4.2, 3}, {4.4, 3}}});
  EXPECT_EQ(refuted_by(spike, straight), "polygo");
  EXPECT_EQ(refuted_by(spike, {straight.front()}), "polygo");
  Scene pebble = scene;
  pebble.polygons.push_back({{{5, 5}, {5.1, 5}, {5, 5.1}}});
  EXPECT_EQ(refuted_by(pebble, {straight.front()}), "polygo");
}

TEST(VerifyCar, WhatStandsBesideTheBulgeOfAnArcIsMet) {
  const double h = std::sqrt(0.5);
  const std::vector<Se2> below = {{-h, 1 - h, -pi / 4}, {h, 1 - h, pi / 4}};  // its lowest point is (0, 0)
  const RobotSpec car{.kind = RobotKind::car, .radius = 0.5, .turning_radius = 1.0};
  const Segment clear{{-h - 0.503, 1 - h}, {-h - 0.6, 1 - h}};  // so near that nothing farther is looked for
  EXPECT_TRUE(verify_car(walls({clear}), car, below, {}, {}).verified);
  const auto v = verify_car(walls({clear, {{0, -0.4}, {0.01, -0.4}}}), car, below, {}, {});
  ASSERT_FALSE(v.verified);
  EXPECT_NEAR(v.first_violation->distance, 0.4, 1e-12);
}

Scene room_with_a_block(double yaw) {
  Scene scene;
  OccupancyMap map;
  map.blocked = Bitmap(30, 20);
  map.yaw_rad = yaw;
  for (std::uint32_t y = 4; y < 16; ++y) {
    for (std::uint32_t x = 15; x < 28; ++x) map.blocked.set(x, y);
  }
  scene.map = map;
  return scene;
}

TEST(VerifyCar, CellsOfMapsAreInTheWay) {
  for (const double yaw : {0.0, 0.7}) {
    SCOPED_TRACE(yaw);
    const Scene scene = room_with_a_block(yaw);
    const auto posed = [&](double x, double y, double theta) {
      const Vec2 p = world_point(*scene.map, {x, y});
      return Se2{p.x, p.y, theta + yaw};
    };
    const RobotSpec ahead{
        .kind = RobotKind::car, .turning_radius = 1.0, .outline = {{8, -0.4}, {9, -0.4}, {9, 0.4}, {8, 0.4}}};
    const RobotSpec disc{.kind = RobotKind::car, .radius = 0.5, .turning_radius = 1.0};
    const auto refuted_by = [&](const RobotSpec& car, const std::vector<Se2>& path) {
      const auto v = verify_car(scene, car, path, {}, {});
      return v.first_violation ? v.first_violation->obstacle.substr(0, 4) : "";
    };
    EXPECT_EQ(refuted_by(disc, {posed(20, 10, 0)}), "cell");  // wholly inside of the block
    EXPECT_EQ(refuted_by(disc, {posed(14.6, 10, 0)}), "cell");
    EXPECT_EQ(refuted_by(disc, {posed(14.4, 10, 0)}), "");
    EXPECT_EQ(refuted_by(disc, {posed(2, 18, 0), posed(29, 18, 0)}), "");
    EXPECT_EQ(refuted_by(disc, {posed(2, 10, 0), posed(29, 10, 0)}), "cell");
    EXPECT_EQ(refuted_by(disc, {posed(29.6, 18, 0)}), "map:");
    EXPECT_EQ(refuted_by(disc, {posed(40, 18, 0)}), "map:");
    EXPECT_EQ(refuted_by(ahead, {posed(12, 10, 0), posed(13, 10, 0)}),
              "cell");  // the reference point is free, not the body
    EXPECT_EQ(refuted_by(ahead, {posed(20, 10, pi), posed(21, 10, pi)}), "gear");
    EXPECT_EQ(refuted_by(ahead, {posed(21, 10, pi), posed(20, 10, pi)}), "");  // and the other way round
    EXPECT_EQ(refuted_by(ahead, {posed(24, 18, pi / 2)}), "map:");
  }
}

TEST(VerifyCar, ManyWallsAreLookedAtOnceAndThoseNearALegOnItsAccount) {
  std::vector<Segment> many;
  for (int i = 0; i < 200'000; ++i)
    many.push_back({{20.0 + i % 500, 1.0 * (i / 500)}, {20.5 + i % 500, 1.0 * (i / 500)}});
  const Scene scene = walls(many);
  std::vector<Se2> path;
  for (int i = 0; i <= 2000; ++i) path.push_back({-9 + 0.009 * i, 0, 0});
  EXPECT_TRUE(verify_car(scene, disc_car, path, {}, {}).verified);
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

TEST(VerifyCar, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = scattered(7, 4, 3);
  std::vector<Se2> path{{1, 1, 0}};
  for (int i = 1; i < 100; ++i) path.push_back({1 + 0.05 * i, 1, 0});
  const Verification one = verify_car(scene, disc_car, path, {}, {.threads = 1});
  for (const unsigned threads : {2U, 3U, 8U}) {
    const Verification many = verify_car(scene, disc_car, path, {}, {.threads = threads});
    EXPECT_EQ(many.min_clearance, one.min_clearance);
    ASSERT_EQ(many.first_violation.has_value(), one.first_violation.has_value());
    if (one.first_violation) {
      EXPECT_EQ(many.first_violation->obstacle, one.first_violation->obstacle);
    }
  }
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
  std::uint64_t free = 0;
  for (const std::uint64_t seed : test::seeds(60, 15)) {
    SCOPED_TRACE(seed);
    const Scene scene = scattered(seed, 4, 3);
    const Se2 a = random_pose(seed, 5);
    const SteeringPiece piece{static_cast<Steer>(static_cast<int>(seed % 3) - 1), seed % 2 == 0 ? -1.2 : 1.2};
    SteeringWord word;
    word.add(piece.steer, piece.length);
    const Se2 end = after_piece(a, piece);
    const SteeringCurve curve(a, end, word, 1.0);
    const RobotSpec car{
        .kind = RobotKind::car, .turning_radius = 1.0, .outline = hook, .steering = SteeringKind::reeds_shepp};
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
  EXPECT_GT(free, test::share(10, 3));
}

}  // namespace
}  // namespace warren
