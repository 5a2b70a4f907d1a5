// SPDX-License-Identifier: BSD-3-Clause
#include "studies/compare/planner_contest.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "solve/answer/write_answer_io.hpp"
#include "solve/question/grid_choice.hpp"
#include "solve/solve.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "studies/compare/cells_on_path.hpp"

namespace warren {
namespace {

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
  Answer solve(const SolveOptions& contender, std::uint64_t seed) const;
  std::optional<std::uint64_t> cells_of(const Answer& answer) const;

  const Scene& scene_;
  const PlannerContestOptions& options_;
  const Execution& execution_;
  Comparison& comparison_;
  std::size_t first_contender_ = 0;
  std::optional<GridFields> raster_;  ///< of the contender on whose raster cells are counted
};

/// Asks every planner, before the first run, whether it can solve this world with these options.
void PlannerContest::enter() {
  comparison_.problems.push_back({.source = scene_.source, .kind = ""});
  first_contender_ = comparison_.contenders.size();
  for (const SolveOptions& options : options_.contenders) {
    if (!raster_ && options.planner == PlannerKind::grid) raster_ = options.grid;
    Contender contender;
    contender.problem = comparison_.problems.size() - 1;
    contender.planner = name_of(choose_solver(options, scene_, options_.question).planner);
    if (options.search) contender.search = name_of(*options.search);
    if (options.queue) contender.queue = name_of(*options.queue);
    contender.library = "warren";
    comparison_.contenders.push_back(std::move(contender));
  }
}

Answer PlannerContest::solve(const SolveOptions& contender, std::uint64_t seed) const {
  execution_.check();
  const Deadline deadline(execution_.deadline, options_.budget_s);
  Execution within = execution_;
  within.deadline = &deadline;
  within.progress = nullptr;  // the bar shows the runs, not the stages of each
  Answer answer = solve_contender(scene_, options_.question, contender, seed, within);
  if (answer.outcome == Outcome::stopped) execution_.check();
  return answer;
}

/// Where the world has a raster, or somebody plans on one.
std::optional<std::uint64_t> PlannerContest::cells_of(const Answer& answer) const {
  if (answer.path.empty()) return std::nullopt;
  if (scene_.map) return cells_passed(answer.path, *scene_.map);
  if (!scene_.grid && !raster_) return std::nullopt;
  const Box box = scene_.bounds ? *scene_.bounds : obstacle_box(scene_);
  return cells_passed(answer.path, Raster{box.min, grid_spec(raster_.value_or(GridFields{}), scene_).cell});
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
  contender.options = json_options(answer.options);
  std::erase_if(contender.options, [](const auto& option) { return option.first == "queue"; });  // has a column
  if (!answer.sampler.empty()) {
    contender.options.insert(contender.options.begin(), {"sampler", json_string(answer.sampler)});
  }
  contender.runs.push_back(run);
  execution_.advance(1);
}

}  // namespace

Answer solve_contender(const Scene& scene, const Question& question, const SolveOptions& contender, std::uint64_t seed,
                       const Execution& execution, ByProducts* keep) {
  SolveOptions options = contender;
  options.seed = seed;
  Answer answer = solve_within(scene, question, options, execution, keep);
  if (keep != nullptr) make_by_products(scene, question, options, execution, *keep);
  return answer;
}

void run_planner_contest(const Scene& scene, const PlannerContestOptions& options, const Execution& execution,
                         Comparison& comparison) {
  PlannerContest(scene, options, execution, comparison).run();
}

}  // namespace warren
