// SPDX-License-Identifier: BSD-3-Clause
// Clearance as tiles, against distances that a plain loop over all walls and cells computes.
#include "apps/serve/tiles/world_tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/plane/geometry.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/text/input_file_io.hpp"
#include "tests/apps/serve/tiles/read_inks.hpp"
#include "tests/apps/serve/town.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren::serve {
namespace {

double to_sides(const Scene& scene, Vec2 p) {
  double least = 1e300;
  for (const Segment& s : bounds_walls(scene)) least = std::min(least, distance(p, s));
  for (std::size_t i = 0; i < scene.walls.size(); ++i) least = std::min(least, distance(p, scene.walls.segment(i)));
  for (const ScenePolygon& polygon : scene.polygons) {
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      const Segment side{polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()]};
      least = std::min(least, distance(p, side));
    }
  }
  return least;
}

double to_cells(const OccupancyMap& map, std::int64_t col, std::int64_t row) {
  double least = 1e300;
  for (std::int64_t y = -1; y <= map.height(); ++y) {
    for (std::int64_t x = -1; x <= map.width(); ++x) {
      const bool is_inside = x >= 0 && y >= 0 && x < map.width() && y < map.height();
      if (is_inside && !map.blocked.test(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))) continue;
      const auto gap = [](std::int64_t d) { return std::max(0.0, std::abs(static_cast<double>(d)) - 0.5); };
      least = std::min(least, std::hypot(gap(x - col), gap(y - row)));
    }
  }
  return least * map.cell;
}

/// Of a tile's pixels; the ink's number, 0 for none.
std::vector<unsigned> inks_of(const ClearanceLayer& layer, const TilePlace& place) {
  std::vector<unsigned> inks;
  for (const test::InkPixel& pixel : test::read_inks(layer.draw(place, {}))) {
    unsigned found = 0;
    const auto is_it = [&](Rgb ink) { return pixel[0] == ink.red && pixel[1] == ink.green && pixel[2] == ink.blue; };
    for (unsigned i = 0; i < step_inks.size(); ++i) found = is_it(step_inks[i]) ? i + 1 : found;
    if (is_it(too_near_ink)) found = step_inks.size() + 1;
    inks.push_back(pixel[3] == 0 ? 0 : found);
  }
  return inks;
}

Vec2 middle_of(const TileGrid& grid, const TilePlace& place, std::size_t i) {
  const Box box = grid.box_of(place);
  const double pixel = grid.pixel(place.zoom);
  const auto x = static_cast<double>(i % TileGrid::pixels);
  const auto y = static_cast<double>(i / TileGrid::pixels);
  return {box.min.x + (x + 0.5) * pixel, box.max.y - (y + 0.5) * pixel};
}

TEST(Steps, AreRoundAndHoldTheUsualValuesBeforeTheLast) {
  EXPECT_EQ(Steps::up_to(7.0, 7.5).each, 1.0);
  EXPECT_EQ(Steps::up_to(7.0, 7.5).count, 8U);
  EXPECT_EQ(Steps::up_to(7.1, 100.0).each, 2.0);
  EXPECT_EQ(Steps::up_to(0.48, 0.5).each, 0.1);
  EXPECT_EQ(Steps::up_to(0.48, 0.49).count, 5U);
  EXPECT_EQ(Steps::up_to(16.0, 16.0).each, 2.5);
  EXPECT_EQ(Steps::up_to(0.0, 0.0).count, 1U);
  const Steps steps{.each = 2.0, .count = 3};
  EXPECT_EQ(steps.of(0.0), 0U);
  EXPECT_EQ(steps.of(1.99), 0U);
  EXPECT_EQ(steps.of(2.0), 1U);
  EXPECT_EQ(steps.of(1e9), 2U);
}

TEST(ClearanceLayer, PixelsOfShapesHaveTheStepOfTheirDistanceAndInsidesNone) {
  const Scene scene = scene_of(town);
  const auto tiles = tiles_of(scene, {});
  const ClearanceLayer layer(*tiles, *scene.bounds, 0.0, {});
  const Steps steps = layer.steps();
  EXPECT_GE(steps.count, 3U);
  for (const TilePlace place : {TilePlace{0, 0, 0}, TilePlace{2, 1, 1}, TilePlace{3, 4, 4}}) {
    const std::vector<unsigned> inks = inks_of(layer, place);
    const double slack = 6.0 * tiles->grid().pixel(place.zoom);  // places 4 pixels apart, and their diagonal
    std::size_t seen = 0;
    for (std::size_t i = 0; i < inks.size(); i += 37) {
      const Vec2 p = middle_of(tiles->grid(), place, i);
      const double d = to_sides(scene, p);
      const bool is_solid = p.x > 60 && p.x < 90 && p.y > 10 && p.y < 50;
      const bool is_room = scene.bounds->contains(p) && !is_solid;
      if (d > slack) {
        EXPECT_EQ(inks[i] != 0, is_room) << p.x << ", " << p.y;
      }
      if (!is_room || inks[i] == 0) continue;
      EXPECT_GE(inks[i], steps.of(std::max(0.0, d - slack)) + 1);
      EXPECT_LE(inks[i], steps.of(d + slack) + 1);
      ++seen;
    }
    EXPECT_GT(seen, 500U);
  }
}

