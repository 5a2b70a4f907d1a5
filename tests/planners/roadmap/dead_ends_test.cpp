// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/lazy_prm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "tests/seeds.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

using test::length_of;

constexpr std::uint8_t sides[] = {CellSides::right, CellSides::up, CellSides::left, CellSides::down};

/// Cells with random open sides, each side open at both of its cells.
CellSides random_cells(std::uint32_t cols, std::uint32_t rows, double share, std::uint64_t seed) {
  CellSides cells{{0.5, 0.5}, cols, rows, RawVector<std::uint8_t>(std::size_t{cols} * rows, 0)};
  for (std::size_t cell = 0; cell < cells.open.size(); ++cell) {
    const auto join = [&](std::uint8_t side, bool has_next, int axis) {
      if (!has_next || uniform(seed, cell, axis) >= share) return;
      cells.open[cell] |= side;
      cells.open[cells.beyond(cell, side)] |= CellSides::opposite(side);
    };
    join(CellSides::right, cell % cols + 1 < cols, 0);
    join(CellSides::up, cell / cols + 1 < rows, 1);
  }
  return cells;
}

/// What can be had from the cell without that side of it.
std::vector<std::size_t> cells_without(const CellSides& cells, std::size_t from, std::uint8_t without) {
  std::vector<std::size_t> found{from};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const std::uint8_t side : sides) {
      if ((cells.open[found[i]] & side) == 0 || (found[i] == from && side == without)) continue;
      const std::size_t next = cells.beyond(found[i], side);
      if (std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
    }
  }
  return found;
}

bool reaches_kept(const CellSides& cells, std::size_t from, std::uint8_t without,
                  const std::vector<std::size_t>& kept) {
  const std::vector<std::size_t> found = cells_without(cells, from, without);
  return std::any_of(found.begin(), found.end(),
                     [&](std::size_t cell) { return std::find(kept.begin(), kept.end(), cell) != kept.end(); });
}

/// Which cells are left when cells with one open side are closed until there is none: one pass after the other.
std::vector<bool> left_by_passes(const CellSides& cells, const std::vector<std::size_t>& kept) {
  std::vector<bool> is_left(cells.open.size(), true);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t cell = 0; cell < is_left.size(); ++cell) {
      if (!is_left[cell] || std::find(kept.begin(), kept.end(), cell) != kept.end()) continue;
      const auto ways = std::count_if(std::begin(sides), std::end(sides), [&](std::uint8_t side) {
        return (cells.open[cell] & side) != 0 && is_left[cells.beyond(cell, side)];
      });
      if (ways != 1) continue;
      is_left[cell] = false;
      changed = true;
    }
  }
  return is_left;
}

TEST(DeadEnds, AreLeftOverTheirWayOutAlone) {
  std::size_t some = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const CellSides cells = random_cells(13, 9, 0.35 + 0.05 * static_cast<double>(seed % 6), seed);
    const std::vector<std::size_t> kept{random_bits(seed, 0, 5) % cells.open.size(),
                                        random_bits(seed, 1, 5) % cells.open.size()};
    CellSides copy{cells.corner, cells.cols, cells.rows, RawVector<std::uint8_t>(cells.open.size())};
    std::copy(cells.open.begin(), cells.open.end(), copy.open.begin());
    const DeadEnds dead_ends(std::move(copy), kept, {});
    const std::vector<bool> is_left = left_by_passes(cells, kept);
    for (std::size_t cell = 0; cell < cells.open.size(); ++cell) {
      ASSERT_EQ(dead_ends.open_sides(cell), cells.open[cell]);
      const std::uint8_t out = dead_ends.way_out(cell);
      if (!reaches_kept(cells, cell, 0, kept)) continue;  // no search comes here
      ASSERT_EQ(out == 0, is_left[cell]) << cell;
      if (out == 0) continue;
      ++some;
      ASSERT_EQ(out & cells.open[cell], out);
      ASSERT_FALSE(reaches_kept(cells, cell, out, kept)) << cell;
    }
  }
  EXPECT_GT(some, 500U);
}

