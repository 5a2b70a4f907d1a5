// SPDX-License-Identifier: BSD-3-Clause
// warren convert: any world into any format that can hold it.
#include <fmt/format.h>

#include "core/error.hpp"
#include "tools/command.hpp"
#include "tools/exit_code.hpp"
#include "tools/run_options.hpp"
#include "tools/terminal.hpp"
#include "tools/world_files.hpp"

namespace warren {
namespace {

constexpr OptionSpec specs[] = {
    {"--output",
     "FILE",
     "where to: .walls .scene .npy .geojson .wkt .svg .png .html by ending; - is standard output",
     {},
     "-o"},
};

int convert(const Arguments& arguments) {
  const auto file = arguments.value("--output");
  if (!file) throw UsageError("-o FILE is missing");
  check_world_file(*file);
  Run run(arguments);
  StageTimes seconds;
  double write_seconds = 0.0;
  const Scene scene = load_world(arguments.operand(0), run.execution(), seconds);
  {
    const StageTimer timer(run.execution(), "write", write_seconds);
    write_world(scene, *file, arguments.command_line(), run.execution());
  }
  run.end();
  if (!run.quiet() && *file != "-")
    print_text(fmt::format("{}: {}\n", run.palette().strong(*file), description_of(scene)));
  return exit_code::success;
}

}  // namespace

Command convert_command() {
  Command command{"convert", "WORLD", "write a world in another format", {}, convert};
  add_options(command.options, specs);
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
