// SPDX-License-Identifier: BSD-3-Clause
// A verdict by the index is that by the pass over all obstacles, bit for bit: in scenes made of ties and degenerations,
// for paths of which most are refuted.
#include "verify/judges/leg_reports.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "tests/seeds.hpp"
#include "tests/verify/judges/same_verdicts.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
namespace {

/// Draws one number after the other.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  double unit() { return uniform(seed_, next_++, 0); }
  double below(double n) { return std::floor(unit() * n); }
  bool one_in(double n) { return below(n) == 0.0; }

 private:
  std::uint64_t seed_;
  std::uint64_t next_ = 0;
};

/// How a scene's coordinates come about: many meet, many lie at the same distance.
enum class Points : std::uint8_t { whole, tenths, far_off, far_apart, almost_whole, anywhere };
constexpr std::uint64_t kinds_of_points = 6;

double coordinate(Points points, Dice& dice) {
  const double whole = dice.below(12.0);
  switch (points) {
    case Points::whole:
      return whole;
    case Points::tenths:
      return 0.1 * whole;
    case Points::far_off:
      return 1e9 + whole / 3.0;
    case Points::far_apart:
      return dice.one_in(6.0) ? (dice.unit() - 0.5) * std::pow(10.0, dice.below(18.0)) : whole;
    case Points::almost_whole:
      return dice.one_in(2.0) ? std::nextafter(whole, 100.0) : whole;
    case Points::anywhere:
      return 12.0 * dice.unit();
  }
  return 0.0;
}

Vec2 point(Points points, Dice& dice) {
  const double x = coordinate(points, dice);
  return {x, coordinate(points, dice)};
}

std::vector<Segment> random_walls(Points points, Dice& dice, std::size_t count) {
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < count; ++i) {
    Segment s{point(points, dice), point(points, dice)};
    if (!walls.empty() && dice.one_in(3.0)) s.a = walls.back().b;                  // a shared end
    if (!walls.empty() && dice.one_in(8.0)) s = {walls.back().b, walls.back().a};  // twice the same
    if (dice.one_in(3.0)) s.b.x = s.a.x;
    if (dice.one_in(3.0)) s.b.y = s.a.y;
    if (dice.one_in(9.0)) s.b = s.a;
    if (dice.one_in(5.0)) s.b = s.a + 0.5 * (s.b - s.a);
    walls.push_back(s);
  }
  return walls;
}

Scene random_scene(Points points, Dice& dice) {
  Scene scene;
  const auto count = static_cast<std::size_t>(dice.below(dice.one_in(4.0) ? 400.0 : 25.0));
  scene.walls = WallSet::narrowest(random_walls(points, dice, count));
  for (double left = dice.below(5.0); left > 0.0; --left) {
    ScenePolygon polygon;
    for (double corners = 1.0 + dice.below(4.0); corners > 0.0; --corners)
      polygon.corners.push_back(point(points, dice));
    if (dice.one_in(3.0)) polygon.corners.push_back(polygon.corners.back());
    scene.polygons.push_back(std::move(polygon));
  }
  const bool holds_nothing = scene.walls.size() == 0 && scene.polygons.empty();
  if (dice.one_in(3.0) || holds_nothing) {
    Box bounds;
    bounds.include(point(points, dice));
    bounds.include(point(points, dice) + Vec2{8.0, 8.0});
    scene.bounds = bounds;
  }
  return scene;
}

std::vector<Vec2> random_path(const Scene& scene, Points points, Dice& dice) {
  const auto count = static_cast<std::size_t>(1.0 + dice.below(dice.one_in(20.0) ? 700.0 : 6.0));
  std::vector<Vec2> path;
  const double step = dice.one_in(2.0) ? 1.0 : 0.05;  // some paths stay where they are, in the open
  Vec2 at = point(points, dice);
  for (std::size_t i = 0; i < count; ++i) {
    if (dice.one_in(7.0)) at = point(points, dice);
    if (dice.one_in(12.0) && scene.walls.size() > 0)
      at = scene.walls.segment(static_cast<std::size_t>(dice.below(static_cast<double>(scene.walls.size())))).b;
    path.push_back(at);
    at = at + Vec2{step * (dice.below(3.0) - 1.0), step * (dice.below(3.0) - 1.0)};
  }
  return path;
}

VerifyOptions random_options(const std::vector<Vec2>& path, Dice& dice) {
  constexpr std::array room{0.0, 0.0, 0.0, 0.1, 0.5, 1.0, 0.01};
  VerifyOptions options;
  options.clearance = room[static_cast<std::size_t>(dice.below(room.size()))];
  options.radius = dice.one_in(3.0) ? room[static_cast<std::size_t>(dice.below(room.size()))] : 0.0;
  options.contact = dice.one_in(2.0) ? Contact::allowed : Contact::blocked;
  if (dice.one_in(2.0)) options.start = path.front();
  if (dice.one_in(10.0)) options.goal = path.front();
  return options;
}

