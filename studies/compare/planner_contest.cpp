// SPDX-License-Identifier: BSD-3-Clause
#include "studies/compare/planner_contest.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "solve/question/answer.hpp"
#include "solve/question/grid_choice.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/question.hpp"
#include "solve/question/write_answer_io.hpp"
#include "studies/compare/cells_on_path.hpp"
#include "tools/screen/signals.hpp"

namespace warren {
namespace {

/// `solve` as far as a contender goes: its planner and its problem.
const Command& solve_options() {
  static const Command command = [] {
    Command made{"compare", "", "", solver_option_specs(), {}};
    add_options(made.options, problem_option_specs());
    return made;
  }();
  return command;
}

void add_option(PlannerWords& words, std::string_view option, const std::string& value) {
  words.push_back(value.empty() ? std::string{option} : fmt::format("{}={}", option, value));
}

/// Is it about the world's question, so that every planner is asked it?
bool is_of_the_problem(std::string_view option) {
  const auto specs = problem_option_specs();
  return std::any_of(specs.begin(), specs.end(), [&](const OptionSpec& spec) { return spec.name == option; });
}

/// Why the planner does not take this option with this value; nothing where it does.
std::optional<std::string> refusal(const std::string& planner, std::string_view option, const std::string& value) {
  PlannerWords words{"--planner=" + planner};
  add_option(words, option, value);
  try {
    const Arguments arguments = solve_arguments(words);
    check_solver_options(arguments);
    problem_options(arguments);
    if (is_of_the_problem(option) || planner_takes(*planner_asked(arguments), option)) return std::nullopt;
  } catch (const UsageError& error) {
    return error.what();
  }
  return fmt::format("{}: {} would ignore it", option, planner);
}

/// The first that would know the option tells best what is wrong with its value.
void check_taken(const PlannerDeal& deal, std::string_view option, const std::string& value) {
  std::string refused;
  for (const std::string& planner : deal.planners) {
    const std::optional<std::string> why = refusal(planner, option, value);
    if (!why) return;
    const bool knows_it = why->find("would ignore it") == std::string::npos;
    if (refused.empty() || knows_it) refused = *why;
  }
  throw UsageError(refused);
}

/// Would this queue go unused?
bool idle_queue(const PlannerWords& words, std::string_view option) {
  const auto has = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  return option == "--queue" && (has("--search=bfs") || has("--search=dfs"));
}

/// Every way to give the contenders of `words` one of the values each.
std::vector<PlannerWords> dealt(const std::vector<PlannerWords>& contenders, std::string_view option,
                                const std::vector<std::string>& values) {
  std::vector<PlannerWords> all;
  for (const PlannerWords& words : contenders) {
    if (values.empty() || idle_queue(words, option)) {
      all.push_back(words);
      continue;
    }
    for (const std::string& value : values) {
      all.push_back(words);
      add_option(all.back(), option, value);
    }
  }
  return all;
}

std::vector<PlannerWords> contenders_of(const PlannerDeal& deal, const std::string& planner) {
  PlannerWords words{"--planner=" + planner};
  for (const auto& [option, value] : deal.common) {
    if (!refusal(planner, option, value)) add_option(words, option, value);
  }
  std::vector<PlannerWords> all{words};
  for (const auto& list : deal.lists) {
    const std::string_view option = list.first;
    std::vector<std::string> taken = list.second;
    std::erase_if(taken, [&](const std::string& value) { return refusal(planner, option, value).has_value(); });
    all = dealt(all, option, taken);
  }
  return all;
}

class PlannerContest {
 public:
  PlannerContest(const Scene& scene, const PlannerContestOptions& options, const Execution& execution,
                 Comparison& comparison)
      : scene_(scene), options_(options), execution_(execution), comparison_(comparison) {}

  void run() {
    enter();
    double seconds = 0.0;
    const StageTimer timer(execution_, "compare", seconds, options_.runs * options_.contenders.size());
    for (std::uint64_t round = 0; round < options_.runs; ++round) {
      for (const std::size_t i : turns(options_.contenders.size(), round)) run_once(i, options_.first_seed + round);
    }
  }

 private:
  void enter();
  void run_once(std::size_t i, std::uint64_t seed);
  Answer solve(const PlannerWords& words, std::uint64_t seed) const;
  std::optional<std::uint64_t> cells_of(const Answer& answer) const;

