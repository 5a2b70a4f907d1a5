// SPDX-License-Identifier: BSD-3-Clause
// warren profile: what each stage of a solve costs, on one thread and on all.
#include "solve/question/planner_choice.hpp"
#include "studies/contests/stage_profile.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/command.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/planner_words.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec profile_specs[] = {
    {"--runs", "N", "how often, on one thread and on all in turns; medians are told (default: 5)"},
    {"--json", "FILE", "write warren.profile/1; - is standard output"},
    {"--picture", "FILE", "a bar a stage, as .svg, .png or .pdf by ending; - is standard output"},
};

int profile(const Arguments& arguments) {
  constexpr std::uint32_t most_runs = 1000;
  constexpr std::uint32_t usual_runs = 5;
  const Question question = question_words(arguments);
  const SolveOptions options = solve_words(arguments);
  const auto runs = given_count(arguments, "--runs", 1, most_runs).value_or(usual_runs);
  const bool standard_output_taken = check_reports(arguments, {"--json", "--picture"});
  check_plots(arguments);
  Run run(arguments);
  StageTimes before;
  const Scene scene =
      load_planned_world(arguments.operand(0), options.roadmap.pipeline, arguments, run.execution(), before);
  const studies::StageProfile profile = studies::profile_stages(scene, question, options, runs, run.execution());
  run.end();
  const bool is_stopped = profile.answer.outcome == Outcome::stopped;
  write_report(arguments, "--json", [&] { return studies::profile_json(profile); });
  write_plots(arguments, run.execution_for_what_is_left(), is_stopped,
              [&] { return PlotsPage{{studies::profile_bars(profile)}}; });
  run.conclude(standard_output_taken, is_stopped ? profile.answer.stop_reason : std::nullopt,
               [&] { return studies::profile_summary(profile, run.palette()); });
  if (is_stopped) return exit_code_of(profile.answer.stop_reason.value_or(StopReason::time));
  return profile.answer.verified ? exit_code::success : exit_code::no_path;
}

}  // namespace

Command profile_command() {
  Command command{"profile", "WORLD", "measure what each stage of a solve costs", {}, profile};
  add_options(command.options, profile_specs);
  add_options(command.options, solve_option_specs());
  add_options(command.options, question_option_specs());
  add_options(command.options, world_option_specs());
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren::tools