TEST(ClearanceLayer, WhereADiscDoesNotFitHasAnInkOfItsOwn) {
  const Scene scene = scene_of("bounds 0 0 100 100\nwall 50 -5 50 105\n");
  const auto tiles = tiles_of(scene, {});
  const ClearanceLayer layer(*tiles, *scene.bounds, 5.0, {});
  const std::vector<unsigned> inks = inks_of(layer, {0, 0, 0});
  const unsigned too_near = step_inks.size() + 1;
  for (std::size_t i = 0; i < inks.size(); i += 11) {
    const Vec2 p = middle_of(tiles->grid(), {0, 0, 0}, i);
    const double d = to_sides(scene, p);
    if (!scene.bounds->contains(p)) {
      ASSERT_EQ(inks[i], 0U) << p.x << ", " << p.y;
    }
    if (scene.bounds->contains(p) && std::abs(d - 5.0) > 0.5) {
      EXPECT_EQ(inks[i] == too_near, d < 5.0) << p.x << ", " << p.y;
    }
  }
}

TEST(ClearanceLayer, PixelsOfMazesHaveTheStepOfTheirDistance) {
  for (const std::string source : {"maze:20x30,seed=3", "maze:12x12,seed=4,loops=0.3"}) {
    SCOPED_TRACE(source);
    const Scene scene = read_world(source, {});
    const auto tiles = tiles_of(scene, {});
    const ClearanceLayer layer(*tiles, obstacle_box(scene, {}), 0.0, {});
    unsigned zoom = 0;
    while (tiles->grid().pixel(zoom) > 1.0 / 16.0) ++zoom;
    const TilePlace place{zoom, 0, 0};
    const std::vector<unsigned> inks = inks_of(layer, place);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < inks.size(); i += 29) {
      const Vec2 p = middle_of(tiles->grid(), place, i);
      const bool is_inside = p.x > 0.5 && p.y > 0.5 && p.x < scene.maze->cols + 0.5 && p.y < scene.maze->rows + 0.5;
      ASSERT_EQ(inks[i] != 0, is_inside) << p.x << ", " << p.y;
      if (!is_inside) continue;
      const double d = to_sides(scene, p);
      EXPECT_EQ(inks[i], layer.steps().of(d) + 1) << p.x << ", " << p.y << ": " << d;
      ++seen;
    }
    EXPECT_GT(seen, 1000U);
  }
  const Scene large = read_world("maze:100x100,seed=3", {});
  const auto tiles = tiles_of(large, {});
  const ClearanceLayer layer(*tiles, obstacle_box(large, {}), 0.0, {});
  for (const unsigned ink : inks_of(layer, {0, 0, 0})) ASSERT_EQ(ink, 0U) << "cells have less than 8 pixels";
}

TEST(ClearanceLayer, WideHallsOfAMazeAreAsFarAsTheirWalls) {
  constexpr LatticeSize size{12, 12};
  PassageWords words = LatticePassages::closed(size, {});
  for (std::size_t row = 0; row < 12; ++row) {
    words.right[row] = (1U << 11U) - 1U;
    words.up[row] = row < 11 ? (1U << 12U) - 1U : 0;
  }
  const auto tiles = maze_tiles(LatticePassages(size, std::move(words)), MazeOutline::of_course(size), {});
  const auto distances = tiles->distances({});
  EXPECT_NEAR(distances.at({6.5, 3.0}), 2.5, 1e-12);
  EXPECT_NEAR(distances.at({6.5, 3.9}), 3.4, 1e-12);
  EXPECT_EQ(distances.at({6.5, 6.5}), 4.0) << "no farther is told";
  EXPECT_TRUE(std::isnan(distances.at({12.6, 3.0})));
}

TEST(ClearanceLayer, PixelsOfMapsHaveTheStepOfTheirCell) {
  std::string text = "type octile\nheight 24\nwidth 32\nmap\n";
  std::mt19937 random(7);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) text += random() % 17 == 0 ? '@' : '.';
    text += '\n';
  }
  const TemporaryDirectory folder;
  folder.write("a.map", text);
  const Scene scene = read_world(folder.file("a.map"), {});
  ASSERT_TRUE(scene.map);
  const auto tiles = tiles_of(scene, {});
  const ClearanceLayer layer(*tiles, obstacle_box(scene, {}), 0.0, {});
  const std::vector<unsigned> inks = inks_of(layer, {0, 0, 0});
  std::size_t seen = 0;
  for (std::size_t i = 0; i < inks.size(); i += 101) {
    const auto cell = cell_at(*scene.map, middle_of(tiles->grid(), {0, 0, 0}, i));
    const bool is_free = cell && !scene.map->blocked.test(cell->x, cell->y);
    ASSERT_EQ(inks[i] != 0, is_free);
    if (!is_free) continue;
    EXPECT_EQ(inks[i], layer.steps().of(to_cells(*scene.map, cell->x, cell->y)) + 1);
    ++seen;
  }
  EXPECT_GT(seen, 500U);
}

}  // namespace
}  // namespace warren::serve
