// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/planner_contest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/solve.hpp"

namespace warren::studies {
namespace {

struct Turn {
  std::size_t contender;
  std::uint64_t seed;
  std::optional<ComparedRun> run = {};  ///< none: a signal came first
};

/// Where the world has a raster, or somebody plans on one.
std::optional<std::uint64_t> cells_of(const Answer& answer, const Scene& scene, const std::optional<GridFields>& raster,
                                      const Execution& execution) {
  if (answer.path.empty()) return std::nullopt;
  if (scene.map) return cells_passed(answer.path, *scene.map);
  if (!scene.grid && !raster) return std::nullopt;
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  return cells_passed(answer.path, box.min, grid_spec(raster.value_or(GridFields{}), scene).cell);
}

/// Trees settle no vertices in a search; they grow them.
std::uint64_t expanded_by(const Answer& answer) {
  const bool grows = is_tree_planner(enum_named<PlannerKind>(answer.planner).value_or(PlannerKind::prm));
  return grows ? answer.roadmap.milestones : answer.counters.expanded;
}

/// In the metric that planners get better by: of bodies that turn, with their turning (Se2World::distance), of all
/// others the length.
double metric_cost(const Answer& answer) {
  if (answer.price && answer.cost) return *answer.cost;
  if (answer.problem.robot.kind != RobotKind::polygon || answer.states.width != 3) return answer.length;
  const double weight = outline_reach(answer.problem.robot.outline);
  return path_length(poses_of(answer.states), [&](const Se2& a, const Se2& b) {
    return std::hypot(distance(a.position(), b.position()), weight * turn_between(a.theta, b.theta));
  });
}

/// Searches of planners that get better begin when their index is there.
std::vector<Improvement> improvements_of(const Answer& answer) {
  if (!answer.verified) return {};
  if (answer.improvements.empty()) {
    return {{.seconds = answer.solve_s, .cost = metric_cost(answer), .length = answer.length, .by = "answer"}};
  }
  std::vector<Improvement> all = answer.improvements;
  for (Improvement& one : all) one.seconds += answer.seconds.index;
  return all;
}

class PlannerContest {
 public:
  PlannerContest(const Scene& scene, const PlannerContestOptions& options, const Execution& execution,
                 Comparison& comparison)
      : scene_(scene), options_(options), execution_(execution), comparison_(comparison) {}

  /// The first round tells who needs others. Rounds beside each other are as many as keep all threads busy.
  void run() {
    constexpr std::size_t turns_at_once = 256;
    enter();
    const StageTimer timer(execution_, "compare", nullptr, options_.runs * options_.contenders.size());
    take(turns_of(0));
    if (execution_.progress != nullptr) {  // the first has told who needs others
      execution_.progress->set_total(options_.contenders.size() + (options_.runs - 1) * turns_of(1).size());
    }
    std::vector<Turn> turns;
    for (std::uint64_t round = 1; round < options_.runs; ++round) {
      const std::vector<Turn> more = turns_of(round);
      if (more.empty()) return;
      turns.insert(turns.end(), more.begin(), more.end());
      const bool more_fit = options_.parallel && turns.size() < turns_at_once && round + 1 < options_.runs;
      if (!more_fit) take(std::exchange(turns, {}));
    }
  }

