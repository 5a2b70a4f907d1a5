// SPDX-License-Identifier: BSD-3-Clause
// Visibility and cells among polygons at coordinates where rounding bites, against brute force in exact rationals: the
// degenerate worlds moved, scaled and turned, so that what was collinear or touching is so no more, or by an ulp, while
// shared corners stay shared; and worlds that broke other people's programs.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "tests/planners/visibility/degenerate_worlds.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "tests/planners/visibility/rational_plane.hpp"

namespace warren {
namespace {

using test::judged;
using test::length_of;
using test::scene_of;

using VertexPairs = std::set<std::pair<rational::Vertex, rational::Vertex>>;

/// Where the grid of the degenerate worlds is put.
struct Map {
  const char* name;
  Vec2 x, y;  ///< images of the unit vectors
  Vec2 origin;
  Vec2 operator()(Vec2 p) const { return p.x * x + p.y * y + origin; }
  bool is_upright() const { return x.y == 0.0 && y.x == 0.0 && x.x > 0.0 && y.y > 0.0; }
};
const Map maps[] = {
    {"as it is", {1, 0}, {0, 1}, {0, 0}},
    {"tenths", {0.1, 0}, {0, 0.1}, {0, 0}},
    {"thirds, moved", {1.0 / 3, 0}, {0, 1.0 / 7}, {0.1, -0.7}},
    {"turned", {0.6, 0.8}, {-0.8, 0.6}, {1.0 / 3, 0.1}},
    {"sheared", {1, 0.1}, {0.3, 1.1}, {-5, 3}},
    {"far away", {0.1, 0}, {0, 0.1}, {1e6, -1e6}},
    {"so far away that an ulp is an eighth", {1, 0}, {0, 1}, {1e15 + 0.1, 1e15 - 0.1}},
    {"tiny", {1e-30, 0}, {0, 0.7e-30}, {0, 0}},
    {"huge", {1e40, 3e39}, {-7e39, 1e40}, {0, 0}},
    {"a sliver", {1, 0}, {1e-9, 1e-9}, {0, 0}},
};

PlaneObstacles moved(const PlaneObstacles& world, const Map& map) {
  PlaneObstacles result;
  for (std::size_t p = 0; p < world.polygons.size(); ++p) {
    std::vector<Vec2> ring;
    for (const Vec2 c : world.polygons[p]) ring.push_back(map(c));
    result.polygons.add(ring);
  }
  for (const Segment& w : world.walls) result.walls.push_back({map(w.a), map(w.b)});
  if (world.bounds && map.is_upright()) result.bounds = Box{map(world.bounds->min), map(world.bounds->max)};
  return result;
}

/// The world as a reader hands it to planners; nothing where rounding has made a ring touch itself.
std::optional<PlaneObstacles> as_read(const PlaneObstacles& world) {
  try {
    return plane_obstacles(scene_of(world), {});
  } catch (const InputError&) {
    return std::nullopt;
  }
}

rational::Vertex vertex(const VisibleCorners& corners, VertexId v) {
  const Vec2 at = corners.position(v);
  return {at.x, at.y, static_cast<int>(v - corners.vertices_first(corners.point(v)))};
}

VertexPairs edges_of(const VisibleCorners& corners, const Graph& graph) {
  VertexPairs pairs;
  for (VertexId v = 0; v < graph.vertex_count(); ++v) {
    for (const VertexId w : graph.neighbours(v)) pairs.insert({vertex(corners, v), vertex(corners, w)});
  }
  return pairs;
}

/// The edges that only one of the two has.
std::string difference(const VertexPairs& mine, const VertexPairs& theirs) {
  std::string text;
  const auto add = [&](const char* what, const VertexPairs& a, const VertexPairs& b) {
    for (const auto& [v, w] : a) {
      if (b.contains({v, w})) continue;
      for (const rational::Vertex& u : {v, w}) {
        text += std::to_string(u.x) + "," + std::to_string(u.y) + "#" + std::to_string(u.sector) + "  ";
      }
      text += std::string(what) + "\n";
    }
  };
  add("missing", theirs, mine);
  add("too many", mine, theirs);
  return text;
}

void expect_edges_by_definition(const PlaneObstacles& world) {
  const VisibleCorners corners(world, {});
  const rational::Plane plane(world);
  std::set<rational::Vertex> vertices;
  for (VertexId v = 0; v < corners.size(); ++v) vertices.insert(vertex(corners, v));
  EXPECT_TRUE(vertices == plane.vertices());
  const VertexPairs mine = edges_of(corners, VisibilityGraph(corners, VisibilityEdges::full, {}).graph());
  const VertexPairs theirs = plane.edges();
  EXPECT_TRUE(mine == theirs) << difference(mine, theirs);
}

struct Tally {
  int solved = 0;
  int bent = 0;
  int apart = 0;
  int blocked = 0;
  int clashes = 0;
};

/// What a plan must be by definition: `shortest` is infinite where there is no path.
void judge(const PlaneObstacles& world, const Solution<Vec2>& plan, Outcome expected, double shortest, bool exactly) {
  ASSERT_EQ(name_of(plan.outcome), name_of(expected));
  if (expected != Outcome::solved) return;
  const double length = length_of(plan.path);
  EXPECT_GE(length, shortest * (1.0 - 1e-12));
  if (exactly) {
    EXPECT_LE(length, shortest * (1.0 + 1e-12));
  }
  const Verification v = judged(world, plan.path);
  EXPECT_TRUE(v.verified) << (v.first_violation ? v.first_violation->obstacle : "");
}

void expect_shortest_paths(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, Tally& tally) {
  if (!box_around(obstacles).contains(start) || !box_around(obstacles).contains(goal)) return;
  const PlaneObstacles world = confined(obstacles);
  const rational::Plane plane(world, {start, goal});
  const double shortest = start == goal ? 0.0 : rational::Plane::shortest(plane.edges(), start, goal);
  Outcome expected = std::isinf(shortest) ? Outcome::not_connected : Outcome::solved;
  if (plane.is_blocked(goal)) expected = Outcome::goal_blocked;
  if (plane.is_blocked(start)) expected = Outcome::start_blocked;
  tally.solved += expected == Outcome::solved ? 1 : 0;
  tally.apart += expected == Outcome::not_connected ? 1 : 0;
  tally.blocked += expected == Outcome::start_blocked || expected == Outcome::goal_blocked ? 1 : 0;
  for (const bool lazy : {false, true}) {
    for (const VisibilityEdges edges : {VisibilityEdges::reduced, VisibilityEdges::full}) {
      VisibilityOptions options;
      options.lazy = lazy;
      options.edges = edges;
      if (lazy && edges == VisibilityEdges::full) continue;
      const Solution<Vec2> plan = visibility_path(world, start, goal, options, {});
      tally.bent += plan.path.size() > 2 ? 1 : 0;
      judge(obstacles, plan, expected, shortest, true);
    }
  }
  for (const DoorKind doors : {DoorKind::funnel, DoorKind::midpoint}) {
    try {
      const Solution<Vec2> plan = plan_through_cells(obstacles, start, goal, {.doors = doors}, {});
      judge(obstacles, plan, expected, shortest, doors == DoorKind::funnel);
    } catch (const ObstacleClash&) {
      ++tally.clashes;  // overlaps, by an ulp perhaps, are not for cells
    }
  }
}

TEST(ExactWorlds, VisibleEdgesAreThoseByExactRationals) {
  int worlds = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Map& map = maps[seed % std::size(maps)];
    SCOPED_TRACE(std::to_string(seed) + ", " + map.name);
    const auto world = as_read(moved(DegenerateWorlds(5000 + seed).make(seed % 3 == 0), map));
    if (!world) continue;
    ++worlds;
    expect_edges_by_definition(*world);
  }
  EXPECT_GT(worlds, 180);
}

TEST(ExactWorlds, PathsAreAsShortAsByExactRationalsAndVerified) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Map& map = maps[seed % std::size(maps)];
    SCOPED_TRACE(std::to_string(seed) + ", " + map.name);
    DegenerateWorlds worlds(7000 + seed);
    const auto world = as_read(moved(worlds.make(seed % 3 == 0), map));
    if (!world) continue;
    const Vec2 aside = seed % 4 < 2 ? Vec2{} : Vec2{0.25 * static_cast<double>(seed % 3), 0.375};
    const Vec2 start = map(worlds.random_point() + aside);
    expect_shortest_paths(*world, start, map(worlds.random_point() + (seed % 4 == 3 ? aside : Vec2{})), tally);
  }
  EXPECT_GT(tally.solved, 60);
  EXPECT_GT(tally.bent, 60);
  EXPECT_GT(tally.apart, 3);
  EXPECT_GT(tally.blocked, 10);
  EXPECT_LT(tally.clashes, 200);
}

