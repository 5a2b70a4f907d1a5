// SPDX-License-Identifier: BSD-3-Clause
// warren bench-scen: a Moving AI scenario file, checked by studies/contests/scenario_check. Exit code 0 only if all
// lengths agree with the published ones.
#include <fmt/format.h>

#include <optional>

#include "core/base/error.hpp"
#include "scenes/formats/moving_ai_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "studies/contests/scenario_check.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec bench_scen_specs[] = {
    {"--map", "FILE", "the map, where the scenario file's own name for it leads nowhere"},
    {"--json", "FILE", "write the figures as JSON; - is standard output"},
};

std::string folder_prefix(const std::string& file) { return file.substr(0, file.rfind('/') + 1); }

/// The map beside the scenario file, by its whole name or its last part; as it stands from here; or without ".scen".
OccupancyMap read_its_map(const Arguments& arguments, const std::string& map, const Execution& execution) {
  const std::string& scen = arguments.operand(0);
  const std::string last = map.substr(map.rfind('/') + 1);
  std::vector<std::string> places{folder_prefix(scen) + map, folder_prefix(scen) + last, map};
  if (scen.ends_with(".scen")) places.push_back(scen.substr(0, scen.size() - 5));
  for (const std::string& place : places) {
    std::optional<InputFile> file;
    try {
      file.emplace(place, execution);
    } catch (const ReadError&) {
      continue;
    }
    check_not_written(arguments, place);
    return read_moving_ai_map(*file, execution);
  }
  throw ReadError(scen, fmt::format("its map {} is neither beside it nor here; --map says where it is", map));
}

int bench_scen(const Arguments& arguments) {
  const auto json = output_file(arguments, "--json");
  static constexpr ExpectedStage searches[] = {{"scenarios", 1.0}};  // little comes before and after
  Run run(arguments, RunScope::whole_command, searches);
  const std::string& file = arguments.operand(0);
  const std::vector<Scenario> scenarios = read_scenarios(InputFile(file, run.execution()), run.execution());
  for (const Scenario& s : scenarios) {
    if (s.map != scenarios.front().map) {
      throw InputError(fmt::format("{}:{}", file, s.line), "expected one map in all lines", s.map);
    }
  }
  const auto given = arguments.value("--map");
  const OccupancyMap map = given ? read_moving_ai_map(InputFile(*given, run.execution()), run.execution())
                                 : read_its_map(arguments, scenarios.front().map, run.execution());
  const studies::ScenarioCheck check = studies::check_scenarios(map, scenarios, file, run.execution());
  run.end();
  if (json) write_file(*json, studies::scenario_json(check), run.execution());
  if (!run.quiet() && json != "-") print_text(studies::scenario_summary(check, run.palette()));
  return check.differing() == 0 ? exit_code::success : exit_code::no_path;
}

}  // namespace

Command bench_scen_command() {
  Command command{"bench-scen", "FILE.scen", "check a Moving AI scenario file against its optima", {}, bench_scen};
  add_options(command.options, bench_scen_specs);
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren::tools
