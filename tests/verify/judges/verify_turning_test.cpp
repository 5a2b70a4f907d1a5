// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_turning.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/plane/polygon.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {
namespace {

using body_scenes::corners_at;
using body_scenes::hook;
using body_scenes::kite;

using std::numbers::pi;
const std::vector<Vec2> bar = {{-1, -0.1}, {1, -0.1}, {1, 0.1}, {-1, 0.1}};

/// A corridor along y = 0, 1 wide, from x = -5 to 5, with a wide room at each end.
Scene corridor() {
  Scene scene;
  scene.bounds = Box{{-10, -5}, {10, 5}};
  scene.polygons.push_back({{{-5, 0.5}, {5, 0.5}, {5, 4}, {-5, 4}}});
  scene.polygons.push_back({{{-5, -0.5}, {-5, -4}, {5, -4}, {5, -0.5}}});
  return scene;
}

TEST(VerifySe2, AcceptsAFreePathAndMeasuresIt) {
  const std::vector<Se2> path = {{-7, 0, pi / 2}, {-7, 0, 0}, {7, 0, 0}, {7, 0, -pi / 2}};
  const auto v = verify_se2(corridor(), bar, path, {.start = path.front(), .goal = path.back()}, {});
  EXPECT_TRUE(v.verified);
  EXPECT_DOUBLE_EQ(v.length, 14.0);
  EXPECT_NEAR(v.turn_rad, pi, 1e-14);
  EXPECT_LE(v.min_clearance, 0.4);
  EXPECT_GE(v.min_clearance, 0.4 - 1.01e-3);
  const auto straight = verify_se2(corridor(), bar, std::vector<Se2>{{-7, 0.1, 0}, {7, 0.1, 0}}, {}, {});
  EXPECT_NEAR(straight.min_clearance, 0.3, 1e-12);  // exact where nothing turns
}

TEST(VerifySe2, RefutesATurnThatTheCorridorHasNoRoomFor) {
  const std::vector<Se2> path = {{-7, 0, 0}, {0, 0, 0}, {0, 0, pi}, {7, 0, pi}};  // both ends of the leg are free
  const auto v = verify_se2(corridor(), bar, path, {}, {});
  EXPECT_FALSE(v.verified);
  ASSERT_TRUE(v.first_violation);
  EXPECT_EQ(v.first_violation->leg, 1U);
  EXPECT_NE(v.first_violation->obstacle.find("polygon"), std::string::npos);
}

TEST(VerifySe2, GoesTheShorterWayThroughTheWrap) {
  // From 3 to -3 radians: a short turn through pi, not a long one through 0, in a corridor where the latter would hit.
  const std::vector<Se2> path = {{0, 0, 3.0}, {0, 0, -3.0}};
  EXPECT_TRUE(verify_se2(corridor(), bar, path, {}, {}).verified);
  const std::vector<Se2> tilted = {{0, 0, 0.3}, {0, 0, -0.3 + 2.0 * pi}};
  EXPECT_TRUE(verify_se2(corridor(), bar, tilted, {}, {}).verified);
}

TEST(VerifySe2, HalfATurnMustBeFreeBothWaysRound) {
  const std::vector<Vec2> arm = {{0, -0.1}, {2, -0.1}, {2, 0.1}, {0, 0.1}};
  const std::vector<Se2> path = {{0, 0, 0}, {0, 0, pi}};
  Scene scene;
  scene.bounds = Box{{-5, -5}, {5, 5}};
  EXPECT_TRUE(verify_se2(scene, arm, path, {}, {}).verified);
  for (const double y : {-1.5, 1.5}) {
    scene.walls = WallSet::narrowest(std::vector<Segment>{{{-0.1, y}, {0.1, y}}});
    EXPECT_FALSE(verify_se2(scene, arm, path, {}, {}).verified) << y;
  }
}

TEST(VerifySe2, WithoutBoundsTheReferencePointStaysInTheObstaclesBox) {
  Scene scene;
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{0, 0}, {10, 0}}, {{0, 10}, {10, 10}}});
  EXPECT_TRUE(verify_se2(scene, bar, std::vector<Se2>{{5, 5, 0}, {9.5, 5, 0}}, {}, {}).verified);
  EXPECT_FALSE(verify_se2(scene, bar, std::vector<Se2>{{5, 5, 0}, {12, 5, 0}}, {}, {}).verified);
}

