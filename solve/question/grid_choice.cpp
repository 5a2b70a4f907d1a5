// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/grid_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace warren {
namespace {

/// The world must have room for a cell each way; a world without extent has none for any.
void refuse_wide_cell(double cell, const Scene& scene) {
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
  constexpr double rounding = 1e-9;
  const double side = std::min(box.width(), box.height());
  if (box.empty() || side == 0.0 || side / cell + rounding >= 1.0) return;
  throw UsageError(
      fmt::format("@cell: {} is too large: the world has {:.6g} x {:.6g}", cell, box.width(), box.height()));
}

}  // namespace

void check_cell(double cell, const Scene& scene) {
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
  if (box.empty()) return;
  const double width = std::max(1.0, std::ceil(box.width() / cell));
  const double height = std::max(1.0, std::ceil(box.height() / cell));
  constexpr double too_many = 4294967296.0;
  if (width * height < too_many) return;
  throw UsageError(
      fmt::format("@cell: {} is too small: the world has {:.6g} x {:.6g} such cells, and 2^32 - 1 are the most", cell,
                  width, height));
}

GridSpec grid_spec(const GridFields& options, const Scene& scene) {
  constexpr std::uint32_t usual_angles = 72;
  constexpr double cells_a_side = 400.0;
  GridSpec grid = scene.grid.value_or(GridSpec{.cell = scene.map ? scene.map->cell : 0.0, .angles = usual_angles});
  if (options.cell) {
    check_cell(*options.cell, scene);
    refuse_wide_cell(*options.cell, scene);
  }
  grid.cell = options.cell.value_or(grid.cell);
  grid.angles = options.angles.value_or(grid.angles);
  if (grid.cell == 0.0) {
    const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
    grid.cell = box.empty() ? 0.0 : std::max(box.width(), box.height()) / cells_a_side;
    if (!(grid.cell > 0.0)) throw UsageError("@cell: is missing, and the world has no extent to divide");
  }
  return grid;
}

GridMethod grid_method(const SolveOptions& options, GridMethod usual) {
  if (!options.search) return usual;
  switch (*options.search) {
    case SearchMethod::astar:
      return GridMethod::astar;
    case SearchMethod::dijkstra:
      return GridMethod::dijkstra;
    case SearchMethod::bfs:
      return GridMethod::bfs;
    case SearchMethod::jump_points:
      return GridMethod::jump_points;
    case SearchMethod::dfs:
      break;
  }
  throw UsageError("@search: grid takes astar, dijkstra and bfs; the planner prm takes dfs");
}

}  // namespace warren
