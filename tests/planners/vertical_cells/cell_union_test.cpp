// SPDX-License-Identifier: BSD-3-Clause
// Cells around the union of polygons that overlap and stick out of the bounds, against the visibility graph, which
// takes such polygons as they are.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "planners/vertical_cells/cell_decomposition.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"

namespace warren {
namespace {

using test::Dice;
using test::length_of;

/// Stars with real coordinates, placed anywhere: many overlap, some stick out.
PlaneObstacles overlapping_stars(std::uint64_t seed, int count) {
  Dice dice(seed);
  PlaneObstacles obstacles;
  obstacles.bounds = Box{{-5.0, 2.0}, {5.0, 12.0}};
  for (int i = 0; i < count; ++i) {
    const Vec2 center{-5.5 + 11.0 * dice.real(), 1.5 + 11.0 * dice.real()};
    const int corners = 3 + dice.roll(6);
    std::vector<Vec2> ring;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.8 * dice.real()) / corners;
      const double reach = 0.4 + 1.2 * dice.real();
      ring.push_back({center.x + reach * std::cos(angle), center.y + reach * std::sin(angle)});
    }
    obstacles.polygons.add(ring);
  }
  return obstacles;
}

TEST(CellUnion, FunnelIsAsShortAsTheVisibilityGraphsPath) {
  int solved = 0;
  int apart = 0;
  int blocked = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = overlapping_stars(seed, 4 + static_cast<int>(seed % 30));
    Dice dice(seed + 1000);
    for (int trial = 0; trial < 4; ++trial) {
      const Vec2 start{-5.0 + 10.0 * dice.real(), 2.0 + 10.0 * dice.real()};
      const Vec2 goal{-5.0 + 10.0 * dice.real(), 2.0 + 10.0 * dice.real()};
      const CellOptions options{.doors = DoorKind::funnel, .overlaps = Overlaps::united};
      const Solution<Vec2> cells = plan_through_cells(obstacles, start, goal, options, {});
      const Solution<Vec2> shortest = visibility_path(obstacles, start, goal, {}, {});
      ASSERT_EQ(cells.outcome, shortest.outcome);
      EXPECT_NEAR(length_of(cells.path), length_of(shortest.path), 1e-10);
      solved += cells.outcome == Outcome::solved ? 1 : 0;
      apart += cells.outcome == Outcome::not_connected ? 1 : 0;
      blocked += cells.outcome == Outcome::start_blocked || cells.outcome == Outcome::goal_blocked ? 1 : 0;
    }
  }
  EXPECT_GT(solved, 60);
  EXPECT_GT(apart, 1);
  EXPECT_GT(blocked, 20);
}

TEST(CellUnion, OutsideOfTheBoundsIsBlocked) {
  const PlaneObstacles obstacles = overlapping_stars(1, 3);
  const CellOptions options{.overlaps = Overlaps::united};
  EXPECT_EQ(plan_through_cells(obstacles, {-5.1, 4.0}, {0.0, 4.0}, options, {}).outcome, Outcome::start_blocked);
  EXPECT_EQ(plan_through_cells(obstacles, {-4.9, 2.1}, {400.0, 4.0}, options, {}).outcome, Outcome::goal_blocked);
}

TEST(NodedPolygons, ShareNothingButCornersAndKeepTheirPlaces) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = overlapping_stars(seed, 12);
    const NodedPolygons noded = node_polygons(obstacles.polygons, {});
    ASSERT_EQ(noded.polygons.size(), obstacles.polygons.size());
    EXPECT_LT(noded.error, 1e-11);
    std::vector<Segment> sides;
    for (std::size_t p = 0; p < noded.polygons.size(); ++p) {
      const auto ring = noded.polygons[p];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        sides.push_back({ring[i], ring[(i + 1) % ring.size()]});
        double near = 1e9;
        for (std::size_t k = 0; k < obstacles.polygons[p].size(); ++k) {
          const auto outline = obstacles.polygons[p];
          near = std::min(near, distance(ring[i], Segment{outline[k], outline[(k + 1) % outline.size()]}));
        }
        EXPECT_LE(near, noded.error + 1e-14);
      }
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(segments_cross(sides[i], sides[j]));
        for (const Vec2 end : {sides[i].a, sides[i].b}) {
          EXPECT_TRUE(end == sides[j].a || end == sides[j].b || !on_segment(end, sides[j]));
        }
      }
    }
  }
}

TEST(NodedPolygons, SidesThatLieOnEachOtherAreCutAtEachOthersEnds) {
  PolygonSet squares;
  squares.add(std::vector<Vec2>{{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  squares.add(std::vector<Vec2>{{4, 1}, {8, 1}, {8, 3}, {4, 3}});
  const NodedPolygons noded = node_polygons(squares, {});
  EXPECT_EQ(noded.polygons[0].size(), 6U);
  EXPECT_EQ(noded.polygons[1].size(), 4U);
}

}  // namespace
}  // namespace warren
