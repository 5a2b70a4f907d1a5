// SPDX-License-Identifier: BSD-3-Clause
// warren info: what is in this file, a world or a roadmap.
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/answer/world_facts.hpp"
#include "solve/roadmaps/roadmap_file_io.hpp"
#include "solve/roadmaps/world_sections.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/command.hpp"

namespace warren {
namespace {

constexpr OptionSpec info_specs[] = {
    {"--json", "FILE", "write it as JSON; - is standard output"},
    {"--check", "all", "of a roadmap file: hold all of it against its checksums and what it promises", "all"},
};

bool is_roadmap(const std::string& path, const Execution& execution) {
  if (is_maze_source(path) || path == "-") return false;
  return is_roadmap_file(InputFile(path, execution).bytes());
}

/// What the roadmap says of itself; --check: after all of it was looked at.
std::string roadmap_info(const Arguments& arguments, const Execution& execution) {
  const RoadmapFile file(arguments.operand(0), execution);
  std::string meta = roadmap_meta(file, execution);
  if (!arguments.has("--check")) return meta;
  file.check_all(execution);
  if (has_world(file)) {
    read_roadmap(arguments.operand(0), execution);
  } else {
    check_roadmap(file, execution);
  }
  return meta;
}

int info(const Arguments& arguments) {
  const auto json = output_file(arguments, "--json");
  Run run(arguments);
  if (is_roadmap(arguments.operand(0), run.execution())) {
    const std::string meta = roadmap_info(arguments, run.execution());
    run.end();
    if (json) write_file(*json, meta, run.execution());
    if (!run.quiet() && json != "-") print_text(meta);
    return exit_code::success;
  }
  if (arguments.has("--check")) throw UsageError("--check: is for roadmap files; a world is checked as it is read");
  StageTimes seconds;
  const Scene scene = load_world(arguments.operand(0), arguments, run.execution(), seconds);
  const std::vector<Fact> facts = facts_of(scene, run.execution());
  run.end();
  if (json) write_file(*json, facts_json(facts), run.execution());
  if (run.quiet() || json == "-") return exit_code::success;
  for (const Fact& fact : facts)
    print_text(fmt::format("{}{}\n", run.palette().faint(fmt::format("{:<11}", fact.name)), printable(fact.text)));
  return exit_code::success;
}

}  // namespace

Command info_command() {
  Command command{"info", "FILE", "say what is in a world or a roadmap", {}, info};
  add_options(command.options, info_specs);
  add_options(command.options, world_option_specs());
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