/// Free motions from what lies behind a cell's way out to what lies beyond.
struct Leaving {
  std::size_t cell;
  VertexId from, to;
};

std::vector<Leaving> all_that_leave(const MazeWorld& world, const DeadEnds& dead_ends, const std::vector<Vec2>& points,
                                    double radius) {
  const CellSides& cells = dead_ends.cells();
  std::vector<Edge> motions;
  MazeWorld::Query query = world.make_query();
  for (VertexId v = 0; v < points.size(); ++v) {
    for (VertexId w = 0; w < points.size(); ++w) {
      if (distance(points[v], points[w]) <= radius && world.is_free_motion(points[v], points[w], query))
        motions.push_back({v, w});
    }
  }
  std::vector<Leaving> leaving;
  for (std::size_t cell = 0; cell < cells.open.size(); ++cell) {
    const std::uint8_t out = dead_ends.way_out(cell);
    if (out == 0) continue;
    const auto is_behind = [&, found = cells_without(cells, cell, out)](VertexId v) {
      return std::find(found.begin(), found.end(), cells.cell_of(points[v])) != found.end();
    };
    for (const Edge& e : motions) {
      if (is_behind(e.from) && !is_behind(e.to)) leaving.push_back({cell, e.from, e.to});
    }
  }
  return leaving;
}

/// From behind which ways out does a motion come to a milestone that is not settled?
std::vector<bool> left_for_unsettled(std::size_t cells, const std::vector<Leaving>& leaving,
                                     const std::vector<double>& labels) {
  std::vector<bool> is_left(cells, false);
  for (const Leaving& motion : leaving) {
    if (!std::signbit(labels[motion.to])) is_left[motion.cell] = true;
  }
  return is_left;
}

std::vector<Vec2> free_points(const MazeWorld& world, std::size_t count, std::uint64_t seed) {
  std::vector<Vec2> points;
  MazeWorld::Query query = world.make_query();
  for (std::uint64_t i = 0; points.size() < count; ++i) {
    const Vec2 p = world.at_unit({uniform(seed, i, 0), uniform(seed, i, 1)});
    if (world.is_free(p, query)) points.push_back(p);
  }
  return points;
}

/// What it waited for has been settled since.
void expect_holds_as_anew(DeadEndSeals& seals, DeadEndSeals anew, std::size_t milestones) {
  const std::vector<double> settled(milestones, -1.0);
  for (VertexId v = 0; v < milestones; ++v) ASSERT_EQ(seals.holds(v, settled), anew.holds(v, settled)) << v;
}

/// Brute force over all motions: a milestone left unexpanded lies behind a way out, its cell's or a later one, over
/// which all motions come to settled milestones.
TEST(DeadEnds, AreSealedWhereAllThatMotionsOutOfThemComeToIsSettled) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::size_t held = 0;
  std::size_t open = 0;
  for (const double radius : {0.3, 0.8, 1.4, 2.0}) {
    const Scene scene = maze_scene({9, 9, 5, MazeAlgorithm::kruskal, 0.05}, false, {});
    const MazeWorld world(scene, 0.02, {});
    const std::vector<std::size_t> kept{0, 80};
    const DeadEnds dead_ends(world.cell_sides(81, {}), kept, {});
    const std::vector<Vec2> points = free_points(world, 600, 7);
    const Neighbours<2> index(points, {});
    const std::vector<Leaving> leaving = all_that_leave(world, dead_ends, points, radius);
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
      std::vector<double> labels(points.size(), -1.0);
      for (std::uint64_t i = 0; i <= trial % 3; ++i)
        labels[random_bits(trial, i, 0) % points.size()] = i % 2 == 0 ? infinite : 1.0;
      DeadEndSeals seals(dead_ends, index, radius, {});
      std::vector<bool> is_held(dead_ends.cells().open.size(), false);
      for (VertexId v = 0; v < points.size(); ++v) {
        const bool holds = seals.holds(v, labels);
        if (holds) is_held[dead_ends.cells().cell_of(points[v])] = true;
        ++(holds ? held : open);
      }
      const std::vector<bool> is_left = left_for_unsettled(dead_ends.cells().open.size(), leaving, labels);
      if (trial % 10 == 0) expect_holds_as_anew(seals, DeadEndSeals(dead_ends, index, radius, {}), points.size());
      for (std::size_t cell = 0; cell < is_held.size(); ++cell) {
        if (!is_held[cell]) continue;
        std::size_t at = cell;
        while (is_left[at] && dead_ends.way_out(at) != 0) at = dead_ends.cells().beyond(at, dead_ends.way_out(at));
        ASSERT_FALSE(is_left[at] || dead_ends.way_out(at) == 0)
            << "radius " << radius << ", trial " << trial << ": cell " << cell;
      }
    }
  }
  EXPECT_GT(held, 100'000U);
  EXPECT_GT(open, 10'000U);
}

void add_walls(Scene& scene, const std::vector<Segment>& more) {
  std::vector<Segment> walls = more;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) walls.push_back(scene.walls.segment(i));
  scene.walls = WallSet::narrowest(walls);
}

