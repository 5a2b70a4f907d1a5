// SPDX-License-Identifier: BSD-3-Clause
// warren build: a roadmap without a question, in a file, for as many questions as one likes. warren update: the roadmap
// of a world that has changed, from the one of the world as it was.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "scenes/text/output_file_io.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec build_specs[] = {
    {"--output", "FILE", "file to write, usually NAME.roadmap", {}, "-o"},
    {"--index", "NAME",
     "auto: give a large roadmap an index, which answers without a search, where that pays; none: give it none "
     "(default: auto)",
     choices_of<IndexChoice>},
    {"--no-world", "", "leave the world out of the file; --world of 'warren query' then names it"},
};

/// Those that some planner that keeps a roadmap takes, and that a roadmap without a question can have; the others
/// become foreign to the command.
std::vector<OptionSpec> kept_options(Command& command) {
  std::vector<OptionSpec> kept;
  static const std::string planners = names_of_planners(keeps_roadmap);
  for (OptionSpec spec : solve_option_specs()) {
    const auto option = option_of_words(spec.name);
    const auto takes = [&](PlannerKind planner) { return keeps_roadmap(planner) && planner_takes(planner, *option); };
    if (spec.name == "--planner") {
      spec.choices = planners;
      spec.help =
          "whose roadmap: prm checks all of it, lazy-prm only what searches meet later; visibility joins corners of "
          "polygons, cells slices of the free space, voronoi follows what is farthest from obstacles (default: by "
          "world and body)";
    }
    if (spec.name == "--samples") spec.help = "how many samples to draw (default: auto, a number by world and body)";
    if (option && question_options.has(*option)) {
      command.foreign.emplace_back(spec.name, "is for a question; 'warren query' takes it");
    } else if (option && work_options.has(*option)) {
      command.foreign.emplace_back(spec.name, "a roadmap that is kept is made in one way; leave it out");
    } else if (option == Option::via) {
      command.foreign.emplace_back(spec.name, "is of one way; a roadmap that is kept is asked way by way");
    } else if (option && std::none_of(std::begin(all_planners), std::end(all_planners), takes)) {
      command.foreign.emplace_back(spec.name, "is for planners whose roadmaps can't be kept; 'warren solve' takes it");
    } else {
      kept.push_back(spec);
    }
  }
  return kept;
}

int build_roadmap_file(const Arguments& arguments) {
  const auto file = output_file(arguments, "--output");
  if (!file) throw UsageError("-o FILE is missing");
  const Question question = question_words(arguments);
  const SolveOptions options = solve_words(arguments);
  const auto index = given_choice<IndexChoice>(arguments, "--index").value_or(IndexChoice::where_it_pays);
  check_not_written(arguments, question.robot);
  Run run(arguments);
  Scene scene = load_world(arguments.operand(0), arguments, run.execution());
  const Roadmap roadmap = build_within(std::move(scene), question, options, run.execution(), index);
  const EdgeCounts edges = count_edges(roadmap, run.execution());
  write_roadmap(roadmap, *file, run.execution(), !arguments.has("--no-world"));
  run.conclude([&] {
    return fmt::format("{}: {}, {} states, {} edges free, {} blocked, {} unchecked\n", run.palette().strong(*file),
                       description_of(roadmap.world.outline()), grouped(count_states(roadmap)), grouped(edges.free),
                       grouped(edges.blocked), grouped(edges.unchecked));
  });
  return exit_code::success;
}

constexpr OptionSpec update_specs[] = {
    {"--output", "FILE", "where the new roadmap goes", {}, "-o"},
    {"--report", "FILE", "write as JSON what was checked again; - is standard output"},
    roadmap_world_option,
};

int update_roadmap(const Arguments& arguments) {
  const auto file = output_file(arguments, "--output");
  if (!file) throw UsageError("-o FILE is missing");
  const auto report = output_file(arguments, "--report");
  Run run(arguments);
  const Roadmap old = load_roadmap(arguments, run.execution());
  Scene now = load_world(arguments.operand(1), arguments, run.execution(), nullptr,
                         without_what_is_said(old.robot, old.world.outline()));
  UpdateAccount account;
  const Roadmap next = update(old, std::move(now), run.execution(), &account);
  std::optional<OutputFile> told;  // whole before the roadmap takes its place
  if (report) {
    told.emplace(*report, run.execution());
    told->write(fmt::format(
        "{{\"schema\": \"warren.update/1\",\n \"mode\": \"{}\",\n \"edges\": {},\n \"edges_checked\": {},\n "
        "\"states_added\": {},\n \"states_dropped\": {}}}\n",
        account.built_anew ? "built" : "changed", account.edges, account.edges_checked, account.states_added,
        account.states_dropped));
    told->complete();
  }
  FirstOfTwoFiles first(*file);
  write_roadmap(next, *file, run.execution());
  if (told) told->commit();
  first.keep();
  run.conclude([&] {
    return fmt::format("{}: {}, {} edges, {} checked; {} states new, {} gone\n", run.palette().strong(*file),
                       account.built_anew ? "built anew" : "changed", grouped(account.edges),
                       grouped(account.edges_checked), grouped(account.states_added), grouped(account.states_dropped));
  });
  return exit_code::success;
}

}  // namespace

Command build_command() {
  const std::initializer_list<std::string_view> not_kept = {"--areas", "--speed-zones", "--keep-out", "--unknown"};
  Command command{"build", "WORLD", "build a roadmap once, for many questions", {}, build_roadmap_file};
  command.options =
      joined_options({build_specs, kept_options(command),
                      options_but(question_option_specs(), {"--start", "--goal", "--goal-pose", "--contact"}),
                      options_but(price_option_specs(), not_kept), world_option_specs(), run_option_specs()});
  for (const std::string_view name : not_kept) {
    command.foreign.emplace_back(name, "is for questions that keep no roadmap; 'warren solve' takes it");
  }
  return command;
}

Command update_command() {
  return {"update", "ROADMAP WORLD", "take a roadmap into a world that has changed",
          joined_options({update_specs, world_option_specs(), run_option_specs()}), update_roadmap};
}

}  // namespace warren::tools