/// The least of all pairs' distances.
double least_distance(const Scene& scene, const std::vector<Vec2>& path) {
  const Obstacles obstacles(scene);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t leg = 0; leg < path.size(); ++leg) {
    const Segment s{path[leg], path[std::min(leg + 1, path.size() - 1)]};
    if (leg > 0 && leg + 1 == path.size()) break;
    for (std::size_t i = 0; i < obstacles.size(); ++i)
      least = std::min(least, exact::distance(s, obstacles.segment(i)));
  }
  for (const Ring& ring : obstacles.rings()) {
    if (ring.polygon != Ring::none && strictly_inside(ring, path.front())) least = 0.0;
  }
  return least;
}

TEST(LegsAgainstIndex, SayWhatThePassOverAllObstaclesSays) {
  std::uint64_t verified = 0;
  std::uint64_t refuted = 0;
  const std::vector<std::uint64_t> seeds = test::seeds(600, 30, 0);
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const auto points = static_cast<Points>(seed % kinds_of_points);
    const Scene scene = random_scene(points, dice);
    const ObstacleIndex index(scene, {});
    for (int question = 0; question < 20; ++question) {
      SCOPED_TRACE(question);
      const std::vector<Vec2> path = random_path(scene, points, dice);
      const VerifyOptions options = random_options(path, dice);
      const Verification by_pass = verify_path(scene, path, options, {.threads = 1});
      expect_same(by_pass, verify_path(scene, path, options, {.threads = 1}, &index));
      EXPECT_EQ(bits(by_pass.min_clearance), bits(least_distance(scene, path) - options.radius));
      (by_pass.verified ? verified : refuted) += 1;
    }
  }
  EXPECT_GT(verified, test::share(600, 15));
  EXPECT_GT(refuted, test::share(600, 15));
}

/// Unit walls of a maze without ways, and a path through it, through cells' middles and beside them.
TEST(LegsAgainstIndex, SayItOfLongPathsAmongManyWalls) {
  constexpr int side = 150;
  std::vector<Segment> walls;
  Dice dice(7);
  for (int x = 0; x <= side; ++x) {
    for (int y = 0; y < side; ++y) {
      const Vec2 low{static_cast<double>(x), static_cast<double>(y)};
      if (dice.one_in(2.0)) walls.push_back({low, low + Vec2{0.0, 1.0}});
      if (dice.one_in(2.0)) walls.push_back({low, low + Vec2{1.0, 0.0}});
    }
  }
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  const ObstacleIndex index(scene, {});
  for (int question = 0; question < 40; ++question) {
    SCOPED_TRACE(question);
    std::vector<Vec2> path;
    const double off = question % 3 == 0 ? 0.5 : dice.unit();
    Vec2 at{dice.below(side) + off, dice.below(side) + 0.5};
    for (int i = 0; i < 1200; ++i) {
      path.push_back(at);
      const double step = question % 2 == 0 ? 1.0 : 7.0 * dice.unit();
      at = at + (dice.one_in(2.0) ? Vec2{step, 0.0} : Vec2{0.0, step * (dice.below(3.0) - 1.0)});
      if (at.x > side || at.y > side || at.y < 0.0) at = {off, 0.5};
    }
    const VerifyOptions options{.clearance = question % 4 == 0 ? 0.0 : 0.1,
                                .contact = question % 8 == 0 ? Contact::allowed : Contact::blocked};
    const Verification by_pass = verify_path(scene, path, options, {});
    for (const unsigned threads : {1U, 2U, 3U, 8U})
      expect_same(by_pass, verify_path(scene, path, options, {.threads = threads}, &index));
  }
}

TEST(LegsAgainstIndex, FindALonelyWallHoweverFarItIs) {
  Scene scene;
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{1e15, 0.0}, {1e15, 1.0}}, {{-3e12, 0.0}, {-3e12, 5.0}}});
  scene.bounds = Box{{-1e16, -1e16}, {1e16, 1e16}};
  const ObstacleIndex index(scene, {});
  const std::vector<Vec2> path{{0.0, 0.0}, {1.0, 1.0}};
  EXPECT_EQ(verify_path(scene, path, {}, {}, &index).min_clearance, 3e12);
}

TEST(LegsAgainstIndex, RefuseWhatThePassRefuses) {
  Scene scene;
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{0.0, 0.0}, {1.0, 0.0}}});
  scene.spheres.push_back({0.0, 0.0, 0.0, 1.0});
  const ObstacleIndex index(scene, {});
  const std::vector<Vec2> path{{0.0, 0.5}, {1.0, 0.5}};
  EXPECT_THROW(verify_path(scene, path, {}, {}, &index), InputError);
  EXPECT_THROW(verify_path(scene, {}, {}, {}, &index), InputError);
}

}  // namespace
}  // namespace warren