struct Question {
  Scene scene;
  Vec2 start, goal;
};

/// Ends in corners, or in the middle of any two cells: of dead ends, too.
Question question(std::uint64_t seed, double loops, bool anywhere) {
  Question asked{
      maze_scene({100, 100, seed, MazeAlgorithm::backtracker, loops}, seed % 2 == 0, {}), {1, 1}, {100, 100}};
  const auto cell = [&](std::uint64_t i) { return static_cast<double>(random_bits(seed, i, 9) % 100 + 1); };
  if (anywhere) {
    asked.start = {cell(0), cell(1)};
    asked.goal = {cell(2), cell(3)};
  }
  if (seed % 3 == 0) {
    std::vector<Segment> closing_nothing;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Vec2 at{1.0 + 98.0 * uniform(seed, i, 20), 1.0 + 98.0 * uniform(seed, i, 21)};
      if (distance(at, asked.start) > 1.0 && distance(at, asked.goal) > 1.0)
        closing_nothing.push_back({at, at + Vec2{0.2, 0.3 * uniform(seed, i, 22)}});
    }
    add_walls(asked.scene, closing_nothing);
  }
  return asked;
}

/// prm, which knows no dead ends, is the oracle.
TEST(DeadEnds, DoNotChangeThePathOfALazySearch) {
  for (const std::uint64_t seed : test::seeds(10)) {
    for (const double loops : {0.0, 0.05}) {
      for (const SearchKind search : {SearchKind::astar, SearchKind::dijkstra}) {
        SCOPED_TRACE(std::to_string(seed) + ", loops " + std::to_string(loops) + ", search " +
                     std::to_string(static_cast<int>(search)));
        const Question asked = question(seed, loops, search == SearchKind::dijkstra || seed > 5);
        const MazeWorld world(asked.scene, 0.1, {});
        RoadmapOptions options;
        options.seed = seed;
        options.search = search;
        const auto eager = prm(WorldView(world), asked.start, asked.goal, options, Execution{2});
        const auto lazy = lazy_prm(WorldView(world), asked.start, asked.goal, options, Execution{1});
        ASSERT_GE(lazy.roadmap.milestones, fewest_for_both_ends);
        ASSERT_EQ(lazy.outcome, eager.outcome);
        EXPECT_EQ(lazy.counters.kept, eager.counters.kept);
        EXPECT_EQ(lazy.path, eager.path);
        EXPECT_NEAR(length_of(lazy), length_of(eager), 1e-12 * length_of(eager));
        const auto two = lazy_prm(WorldView(world), asked.start, asked.goal, options, Execution{2});
        EXPECT_EQ(two.path, lazy.path);
        EXPECT_EQ(two.counters, lazy.counters);
      }
    }
  }
}

