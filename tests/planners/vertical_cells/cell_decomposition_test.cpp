// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/cell_decomposition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench/plain_graph.hpp"
#include "core/plane/geometry.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/paths.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "tests/refusals.hpp"

namespace warren {
namespace {

using test::Dice;
using test::disjoint_polygons;
using test::obstacles_of;
using test::PolygonsInCells;

PlaneObstacles polygons(const std::vector<std::vector<Vec2>>& outlines, std::optional<Box> bounds = {}) {
  PlaneObstacles obstacles;
  for (const auto& outline : outlines) obstacles.polygons.add(outline);
  obstacles.bounds = bounds;
  return obstacles;
}

const std::vector<Vec2> unit_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

void expect_formula(const PlaneObstacles& obstacles) {
  const CellDecomposition cells = decompose(obstacles, {}, {});
  const std::size_t k = obstacles.polygons.size() + obstacles.walls.size();
  const std::size_t corners = obstacles.polygons.corners.size() + 2 * obstacles.walls.size();
  EXPECT_EQ(cells.cells.size(), corners + k + 1);
  EXPECT_EQ(cells.doors.size(), corners + 2 * k);
}

/// Is p strictly inside the polygon? By winding, without the sweep.
bool inside_by_crossings(std::span<const Vec2> corners, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i];
    const Vec2 b = corners[i + 1 == corners.size() ? 0 : i + 1];
    if (on_segment(p, {a, b})) return false;
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    if ((orient2d(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

bool inside_any(const PlaneObstacles& obstacles, Vec2 p) {
  for (std::size_t i = 0; i < obstacles.polygons.size(); ++i) {
    if (inside_by_crossings(obstacles.polygons[i], p)) return true;
  }
  return false;
}

/// Does the closed cell contain p? By its own four sides.
bool contains(const CellDecomposition& cells, const VerticalCell& cell, Vec2 p) {
  const double left = cell.left == no_number ? cells.box.min.x : cells.corners[cell.left].x;
  const double right = cell.right == no_number ? cells.box.max.x : cells.corners[cell.right].x;
  return left <= p.x && p.x <= right && cells.side(cell.lower, p) >= 0 && cells.side(cell.upper, p) <= 0;
}

/// Rounded.
double area(const CellDecomposition& cells, const VerticalCell& cell) {
  const double left = cell.left == no_number ? cells.box.min.x : cells.corners[cell.left].x;
  const double right = cell.right == no_number ? cells.box.max.x : cells.corners[cell.right].x;
  const auto width_at = [&](double x) { return cells.height(cell.upper, x) - cells.height(cell.lower, x); };
  return 0.5 * (right - left) * (width_at(left) + width_at(right));
}

double free_area(const PlaneObstacles& obstacles) {
  double sum = obstacles.bounds->width() * obstacles.bounds->height();
  for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
    const auto corners = obstacles.polygons[p];
    for (std::size_t i = 0; i < corners.size(); ++i) sum -= 0.5 * cross(corners[i], corners[(i + 1) % corners.size()]);
  }
  return sum;
}

TEST(CellDecomposition, CountsFollowTheFormulaOnSmallWorlds) {
  const Box box{{-5, -5}, {5, 5}};
  expect_formula(polygons({}, box));
  expect_formula(polygons({{{0, 0}, {1, 0}, {0, 1}}}, box));
  expect_formula(polygons({unit_square}, box));
  expect_formula(polygons({unit_square}));                                         // touches its own box all around
  expect_formula(polygons({unit_square}, Box{{0, 0}, {5, 5}}));                    // stands in the bounds' corner
  expect_formula(polygons({unit_square, {{2, 0}, {3, 0}, {3, 1}, {2, 1}}}, box));  // equal heights
  expect_formula(polygons({unit_square, {{0, 2}, {1, 2}, {1, 3}, {0, 3}}}, box));  // equal x
  expect_formula(
      polygons({{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3}, {3, 3}, {3, 1}, {0, 1}}}, box));  // open to the left
  expect_formula(polygons({{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}}, box));       // corners on straight sides
  PlaneObstacles walls = polygons({}, box);
  walls.walls = {{{0, 0}, {1, 1}}, {{2, 0}, {2, 3}}, {{0, 3}, {1, 3}}};
  expect_formula(walls);
}

TEST(CellDecomposition, CountsFollowTheFormulaOnRandomDisjointPolygonsWithEqualCoordinates) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    PlaneObstacles obstacles = disjoint_polygons(seed);
    expect_formula(obstacles);
    obstacles.bounds.reset();
    if (!obstacles.polygons.empty()) expect_formula(obstacles);
  }
}

TEST(CellDecomposition, CellsTileTheFreePlane) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed);
    const CellDecomposition cells = decompose(obstacles, {}, {});
    double sum = 0.0;
    for (const VerticalCell& cell : cells.cells) {
      EXPECT_GE(area(cells, cell), 0.0);
      sum += area(cells, cell);
    }
    EXPECT_NEAR(sum, free_area(obstacles), 1e-9 * sum);
  }
}

