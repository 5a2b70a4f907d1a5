// SPDX-License-Identifier: BSD-3-Clause
#include "solve/solve_and_keep.hpp"

#include <utility>

#include "solve/kept/roadmap_query.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/solve.hpp"

namespace warren {
namespace {

/// What shapes the roadmap.
SolveOptions options_of_roadmap(const SolveOptions& options, PlannerKind planner) {
  SolveOptions kept = options;
  kept.planner = planner;
  for (const Option option : options_in(question_options)) copy_option(option, kept, {});
  return kept;
}

/// As many samples as the last round drew, unless nobody has drawn any or they are all the places that there are.
void take_samples(const Answer& answer, SolveOptions& options) {
  const auto sampler = enum_named<SamplerKind>(answer.sampler);
  const bool all_places = sampler && takes_all_places(*sampler);
  if (answer.roadmap.samples > 0 && !all_places) options.roadmap.samples = answer.roadmap.samples;
}

void add_account(const BuildAccount& built, Answer& answer) {
  answer.counters += built.counters;
  answer.seconds.index += built.seconds.index;
  answer.seconds.sample += built.seconds.sample;
  answer.seconds.neighbours += built.seconds.neighbours;
  answer.seconds.connect += built.seconds.connect;
}

Answer kept_and_solved(Scene scene, const Question& question, const SolveOptions& options, const Execution& execution,
                       Roadmap& roadmap, ByProducts* keep) {
  SolveOptions built_by = options_of_roadmap(options, choose_solver(options, scene, question).planner);
  check_buildable(scene, question, built_by);
  const bool by_question = is_roadmap_planner(*built_by.planner) && grows(built_by, scene, robot_of(scene, question));
  Answer solved;
  if (by_question) {
    solved = solve_within(scene, question, options, execution, keep);
    if (solved.outcome == Outcome::stopped) return solved;
    take_samples(solved, built_by);
  }
  BuildAccount account;
  roadmap = build_within(std::move(scene), question, built_by, execution, IndexChoice::where_it_pays, &account);
  if (by_question && built_by.planner != PlannerKind::lazy_prm) return solved;
  const RoadmapQuery query(roadmap, execution, Questions::one);
  RoadmapSearchFields how{.search = options.search,
                          .queue = options.queue,
                          .optimise = options.optimise,
                          .cusp_cost = options.car.cusp_cost,
                          .reverse_cost = options.car.reverse_cost,
                          .heuristic = options.heuristic};
  if (!roadmap.arrays.hierarchy.empty() && !how.search) how.search = SearchMethod::astar;  // as solve searches
  QuestionScratch scratch;
  Answer asked = query.ask_within(question.start, question.goal, how, execution, scratch, by_question ? nullptr : keep);
  if (asked.outcome == Outcome::stopped) return asked;
  learn(roadmap, query, execution);
  if (by_question) return solved;
  add_account(account, asked);
  return asked;
}

}  // namespace

Answer solve_and_keep(Scene scene, const Question& question, const SolveOptions& options, const Execution& execution,
                      Roadmap& roadmap, ByProducts* keep) {
  Answer answer = kept_and_solved(std::move(scene), question, options, execution, roadmap, keep);
  price_heuristic(roadmap.world.whole(execution), question, options, execution, answer);
  explain_blocked_end(roadmap, answer, execution);
  return answer;
}

}  // namespace warren
