// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/disc_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "planners/visibility/visibility_graph.hpp"
#include "tests/planners/visibility/degenerate_worlds.hpp"
#include "tests/planners/visibility/disc_oracle.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "tests/planners/visibility/strange_worlds.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using test::Dice;
using test::disjoint_polygons;
using test::scene_around;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A question, and what it is scaled by.
struct DiscProblem {
  PlaneObstacles obstacles;
  Vec2 start, goal;
  double radius = 1.0;
};

DiscPath plan(const DiscProblem& p, const Execution& execution = {}) {
  return shortest_disc_path(DiscGround(p.obstacles, execution), p.start, p.goal, p.radius, execution);
}

/// Pieces follow each other from start to goal, arcs are on their circles; the polyline keeps the radius, says the
/// judge, and is hardly longer.
void expect_sound(const DiscProblem& p, const DiscPath& path) {
  ASSERT_EQ(path.outcome, Outcome::solved);
  ASSERT_FALSE(path.pieces.empty());
  EXPECT_EQ(path.pieces.front().from, p.start);
  EXPECT_EQ(path.pieces.back().to, p.goal);
  double length = 0.0;
  double turned = 0.0;
  const double rounding = 1e-9 * path.radius + 1e-15 * (norm(p.start) + norm(p.goal) + path.length);
  for (std::size_t i = 0; i < path.pieces.size(); ++i) {
    const DiscPiece& piece = path.pieces[i];
    if (i > 0) {
      EXPECT_LE(distance(path.pieces[i - 1].to, piece.from), rounding);
    }
    length += piece.centre ? path.radius * piece.angle : distance(piece.from, piece.to);
    if (piece.centre) {
      turned += path.radius * piece.angle;
      EXPECT_NEAR(distance(piece.from, *piece.centre), path.radius, rounding);
    }
  }
  // ends of pieces are rounded to doubles, far from the origin more than all else
  const double unit = 0x1p-52 * (norm(p.start) + norm(p.goal) + path.length);
  const double summed = 1e-11 * (1.0 + length) + unit * static_cast<double>(path.pieces.size());
  EXPECT_NEAR(path.length, length, summed);
  EXPECT_LE(path.lower_bound, path.length);
  const Path<Vec2> line = polyline_of(path, {});
  const double drawn = test::length_of(line);
  EXPECT_GE(drawn, length - summed);
  EXPECT_LE(drawn, length + 3e-6 * turned + summed);
  const Verification verdict =
      verify_path(scene_around(p.obstacles, line), line, {.radius = p.radius, .start = p.start, .goal = p.goal}, {});
  EXPECT_TRUE(verdict.verified) << (verdict.first_violation ? verdict.first_violation->obstacle : "");
}

/// Arcs but those of rounding's size: of three corners in a row, the one between may stand out once they are rounded.
std::ptrdiff_t turns_of(const DiscPath& path) {
  return std::count_if(path.pieces.begin(), path.pieces.end(),
                       [](const DiscPiece& piece) { return piece.centre && piece.angle > 1e-12; });
}

/// What the oracle says, with room for doubt: `loose` finds whatever is free by 1e-9 of the radius more.
std::optional<double> oracle(const DiscProblem& p, double doubt) {
  return test::DiscOracle(p.obstacles, p.radius, doubt * p.radius).length(p.start, p.goal);
}

/// Whether there was a way.
bool expect_shortest(const DiscProblem& p) {
  const DiscPath path = plan(p);
  const std::optional<double> best = oracle(p, 1e-11);
  if (!best) {
    EXPECT_EQ(path.outcome, Outcome::infeasible);
    EXPECT_EQ(path.lower_bound, infinite);
    return false;
  }
  EXPECT_EQ(path.outcome, Outcome::solved) << *best;
  if (path.outcome != Outcome::solved) return false;
  EXPECT_NEAR(path.length, *best, 1e-10 * *best);
  EXPECT_NEAR(path.lower_bound, *best, 1e-10 * *best);
  expect_sound(p, path);
  return true;
}