/// Start and goal stand in two slits before a dead end, where no milestones are, and the way between them leads
/// through it: nothing lies before its way out that could be settled.
TEST(DeadEnds, AreNotWhereMilestonesOfAnEndAre) {
  std::vector<Segment> walls{
      {{0.5, 0.5}, {30.5, 0.5}}, {{0.5, 30.5}, {30.5, 30.5}}, {{0.5, 0.5}, {0.5, 30.5}}, {{30.5, 0.5}, {30.5, 30.5}}};
  for (const double side : {-1.0, 1.0}) {
    walls.push_back({{9.5, 10.0 + 0.5 * side}, {11.5, 10.0 + 0.5 * side}});
    walls.push_back({{9.5, 10.0 + 0.451 * side}, {10.5, 10.0 + 0.451 * side}});
    walls.push_back({{9.5, 10.0 + 0.25 * side}, {10.5, 10.0 + 0.25 * side}});
  }
  walls.push_back({{11.5, 9.5}, {11.5, 10.5}});
  for (const double x : {10.4, 10.5}) walls.push_back({{x, 9.75}, {x, 10.25}});
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  const MazeWorld world(scene, 0.1, {});
  RoadmapOptions options;
  options.samples = 100'000;
  options.radius = 0.15;
  const auto eager = prm(WorldView(world), Vec2{10.499, 9.6495}, Vec2{10.499, 10.3505}, options, {});
  const auto lazy = lazy_prm(WorldView(world), Vec2{10.499, 9.6495}, Vec2{10.499, 10.3505}, options, {});
  ASSERT_EQ(eager.outcome, Outcome::solved);
  ASSERT_GE(lazy.roadmap.milestones, fewest_for_both_ends);
  EXPECT_GT(lazy.path.size(), 4U);
  EXPECT_EQ(lazy.path, eager.path);
}

TEST(DeadEnds, AreLeftUnexpandedInAMaze) {
  const Scene scene = maze_scene({100, 100, 3, MazeAlgorithm::kruskal}, false, {});
  const MazeWorld world(scene, 0.1, {});
  RoadmapOptions options;
  const auto by_radius = lazy_prm(WorldView(world), Vec2{1, 1}, Vec2{100, 100}, options, {});
  options.neighbours = 20;  // by which no motion has a longest length
  const auto by_nearest = lazy_prm(WorldView(world), Vec2{1, 1}, Vec2{100, 100}, options, {});
  ASSERT_EQ(by_radius.outcome, Outcome::solved);
  ASSERT_EQ(by_nearest.outcome, Outcome::solved);
  EXPECT_LT(3 * by_radius.counters.expanded, by_nearest.counters.expanded);
}

/// What both sides together have not found is not there.
TEST(DeadEnds, OfAMazeWithoutAWayLeaveTheOutcomeAndTheGapAsTheyAre) {
  Scene scene = maze_scene({100, 100, 8}, false, {});
  add_walls(scene, {{{0.5, 60.5}, {100.5, 60.5}}});
  const MazeWorld world(scene, 0.1, {});
  RoadmapOptions options;
  options.samples = 100'000;
  const auto eager = prm(WorldView(world), Vec2{1, 1}, Vec2{100, 100}, options, {});
  const auto lazy = lazy_prm(WorldView(world), Vec2{1, 1}, Vec2{100, 100}, options, {});
  ASSERT_EQ(eager.outcome, Outcome::not_connected);
  ASSERT_EQ(lazy.outcome, Outcome::not_connected);
  ASSERT_TRUE(eager.separation.is_known());
  EXPECT_EQ(lazy.separation.start_size, eager.separation.start_size);
  EXPECT_EQ(lazy.separation.nearest_gap, eager.separation.nearest_gap);
  options.tells_separation = false;
  EXPECT_FALSE(lazy_prm(WorldView(world), Vec2{1, 1}, Vec2{100, 100}, options, {}).separation.is_known());
  EXPECT_FALSE(prm(WorldView(world), Vec2{1, 1}, Vec2{100, 100}, options, {}).separation.is_known());
}

}  // namespace
}  // namespace warren