/// A world that a bug report, here or of another program, was about: its line, and pairs of start and goal.
struct Case {
  const char* name;
  std::vector<std::vector<Vec2>> polygons;
  std::vector<Segment> walls;
  std::optional<Box> bounds;
  std::vector<Segment> ways;
};

constexpr Box box{{0, 0}, {12, 12}};
const std::vector<Case> cases{
    {"triangles that share a corner",
     {{{2, 2}, {6, 6}, {2, 8}}, {{6, 6}, {10, 2}, {10, 8}}},
     {},
     box,
     {{{6, 3}, {6, 9}}, {{2, 2}, {10, 8}}, {{0, 0}, {12, 12}}, {{6, 6}, {6, 0}}}},
    {"a corner on another's side",
     {{{2, 2}, {10, 2}, {10, 4}, {2, 4}}, {{6, 4}, {8, 9}, {4, 9}}},
     {},
     box,
     {{{3, 5}, {9, 5}}, {{6, 4}, {6, 12}}, {{4, 4}, {8, 4}}}},
    {"a side shared by half",
     {{{2, 2}, {6, 2}, {6, 8}, {2, 8}}, {{6, 4}, {9, 4}, {9, 10}, {6, 10}}},
     {},
     std::nullopt,
     {{{6, 2}, {6, 10}}, {{6, 3}, {2, 8}}, {{2, 2}, {9, 10}}, {{6, 6}, {9, 4}}}},
    {"a sliver",
     {{{1, 5}, {11, 5}, {11, 5.000000000000001}}, {{1, 6}, {11, 6.000000000000001}, {11, 6}}},
     {},
     box,
     {{{6, 4}, {6, 8}}, {{1, 5}, {11, 6}}, {{6, 5}, {6, 6}}}},
    {"corners on a line, and sides on it too",
     {{{1, 3}, {2, 3}, {3, 3}, {4, 3}, {4, 5}, {1, 5}}, {{6, 3}, {7, 3}, {9, 3}, {9, 1}, {6, 1}}},
     {{{4, 3}, {6, 3}}, {{9, 3}, {10, 3}}},
     box,
     {{{0, 3}, {12, 3}}, {{5, 2}, {5, 4}}, {{2, 3}, {7, 3}}}},
    {"a slot as wide as an ulp",
     {{{2, 2}, {10, 2}, {10, 10}, {6, 10}, {6, 4}, {5.999999999999999, 4}, {5.999999999999999, 10}, {2, 10}}},
     {},
     box,
     {{{6, 4}, {6, 12}}, {{6, 11}, {6, 5}}, {{1, 1}, {11, 11}}}},
    {"a corner whose sides are an ulp apart",
     {{{3, 3}, {9, 6}, {9, 6.000000000000001}}, {{3, 3}, {1, 8}, {0.5, 8}}},
     {},
     box,
     {{{8, 4}, {8, 7}}, {{3, 3}, {11, 6}}, {{2, 3}, {2, 10}}}},
    {"a wedge that is left around a wall's end",
     {{{3, 6}, {6, 6}, {6, 8}, {3, 8}}},
     {{{5, 10}, {3, 8}}},
     box,
     {{{4, 8.125}, {1, 7}}, {{4, 8}, {1, 7}}, {{1, 7}, {4, 8.125}}}},
    {"a side on the box, walls on it and ending there",
     {{{3, 0}, {6, 0}, {6, 3}, {3, 3}}, {{12, 4}, {12, 7}, {9, 6}}},
     {{{0, 0}, {1, 0}}, {{6, 0}, {8, 0}}, {{12, 7}, {12, 9}}, {{0, 12}, {2, 10}}, {{0, 5}, {0, 12}}},
     std::nullopt,
     {{{2, 1}, {7, 1}}, {{3, 0}, {6, 0}}, {{11, 4}, {11, 9}}, {{12, 5}, {12, 4}}, {{1, 0}, {2, 2}}, {{0, 0}, {12, 9}}}},
    {"walls that meet, overlap and stand twice",
     {},
     {{{2, 2}, {2, 9}}, {{2, 9}, {7, 9}}, {{5, 9}, {9, 9}}, {{9, 9}, {9, 2}}, {{9, 2}, {9, 9}}, {{4, 5}, {4, 5}}},
     box,
     {{{5, 6}, {5, 11}}, {{4, 5}, {5, 11}}, {{2, 2}, {9, 2}}, {{2, 9}, {9, 9}}, {{7, 9}, {7, 12}}}},
    {"rooms within rooms",
     {{{1, 1}, {11, 1}, {11, 11}, {1, 11}, {1, 2}, {2, 2}, {2, 10}, {10, 10}, {10, 2}, {3, 2}, {3, 1.5}, {1, 1.5}},
      {{4, 4}, {8, 4}, {8, 8}, {7, 8}, {7, 5}, {5, 5}, {5, 8}, {4, 8}}},
     {},
     std::nullopt,
     {{{6, 6}, {1, 11}}, {{6, 6}, {9, 3}}, {{2, 2}, {10, 10}}, {{1, 1}, {11, 11}}}},
    {"start and goal on corners of the box",
     {{{0, 0}, {3, 0}, {0, 3}}, {{12, 12}, {9, 12}, {12, 9}}},
     {},
     box,
     {{{0, 0}, {12, 12}}, {{12, 0}, {0, 12}}, {{3, 0}, {12, 12}}}},
};

TEST(ExactWorlds, ThatBugReportsWereAboutHaveTheirEdgesAndShortestPaths) {
  Tally tally;
  for (const Case& c : cases) {
    for (const Map& map : maps) {
      SCOPED_TRACE(std::string(c.name) + ", " + map.name);
      PlaneObstacles world{{}, c.walls, c.bounds};
      for (const auto& ring : c.polygons) world.polygons.add(ring);
      const auto read = as_read(moved(world, map));
      if (!read) continue;  // rounding has closed what was open by an ulp
      expect_edges_by_definition(*read);
      for (const Segment& way : c.ways) expect_shortest_paths(*read, map(way.a), map(way.b), tally);
    }
  }
  EXPECT_GT(tally.solved, 200);
  EXPECT_LT(tally.clashes, 150);
}

}  // namespace
}  // namespace warren