TEST(CellDecomposition, PointsAreFoundInTheCellsThatContainThem) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed, 3);
    Dice dice(seed + 1000);
    std::vector<Vec2> points = obstacles.polygons.corners;
    for (int i = 0; i < 300; ++i) {  // on integers and between, some outside the bounds
      points.push_back({dice.roll(150) * 0.5 - 14.0, dice.roll(150) * 0.5 - 14.0});
    }
    const CellDecomposition cells = decompose(obstacles, points, {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      SCOPED_TRACE(::testing::Message() << points[i].x << " " << points[i].y);
      const bool blocked = !obstacles.bounds->contains(points[i]) || inside_any(obstacles, points[i]);
      ASSERT_EQ(cells.places[i].blocked, blocked);
      ASSERT_EQ(cells.places[i].cells.empty(), blocked);
      for (const VertexId c : cells.places[i].cells) EXPECT_TRUE(contains(cells, cells.cells[c], points[i]));
      const auto holds = [&](const VerticalCell& c) { return contains(cells, c, points[i]); };
      if (!blocked && std::count_if(cells.cells.begin(), cells.cells.end(), holds) == 1) {
        EXPECT_EQ(cells.places[i].cells.size(), 1U);
      }
    }
  }
}

TEST(CellDecomposition, DoorsLieBetweenTheirCellsAndBlockNothing) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed);
    const CellDecomposition cells = decompose(obstacles, {}, {});
    for (std::uint32_t d = 0; d < cells.doors.size(); ++d) {
      const Door& door = cells.doors[d];
      const Segment line = cells.door_line(d);
      EXPECT_FALSE(door.shut);
      EXPECT_LT(line.a.y, line.b.y);
      EXPECT_EQ(cells.cells[door.left].right, door.corner);
      EXPECT_EQ(cells.cells[door.right].left, door.corner);
      const Vec2 middle = 0.5 * (line.a + line.b);
      EXPECT_FALSE(inside_any(obstacles, middle));
      EXPECT_TRUE(contains(cells, cells.cells[door.left], middle));
      EXPECT_TRUE(contains(cells, cells.cells[door.right], middle));
    }
  }
}

TEST(CellDecomposition, JoinsTheSquaresOfAGridExactlyWhereAFloodDoes) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const PolygonsInCells world(seed, 3 + static_cast<int>(seed % 7), seed % 2 == 0);
    std::vector<Vec2> centers;
    for (int y = 0; y < world.side(); ++y) {
      for (int x = 0; x < world.side(); ++x) centers.push_back({x + 0.5, y + 0.5});
    }
    const CellDecomposition cells = decompose(world.obstacles(), centers, {});
    std::vector<Edge> open;
    for (const Door& door : cells.doors) {
      if (!door.shut) open.push_back({door.left, door.right});
    }
    const Components parts = bench::plain_components(assemble_graph(cells.cells.size(), open, {}));
    const std::vector<int> regions = world.regions();
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const bool full = world.is_full(static_cast<int>(i) % world.side(), static_cast<int>(i) / world.side());
      ASSERT_EQ(cells.places[i].blocked, full);
      for (std::size_t j = 0; j < i && !full; ++j) {
        if (cells.places[j].blocked) continue;
        ASSERT_EQ(parts.connected(cells.places[i].cells.front(), cells.places[j].cells.front()),
                  regions[i] == regions[j])
            << i << " " << j;
      }
    }
  }
}