 private:
  /// Asks every planner, before the first run, whether it can solve this world with these options.
  void enter() {
    comparison_.problems.push_back({.source = scene_.source, .kind = "", .unit = std::string(unit_of(scene_))});
    if (options_.parallel) {
      comparison_.notes.push_back(fmt::format("times are of runs beside each other, up to {} at once, on a thread each",
                                              thread_count(execution_.threads)));
    }
    first_contender_ = comparison_.contenders.size();
    for (const PlannerContender& asked : options_.contenders) {
      const SolveOptions& options = asked.options;
      if (!raster_ && options.planner == PlannerKind::grid) raster_ = options.grid;
      Contender contender;
      contender.dealt = asked.dealt;
      contender.problem = comparison_.problems.size() - 1;
      contender.planner = name_of(choose_solver(options, scene_, asked.question).planner);
      if (options.search) contender.search = name_of(*options.search);
      if (options.queue) contender.queue = name_of(*options.queue);
      contender.library = "warren";
      comparison_.contenders.push_back(std::move(contender));
    }
  }
  std::vector<Turn> turns_of(std::uint64_t round) const {
    std::vector<Turn> all;
    for (const std::size_t i : turns(options_.contenders.size(), round)) {
      const bool sits_out = round > 0 && !options_.repeat_all && contender(i).deterministic;
      if (!sits_out) all.push_back({i, options_.first_seed + round});
    }
    return all;
  }
  /// Runs are kept in the order of the turns, whichever end first.
  void take(std::vector<Turn> turns) {
    Execution side_by_side = execution_;
    if (!options_.parallel) side_by_side.threads = 1;
    const auto keep = [&] {
      for (const Turn& turn : turns) {
        if (turn.run) contender(turn.contender).runs.push_back(*turn.run);
      }
    };
    try {
      for_chunks(turns.size(), 1, side_by_side, [&](Range r) { turns[r.first].run = run_once(turns[r.first]); });
    } catch (...) {
      keep();
      throw;
    }
    keep();
  }
  ComparedRun run_once(const Turn& turn) {
    const PlannerContender& asked = options_.contenders[turn.contender];
    const Answer answer = solve(asked, turn.seed);
    if (turn.seed == options_.first_seed) describe(contender(turn.contender), asked, answer);
    ComparedRun run{.seed = turn.seed,
                    .outcome = answer.outcome,
                    .time_s = answer.solve_s,
                    .length = answer.length,
                    .hops = path_points(answer) > 0 ? path_points(answer) - 1 : 0,
                    .expanded = expanded_by(answer)};
    if (answer.verified) run.min_clearance = answer.min_clearance;
    run.cells = cells_of(answer, scene_, raster_, execution_.quiet());
    run.turn_rad = answer.turn_rad;
    if (answer.seconds.search > 0.0) run.search_s = answer.seconds.search;
    run.raw_length = answer.raw_length;
    run.cost = answer.cost;
    run.is_priced = answer.price.has_value();
    run.counters = answer.counters;
    run.costs = answer.costs;
    run.roadmap = answer.roadmap;
    run.improvements = improvements_of(answer);
    run.lower_bound = answer.lower_bound;
    return run;
  }
  Answer solve(const PlannerContender& contender, std::uint64_t seed) const {
    execution_.check();
    const Deadline deadline(execution_.deadline, options_.budget_s);
    Execution within = execution_;
    within.deadline = &deadline;
    within.progress = nullptr;  // the bar shows the runs, not the stages of each
    within.on_improvement = nullptr;
    if (options_.parallel) within.threads = 1;
    Answer answer = solve_contender(scene_, contender, seed, within);
    if (answer.stop_reason) execution_.check();
    return answer;
  }
  /// What was dealt out is an option, whether or not the answer repeats it.
  void describe(Contender& contender, const PlannerContender& asked, const Answer& answer) const {
    contender.search = answer.search;
    contender.deterministic = !depends_on_seed(answer, asked.options, scene_);
    auto& options = contender.options;
    options = json_options(answer.options);
    if (!answer.sampler.empty()) options.insert(options.begin(), {"sampler", json_string(answer.sampler)});
    for (const auto& [name, word] : asked.dealt) {
      const bool has_column = name == name_of(Option::search) || name == name_of(Option::queue);
      const auto is_it = [&, &name = name](const auto& option) { return option.first == name; };
      if (has_column || std::any_of(options.begin(), options.end(), is_it)) continue;
      const std::optional<double> number = number_in_word(word);
      options.emplace_back(name, number ? fmt::format("{}", *number) : json_string(word));
    }
    std::erase_if(options, [](const auto& option) { return option.first == "queue"; });  // has a column
  }
  Contender& contender(std::size_t i) const { return comparison_.contenders[first_contender_ + i]; }

