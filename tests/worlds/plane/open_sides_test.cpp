// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/maze_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/rng.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

constexpr std::size_t any_number = std::size_t{1} << 30;

/// Is the side open at both of its cells, or at neither, and is there a cell behind it?
void expect_sides_shared(const CellSides& cells) {
  for (std::size_t cell = 0; cell < cells.open.size(); ++cell) {
    for (const std::uint8_t side : {CellSides::right, CellSides::up, CellSides::left, CellSides::down}) {
      if ((cells.open[cell] & side) == 0) continue;
      const std::size_t beyond = cells.beyond(cell, side);
      ASSERT_LT(beyond, cells.open.size());
      ASSERT_NE(cells.open[beyond] & CellSides::opposite(side), 0) << cell << " " << int{side};
      const Segment one = cells.side_of_cell(cell, side);
      const Segment other = cells.side_of_cell(beyond, CellSides::opposite(side));
      ASSERT_EQ(one.a, other.a);
      ASSERT_EQ(one.b, other.b);
    }
  }
}

/// The cells that a motion passes, by the middles of its pieces between the lines of the grid.
std::vector<std::size_t> cells_on_the_way(const CellSides& cells, Vec2 from, Vec2 to) {
  std::vector<double> cuts{0.0, 1.0};
  for (double line = -60.5; line < 60.0; line += 1.0) {
    cuts.push_back((line - from.x) / (to.x - from.x));
    cuts.push_back((line - from.y) / (to.y - from.y));
  }
  std::erase_if(cuts, [](double t) { return !(t >= 0.0 && t <= 1.0); });
  std::sort(cuts.begin(), cuts.end());
  std::vector<std::size_t> passed;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const std::size_t cell = cells.cell_of(from + 0.5 * (cuts[i] + cuts[i + 1]) * (to - from));
    if (passed.empty() || passed.back() != cell) passed.push_back(cell);
  }
  return passed;
}

std::uint8_t side_between(const CellSides& cells, std::size_t from, std::size_t to) {
  for (const std::uint8_t side : {CellSides::right, CellSides::up, CellSides::left, CellSides::down}) {
    if (cells.beyond(from, side) == to) return side;
  }
  return 0;
}

/// Walls along the cells' sides or nearly so, unit and long ones, and some that lie anywhere.
Scene walls_of_any_kind(std::uint64_t seed, double r) {
  std::vector<Segment> walls;
  const auto draw = [&](std::uint64_t i, int axis) { return uniform(seed, i, axis); };
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double line = std::floor(draw(i, 0) * 24.0) - 10.5;
    const double at = std::floor(draw(i, 1) * 24.0) - 10.5;
    const double length = i % 7 == 0 ? 5.0 * draw(i, 2) : 1.0;
    const double shift = i % 3 == 0 ? 2.2 * r * (draw(i, 3) - 0.5) : 0.0;
    const double tilt = i % 5 == 0 ? 1.5 * r * (draw(i, 4) - 0.5) : 0.0;
    const double end = i % 4 == 0 ? r * (draw(i, 5) - 0.5) : 0.0;
    Segment wall{{line + shift, at + end}, {line + shift + tilt, at + length - end}};
    if (i % 11 == 0) wall = {{24.0 * draw(i, 0) - 10.0, 24.0 * draw(i, 1) - 10.0}, {line, at}};
    if (i % 2 == 0) wall = {{wall.a.y, wall.a.x}, {wall.b.y, wall.b.x}};
    walls.push_back(wall);
  }
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  return scene;
}