TEST(VerifySe2, SeesWhatAStraightLegSweepsOver) {
  Scene scene;
  scene.bounds = Box{{-10, -10}, {10, 10}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{0, 0}, {0.01, 0.01}}});
  const auto verified = [&](const Se2& a, const Se2& b) {
    return verify_se2(scene, bar, std::vector<Se2>{a, b}, {}, {}).verified;
  };
  EXPECT_FALSE(verified({-5, 0, 0.3}, {5, 0, 0.3}));  // neither end is near
  EXPECT_FALSE(verified({0, -5, 0.3}, {0, 5, 0.3}));
  EXPECT_TRUE(verified({-5, 1, 0.3}, {5, 1, 0.3}));
  // Sliding along at a billionth: too near for halving, no matter for a leg that does not turn.
  EXPECT_TRUE(verified({-5, -0.1 - 1e-9, 0}, {5, -0.1 - 1e-9, 0}));
  EXPECT_FALSE(verified({-5, -0.1 + 1e-9, 0}, {5, -0.1 + 1e-9, 0}));
}

TEST(VerifySe2, ComparesStartAndGoal) {
  const std::vector<Se2> path = {{-7, 0, 0}, {7, 0, 0}};
  const auto verified = [&](const Se2& start, const Se2& goal, bool any_heading) {
    return verify_se2(corridor(), bar, path, {.start = start, .goal = goal, .any_heading = any_heading}, {}).verified;
  };
  EXPECT_TRUE(verified({-7, 0, 2 * pi}, {7, 0, 0}, false));
  EXPECT_FALSE(verified({-7, 0, 1}, {7, 0, 0}, false));
  EXPECT_FALSE(verified({-7, 0, 0}, {7, 0, 1}, false));
  EXPECT_TRUE(verified({-7, 0, 0}, {7, 0, 1}, true));
  EXPECT_FALSE(verified({-7, 0.1, 0}, {7, 0, 0}, false));
  for (const double share : {0.5, 2.0}) {
    const double off = share * PoseVerifyOptions::tolerance;
    EXPECT_EQ(verified({-7, off, 0}, {7, 0, 0}, false), share < 1.0);
    EXPECT_EQ(verified({-7, 0, off}, {7, 0, 0}, false), share < 1.0);
    EXPECT_EQ(verified({-7, 0, 0}, {7, -off, 0}, false), share < 1.0);
    EXPECT_EQ(verified({-7, 0, 0}, {7, 0, off}, false), share < 1.0);
  }
}

TEST(VerifySe2, SeesBodiesInPolygonsOutsideTheBoundsAndWallsInTheBody) {
  const auto violation = [](const Scene& scene, const Se2& pose) {
    const auto v = verify_se2(scene, hook, std::vector<Se2>{pose}, {}, {});
    return v.first_violation ? v.first_violation->obstacle : std::string("none");
  };
  EXPECT_EQ(violation(corridor(), {0, 0, 0}).substr(0, 9), "polygon 0");  // 0.5 high: touches
  EXPECT_EQ(violation(corridor(), {0, -0.1, 0}), "none");
  EXPECT_EQ(violation(corridor(), {0, 2, 0}).substr(0, 9), "polygon 0");
  EXPECT_EQ(violation(corridor(), {20, 0, 0}).substr(0, 6), "bounds");
  EXPECT_EQ(violation(corridor(), {9.5, 0, 0}).substr(0, 6), "bounds");
  Scene wall;
  wall.bounds = Box{{-10, -10}, {10, 10}};
  wall.walls = WallSet::narrowest(std::vector<Segment>{{{0.35, 0.0}, {0.45, 0.1}}});
  EXPECT_EQ(violation(wall, {0, 0, 0}).substr(0, 6), "wall 0");
  EXPECT_EQ(violation(wall, {0.35, 0, 0}), "none");
}

