// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/grid_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr OptionSpec grid_specs[] = {
    {"--cell", "C",
     "grid in a scene: distance of its positions (default: the file's grid line, else a 400th of the longer side)"},
    {"--angles", "N", "grid: headings of a body that turns (default: the file's grid line, else 72)"},
    {"--face-motion", "", "grid of a body that turns: it moves only where it faces"},
    {"--step-cost", "C", "grid in a scene or of a body that turns: what a step to the side costs (default: 1)"},
    {"--turn-cost", "C", "grid of a body that turns: what a turn to the next heading costs (default: 1)"},
    {"--diagonal", "NAME", "grid: what a diagonal step costs (default: sqrt2)", "sqrt2 unit none"},
    {"--layers", "NAME",
     "grid in a scene: exact footprints, or report 004's discs, rounded up, among walls two cells thick "
     "(default: exact)",
     "exact report004"},
};

constexpr std::array<std::string_view, 3> diagonal_words{"sqrt2", "unit", "none"};
constexpr std::array<std::string_view, 4> method_words{"astar", "dijkstra", "bfs", "jump-points"};

/// The world must have room for a cell each way; a world without extent has none for any.
void refuse_wide_cell(std::string_view text, double cell, const Scene& scene) {
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
  constexpr double rounding = 1e-9;
  const double side = std::min(box.width(), box.height());
  if (box.empty() || side == 0.0 || side / cell + rounding >= 1.0) return;
  throw UsageError(
      fmt::format("--cell: {} is too large: the world has {:.6g} x {:.6g}", text, box.width(), box.height()));
}

}  // namespace

std::span<const OptionSpec> grid_option_specs() { return grid_specs; }

double cell_value(std::string_view text, const Scene& scene) {
  const double cell = positive_value("--cell", text);
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
  if (box.empty()) return cell;
  const double width = std::max(1.0, std::ceil(box.width() / cell));
  const double height = std::max(1.0, std::ceil(box.height() / cell));
  constexpr double too_many = 4294967296.0;
  if (width * height < too_many) return cell;
  throw UsageError(
      fmt::format("--cell: {} is too small: the world has {:.6g} x {:.6g} such cells, and 2^32 - 1 are the most", text,
                  width, height));
}

GridSpec grid_spec(const Arguments& arguments, const Scene& scene) {
  constexpr std::uint32_t usual_angles = 72;
  constexpr std::uint64_t most_angles = 1'000'000;
  constexpr double cells_a_side = 400.0;
  GridSpec grid = scene.grid.value_or(GridSpec{.cell = scene.map ? scene.map->cell : 0.0, .angles = usual_angles});
  if (const auto text = arguments.value("--cell")) {
    grid.cell = cell_value(*text, scene);
    refuse_wide_cell(*text, grid.cell, scene);
  }
  if (const auto text = arguments.value("--angles")) {
    grid.angles = static_cast<std::uint32_t>(count_value("--angles", *text, 1, most_angles));
  }
  if (grid.cell == 0.0) {
    const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
    grid.cell = box.empty() ? 0.0 : std::max(box.width(), box.height()) / cells_a_side;
    if (!(grid.cell > 0.0)) throw UsageError("--cell: is missing, and the world has no extent to divide");
  }
  return grid;
}

Diagonal diagonal_option(const Arguments& arguments) {
  const auto text = arguments.value("--diagonal");
  return text ? static_cast<Diagonal>(choice_value("--diagonal", *text, diagonal_words)) : Diagonal::sqrt2;
}

GridMethod method_option(const Arguments& arguments, GridMethod usual) {
  const auto text = arguments.value("--search");
  if (!text) return usual;
  if (*text == "dfs") throw UsageError("--search: grid takes astar, dijkstra and bfs; the planner prm takes dfs");
  return static_cast<GridMethod>(choice_value("--search", *text, method_words));
}

std::string_view name_of(Diagonal diagonal) { return diagonal_words[static_cast<std::size_t>(diagonal)]; }
std::string_view name_of(GridMethod method) { return method_words[static_cast<std::size_t>(method)]; }

}  // namespace warren