TEST(CellDecomposition, RefusesWhatCrossesOrOverlapsAndNamesIt) {
  struct Case {
    std::vector<std::vector<Vec2>> polygons;
    std::vector<Segment> walls;
    std::optional<Box> bounds;
    std::string text;
  };
  const std::vector<Vec2> shifted{{0.5, 0.5}, {2, 0.5}, {2, 2}, {0.5, 2}};
  const std::vector<Vec2> within{{0.2, 0.2}, {0.8, 0.2}, {0.5, 0.8}};
  const std::vector<Vec2> far{{10, 10}, {11, 10}, {11, 11}};
  const Case cases[] = {
      {{far, unit_square, shifted}, {}, {}, "polygon"},
      {{far, unit_square, within}, {}, {}, "polygon 2: overlaps polygon 1"},
      {{unit_square, unit_square}, {}, {}, "overlaps polygon"},
      {{unit_square, {{0, 0}, {1, 0}, {0.5, 0.5}}}, {}, {}, "overlaps polygon"},
      {{unit_square}, {{{0.5, 0.5}, {3, 0.5}}}, {}, "crosses"},
      {{}, {{{0, 0}, {2, 2}}, {{0, 2}, {2, 0}}}, {}, "wall 0: crosses wall 1"},
      {{unit_square}, {}, Box{{-1, -1}, {0.5, 2}}, "polygon 0: reaches out of the bounds"},
      {{}, {{{0, 0}, {3, 0}}}, Box{{-1, -1}, {2, 2}}, "wall 0: reaches out of the bounds"},
      {{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}, {}, {}, "polygon 0: crosses itself"},
      {{{{0, 0}, {0, 1}, {1, 1}, {1, 0}}}, {}, {}, "polygon 0: crosses itself"},  // clockwise: its outside is blocked
  };
  for (const Case& c : cases) {
    PlaneObstacles obstacles = polygons(c.polygons, c.bounds);
    obstacles.walls = c.walls;
    const std::string said = test::refusal<ObstacleClash>([&] { decompose(obstacles, {}, {}); });
    EXPECT_NE(said.find(c.text), std::string::npos) << c.text << ' ' << said;
  }
}

TEST(CellDecomposition, LeavesOutWhatStandsOutsideTheBounds) {
  const PlaneObstacles inside = polygons({unit_square}, Box{{-1, -1}, {3, 3}});
  PlaneObstacles more = inside;
  more.polygons.add(std::vector<Vec2>{{4, 0}, {5, 0}, {5, 1}});
  more.walls = {{{3, 0}, {9, 9}}, {{0.5, 2}, {0.5, 2}}};  // touches from outside; has no length
  EXPECT_EQ(decompose(more, {}, {}).cells.size(), decompose(inside, {}, {}).cells.size());
}

TEST(CellDecomposition, StopsAtTheDeadline) {
  const PlaneObstacles obstacles = disjoint_polygons(1);
  const Deadline over(0.0);
  EXPECT_THROW(decompose(obstacles, {}, {.deadline = &over}), Stopped);
}

// In general position with bounds around: cells are corners + polygons + 1, doors corners + 2 polygons.
TEST(CellDecomposition, GivesKnownWorldsTheirNumbers) {
  struct Case {
    const char* file;
    std::size_t cells, doors;
  };
  for (const Case& c :
       {Case{"tests/data/sparse.scene", 13 + 3 + 1, 13 + 6}, Case{"tests/data/dense.scene", 43 + 9 + 1, 43 + 18},
        Case{"examples/worlds/poly-easy.scene", 75, 84}}) {
    const CellDecomposition cells = decompose(obstacles_of(read_world(test::source_dir() + "/" + c.file, {})), {}, {});
    EXPECT_EQ(cells.cells.size(), c.cells) << c.file;
    EXPECT_EQ(cells.doors.size(), c.doors) << c.file;
  }
}

}  // namespace
}  // namespace warren
