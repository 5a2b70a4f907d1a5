// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/kept_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/mazes/cell_bits.hpp"
#include "verify/streamed/looked_up_walls.hpp"

namespace warren {
namespace {

Segment right_of(std::ptrdiff_t col, std::ptrdiff_t row) {
  const Vec2 corner{static_cast<double>(col) + 1.5, static_cast<double>(row) + 1.5};
  return {{corner.x, corner.y - 1}, corner};
}
Segment above(std::ptrdiff_t col, std::ptrdiff_t row) {
  const Vec2 corner{static_cast<double>(col) + 1.5, static_cast<double>(row) + 1.5};
  return {{corner.x - 1, corner.y}, corner};
}

}  // namespace

bool is_nothing_but_maze(const Scene& scene) {
  return scene.maze && !scene.bounds && scene.polygons.empty() && !scene.map && !has_solids(scene);
}

bool walls_are_passages(const RoadmapFile& file, const Scene& outline) {
  return is_nothing_but_maze(outline) && file.find("maze.walls") == nullptr && file.find("world.walls") == nullptr;
}

std::unique_ptr<KeptCells> cells_of_file(const RoadmapFile& file, MazeHint maze, const std::string& hash,
                                         const Execution& execution) {
  return cells_of_words(file.name(), maze, file.section<std::uint64_t>("passages.right", execution),
                        file.section<std::uint64_t>("passages.up", execution), hash, execution);
}

std::unique_ptr<KeptCells> cells_of_words(const std::string& where, MazeHint maze, std::span<const std::uint64_t> right,
                                          std::span<const std::uint64_t> up, const std::string& hash,
                                          const Execution& execution) {
  auto walls = std::make_unique<JudgedPassages>(where, maze.rows, maze.cols, right, up);
  const HashedCells found = hash_of_cells(*walls, execution);
  if (found.hash == hash) return std::make_unique<KeptCells>(std::move(walls), found.walls);
  throw InputError(where, fmt::format("the world inside is not its own, {}", hash), found.hash);
}

std::unique_ptr<KeptCells> cells_of_scene(const Scene& scene, const Execution& execution) {
  if (!is_nothing_but_maze(scene)) return nullptr;
  try {
    auto walls = std::make_unique<JudgedGridLines>(scene.walls, scene.maze->rows, scene.maze->cols, execution);
    return std::make_unique<KeptCells>(std::move(walls), scene.walls.size());
  } catch (const InputError&) {  // a wall off the grid, say
    return nullptr;
  }
}

KeptCells::KeptCells(std::unique_ptr<const LookedUpWalls> cells, std::size_t count)
    : walls(std::move(cells)), wall_count(count) {
  const std::ptrdiff_t cols = walls->cols();
  const std::ptrdiff_t rows = walls->rows();
  for (const std::ptrdiff_t col : {std::ptrdiff_t{-1}, cols - 1}) {
    std::ptrdiff_t row = 0;
    while (row + 1 < rows && (walls->walls_at(col, row) & CellTile::right_wall) == 0) ++row;
    rim_.push_back(right_of(col, row));
  }
  for (const std::ptrdiff_t row : {std::ptrdiff_t{-1}, rows - 1}) {
    std::ptrdiff_t col = 0;
    while (col + 1 < cols && (walls->walls_at(col, row) & CellTile::upper_wall) == 0) ++col;
    rim_.push_back(above(col, row));
  }
}

Scene KeptCells::walls_in(const Box& box) const {
  const auto cell = [](double x, std::uint32_t count) {
    return static_cast<std::ptrdiff_t>(std::clamp(std::floor(x - 0.5), 0.0, count - 1.0));
  };
  std::vector<Segment> found = rim_;
  for (std::ptrdiff_t row = cell(box.min.y, walls->rows()) - 1; row <= cell(box.max.y, walls->rows()); ++row) {
    for (std::ptrdiff_t col = cell(box.min.x, walls->cols()) - 1; col <= cell(box.max.x, walls->cols()); ++col) {
      const unsigned stand = walls->walls_at(col, row);
      if (row >= 0 && (stand & CellTile::right_wall) != 0) found.push_back(right_of(col, row));
      if (col >= 0 && (stand & CellTile::upper_wall) != 0) found.push_back(above(col, row));
    }
  }
  Scene scene;
  scene.walls = WallSet::narrowest(found);
  return scene;
}

}  // namespace warren