TEST(OpenSides, NoFreeMotionCrossesAClosedOne) {
  std::size_t crossed = 0;
  std::size_t closed = 0;
  for (const std::uint64_t seed : test::seeds(24, 6, 0)) {
    for (const double r : {0.002, 0.1, 0.3}) {
      SCOPED_TRACE(std::to_string(seed) + ", clearance " + std::to_string(r));
      const MazeWorld world(walls_of_any_kind(seed, r), r, {});
      const CellSides cells = world.cell_sides(any_number, {});
      expect_sides_shared(cells);
      closed += static_cast<std::size_t>(std::count_if(cells.open.begin(), cells.open.end(),
                                                       [](std::uint8_t sides) { return sides != CellSides::all; }));
      MazeWorld::Query query = world.make_query();
      for (std::uint64_t i = 0; i < 4000; ++i) {
        const Vec2 from = world.at_unit({uniform(seed + 99, i, 0), uniform(seed + 99, i, 1)});
        const Vec2 to = from + Vec2{2.0 * uniform(seed + 99, i, 2) - 1.0, 2.0 * uniform(seed + 99, i, 3) - 1.0};
        if (!world.box().contains(to) || !world.is_free_motion(from, to, query)) continue;
        const std::vector<std::size_t> passed = cells_on_the_way(cells, from, to);
        for (std::size_t k = 0; k + 1 < passed.size(); ++k) {
          const std::uint8_t side = side_between(cells, passed[k], passed[k + 1]);
          if (side == 0) continue;  // through a corner
          ++crossed;
          ASSERT_NE(cells.open[passed[k]] & side, 0) << from.x << ", " << from.y << " to " << to.x << ", " << to.y;
        }
      }
    }
  }
  EXPECT_GT(crossed, test::share(10'000));
  EXPECT_GT(closed, test::share(10'000));
}

TEST(OpenSides, AreThoseOfAMazeThatHaveNoWall) {
  for (const bool merged : {false, true}) {
    const Scene scene = maze_scene({17, 23, 4, MazeAlgorithm::kruskal, 0.1}, merged, {});
    const MazeCells walls = cells_of_walls(scene.walls, *scene.maze, {});
    const CellSides cells = MazeWorld(scene, 0.1, {}).cell_sides(any_number, {});
    ASSERT_EQ(cells.cols, 23U);
    ASSERT_EQ(cells.rows, 17U);
    EXPECT_EQ(cells.corner, (Vec2{0.5, 0.5}));
    for (std::uint32_t cell = 0; cell < 17 * 23; ++cell) {
      const std::uint32_t col = cell % 23;
      const std::uint32_t row = cell / 23;
      EXPECT_EQ(cells.cell_of({col + 1.0, row + 1.0}), cell);
      EXPECT_EQ((cells.open[cell] & CellSides::right) != 0, col + 1 < 23 && !walls.wall_right(col, row)) << cell;
      EXPECT_EQ((cells.open[cell] & CellSides::up) != 0, row + 1 < 17 && !walls.wall_above(col, row)) << cell;
    }
    expect_sides_shared(cells);
  }
}

/// Far beyond a block of cells, by walls that reach beyond many.
TEST(OpenSides, AreThoseOfUnitWallsWhereWallsAreLong) {
  const auto sides = [](bool merged) {
    return MazeWorld(maze_scene({75, 300, 9, MazeAlgorithm::backtracker, 0.02}, merged, {}), 0.1, {})
        .cell_sides(any_number, {});
  };
  const CellSides unit = sides(false);
  const CellSides merged = sides(true);
  EXPECT_TRUE(std::equal(unit.open.begin(), unit.open.end(), merged.open.begin(), merged.open.end()));
  Scene shelves;
  constexpr std::size_t length = 60'000;
  shelves.walls = WallSet::narrowest(std::vector<Segment>{
      {{0.5, 0.5}, {length + 0.5, 0.5}}, {{0.5, 1.5}, {length - 0.5, 1.5}}, {{0.5, 2.5}, {length + 0.5, 2.5}}});
  const CellSides long_ones = MazeWorld(shelves, 0.1, {}).cell_sides(any_number, {});
  ASSERT_EQ(long_ones.rows, 2U);
  for (std::size_t col = 0; col < length; ++col)
    ASSERT_EQ((long_ones.open[col] & CellSides::up) != 0, col + 1 == length) << col;
}

TEST(OpenSides, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = maze_scene({400, 700, 2}, false, {});
  const CellSides one = MazeWorld(scene, 0.1, {}).cell_sides(any_number, Execution{1});
  expect_sides_shared(one);  // between chunks of rows, too
  for (const unsigned threads : {2U, 3U, 8U}) {
    const CellSides more = MazeWorld(scene, 0.1, {}).cell_sides(any_number, Execution{threads});
    EXPECT_TRUE(std::equal(one.open.begin(), one.open.end(), more.open.begin(), more.open.end())) << threads;
  }
}

TEST(OpenSides, AreNotToldWhereACellIsNoCertainPlaceOrThereAreTooMany) {
  const Scene scene = maze_scene({20, 30, 1}, false, {});
  EXPECT_EQ(MazeWorld(scene, 0.1, {}).cell_sides(600, {}).open.size(), 600U);
  EXPECT_TRUE(MazeWorld(scene, 0.1, {}).cell_sides(599, {}).open.empty());
  EXPECT_TRUE(MazeWorld(scene, 0.0, {}).cell_sides(600, {}).open.empty());
  Scene far;
  far.walls = WallSet::narrowest(std::vector<Segment>{{{0.0, 0.0}, {1.0, 0.0}}, {{2e9, 0.0}, {2e9, 1.0}}});
  EXPECT_TRUE(MazeWorld(far, 0.1, {}).cell_sides(std::size_t{1} << 50, {}).open.empty());
}

}  // namespace
}  // namespace warren
