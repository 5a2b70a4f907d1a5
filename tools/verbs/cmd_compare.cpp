// SPDX-License-Identifier: BSD-3-Clause
// warren compare: planners side by side on a world over many seeds, or searches and queues side by side on a world's
// graph and on random graphs of many sizes.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>

#include "core/base/error.hpp"
#include "pictures/formats/write_picture.hpp"
#include "studies/compare/comparison_report.hpp"
#include "studies/contests/contest_pictures.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/verbs/compare_options.hpp"
#include "tools/verbs/run_comparison.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec output_specs[] = {
    {"--budget", "TIME", "each run, of a planner or a search, may take so long (default: none)"},
    {"--json", "FILE", "write warren.compare/1; - is standard output"},
    {"--csv", "FILE", "write a line a planner or search; - is standard output"},
    {"--html", "FILE", "write a page of tables and plots that needs no network; - is standard output"},
    {"--runs", "FILE", "write a line a run as CSV; - is standard output"},
    {"--picture", "FILE",
     "plot times against size, or the share solved against time and box plots, as .svg, .png or .pdf by ending; - is "
     "standard output"},
    {"--figures", "FILE", "each of these plots as a file of its own: k.pdf writes k-length.pdf and others"},
    {"--table", "FILE", "write the table for a document: .tex, or else Markdown; - is standard output"},
    {"--log", "FILE", "write every run as OMPL's benchmarks do; - is standard output"},
};

/// Throws unless every output can be written; says whether one of them takes standard output.
bool check_outputs_of_compare(const Arguments& arguments) {
  const bool taken =
      check_reports(arguments, {"--json", "--csv", "--runs", "--picture", "--html", "--log", "--table", "--figures"});
  check_plots(arguments);
  if (const auto folder = arguments.value("--pictures")) studies::make_folder(*folder);
  if (arguments.has("--log") && arguments.has("--sizes")) {
    throw UsageError("--log: holds the runs on one world; --sizes has many graphs");
  }
  return taken;
}

/// One `warren compare`.
class CompareCommand {
 public:
  explicit CompareCommand(const Arguments& arguments)
      : arguments_(arguments),
        options_(compare_options(arguments)),
        standard_output_taken_(check_outputs_of_compare(arguments)),
        begin_(std::chrono::system_clock::now()) {}

  int run() {
    Run run(arguments_, RunScope::each_run, expected_stages());
    execution_ = run.execution();
    compare(run);
    run.end();
    if (arguments_.has("--picture") || arguments_.has("--figures") || arguments_.has("--html")) {
      for (std::string note : {studies::note_on_heat_maps(comparison_), studies::note_on_box_plots(comparison_)}) {
        if (!note.empty()) comparison_.notes.push_back(std::move(note));
      }
    }
    write_outputs();
    run.conclude(standard_output_taken_, comparison_.stopped,
                 [&] { return studies::comparison_summary(comparison_, run.palette()); });
    return exit_code();
  }

 private:
  ExpectedStages expected_stages() const;
  void compare(const Run& run);
  void write_outputs() const;
  studies::OmplExperiment experiment() const;
  int exit_code() const;

  const Arguments& arguments_;
  CompareOptions options_;
  bool standard_output_taken_;
  std::chrono::system_clock::time_point begin_;
  Execution execution_;
  studies::Comparison comparison_;
  std::optional<Outcome> no_graph_;  // why the world gave none
};

/// The runs are counted, and those of all take turns; of graphs of several sizes, and of pictures, nobody knows.
ExpectedStages CompareCommand::expected_stages() const {
  static constexpr ExpectedStage runs[] = {{"compare", 1.0}};
  const bool more_follows = arguments_.has("--sizes") || arguments_.has("--pictures");
  return more_follows ? ExpectedStages{} : ExpectedStages(runs);
}

void CompareCommand::compare(const Run& run) {
  std::optional<Scene> scene;
  try {
    StageTimes before;
    if (options_.world) scene = load_world(*options_.world, arguments_, execution_, before);
  } catch (const Stopped& stopped) {
    comparison_.stopped = stopped.reason;
    return;
  }
  no_graph_ = run_comparison(options_, scene ? &*scene : nullptr, execution_, comparison_,
                             [&](std::string_view line) { run.note(line); });
}

void CompareCommand::write_outputs() const {
  write_report(arguments_, "--json", [&] { return studies::comparison_json(comparison_); });
  write_report(arguments_, "--csv", [&] { return studies::comparison_csv(comparison_); });
  write_report(arguments_, "--runs", [&] { return studies::comparison_runs(comparison_); });
  write_plots(arguments_, execution_, comparison_.stopped.has_value(),
              [&] { return studies::comparison_plots(comparison_); });
  write_report(arguments_, "--html", [&] { return studies::comparison_page(comparison_, arguments_.command_line()); });
  write_report(arguments_, "--table",
               [&] { return studies::comparison_document(comparison_, ending_of(*arguments_.value("--table"))); });
  write_report(arguments_, "--log", [&] { return studies::ompl_log(comparison_, experiment()); });
}

studies::OmplExperiment CompareCommand::experiment() const {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host.fill('\0');
  studies::OmplExperiment e;
  e.name = "compare_" + options_.world.value_or("");
  for (char& c : e.name) c = c == ' ' || c == '\t' ? '_' : c;
  e.hostname = host[0] == '\0' ? "unknown" : std::string(host.data());
  e.date = fmt::format("{:%Y-%b-%d %H:%M:%S}", fmt::localtime(std::chrono::system_clock::to_time_t(begin_)));
  e.setup = arguments_.command_line();
  e.seed = options_.planners ? options_.planners->first_seed : 1;
  e.budget_s = std::isfinite(options_.budget_s) ? options_.budget_s : 0.0;
  e.memory_mb = execution_.deadline->memory_bytes() >> 20;
  e.total_s = std::chrono::duration<double>(std::chrono::system_clock::now() - begin_).count();
  return e;
}

/// A comparison in which nobody found a path has no answer; one whose planners succeed now and then is what was asked.
int CompareCommand::exit_code() const {
  if (comparison_.stopped) return exit_code_of(*comparison_.stopped);
  bool any_solved = false;
  for (const studies::Contender& contender : comparison_.contenders) {
    for (const studies::ComparedRun& run : contender.runs) {
      if (run.outcome == Outcome::stopped) return exit_code::budget;
      any_solved = any_solved || run.solved();
    }
  }
  return any_solved && !no_graph_ ? exit_code::success : exit_code::no_path;
}

}  // namespace

Command compare_command() {
  Command command{"compare", "[WORLD]", "measure planners, or searches and their queues, side by side", {}, {}};
  add_options(command.options, compare_option_specs());
  add_options(command.options, world_option_specs());
  add_options(command.options, output_specs);
  add_options(command.options, run_option_specs(), {"--budget"});
  command.run = [](const Arguments& arguments) { return CompareCommand(arguments).run(); };
  return command;
}

}  // namespace warren::tools
