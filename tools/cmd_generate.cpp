// SPDX-License-Identifier: BSD-3-Clause
// warren generate maze: writes a maze of any size, the same for the same seed on every machine.
#include <fmt/format.h>

#include <limits>

#include "core/error.hpp"
#include "tools/command.hpp"
#include "tools/exit_code.hpp"
#include "tools/human_units.hpp"
#include "tools/option_values.hpp"
#include "tools/run_options.hpp"
#include "tools/terminal.hpp"
#include "tools/world_files.hpp"
#include "worlds/maze_generator.hpp"
#include "worlds/world_io.hpp"

namespace warren {
namespace {

constexpr OptionSpec specs[] = {
    {"--output", "FILE", "where to: .walls .scene .npy .svg .png .html by ending; - is standard output", {}, "-o"},
    {"--seed", "N", "which maze (default: 1)"},
    {"--algorithm", "NAME", "how it is made (default: backtracker)", "backtracker kruskal prim wilson course"},
    {"--loops", "F", "fraction of the remaining walls taken out, 0 to 1 (default: 0)"},
    {"--unit-walls", "", "walls one cell long instead of walls as long as they go"},
};

MazeOptions maze_options(const Arguments& arguments) {
  if (arguments.operand(0) != "maze") {
    throw UsageError("'" + arguments.operand(0) + "' is nothing that can be generated; did you mean maze?");
  }
  MazeOptions options = parse_maze_source("maze:" + arguments.operand(1));
  if (arguments.operand(1).find(',') != std::string::npos) {
    throw UsageError("expected ROWSxCOLS (found: '" + arguments.operand(1) +
                     "'); seed, algorithm and loops are options");
  }
  if (const auto seed = arguments.value("--seed")) {
    options.seed = count_value("--seed", *seed, 0, std::numeric_limits<std::uint64_t>::max());
  }
  if (const auto loops = arguments.value("--loops")) options.loops = number_value("--loops", *loops, 0.0, 1.0);
  if (const auto name = arguments.value("--algorithm")) {
    constexpr std::string_view words[] = {"backtracker", "kruskal", "prim", "wilson", "course"};
    options.algorithm = static_cast<MazeAlgorithm>(choice_value("--algorithm", *name, words));
  }
  return options;
}

int generate(const Arguments& arguments) {
  const MazeOptions options = maze_options(arguments);
  const auto file = arguments.value("--output");
  if (!file) throw UsageError("-o FILE is missing");
  check_world_file(*file);
  Run run(arguments);
  double seconds = 0.0;
  Scene scene;
  {
    const StageTimer timer(run.execution(), "generate", seconds);
    scene = maze_scene(options, !arguments.has("--unit-walls"), run.execution());
  }
  double write_seconds = 0.0;
  {
    const StageTimer timer(run.execution(), "write", write_seconds);
    write_world(scene, *file, arguments.command_line(), run.execution());
  }
  run.end();
  if (!run.quiet() && *file != "-") {
    print_text(fmt::format("{}: {}, generated in {}, written in {}\n", run.palette().strong(*file),
                           description_of(scene), human_seconds(seconds), human_seconds(write_seconds)));
  }
  return exit_code::success;
}

}  // namespace

Command generate_command() {
  Command command{"generate", "maze ROWSxCOLS", "write a maze of any size", {}, generate};
  add_options(command.options, specs);
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
