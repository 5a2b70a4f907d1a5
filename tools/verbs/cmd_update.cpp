// SPDX-License-Identifier: BSD-3-Clause
// warren update: the roadmap of a world that has changed, from the one of the world as it was.
#include <fmt/format.h>

#include <optional>

#include "core/base/error.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec update_specs[] = {
    {"--output", "FILE", "where the new roadmap goes", {}, "-o"},
    {"--report", "FILE", "write as JSON what was checked again; - is standard output"},
    roadmap_world_option,
};

std::string report_of(const UpdateAccount& a) {
  return fmt::format(
      "{{\"schema\": \"warren.update/1\",\n \"mode\": \"{}\",\n \"edges\": {},\n \"edges_checked\": {},\n "
      "\"states_added\": {},\n \"states_dropped\": {}}}\n",
      a.built_anew ? "built" : "changed", a.edges, a.edges_checked, a.states_added, a.states_dropped);
}

int update_roadmap(const Arguments& arguments) {
  const auto file = output_file(arguments, "--output");
  if (!file) throw UsageError("-o FILE is missing");
  const auto report = output_file(arguments, "--report");
  Run run(arguments);
  StageTimes seconds;
  const Roadmap old = load_roadmap(arguments, run.execution(), seconds);
  Scene now = load_world(arguments.operand(1), arguments, run.execution(), seconds);
  UpdateAccount account;
  const Roadmap next = update(old, std::move(now), run.execution(), &account);
  std::optional<OutputFile> told;  // whole before the roadmap takes its place
  if (report) {
    told.emplace(*report, run.execution());
    told->write(report_of(account));
    told->complete();
  }
  FirstOfTwoFiles first(*file);
  write_roadmap(next, *file, run.execution());
  if (told) told->commit();
  first.keep();
  run.end();
  run.conclude(file == "-" || report == "-", {}, [&] {
    return fmt::format("{}: {}, {} edges, {} checked; {} states new, {} gone\n", run.palette().strong(*file),
                       account.built_anew ? "built anew" : "changed", grouped(account.edges),
                       grouped(account.edges_checked), grouped(account.states_added), grouped(account.states_dropped));
  });
  return exit_code::success;
}

}  // namespace

Command update_command() {
  Command command{"update", "ROADMAP WORLD", "take a roadmap into a world that has changed", {}, update_roadmap};
  add_options(command.options, update_specs);
  add_options(command.options, world_option_specs());
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren::tools