/// Places of the world where the disc stands well.
std::optional<Vec2> free_place(Dice& dice, const DiscProblem& p) {
  const test::DiscOracle looser(p.obstacles, p.radius, -1e-3 * p.radius);
  const Box box = box_around(p.obstacles);
  for (int i = 0; i < 60; ++i) {
    const Vec2 at{box.min.x + dice.real() * box.width(), box.min.y + dice.real() * box.height()};
    if (looser.stands(at)) return at;
  }
  return std::nullopt;
}

std::optional<DiscProblem> with_ends(Dice& dice, DiscProblem p) {
  const std::optional<Vec2> start = free_place(dice, p);
  const std::optional<Vec2> goal = free_place(dice, p);
  if (!start || !goal) return std::nullopt;
  p.start = *start;
  p.goal = *goal;
  return p;
}

std::optional<DiscProblem> among_stars(std::uint64_t seed) {
  Dice dice(seed + 7'000);
  DiscProblem p;
  p.obstacles = disjoint_polygons(seed, 2 + dice.roll(2));
  p.radius = 0.2 + 3.0 * dice.real();
  if (dice.roll(3) == 0) p.obstacles.bounds.reset();
  return with_ends(dice, p);
}

/// Touching, overlapping and crossing obstacles, walls without width and without length; radii at random, so that no
/// gap is as wide as the disc.
std::optional<DiscProblem> among_degenerate(std::uint64_t seed) {
  Dice dice(seed + 8'000);
  DiscProblem p;
  p.obstacles = DegenerateWorlds(seed).make(seed % 2 == 0);
  if (p.obstacles.polygons.empty() && p.obstacles.walls.empty()) return std::nullopt;
  if (dice.roll(2) == 0) p.obstacles.walls.push_back({{5.25, 6.5}, {5.25, 6.5}});
  p.radius = 0.1 + 1.2 * dice.real();
  return with_ends(dice, p);
}

using ProblemBySeed = std::optional<DiscProblem> (*)(std::uint64_t);

/// How many had a way.
int expect_all_shortest(const std::vector<std::uint64_t>& seeds, ProblemBySeed make) {
  int solved = 0;
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    const std::optional<DiscProblem> problem = make(seed);
    if (problem && expect_shortest(*problem)) ++solved;
    if (testing::Test::HasFailure()) return solved;
  }
  return solved;
}

TEST(DiscPath, IsAsLongAsBruteForceOverAllTangentsSays) {
  const std::vector<std::uint64_t> seeds = test::seeds(1000, 24);
  EXPECT_GT(expect_all_shortest(seeds, among_stars), static_cast<int>(seeds.size() / 3));
}

TEST(DiscPath, IsAsLongAsBruteForceSaysWhereObstaclesTouchOverlapAndCross) {
  const std::vector<std::uint64_t> seeds = test::seeds(2000, 80);
  EXPECT_GT(expect_all_shortest(seeds, among_degenerate), static_cast<int>(seeds.size() / 4));
}

/// Gaps as wide as the disc, ends that touch, corners that an ulp parts: nothing is claimed that the judge refuses, and
/// the lower bound is none that a plain search beats.
TEST(DiscPath, ClaimsNothingFalseInStrangeWorlds) {
  int solved = 0;
  for (const std::uint64_t seed : test::seeds(3000, 300)) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    test::PlaneProblem strange = test::StrangeWorlds(seed).make();
    DiscProblem p{std::move(strange.obstacles), strange.start, strange.goal, 1.0};
    const Box box = box_around(p.obstacles);
    if (box.empty()) continue;
    constexpr double shares[] = {0.5, 0.25, 0.125, 0.05, 0.01, 1e-6};
    p.radius = shares[dice.roll(6)] * std::max(box.width(), box.height()) / (1.0 + dice.roll(3));
    if (!(p.radius > 0.0)) continue;
    const DiscPath path = plan(p);
    if (path.outcome == Outcome::solved) {
      ++solved;
      expect_sound(p, path);
    }
    const test::DiscOracle tight(p.obstacles, p.radius, 0.0);
    if (tight.stands(p.start) && tight.stands(p.goal) && !(p.start == p.goal)) {
      const std::optional<double> plain = oracle(p, 0.0);
      if (plain) {
        EXPECT_LE(path.lower_bound, *plain * (1.0 + 1e-13));
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(solved, test::share(60, 3));
}

/// A rectangle from a to b.
void add_box(PlaneObstacles& to, Vec2 a, Vec2 b) { to.polygons.add(std::vector<Vec2>{a, {b.x, a.y}, b, {a.x, b.y}}); }

/// Two blocks that leave a corridor of this width from left to right in a room that is shut but for it.
DiscProblem corridor(double width, double radius) {
  DiscProblem p;
  add_box(p.obstacles, {3, 0}, {7, 4});
  add_box(p.obstacles, {3, 4 + width}, {7, 10});
  p.obstacles.bounds = Box{{0, 0}, {10, 10}};
  p.start = {1.5, 2};
  p.goal = {8.5, 7};
  p.radius = radius;
  return p;
}

TEST(DiscPath, PassesACorridorWiderByABillionthAndNoneNarrower) {
  for (const double radius : {0.25, 0.7, 1.1}) {
    SCOPED_TRACE(radius);
    const DiscProblem wide = corridor(2.0 * radius * (1.0 + 1e-9), radius);
    expect_sound(wide, plan(wide));
    EXPECT_TRUE(expect_shortest(wide));
    const DiscPath none = plan(corridor(2.0 * radius * (1.0 - 1e-9), radius));
    EXPECT_EQ(none.outcome, Outcome::infeasible);
    EXPECT_EQ(none.lower_bound, infinite);
  }
  const DiscPath doubtful = plan(corridor(1.0, 0.5));
  EXPECT_NE(doubtful.outcome, Outcome::infeasible);
  EXPECT_GT(doubtful.lower_bound, 8.0);
}

/// One corner between start and goal: two tangents and an arc, by hand.
TEST(DiscPath, GoesAroundACornerOnAnArc) {
  DiscProblem p;
  p.obstacles.walls = {{{0, 0}, {0, -5}}};
  p.obstacles.bounds = Box{{-5, -5}, {5, 5}};
  p.start = {-3, 0};
  p.goal = {3, 0};
  p.radius = 1.5;
  const DiscPath path = plan(p);
  expect_sound(p, path);
  EXPECT_NEAR(path.length, 2.0 * std::sqrt(9.0 - 2.25) + 1.5 * (std::acos(-1.0) - 2.0 * std::acos(0.5)), 1e-11);
  EXPECT_EQ(path.arcs(), 1U);
  EXPECT_EQ(path.circles, 1U);
}

TEST(DiscPath, GoesAroundAWallWithoutLengthOnTheShorterSide) {
  DiscProblem p;
  p.obstacles.walls = {{{0, 0.25}, {0, 0.25}}};
  p.obstacles.bounds = Box{{-5, -5}, {5, 5}};
  p.start = {-3, 0};
  p.goal = {3, 0};
  p.radius = 1.0;
  EXPECT_TRUE(expect_shortest(p));
  EXPECT_EQ(plan(p).arcs(), 1U);
}

/// With bounds the whole disc stays inside; without them its centre stays in the obstacles' box.
TEST(DiscPath, KeepsFromTheBoundsAndWithoutThemInTheBox) {
  DiscProblem p;
  p.obstacles.walls = {{{0, 0}, {0, 3}}, {{-4, 4.5}, {-4, 4.5}}, {{4, -4.5}, {4, -4.5}}};
  p.start = {-2.9, 1};
  p.goal = {2.9, 1};
  p.radius = 1.0;
  EXPECT_TRUE(expect_shortest(p));
  p.obstacles.bounds = Box{{-4, -1.9}, {4, 4.5}};  // neither above nor below
  EXPECT_FALSE(expect_shortest(p));
  p.obstacles.bounds->min.y = -2.5;
  EXPECT_TRUE(expect_shortest(p));
}

/// Corners in a heap: none is passed between.
TEST(DiscPath, GoesAroundAHeapOfCorners) {
  Dice dice(3);
  DiscProblem p;
  for (int i = 0; i < 40; ++i) {
    const Vec2 at{dice.real(), dice.real()};
    p.obstacles.walls.push_back({at, at + Vec2{0.3 * dice.real(), 0.3 * dice.real()}});
  }
  p.obstacles.bounds = Box{{-6, -6}, {6, 6}};
  p.start = {-4, 0.4};
  p.goal = {4, 0.6};
  for (const double radius : {0.01, 0.1, 0.5, 1.5}) {
    p.radius = radius;
    EXPECT_TRUE(expect_shortest(p));
  }
}

DiscProblem mapped(const DiscProblem& p, double scale, const std::function<Vec2(Vec2)>& map) {
  DiscProblem result{{}, map(p.start), map(p.goal), scale * p.radius};
  for (std::size_t i = 0; i < p.obstacles.polygons.size(); ++i) {
    std::vector<Vec2> ring;
    for (const Vec2 c : p.obstacles.polygons[i]) ring.push_back(map(c));
    if (cross(ring[1] - ring[0], ring[2] - ring[0]) * cross(p.obstacles.polygons[i][1] - p.obstacles.polygons[i][0],
                                                            p.obstacles.polygons[i][2] - p.obstacles.polygons[i][0]) <
        0.0) {
      std::reverse(ring.begin(), ring.end());
    }
    result.obstacles.polygons.add(ring);
  }
  for (const Segment& w : p.obstacles.walls) result.obstacles.walls.push_back({map(w.a), map(w.b)});
  if (p.obstacles.bounds) {
    Box box;
    box.include(map(p.obstacles.bounds->min));
    box.include(map(p.obstacles.bounds->max));
    result.obstacles.bounds = box;
  }
  return result;
}

TEST(DiscPath, IsTheSameMirroredTurnedScaledAndShifted) {
  for (const std::uint64_t seed : test::seeds(200, 10)) {
    SCOPED_TRACE(seed);
    std::optional<DiscProblem> p = among_stars(seed);
    if (!p) continue;
    const auto on_grid = [](Vec2 v) {
      return Vec2{std::round(v.x * 1024.0) / 1024.0, std::round(v.y * 1024.0) / 1024.0};
    };
    p->start = on_grid(p->start);
    p->goal = on_grid(p->goal);
    const DiscPath path = plan(*p);
    const auto expect_same = [&](double scale, double tolerance, const std::function<Vec2(Vec2)>& map) {
      const DiscProblem other = mapped(*p, scale, map);
      const DiscPath again = plan(other);
      ASSERT_EQ(again.outcome, path.outcome);
      if (path.outcome != Outcome::solved) return;
      EXPECT_NEAR(again.length, scale * path.length, tolerance * scale * path.length);
      EXPECT_EQ(turns_of(again), turns_of(path));
      expect_sound(other, again);
    };
    expect_same(1.0, 1e-12, [](Vec2 v) { return Vec2{-v.x, v.y}; });
    expect_same(1.0, 1e-12, [](Vec2 v) { return Vec2{-v.y, v.x}; });
    expect_same(1024.0, 1e-12, [](Vec2 v) { return 1024.0 * v; });
    expect_same(1e-3, 1e-11, [](Vec2 v) { return 1e-3 * v; });
    expect_same(1.0, 1e-9, [](Vec2 v) { return v + Vec2{4e6, -4e6}; });
    if (!p->obstacles.bounds) continue;
    p->obstacles.bounds.reset();  // a box turns into none
    for (const Vec2 c : {Vec2{-40, -40}, Vec2{120, 120}, Vec2{-40, 120}, Vec2{120, -40}}) {
      p->obstacles.walls.push_back({c, c + Vec2{0.5, 0.25}});
    }
    const DiscPath open = plan(*p);
    const DiscPath turned = plan(mapped(*p, 1.0, [](Vec2 v) {
      return Vec2{0.6 * v.x - 0.8 * v.y, 0.8 * v.x + 0.6 * v.y};
    }));
    ASSERT_EQ(turned.outcome, open.outcome);
    EXPECT_NEAR(turned.length, open.length, 1e-11 * open.length);
  }
}

TEST(DiscPath, OfAlmostNoRadiusIsThePointsAndLargerOnesAreLonger) {
  for (const std::uint64_t seed : test::seeds(200, 12)) {
    SCOPED_TRACE(seed);
    std::optional<DiscProblem> p = among_stars(seed);
    if (!p || !p->obstacles.bounds) continue;  // the rim of a box lets a point pass
    const double radius = p->radius;
    const Solution<Vec2> point = confined_visibility_path(p->obstacles, p->start, p->goal, {.lazy = true}, {});
    ASSERT_EQ(point.outcome, Outcome::solved);
    const double length = test::length_of(point.path);
    const double roundings = 3.0 + static_cast<double>(point.path.size());
    p->radius = 1e-9;
    const DiscPath tiny = plan(*p);
    expect_sound(*p, tiny);
    EXPECT_NEAR(tiny.length, length, 1e-7);
    EXPECT_GE(tiny.length, length * (1.0 - roundings * 0x1p-53));
    double last = length;
    for (const double share : {0.25, 0.5, 0.5 + 1e-9, 1.0}) {
      p->radius = share * radius;
      const DiscPath path = plan(*p);
      if (path.outcome != Outcome::solved) break;
      EXPECT_GE(path.length, last * (1.0 - 1e-14));
      last = path.length;
    }
  }
}

TEST(DiscPath, OfARoadmapIsTheSame) {
  for (const std::uint64_t seed : test::seeds(200, 20)) {
    SCOPED_TRACE(seed);
    for (const ProblemBySeed make : {among_stars, among_degenerate}) {
      const std::optional<DiscProblem> p = make(seed);
      if (!p) continue;
      const DiscRoadmap roadmap(p->obstacles, {});
      const DiscPath path = plan(*p);
      const DiscPath asked =
          shortest_disc_path(roadmap.ground, p->start, p->goal, p->radius, {}, &roadmap.graph.graph());
      EXPECT_EQ(asked.outcome, path.outcome);
      EXPECT_EQ(asked.length, path.length);
      EXPECT_EQ(asked.lower_bound, path.lower_bound);
      EXPECT_EQ(asked.arrivals, path.arrivals);
      ASSERT_EQ(asked.pieces.size(), path.pieces.size());
      for (std::size_t i = 0; i < path.pieces.size(); ++i) EXPECT_EQ(asked.pieces[i].to, path.pieces[i].to);
    }
  }
}

TEST(DiscPath, BlockedEndsAndEqualEnds) {
  DiscProblem p = corridor(3.0, 1.0);
  p.start = {0.5, 2};  // the bounds are nearer than the radius
  EXPECT_EQ(plan(p).outcome, Outcome::start_blocked);
  p.start = {1.5, 2};
  p.goal = {5, 2};  // inside of a block
  EXPECT_EQ(plan(p).outcome, Outcome::goal_blocked);
  p.goal = p.start;
  const DiscPath stay = plan(p);
  EXPECT_EQ(stay.outcome, Outcome::solved);
  EXPECT_EQ(stay.length, 0.0);
}

TEST(DiscPath, StopsAtTheDeadline) {
  const Deadline over(0.0);
  Execution execution;
  execution.deadline = &over;
  EXPECT_THROW(plan(corridor(3.0, 1.0), execution), Stopped);
}

}  // namespace
}  // namespace warren
