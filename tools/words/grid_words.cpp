// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about grids and lattices.
#include "tools/words/option_values.hpp"
#include "tools/words/planner_words.hpp"

namespace warren::tools {
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
     "grid in a scene. exact: the body's own outline; report004: discs that cover it, rounded up to cells, among walls "
     "two cells thick (default: exact)",
     "exact report004"},
};

}  // namespace

std::span<const OptionSpec> grid_option_specs() { return grid_specs; }

GridFields grid_words(const Arguments& arguments) {
  constexpr std::uint32_t most_angles = 1'000'000;
  GridFields grid;
  grid.cell = given_value(arguments, "--cell", positive_value);
  grid.angles = given_count(arguments, "--angles", 1, most_angles);
  grid.face_motion = arguments.has("--face-motion");
  grid.step_cost = given_value(arguments, "--step-cost", positive_value);
  grid.turn_cost = given_value(arguments, "--turn-cost", positive_value);
  grid.diagonal = given_choice<Diagonal>(arguments, "--diagonal");
  grid.layers = given_choice<LayerKind>(arguments, "--layers");
  return grid;
}

}  // namespace warren::tools
