// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/lattice_roadmap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "planners/lengths/lattice_passages.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/mazes/cell_bits.hpp"
#include "solve/kept/maze_bits.hpp"
#include "solve/question/planner_choice.hpp"

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

constexpr std::uint32_t most_passes = 32;

LatticePassages passages_of(const Scene& scene, double reach, const Execution& execution) {
  if (auto passages = passages_of_maze(scene, reach, execution)) return std::move(*passages);
  const std::vector<Segment> bounds = bounds_walls(scene);
  return wall_passages({scene.walls, bounds, scene.bounds, reach, {scene.maze->rows, scene.maze->cols}}, execution);
}

}  // namespace

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

const std::optional<MazeWorld>* WallsNearEnds::index(const Execution& execution) const {
  return indexed_.get_after(most_passes, execution, [&] {
    auto indexed = std::make_unique<std::optional<MazeWorld>>();
    memory_holds([&] { indexed->emplace(world_.whole(execution), reach_, execution); });
    return indexed;
  });
}

/// The walls that motions of a few cells around a place can meet, and those that reach farthest: the box of all walls,
/// which the reference point stays in, is theirs too.
Scene WallsNearEnds::around(const Scene& scene, Vec2 p, const Execution& execution) const {
  constexpr std::size_t polled = std::size_t{1} << 20;
  const Box near = room_of_motions(p);
  std::vector<Segment> walls;
  Box all;
  std::array<Segment, 4> farthest{};
  scene.walls.visit([&](auto held) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (i % polled == 0) execution.check();
      const Segment s = held[i].segment();
      const Box box = box_of(s);
      if (near.meets(box)) walls.push_back(s);
      if (box.min.x < all.min.x) farthest[0] = s;
      if (box.min.y < all.min.y) farthest[1] = s;
      if (box.max.x > all.max.x) farthest[2] = s;
      if (box.max.y > all.max.y) farthest[3] = s;
      all.include(box);
    }
  });
  if (!all.empty()) walls.insert(walls.end(), farthest.begin(), farthest.end());
  Scene local;
  local.bounds = scene.bounds;
  local.walls = WallSet::narrowest(walls);
  return local;
}

std::unique_ptr<RouteIndex> lattice_index(const Scene& scene, const Question& body, const SolveOptions& options,
                                          const Execution& execution) {
  const RobotSpec robot = robot_of(scene, body);
  const bool is_maze = scene.maze && scene.polygons.empty() && !scene.map && !has_solids(scene) && is_round(robot);
  if (!is_maze || options.planner != PlannerKind::prm) return nullptr;
  const double reach = clearance_of(scene, body) + robot.radius;
  const RoadmapOptions roadmap = planner_options(options, scene, WallProblem{}).roadmap;
  const std::uint64_t cells = std::uint64_t{scene.maze->rows} * scene.maze->cols;
  if (cells < fewest_indexed_cells || !tiled_prm_applies(roadmap, reach)) return nullptr;
  try {
    return std::make_unique<RouteIndex>(passages_of(scene, reach, execution), RouteIndexOptions{}, execution);
  } catch (const InputError&) {  // it doesn't pay
    return nullptr;
  }
}

}  // namespace warren
