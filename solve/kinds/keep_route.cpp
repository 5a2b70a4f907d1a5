// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/error.hpp"
#include "core/plane/se2.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/kinds/solve_to_goal.hpp"
#include "solve/question/question_of_arm.hpp"

namespace warren {
namespace {

using State = std::vector<double>;

/// From one value of a number to another; joints: of an arm, those without end go the shorter way.
double way(std::span<const ArmVariable> joints, std::size_t i, double from, double to) {
  return i < joints.size() ? variable_way(joints[i], from, to) : to - from;
}

/// The state at a share of the motion; a heading turns the shorter way.
State between(const State& a, const State& b, double share, bool of_arm, std::span<const ArmVariable> joints) {
  if (share <= 0.0) return a;
  if (share >= 1.0) return b;
  State state = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    state[i] += share * (a.size() == 3 && i == 2 && !of_arm ? turn_between(a[2], b[2]) : way(joints, i, a[i], b[i]));
  }
  return state;
}

struct OnRoute {
  double share = 0.0;  // of the motion
  double distance = std::numeric_limits<double>::infinity();
};

/// Of bodies of the plane the place counts, of arms all joints.
OnRoute nearest_on(const State& a, const State& b, const State& to, bool of_arm, std::span<const ArmVariable> joints) {
  const std::size_t compared = of_arm ? to.size() : 2;
  double along = 0.0;
  double length_sq = 0.0;
  for (std::size_t i = 0; i < compared; ++i) {
    const double whole = way(joints, i, a[i], b[i]);
    along += whole * way(joints, i, a[i], to[i]);
    length_sq += whole * whole;
  }
  OnRoute found;
  found.share = length_sq > 0.0 ? std::clamp(along / length_sq, 0.0, 1.0) : 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < compared; ++i) {
    const double off = way(joints, i, to[i], a[i] + found.share * way(joints, i, a[i], b[i]));
    sum += off * off;
  }
  found.distance = std::sqrt(sum);
  return found;
}

/// Of the route's rest, as it is now: how long, how free; none: it is not free.
struct Cost {
  Verdict verdict;
  PriceParts price;
  double sum = 0.0;
};

/// is_at_goal: else the judge asks whether an arm's tool is where it shall be.
std::optional<Cost> cost_now(const std::vector<State>& states, const Scene& scene, const Question& question,
                             const Problem& problem, bool is_at_goal, const Execution& execution) {
  Question asked = question;
  asked.route = {};
  asked.rule = {};
  if (is_at_goal) {
    asked.goal = states.back();
    asked.goal_pose.reset();
  }
  asked.robot = problem.robot;  // as options have made it
  RecordedAnswer path = recorded(std::span(states));
  path.problem = asked;
  Cost cost;
  cost.verdict = verifying_kind(scene, asked).verify(scene, asked, path, execution);
  if (!cost.verdict.verified) return std::nullopt;
  cost.price = judged_price(scene, problem.prices, problem.robot, path, execution).value_or(PriceParts{});
  cost.sum = cost.verdict.length + cost.price.sum();
  return cost;
}

/// The goals that were asked for, in their order: take_goal() has changed places.
std::vector<State> asked_goals(const Answer& answer) {
  std::vector<State> goals = answer.problem.rule.others;
  State first = answer.goal_reached ? answer.goal_reached->asked : answer.problem.goal;
  const std::uint64_t number = answer.goal_index.value_or(0);
  if (number > 0 && number <= goals.size()) std::swap(first, goals[number - 1]);
  goals.insert(goals.begin(), std::move(first));
  return goals;
}

/// Of an arm of files.
std::span<const ArmVariable> joints_of(const Problem& problem) {
  const auto& files = problem.robot.files;
  return files && files->read ? std::span<const ArmVariable>(files->read->variables) : std::span<const ArmVariable>();
}

/// Where it ends; none: the goal is a place of an arm's tool, and the judge asks.
std::optional<PathEnd> check_route(const RouteRule& rule, const Answer& answer) {
  const std::vector<State>& route = rule.keep_to;
  const Problem& problem = answer.problem;
  if (answer.price && !is_round(problem.robot)) {
    throw UsageError("@keep_to: what an older path of a car costs in turns and gears is not compared; ask without");
  }
  if (problem.robot.kind == RobotKind::polygon &&
      gets_better(enum_named<PlannerKind>(answer.planner).value_or(PlannerKind::prm))) {
    throw UsageError("@keep_to: compares lengths, and this planner minimises turns as well; take another one");
  }
  for (const State& state : route) {
    if (state.size() == problem.start.size()) continue;
    throw UsageError(
        fmt::format("@keep_to: the path's states have {} numbers, the body's {}", state.size(), problem.start.size()));
  }
  if (names_other_joints(rule.joints, joints_of(problem)))
    throw UsageError("@keep_to: the path is of other joints than the robot's, or in another order");
  if (problem.goal_pose) return std::nullopt;
  const std::vector<State> goals = asked_goals(answer);
  const auto is_of_tool = [&](const State& goal) { return goal.size() != route.back().size(); };
  if (is_arm(problem.robot) && std::ranges::any_of(goals, is_of_tool)) return std::nullopt;
  const std::optional<PathEnd> end = reached_goal(route.back(), goals, problem.rule);
  if (!end) throw UsageError("@keep_to: the path ends at another place than the goal");
  return end;
}