  const Scene& scene_;
  const PlannerContestOptions& options_;
  const Execution& execution_;
  Comparison& comparison_;
  std::size_t first_contender_ = 0;
  std::optional<GridFields> raster_;  ///< of the contender on whose raster cells are counted
};

/// Why the planner does not take this option as it is in `from`; nothing where it does.
std::optional<UsageError> refusal(PlannerKind planner, Option option, const SolveOptions& from) {
  SolveOptions alone{.planner = planner};
  copy_option(option, alone, from);
  if (option == Option::samples && !alone.roadmap.samples) alone.roadmap.samples = 1;  // what takes a number takes none
  try {
    check_solver_options(alone);
    return std::nullopt;
  } catch (const UsageError& error) {
    return error;
  }
}

/// The first that would know the option tells best what is wrong with its value.
void check_taken(const std::vector<PlannerKind>& planners, Option option, const SolveOptions& from) {
  std::optional<UsageError> refused;
  for (const PlannerKind planner : planners) {
    const std::optional<UsageError> why = refusal(planner, option, from);
    if (!why) return;
    const bool knows_it = std::string_view(why->what()).find("would ignore it") == std::string_view::npos;
    if (!refused || knows_it) refused.emplace(*why);
  }
  if (refused) throw UsageError(*refused);
}

/// Would this queue, or this estimate, go unused?
bool idles(const SolveOptions& contender, Option option) {
  const SearchMethod search = contender.search.value_or(SearchMethod::astar);
  if (option == Option::heuristic) return search != SearchMethod::astar;
  return option == Option::queue && (search == SearchMethod::bfs || search == SearchMethod::dfs);
}

/// Throws where another `times` as many contenders would be too many.
void check_count(std::size_t contenders, std::size_t times) {
  constexpr std::size_t most_contenders = 10'000;
  if (contenders * std::max<std::size_t>(times, 1) <= most_contenders) return;
  throw UsageError(fmt::format("@planners: more than {} contenders come of these lists; shorten one", most_contenders));
}

/// Each contender that takes them once with each of the values; give(contender, value): the word that says which.
template <class Value, class Takes, class Give>
void deal_out(std::vector<PlannerContender>& contenders, std::string_view name, const std::vector<Value>& values,
              const Takes& takes, const Give& give) {
  check_count(contenders.size(), values.size());
  for (const PlannerContender& contender : std::exchange(contenders, {})) {
    if (values.empty() || !takes(contender)) {
      contenders.push_back(contender);
      continue;
    }
    for (const Value& value : values) {
      PlannerContender& one = contenders.emplace_back(contender);
      const std::string word = give(one, value);
      if (values.size() > 1) one.dealt.emplace_back(name, word);
    }
  }
}

std::vector<PlannerContender> contenders_of(const PlannerDeal& deal, PlannerKind planner) {
  SolveOptions usual{.planner = planner, .seed = deal.common.seed};
  for (const Option option : given(deal.common).members()) {
    if (!refusal(planner, option, deal.common)) copy_option(option, usual, deal.common);
  }
  std::vector<PlannerContender> all{{usual, deal.question, {}}};
  for (DealtOption list : deal.lists) {
    std::erase_if(list.values, [&](const DealtValue& v) { return refusal(planner, list.option, v.value).has_value(); });
    const auto takes = [&](const PlannerContender& one) { return !idles(one.options, list.option); };
    deal_out(all, name_of(list.option), list.values, takes, [&](PlannerContender& one, const DealtValue& value) {
      copy_option(list.option, one.options, value.value);
      return value.word;
    });
  }
  const auto all_take = [](const PlannerContender&) { return true; };
  deal_out(all, "clearance", deal.clearances, all_take, [](PlannerContender& one, double clearance) {
    one.question.clearance = clearance;
    one.question.validate();
    return fmt::format("{}", clearance);
  });
  return all;
}

/// An option that some planner takes in this world is not for those that take it in others alone.
std::vector<PlannerContender> without_strange_options(std::vector<PlannerContender> contenders, const Scene& scene) {
  const auto takes = [&](const PlannerContender& contender, Option option) {
    return planner_takes(*contender.options.planner, option, scene, contender.question);
  };
  const std::vector<PlannerContender> all = contenders;
  for (PlannerContender& contender : contenders) {
    for (const Option option : given(contender.options).members()) {
      if (takes(contender, option)) continue;
      const bool is_for_others = std::any_of(all.begin(), all.end(), [&](const PlannerContender& other) {
        return given(other.options).has(option) && takes(other, option);
      });
      if (is_for_others) copy_option(option, contender.options, {});
    }
  }
  return contenders;
}

}  // namespace

bool depends_on_seed(const Answer& answer, const SolveOptions& options, const Scene& scene) {
  const auto planner = enum_named<PlannerKind>(answer.planner);
  if (!planner || is_tree_planner(*planner) || gets_better(*planner)) return true;
  if (is_roadmap_planner(*planner)) {
    const auto sampler = enum_named<SamplerKind>(answer.sampler);
    if (!sampler || !takes_all_places(*sampler)) return true;
  }
  const RobotKind body = answer.problem.robot.kind;
  const bool taut = !scene.map && (body == RobotKind::point || body == RobotKind::disc);
  return options.optimise && !taut;
}

Answer solve_contender(const Scene& scene, const PlannerContender& contender, std::uint64_t seed,
                       const Execution& execution, ByProducts* keep) {
  SolveOptions options = contender.options;
  options.seed = seed;
  Answer answer = solve_within(scene, contender.question, options, execution, keep);
  if (keep != nullptr) make_by_products(scene, contender.question, options, execution, *keep);
  return answer;
}

void run_planner_contest(const Scene& scene, const PlannerContestOptions& options, const Execution& execution,
                         Comparison& comparison) {
  PlannerContestOptions here = options;
  here.contenders = without_strange_options(options.contenders, scene);
  PlannerContest(scene, here, execution, comparison).run();
}

std::vector<PlannerContender> deal_planners(const PlannerDeal& deal) {
  deal.question.validate();
  for (const Option option : given(deal.common).members()) check_taken(deal.planners, option, deal.common);
  for (const DealtOption& list : deal.lists) {
    for (const DealtValue& value : list.values) check_taken(deal.planners, list.option, value.value);
  }
  std::vector<PlannerContender> all;
  for (const PlannerKind planner : deal.planners) {
    for (PlannerContender& contender : contenders_of(deal, planner)) {
      check_solver_options(contender.options);
      all.push_back(std::move(contender));
    }
  }
  check_count(all.size(), 1);
  return all;
}

std::uint64_t cells_passed(std::span<const Vec2> path, Vec2 origin, double cell) {
  if (path.empty()) return 0;
  const auto index = [&](double at, double from) { return std::int64_t{std::llround((at - from) / cell)}; };
  std::int64_t steps = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const std::int64_t dx = index(path[i].x, origin.x) - index(path[i - 1].x, origin.x);
    const std::int64_t dy = index(path[i].y, origin.y) - index(path[i - 1].y, origin.y);
    steps += std::max(std::abs(dx), std::abs(dy));
  }
  return static_cast<std::uint64_t>(steps) + 1;
}

std::uint64_t cells_passed(std::span<const Vec2> path, const OccupancyMap& map) {
  std::vector<Vec2> in_cells;
  for (const Vec2 p : path) in_cells.push_back(map_point(map, p));
  return cells_passed(in_cells, {0.5, 0.5}, 1.0);
}

}  // namespace warren::studies