  const Scene& scene_;
  const PlannerContestOptions& options_;
  const Execution& execution_;
  Comparison& comparison_;
  std::size_t first_contender_ = 0;
  PlannerWords raster_words_;  ///< of the contender whose raster cells are counted on
};

/// Asks every planner, before the first run, whether it can solve this world with these options.
void PlannerContest::enter() {
  comparison_.problems.push_back({.source = scene_.source, .kind = ""});
  first_contender_ = comparison_.contenders.size();
  for (const PlannerWords& words : options_.contenders) {
    if (raster_words_.empty() && words.front() == "--planner=grid") raster_words_ = words;
    const Arguments arguments = solve_arguments(words);
    const ChosenSolver solver = choose_solver(arguments, scene_, problem_options(arguments));
    Contender contender;
    contender.problem = comparison_.problems.size() - 1;
    contender.planner = name_of(solver.planner);
    contender.search = arguments.value("--search").value_or("");
    contender.queue = arguments.value("--queue").value_or("");
    contender.library = "warren";
    comparison_.contenders.push_back(std::move(contender));
  }
}

Answer PlannerContest::solve(const PlannerWords& words, std::uint64_t seed) const {
  execution_.check();
  const std::size_t memory =
      execution_.deadline != nullptr ? execution_.deadline->memory_bytes() : std::numeric_limits<std::size_t>::max();
  const Deadline deadline(options_.budget_s, memory, &signal_flag());
  Execution within = execution_;
  within.deadline = &deadline;
  within.progress = nullptr;  // the bar shows the runs, not the stages of each
  Answer answer = solve_contender(scene_, words, seed, within);
  if (answer.outcome == Outcome::stopped) execution_.check();
  return answer;
}

/// Where the world has a raster, or somebody plans on one.
std::optional<std::uint64_t> PlannerContest::cells_of(const Answer& answer) const {
  if (answer.path.empty()) return std::nullopt;
  if (scene_.map) return cells_passed(answer.path, *scene_.map);
  if (!scene_.grid && raster_words_.empty()) return std::nullopt;
  const Box box = scene_.bounds ? *scene_.bounds : obstacle_box(scene_);
  return cells_passed(answer.path, Raster{box.min, grid_spec(solve_arguments(raster_words_), scene_).cell});
}

/// Trees settle no vertices in a search; they grow them.
std::uint64_t expanded_by(const Answer& answer) {
  const bool grows = answer.planner == name_of(PlannerKind::rrt) || answer.planner == name_of(PlannerKind::rrt_connect);
  return grows ? answer.roadmap.milestones : answer.counters.expanded;
}

std::size_t state_count(const Answer& answer) {
  return answer.states.empty() ? answer.path.size() : answer.states.size();
}

void PlannerContest::run_once(std::size_t i, std::uint64_t seed) {
  const Answer answer = solve(options_.contenders[i], seed);
  Contender& contender = comparison_.contenders[first_contender_ + i];
  ComparedRun run{.seed = seed,
                  .outcome = answer.outcome,
                  .time_s = answer.solve_s,
                  .length = answer.length,
                  .hops = state_count(answer) > 0 ? state_count(answer) - 1 : 0,
                  .expanded = expanded_by(answer)};
  if (answer.verified) run.min_clearance = answer.min_clearance;
  run.cells = cells_of(answer);
  run.turn_rad = answer.turn_rad;
  if (answer.seconds.search > 0.0) run.search_s = answer.seconds.search;
  contender.search = answer.search;
  contender.options = answer.options;
  std::erase_if(contender.options, [](const auto& option) { return option.first == "queue"; });  // has a column
  if (!answer.sampler.empty()) {
    contender.options.insert(contender.options.begin(), {"sampler", json_string(answer.sampler)});
  }
  contender.runs.push_back(run);
  execution_.advance(1);
}

}  // namespace

Arguments solve_arguments(const PlannerWords& words) { return {solve_options(), words}; }

PlannerWords words_without_planner(const PlannerDeal& deal) {
  PlannerWords words;
  for (const auto& [option, value] : deal.common) add_option(words, option, value);
  for (const auto& [option, values] : deal.lists) {
    for (const std::string& value : values) add_option(words, option, value);
  }
  return words;
}

std::vector<PlannerWords> deal_planners(const PlannerDeal& deal) {
  for (const auto& [option, value] : deal.common) check_taken(deal, option, value);
  for (const auto& [option, values] : deal.lists) {
    for (const std::string& value : values) check_taken(deal, option, value);
  }
  std::vector<PlannerWords> all;
  for (const std::string& planner : deal.planners) {
    for (PlannerWords& words : contenders_of(deal, planner)) {
      const Arguments arguments = solve_arguments(words);
      check_solver_options(arguments);
      problem_options(arguments);
      all.push_back(std::move(words));
    }
  }
  return all;
}

Answer solve_contender(const Scene& scene, const PlannerWords& words, std::uint64_t seed, const Execution& execution,
                       Drawing* drawing) {
  PlannerWords all = words;
  all.push_back(fmt::format("--seed={}", seed));
  const Arguments arguments = solve_arguments(all);
  const ProblemOptions problem = problem_options(arguments);
  const ChosenSolver solver = choose_solver(arguments, scene, problem);
  const SolveRequest request{arguments, scene, problem, solver.planner, execution, drawing};
  Answer answer = solver.kind->solve(request);
  if (drawing != nullptr && solver.kind->draw != nullptr) solver.kind->draw(request);
  return answer;
}

void run_planner_contest(const Scene& scene, const PlannerContestOptions& options, const Execution& execution,
                         Comparison& comparison) {
  PlannerContest(scene, options, execution, comparison).run();
}

}  // namespace warren
