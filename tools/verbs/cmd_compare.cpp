// SPDX-License-Identifier: BSD-3-Clause
// warren compare: planners side by side on a world over many seeds, or searches and queues side by side on a world's
// graph and on random graphs of many sizes.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "core/base/error.hpp"
#include "scenes/text/output_file_io.hpp"
#include "studies/compare/comparison_report.hpp"
#include "studies/compare/contest_pictures.hpp"
#include "studies/compare/graph_of_world.hpp"
#include "studies/measure/human_units.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/signals.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/verbs/compare_options.hpp"
#include "tools/words/command.hpp"
#include "worlds/rasters/map_borders.hpp"

namespace warren {
namespace {

constexpr OptionSpec output_specs[] = {
    {"--budget", "TIME", "each run, of a planner or a search, may take so long (default: none)"},
    {"--json", "FILE", "write warren.compare/1; - is standard output"},
    {"--csv", "FILE", "write a line a planner or search; - is standard output"},
    {"--svg", "FILE", "plot times against size, or the share solved against time; - is standard output"},
    {"--log", "FILE", "write every run as OMPL's benchmarks do; - is standard output"},
};
constexpr std::array<const char*, 4> output_options{"--json", "--csv", "--svg", "--log"};

/// Throws unless every output can be written; says whether one of them takes standard output.
bool check_reports(const Arguments& arguments) {
  bool taken = false;
  for (const char* option : output_options) {
    const auto file = output_file(arguments, option);
    taken = taken || file == "-";
  }
  check_picture_ending("--svg", arguments.value("--svg").value_or(""), ".svg");
  if (const auto folder = arguments.value("--pictures")) make_folder(*folder);
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
        standard_output_taken_(check_reports(arguments)),
        begin_(std::chrono::system_clock::now()) {}

  int run() {
    Run run(arguments_, RunScope::each_run);
    execution_ = run.execution();
    if (const auto threads = arguments_.value("--threads")) execution_.threads = threads_value(*threads);
    compare(run);
    run.end();
    write_outputs();
    if (!run.quiet() && !standard_output_taken_) {
      print_text(comparison_summary(comparison_, run.palette()));
    } else if (comparison_.stopped) {
      say_stopped(*comparison_.stopped);
    }
    return exit_code();
  }

 private:
  void compare(const Run& run);
  void compare_on_world(const Run& run);
  void compare_searches(const Scene& scene, const Run& run);
  bool needs_map_walls(const Scene& scene) const;
  std::string graph_planner(const Scene& scene) const;
  void write_outputs() const;
  OmplExperiment experiment() const;
  int exit_code() const;

  const Arguments& arguments_;
  CompareOptions options_;
  bool standard_output_taken_;
  std::chrono::system_clock::time_point begin_;
  Execution execution_;
  Comparison comparison_;
  std::optional<Outcome> no_graph_;  // why the world gave none
};

void CompareCommand::compare(const Run& run) {
  try {
    if (options_.world) compare_on_world(run);
    if (options_.sweep) {
      run_size_sweep(*options_.sweep, execution_, comparison_, [&](std::string_view line) { run.note(line); });
    }
  } catch (const Stopped& stopped) {
    comparison_.stopped = stopped.reason;
  }
}

void CompareCommand::compare_on_world(const Run& run) {
  StageTimes before;
  Scene scene = load_world(*options_.world, arguments_, execution_, before);
  if (!options_.planners) return compare_searches(scene, run);
  if (scene.map && needs_map_walls(scene)) add_map_walls(scene, execution_);
  run_planner_contest(scene, *options_.planners, execution_, comparison_);
  if (options_.planners->pictures.empty()) return;
  draw_contest(scene, *options_.planners, comparison_, options_.planners->pictures, execution_);
  comparison_.notes.push_back("pictures: " + options_.planners->pictures);
}

/// Bodies that turn plan among a map's borders, and pictures show them.
bool CompareCommand::needs_map_walls(const Scene& scene) const {
  const auto turns = [&](const PlannerWords& words) {
    const RobotKind body = robot_of(scene, problem_options(solve_arguments(words))).kind;
    return body != RobotKind::point && body != RobotKind::disc;
  };
  const std::vector<PlannerWords>& all = options_.planners->contenders;
  return !options_.planners->pictures.empty() || std::any_of(all.begin(), all.end(), turns);
}

/// Chosen as `solve` chooses, by the world and the options.
std::string CompareCommand::graph_planner(const Scene& scene) const {
  if (!options_.graph.empty()) return options_.graph;
  return usual_graph_planner(scene, solve_arguments(words_without_planner(options_.graph_deal)));
}

void CompareCommand::compare_searches(const Scene& scene, const Run& run) {
  PlannerDeal deal = options_.graph_deal;
  deal.planners = {graph_planner(scene)};
  if (deal.planners.front() == "prm") deal.common.emplace_back("--pipeline", "plain");  // tiles leave no roadmap
  const Deadline deadline(options_.budget_s, execution_.deadline->memory_bytes(), &signal_flag());
  Execution within = execution_;
  within.deadline = &deadline;
  const WorldGraph made = world_graph(scene, solve_arguments(deal_planners(deal).front()), within);
  if (made.graph.at.empty()) {
    no_graph_ = made.outcome;
    comparison_.notes.push_back(fmt::format("{}: {}", scene.source, name_of(made.outcome)));
    return;
  }
  run.note(fmt::format("{}: {} vertices, {} edges, {} searches", scene.source, made.graph.graph.vertex_count(),
                       made.graph.graph.edge_count(), options_.searches.variants.size()));
  run_search_contest(made.graph, options_.searches, execution_, comparison_);
}

void CompareCommand::write_outputs() const {
  const auto write = [&](std::string_view option, const auto& text) {
    if (const auto file = arguments_.value(option)) write_file(*file, text(), Execution{});
  };
  write("--json", [&] { return comparison_json(comparison_); });
  write("--csv", [&] { return comparison_csv(comparison_); });
  write("--svg", [&] { return comparison_svg(comparison_); });
  write("--log", [&] { return ompl_log(comparison_, experiment()); });
}

OmplExperiment CompareCommand::experiment() const {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host.fill('\0');
  OmplExperiment e;
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
  for (const Contender& contender : comparison_.contenders) {
    for (const ComparedRun& run : contender.runs) {
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
  for (const OptionSpec& option : run_option_specs()) {
    if (option.name != "--budget") command.options.push_back(option);
  }
  command.run = [](const Arguments& arguments) { return CompareCommand(arguments).run(); };
  return command;
}

}  // namespace warren