/// Verdicts against the fast world on random motions: whatever that accepts is verified, and what is verified with room
/// to spare is accepted. Least distances against sampled ones.
TEST(VerifySe2, AgreesWithTheFastWorldAndWithSampledDistances) {
  std::uint64_t free = 0;
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    const Scene scene = body_scenes::scattered(seed);
    const auto& outline = seed % 2 == 0 ? kite : hook;
    const double clearance = seed % 3 == 0 ? 0.05 : 0.0;
    const Se2World world(scene, outline, clearance);
    auto query = world.make_query();
    for (std::uint64_t i = 0; i < 60; ++i) {
      const Se2 a = body_scenes::random_pose(seed, 2 * i);
      const Se2 b = world.interpolate(a, body_scenes::random_pose(seed, 2 * i + 1), 0.2);
      const std::vector<Se2> leg = {a, b};
      const auto v = verify_se2(scene, outline, leg, {.clearance = clearance}, {});
      const bool accepted = world.is_free_motion(a, b, query);
      if (accepted) {
        EXPECT_TRUE(v.verified) << i;
      }
      if (!v.verified) continue;
      ++free;
      if (v.min_clearance > clearance + 1e-3 * world.radius()) {
        EXPECT_TRUE(accepted) << i;
      }
      double sampled = 1e9;
      for (int step = 0; step <= 200; ++step) {
        const std::vector<Vec2> body = corners_at(outline, world.interpolate(a, b, step / 200.0));
        for (const ScenePolygon& p : scene.polygons) sampled = std::min(sampled, distance(body, p.corners));
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
          sampled = std::min(sampled, distance(body, scene.walls.segment(w)));
        }
        for (const Vec2 p : body) sampled = std::min({sampled, p.x, p.y, 10.0 - p.x, 10.0 - p.y});
      }
      EXPECT_LE(v.min_clearance, sampled);
      const double turn = std::abs(turn_between(a.theta, b.theta));
      const double travel = distance(a.position(), b.position()) + world.radius() * turn;
      EXPECT_GE(v.min_clearance, sampled - travel / 400.0 - 1e-3 * world.radius());
    }
  }
  EXPECT_GT(free, test::share(100));
}

/// A path of many short legs, judged in runs, against each of its legs judged alone.
TEST(VerifySe2, LongRunsOfShortLegsAreJudgedAsEachLegAlone) {
  int refuted = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {  // few refute: no share is sure to hold enough
    SCOPED_TRACE(seed);
    const Scene scene = body_scenes::scattered(seed);
    SequentialRng rng(seed);
    std::vector<Se2> path{body_scenes::random_pose(seed, 0)};
    while (path.size() < 60) {
      const auto kind = rng.below(4);
      const double way = rng.below(2) == 0 ? 0.03 : -0.03;
      for (auto n = 1 + rng.below(20); n > 0; --n) {
        Se2 next = path.back();
        next.x += kind == 0 || kind == 2 ? way : 0.0;
        next.y += kind == 1 || kind == 2 ? way : 0.0;
        next.theta += kind == 3 ? 2.0 * way : 0.0;
        path.push_back(next);
      }
    }
    Verification whole = verify_se2(scene, kite, path, {}, {});
    Verification alone;
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const auto leg = verify_se2(scene, kite, std::span(path).subspan(i, 2), {}, {});
      alone.min_clearance = std::min(alone.min_clearance, leg.min_clearance);
      if (!leg.verified && !first) first = i;
    }
    EXPECT_EQ(whole.verified, !first);
    EXPECT_NEAR(whole.min_clearance, alone.min_clearance, first ? 0.1 : 2e-3);
    if (!first) continue;
    ++refuted;
    ASSERT_TRUE(whole.first_violation);
    EXPECT_EQ(whole.first_violation->leg, *first);
  }
  EXPECT_GT(refuted, 3);
  EXPECT_LT(refuted, 20);
}

TEST(VerifySe2, IsTheSameForAnyNumberOfThreads) {
  std::vector<Se2> path;
  for (int i = 0; i <= 40; ++i) path.push_back({-7 + 0.35 * i, 0.02 * (i % 5), 0.1 * (i % 3)});
  std::vector<Verification> all;
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    all.push_back(verify_se2(corridor(), bar, path, {}, {.threads = threads}));
  }
  for (const auto& v : all) {
    EXPECT_TRUE(v.verified);
    EXPECT_EQ(v.min_clearance, all.front().min_clearance);
    EXPECT_EQ(v.length, all.front().length);
  }
}

TEST(VerifySe2, RefusesPathsWithoutPosesAndNumbersThatAreNone) {
  EXPECT_THROW(verify_se2(corridor(), bar, {}, {}, {}), InputError);
  const std::vector<Se2> nan = {{0, std::nan(""), 0}};
  EXPECT_THROW(verify_se2(corridor(), bar, nan, {}, {}), InputError);
  const std::vector<Se2> dizzy{{1, 1, 0}, {1, 1, 1e16}};
  EXPECT_THROW(verify_se2(corridor(), bar, dizzy, {}, {}), InputError);
}

}  // namespace
}  // namespace warren
