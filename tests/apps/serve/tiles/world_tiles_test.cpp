// SPDX-License-Identifier: BSD-3-Clause
// Tiles against the world itself: where they lie, and what their pixels show.
#include "apps/serve/tiles/world_tiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/serve/tiles/web_tile.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/text/input_file_io.hpp"
#include "tests/apps/serve/tiles/read_tile.hpp"

namespace warren::serve {
namespace {

Scene shapes_of(const std::string& text) { return read_scene(InputFile::of_bytes("test.scene", text), {}); }

/// The pixel in which a point of the world lies.
double darkness_at(const WorldTiles& tiles, unsigned zoom, Vec2 p) {
  const TileGrid& grid = tiles.grid();
  const double side = grid.pixel(zoom) * TileGrid::pixels;
  const TilePlace place{zoom, static_cast<std::uint32_t>((p.x - grid.corner.x) / side),
                        static_cast<std::uint32_t>((grid.corner.y - p.y) / side)};
  const Box box = grid.box_of(place);
  const test::GreyTile tile = test::read_tile(tiles.draw(place, {}));
  return tile.darkness(static_cast<std::size_t>((p.x - box.min.x) / grid.pixel(zoom)),
                       static_cast<std::size_t>((box.max.y - p.y) / grid.pixel(zoom)));
}

TEST(TileGrid, TilesOfAZoomMakeUpTheWorldWithYUp) {
  const TileGrid grid{.corner = {-10, 30}, .span = 64, .levels = 3};
  EXPECT_EQ(grid.box_of({0, 0, 0}).min, (Vec2{-10, -34}));
  EXPECT_EQ(grid.box_of({0, 0, 0}).max, (Vec2{54, 30}));
  EXPECT_EQ(grid.box_of({1, 1, 0}).min, (Vec2{22, -2}));
  EXPECT_EQ(grid.box_of({1, 0, 1}).max, (Vec2{22, -2}));
  EXPECT_DOUBLE_EQ(grid.pixel(2), 64.0 / 512.0 / 4.0);
}

TEST(TileGrid, CellsAndPixelsNeverLieAskew) {
  for (const std::uint32_t n : {1U, 2U, 7U, 41U, 500U, 510U, 511U, 1000U, 10'000U, 65'536U}) {
    SCOPED_TRACE(n);
    CellsOnTiles cells;
    const TileGrid grid = grid_for_cells(n, n / 2 + 1, 1.0, {0.5, n / 2 + 1.5}, cells);
    for (unsigned zoom = 0; zoom < grid.levels; ++zoom) {
      EXPECT_EQ(std::exp2(std::round(std::log2(grid.pixel(zoom)))), grid.pixel(zoom));
    }
    const Box whole = grid.box_of({0, 0, 0});
    EXPECT_LE(whole.min.x, 0.5);
    EXPECT_GE(whole.max.x, n + 0.5);
    EXPECT_GE(whole.max.y, n / 2 + 1.5);
    EXPECT_LE(whole.min.y, 0.5);
    EXPECT_EQ(grid.pixel(grid.levels - 1), 1.0 / 64.0);
  }
}

TEST(ShadePyramid, IsTheMeanOfTheCells) {
  const std::uint32_t width = 13;
  const std::uint32_t height = 7;
  const auto shade = [](std::uint32_t x, std::uint32_t y) {
    return static_cast<std::uint8_t>((37 * x + 91 * y) % 256);
  };
  const ShadePyramid pyramid(width, height, shade, {});
  EXPECT_EQ(pyramid.levels(), 5U);
  for (unsigned level = 1; level < pyramid.levels(); ++level) {
    const std::uint32_t side = 1U << level;
    for (std::uint32_t y = 0; y * side < height; ++y) {
      for (std::uint32_t x = 0; x * side < width; ++x) {
        double sum = 0.0;
        for (std::uint32_t v = y * side; v < std::min(height, (y + 1) * side); ++v) {
          for (std::uint32_t u = x * side; u < std::min(width, (x + 1) * side); ++u) sum += shade(u, v);
        }
        EXPECT_NEAR(pyramid.at(level, x, y), sum / (side * side), 1.5) << level << " " << x << " " << y;
      }
    }
    EXPECT_EQ(pyramid.at(level, -1, 0), 0);
    EXPECT_EQ(pyramid.at(level, 0, 1000), 0);
  }
}

TEST(MazeTiles, ShowEachWallAndNoOther) {
  for (const char* source : {"maze:9x14,seed=3", "maze:40x23,seed=5,loops=0.1", "maze:1x1", "maze:3x300,seed=2"}) {
    SCOPED_TRACE(source);
    const Scene scene = read_world(source, {});
    const auto tiles = tiles_of(scene, {});
    const unsigned zoom = std::max(3U, tiles->grid().levels) - 3;  // 16 pixels a cell, or more
    std::set<std::pair<long, long>> walls;                         // unit pieces, by twice their middles
    const auto twice = [](Vec2 p) { return std::pair(std::lround(2 * p.x), std::lround(2 * p.y)); };
    const auto cut = [&](const Segment& s) {
      const auto parts = static_cast<int>(std::round(distance(s.a, s.b)));
      for (int i = 0; i < parts; ++i) {
        walls.insert(twice(s.a + ((i + 0.5) / parts) * (s.b - s.a)));
      }
    };
    for (std::size_t i = 0; i < scene.walls.size(); ++i) cut(scene.walls.segment(i));
    std::map<std::pair<std::uint32_t, std::uint32_t>, test::GreyTile> drawn;
    const TileGrid& grid = tiles->grid();
    const double side = grid.pixel(zoom) * TileGrid::pixels;
    const auto darkness = [&](Vec2 p) {
      const TilePlace place{zoom, static_cast<std::uint32_t>((p.x - grid.corner.x) / side),
                            static_cast<std::uint32_t>((grid.corner.y - p.y) / side)};
      auto& tile = drawn[{place.x, place.y}];
      if (tile.empty()) tile = test::read_tile(tiles->draw(place, {}));
      const Box box = grid.box_of(place);
      return tile.darkness(static_cast<std::size_t>((p.x - box.min.x) / grid.pixel(zoom)),
                           static_cast<std::size_t>((box.max.y - p.y) / grid.pixel(zoom)));
    };
    for (std::uint32_t row = 0; row <= scene.maze->rows; ++row) {
      for (std::uint32_t col = 0; col <= scene.maze->cols; ++col) {
        const Vec2 right{col + 0.5, row + 1.0};
        const Vec2 upper{col + 1.0, row + 0.5};
        if (row < scene.maze->rows) {
          EXPECT_EQ(darkness(right) > 0.5, walls.count(twice(right)) > 0) << right.x << "," << right.y;
        }
        if (col < scene.maze->cols) {
          EXPECT_EQ(darkness(upper) > 0.5, walls.count(twice(upper)) > 0) << upper.x << "," << upper.y;
        }
        if (row < scene.maze->rows && col < scene.maze->cols) {
          EXPECT_EQ(darkness({col + 1.0, row + 1.0}), 0.0);
        }
      }
    }
  }
}

TEST(MazeTiles, TheOutlineIsTheWorldsOwn) {
  const Scene course = read_world("maze:5x7,seed=3", {});
  const LatticeSize size{5, 7};
  const MazeOutline seen = MazeOutline::of_walls(course.walls, size, {});
  const MazeOutline known = MazeOutline::of_course(size);
  EXPECT_EQ(seen.left, known.left);
  EXPECT_EQ(seen.right, known.right);
  EXPECT_EQ(seen.lower, known.lower);
  EXPECT_EQ(seen.upper, known.upper);
  const std::vector<Segment> sides{{{0.5, 0.5}, {7.5, 0.5}}, {{3.5, 5.5}, {1.5, 5.5}}, {{0.5, 2.5}, {0.5, 5.5}}};
  const MazeOutline others = MazeOutline::of_walls(WallSet::narrowest(sides), size, {});
  EXPECT_EQ(others.lower, std::vector<bool>(7, true));
  EXPECT_EQ(others.upper, (std::vector<bool>{false, true, true, false, false, false, false}));
  EXPECT_EQ(others.left, (std::vector<bool>{false, false, true, true, true}));
  EXPECT_EQ(others.right, std::vector<bool>(5, false));
}

TEST(MazeTiles, FromAfarShowTheShareOfWalls) {
  const Scene scene = read_world("maze:600x600,seed=1", {});
  const auto tiles = tiles_of(scene, {});
  const test::GreyTile whole = test::read_tile(tiles->draw({0, 0, 0}, {}));
  double inside = 0.0;
  for (std::size_t y = 100; y < 200; ++y) {
    for (std::size_t x = 100; x < 200; ++x) inside += whole.darkness(x, y) / 1e4;
  }
  EXPECT_GT(inside, 0.1);
  EXPECT_LT(inside, 0.5);
  EXPECT_EQ(whole.darkness(511, 511), 0.0);  // beyond it
}

TEST(MapTiles, ShowBlockedUnknownAndFreeCellsFromNearAndAfar) {
  Scene scene;
  scene.map.emplace();
  scene.map->blocked = Bitmap(40, 20);
  scene.map->unknown = Bitmap(40, 20);
  scene.map->cell = 0.5;
  scene.map->origin = {-3, 2};
  scene.map->yaw_rad = 0.3;
  for (std::uint32_t y = 0; y < 20; ++y) {
    for (std::uint32_t x = 0; x < 40; ++x) {
      if ((x * 7 + y * 3) % 5 == 0) scene.map->blocked.set(x, y);
      if ((x * 7 + y * 3) % 15 == 0) scene.map->unknown.set(x, y);
    }
  }
  const auto tiles = tiles_of(scene, {});
  for (const unsigned zoom : {0U, 1U, 3U}) {
    for (const Cell cell : {Cell{0, 0}, Cell{5, 0}, Cell{15, 0}, Cell{1, 1}, Cell{39, 19}, Cell{20, 10}}) {
      const double dark = darkness_at(*tiles, zoom, cell_centre(*scene.map, cell));
      const bool blocked = scene.map->blocked.test(cell.x, cell.y);
      const bool unknown = scene.map->unknown.test(cell.x, cell.y);
      SCOPED_TRACE(::testing::Message() << zoom << ": " << cell.x << "," << cell.y);
      EXPECT_GE(dark, !blocked ? 0.0 : unknown ? 0.1 : 0.7);
      EXPECT_LE(dark, !blocked ? 0.0 : unknown ? 0.6 : 1.0);
    }
  }
}

TEST(ShapeTiles, ShowWallsPolygonsAndBoundsAtEveryZoom) {
  const Scene scene = shapes_of("bounds 0 0 100 60\nwall 10 10 50 40\npolygon 60 10 90 10 90 50 60 50\n");
  const auto tiles = tiles_of(scene, {});
  for (const unsigned zoom : {0U, 2U, 6U, 9U}) {
    SCOPED_TRACE(zoom);
    EXPECT_GT(darkness_at(*tiles, zoom, {30, 25}), 0.4);
    EXPECT_GT(darkness_at(*tiles, zoom, {0, 30}), 0.3);
    EXPECT_GT(darkness_at(*tiles, zoom, {75, 30}), 0.05);  // inside
    EXPECT_LT(darkness_at(*tiles, zoom, {75, 30}), 0.3);
    EXPECT_EQ(darkness_at(*tiles, zoom, {20, 45}), 0.0);
  }
}

TEST(WorldTiles, AreTheSameBytesForAnyNumberOfThreads) {
  const Scene scene = read_world("maze:700x700,seed=4", {});
  const auto one = tiles_of(scene, {.threads = 1});
  const auto three = tiles_of(scene, {.threads = 3});
  for (const TilePlace place : {TilePlace{0, 0, 0}, TilePlace{1, 1, 1}, TilePlace{3, 2, 5}}) {
    EXPECT_EQ(one->draw(place, {}), three->draw(place, {}));
  }
}

}  // namespace
}  // namespace warren::serve