/// The answer's goal is where the kept route ends.
void take_end(Answer& answer, const State& place, const PathEnd& end) {
  std::vector<State> goals = asked_goals(answer);
  const std::optional<GoalReached> before = std::exchange(answer.goal_reached, std::nullopt);
  const std::optional<std::uint64_t> number_before = answer.goal_index;
  GoalRule& rule = answer.problem.rule;
  if (rule.region || rule.tolerance) {
    answer.goal_reached = GoalReached{goals[end.number], end.distance, {}};
    if (end.distance == 0.0) answer.goal_reached->distance_bound = 0.0;
    if (before && number_before.value_or(0) == end.number && end.distance > 0.0) {
      answer.goal_reached->distance_bound = before->distance_bound;
    }
  }
  answer.problem.goal = std::move(goals.front());
  goals.erase(goals.begin());
  rule.others = std::move(goals);
  if (!rule.others.empty()) answer.goal_index = end.number;
  take_goal(answer.problem, place, answer.goal_index);
}

void take(Answer& answer, const std::vector<State>& states, const Cost& cost) {
  const RecordedAnswer path = recorded(std::span(states));
  answer.outcome = Outcome::solved;
  answer.stop_reason.reset();
  answer.verified = true;
  answer.path = path.path;
  answer.states = path.states;
  answer.length = cost.verdict.length;
  answer.min_clearance = cost.verdict.min_clearance;
  answer.raw_length.reset();
  answer.improvements.clear();  // of the path that was found
  answer.iterations.reset();
  answer.ended_by.clear();
  answer.optimal = false;
  answer.path_figures.clear();
  if (answer.price || cost.price.sum() > 0.0) {
    answer.price = cost.price;
    answer.cost = cost.sum;
  } else {
    answer.cost.reset();  // of the planner's own steps
  }
  if (!answer.turn_rad) return;
  double turn = 0.0;
  for (std::size_t i = 1; i < states.size(); ++i) turn += std::abs(turn_between(states[i - 1][2], states[i][2]));
  answer.turn_rad = turn;
}

}  // namespace

std::vector<State> rest_of_route(const std::vector<State>& route, const State& start, double slack, bool is_cut,
                                 bool of_arm, std::span<const ArmVariable> joints) {
  if (route.empty()) return {};
  if (route.size() == 1) return {start, route.front()};
  std::vector<OnRoute> on(route.size() - 1);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < on.size(); ++i) {
    on[i] = nearest_on(route[i], route[i + 1], start, of_arm, joints);
    least = std::min(least, on[i].distance);
  }
  std::size_t leg = 0;
  while (leg + 1 < on.size() && on[leg].distance > least + slack) ++leg;
  while (leg + 1 < on.size() && on[leg + 1].distance < on[leg].distance) ++leg;  // on with this pass
  std::vector<State> rest{start};
  const State place = between(route[leg], route[leg + 1], on[leg].share, of_arm, joints);
  if (is_cut && place != start && on[leg].share < 1.0) rest.push_back(place);
  for (std::size_t i = leg + 1; i < route.size(); ++i) {
    if (route[i] != rest.back()) rest.push_back(route[i]);
  }
  return rest;
}

void keep_to_route(Answer& answer, const Scene& scene, const Question& question, const SolveOptions& options,
                   const Execution& execution) {
  const RouteRule& rule = question.route;
  if (rule.keep_to.empty() || answer.problem.start.empty()) return;
  if (rule.alternatives) throw UsageError("@alternatives: and @keep_to are two questions; ask one of them");
  if (!question.rule.visit.empty() || question.rule.back) {
    throw UsageError("@keep_to: is for a way to a goal; of places to visit nobody knows which are left");
  }
  if (!options.trees.via.empty()) throw UsageError("@keep_to: nobody knows which places of @via are left");
  const std::optional<PathEnd> end = check_route(rule, answer);
  const StageTimer timer(execution, "keep", answer.seconds.verify, rule.keep_to.size());
  const Problem& problem = answer.problem;
  // So far from its route the body is still on it.
  const double slack = extent_of(problem.robot) + (scene.map ? scene.map->cell : 0.0);
  const bool is_car = problem.robot.kind == RobotKind::car;
  const std::vector<State> rest =
      rest_of_route(rule.keep_to, problem.start, slack, !is_car, is_arm(problem.robot), joints_of(problem));
  KeptRoute told;
  const std::optional<Cost> kept = cost_now(rest, scene, question, problem, end.has_value(), execution);
  if (kept) told.kept_cost = kept->sum;
  if (answer.verified) {
    const auto price = judged_price(scene, problem.prices, problem.robot, recorded(answer), execution);
    told.new_cost = answer.length + price.value_or(PriceParts{}).sum();
  }
  constexpr double usual_gain = 0.05;
  const double gain = rule.unless_gain.value_or(usual_gain);
  told.kept = kept && (!told.new_cost || (1.0 - gain) * kept->sum <= *told.new_cost);
  // A tolerance asks for the nearest place that can be reached.
  if (end && problem.rule.tolerance && answer.verified && answer.goal_reached &&
      end->distance > answer.goal_reached->distance * (1.0 + 1e-9)) {
    told.kept = false;
  }
  if (told.kept) {
    take(answer, rest, *kept);
    if (end) take_end(answer, rule.keep_to.back(), *end);
  }
  answer.keeping = told;
}

}  // namespace warren
