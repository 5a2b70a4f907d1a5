// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/solve_to_goal.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "core/base/error.hpp"
#include "solve/kinds/goals_on_map.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/question/question_of_arm.hpp"

namespace warren {
namespace {

Vec2 position(const std::vector<double>& state) { return {state[0], state[1]}; }

class ToGoal {
 public:
  ToGoal(const SolveKind& kind, const SolveRequest& request)
      : kind_(kind),
        request_(request),
        rule_(rule_of(request.scene, request.question)),
        goals_(goals_of(request.scene, request.question)) {}

  Answer run() {
    const bool is_refused = request_.scene.map && is_round(robot_of(request_.scene, request_.question));
    if (goals_.front().size() < 2 || is_refused) return kind_.solve(request_);  // which says what is missing, or why
    if (rule_.region && (!find_places() || plan_to_places())) return told();
    // Who gets better would spend all the time on a goal that is cut off.
    const bool keeps_time = rule_.tolerance && gets_better(request_.planner) && is_cut_off();
    plan_to_goals(keeps_time ? 0.5 * request_.execution.seconds_left() : 0.0);
    if (keeps_time && stopped_ && !request_.execution.should_stop()) stopped_.reset();
    const bool is_settled = has_path() || best_->outcome == Outcome::start_blocked || stopped_;
    if (!is_settled && rule_.tolerance && (places_ || find_places())) plan_to_places();
    return told();
  }

 private:
  bool has_path() const { return best_ && best_->verified; }

  /// Plans to a state, of or near a goal.
  void plan(const std::vector<double>& state, const Execution& execution, std::size_t goal) {
    Question question = request_.question;
    question.goal = state;
    question.rule = {};
    if (request_.keep != nullptr) {
      ByProducts fresh;
      fresh.wants_certificate = request_.keep->wants_certificate;
      *request_.keep = std::move(fresh);
    }
    const SolveRequest to_state{request_.options, request_.scene, question, request_.planner, execution, request_.keep};
    Answer answer = kind_.solve(to_state);
    if (answer.outcome == Outcome::stopped) stopped_ = answer.stop_reason;
    tell_bound(answer, request_.scene, request_.options, execution);
    work_ += answer.counters;
    solve_s_ += answer.solve_s;
    const double paid = paid_for(answer, request_);
    const bool is_best = answer.optimal && paid <= told_cost(answer) * (1.0 + 0x1p-40);  // prices come later
    last_ = {answer.outcome, answer.verified && is_best, answer.verified ? answer.lower_bound : std::nullopt};
    if (best_ && !is_better(answer, paid)) return;
    best_ = std::move(answer);
    best_paid_ = paid;
    goal_ = goal;
    if (request_.keep != nullptr) made_ = std::move(*request_.keep);
  }
  /// Of the paths to a goal, by what is known of the last plan; planned: was that to this goal?
  void note_bound(std::size_t goal, bool planned) {
    const bool is_shut = planned && (last_.outcome == Outcome::goal_blocked || last_.outcome == Outcome::infeasible);
    all_proved_ &= is_shut || (planned && last_.optimal);
    if (is_shut) return;
    constexpr double rounding = 0x1p-40;
    double least = 0.0;
    if (planned && last_.lower_bound) {
      least = *last_.lower_bound;
    } else if (!is_arm(best_->problem.robot)) {
      least = distance(position(best_->problem.start), position(goals_[goal])) * (1.0 - rounding);
    }
    bound_ = std::min(bound_, least);
  }
  /// A cheaper path; without one, what leaves more open.
  bool is_better(const Answer& answer, double paid) const {
    if (answer.verified != best_->verified) return answer.verified;
    if (answer.verified) return paid < best_paid_;
    const auto openness = [](Outcome outcome) {
      constexpr std::array order{Outcome::goal_blocked, Outcome::infeasible, Outcome::not_connected, Outcome::stopped,
                                 Outcome::start_blocked};
      return std::ranges::find(order, outcome) - order.begin();
    };
    return openness(answer.outcome) > openness(best_->outcome);
  }

  /// Planners that get better share the time, but for so much that is kept.
  void plan_to_goals(double kept_s) {
    const Execution& whole = request_.execution;
    bool is_over = false;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      if (is_over) {
        note_bound(i, false);
        continue;
      }
      Execution execution = whole;
      std::optional<Deadline> share;
      const std::function<bool(const Improvement&)> forward = [&](const Improvement& better) {
        return (has_path() && better.cost >= told_cost(*best_)) || (*whole.on_improvement)(better);
      };
      if (gets_better(request_.planner)) {
        const double left = whole.seconds_left();
        const double seconds = std::isinf(left) ? left : (left - kept_s) / static_cast<double>(goals_.size() - i);
        execution.deadline = &share.emplace(whole.deadline, seconds);
        if (whole.on_improvement != nullptr) execution.on_improvement = &forward;
      }
      plan(goals_[i], execution, i);
      note_bound(i, true);
      is_over = best_->outcome == Outcome::start_blocked ||
                (stopped_ && (!gets_better(request_.planner) || whole.should_stop()));
    }
    if (has_path() && stopped_ && !gets_better(request_.planner)) {  // what is left may be cheaper
      make_stopped(*best_, *stopped_);
    }
  }

  /// Whoever starts in the region is there.
  std::vector<GoalPlace> place_of_start() const {
    const Question& question = request_.question;
    std::vector<double> start = question.start.empty() ? request_.scene.start : question.start;
    if (!rule_.region || start.size() < 2) return {};
    const std::size_t width = start.size();
    start.resize(3, 0.0);
    std::optional<GoalPlace> place = GoalPlaces(goals_, rule_, 0.0).place({start[0], start[1], start[2]});
    if (!place) return {};
    place->state.resize(width);
    return {*place};
  }

  /// Does a lattice, in a quarter of the time, join places near the goals to the start, and none of the goals?
  bool is_cut_off() {
    Execution execution = request_.execution;
    const Deadline share(execution.deadline, 0.25 * execution.seconds_left());
    execution.deadline = &share;
    const SolveRequest in_time{request_.options, request_.scene, request_.question, request_.planner, execution};
    try {
      places_ = places_for(in_time);
    } catch (const Error&) {  // a lattice that is too fine tells nothing, nor does one that takes too long
      return false;
    }
    return !places_->empty() && places_->front().distance > 0.0;
  }

  std::vector<GoalPlace> places_for(const SolveRequest& request) const {
    std::vector<GoalPlace> places = place_of_start();
    if (!places.empty()) return places;
    const bool drives = robot_of(request.scene, request.question).kind == RobotKind::car;
    return drives ? places_of_car(request) : places_on_layers(request);
  }

  /// What a lattice joins to the start. False: it was stopped, and so is the answer.
  bool find_places() {
    Answer chosen;
    chosen.problem.robot = robot_of(request_.scene, request_.question);
    chosen.planner = name_of(request_.planner);
    chosen.seed = request_.options.seed;
    answer_within_limits(chosen, [&] {
      const StageTimer timer(request_.execution, "search", chosen.seconds.search);
      places_ = places_for(request_);
      chosen.outcome = Outcome::not_connected;
    });
    solve_s_ += chosen.solve_s;
    if (chosen.outcome != Outcome::stopped) return true;
    const StopReason reason = *chosen.stop_reason;
    if (!best_) best_ = std::move(chosen);
    make_stopped(*best_, reason);
    return false;
  }

  /// Plans to the first of the places that the planner reaches. Does it reach one?
  bool plan_to_places() {
    for (const GoalPlace& place : *places_) {
      plan(place.state, request_.execution, place.goal);
      if (has_path()) place_ = place;
      if (has_path() || stopped_) return true;
    }
    return false;
  }

  Answer told() {
    Answer& answer = *best_;
    answer.counters = work_;
    answer.solve_s = solve_s_;
    if (request_.keep != nullptr) *request_.keep = std::move(made_);
    if (!answer.verified) answer.problem.goal = goals_.front();
    answer.problem.rule = rule_;
    // A tolerance or region that nobody has used up leaves places.
    if (!answer.verified && (rule_.tolerance || rule_.region)) settle_without_place();
    if (!answer.verified) return std::move(answer);
    if (!rule_.others.empty()) answer.goal_index = goal_;
    tell_place();
    bound();
    return std::move(answer);
  }

  void tell_place() {
    Answer& answer = *best_;
    std::vector<double> reached = std::exchange(answer.problem.goal, goals_.front());
    take_goal(answer.problem, std::move(reached), answer.goal_index);
    if (!rule_.tolerance && !rule_.region) return;
    const std::vector<double>& asked = goals_[goal_];
    const double off = place_ ? place_->distance : 0.0;
    answer.goal_reached = GoalReached{asked, off, {}};
    if (off == 0.0) answer.goal_reached->distance_bound = 0.0;
    if (off > 0.0 && rule_.tolerance) answer.goal_reached->distance_bound = distance_bound(goal_);
  }

  /// Of what may be near enough nobody has proved that it can't be reached, unless the bounds say so.
  void settle_without_place() {
    Answer& answer = *best_;
    if (!is_blocked(answer.outcome) && answer.outcome != Outcome::infeasible) return;
    if (answer.outcome == Outcome::start_blocked) return;
    const double reach = rule_.tolerance.value_or(rule_.region.value_or(0.0));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < goals_.size(); ++i) least = std::min(least, distance_bound(i).value_or(0.0));
    if (!(least > reach)) answer.outcome = Outcome::not_connected;
  }

  /// On a map: of all places that the disc reaches which the body holds around its reference point. None where time or
  /// memory end meanwhile.
  std::optional<double> distance_bound(std::size_t goal) const {
    std::optional<double> bound;
    if (request_.scene.map) stopped_by([&] { bound = bound_on_map(*request_.scene.map, goal); });
    return bound;
  }
  std::optional<double> bound_on_map(const OccupancyMap& map, std::size_t goal) const {
    const Problem& problem = best_->problem;
    const std::optional<double> held = held_radius(problem.robot);
    WallProblem disc;
    disc.start = position(problem.start);
    if (held) disc.robot = {.kind = RobotKind::disc, .radius = *held, .outline = {}};
    if (held) disc.clearance = problem.clearance;
    if (!held || !cell_at(map, disc.start)) return std::nullopt;
    const Bitmap closed = closed_cells(map, disc.start);
    WaysOverCells ways(map, disc, closed, closed, Diagonal::sqrt2, nullptr, nullptr, request_.execution);
    return ways.distance_bound(position(goals_[goal]));
  }

  /// Of what was left to choose from: the planner's own is of the goal that it was given.
  void bound() {
    Answer& answer = *best_;
    const bool is_near = place_ && rule_.tolerance;  // others may be as near
    if (!is_near && ((rule_.others.empty() && !rule_.region) || (all_proved_ && !place_))) return;
    take_bound_of_choice(answer, std::nullopt);
    const bool in_metric = gets_better(request_.planner);
    if (is_arm(answer.problem.robot) || (answer.cost && !answer.price && !in_metric)) return;
    const Vec2 start = position(answer.problem.start);
    answer.lower_bound = rule_.region || is_near
                             ? bound_of_choice(start, position(goals_.front()), rule_, false, off_goal(answer))
                             : bound_;
  }

  const SolveKind& kind_;
  const SolveRequest& request_;
  GoalRule rule_;
  std::vector<std::vector<double>> goals_;
  std::optional<Answer> best_;
  double best_paid_ = 0.0;  // for that, prices of places included
  ByProducts made_;         // of the best
  std::size_t goal_ = 0;
  std::optional<std::vector<GoalPlace>> places_;  // that the lattice joins to the start; none: nobody has looked
  std::optional<GoalPlace> place_;                // where the path ends at none of the goals
  struct {
    Outcome outcome = Outcome::stopped;
    bool optimal = false;
    std::optional<double> lower_bound;
  } last_;  // of the last plan
  std::optional<StopReason> stopped_;
  bool all_proved_ = true;                                  // the best path to each goal, or that there is none
  double bound_ = std::numeric_limits<double>::infinity();  // of the paths to any goal
  Counters work_;
  double solve_s_ = 0.0;
};

// Keeping a route.

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

double paid_for(const Answer& answer, const SolveRequest& request) {
  const Prices prices = prices_of(request.scene, request.question);
  double paid = told_cost(answer);
  if (!answer.verified || prices.empty()) return paid;
  stopped_by([&] {
    const auto price = judged_price(request.scene, prices, answer.problem.robot, recorded(answer), request.execution);
    paid += price.value_or(PriceParts{}).sum();
  });
  return paid;
}

std::vector<std::vector<double>> goals_of(const Scene& scene, const Question& question) {
  auto goals = rule_of(scene, question).goals(question.goal.empty() ? scene.goal : question.goal);
  const RobotSpec robot = robot_of(scene, question);
  for (std::vector<double>& goal : goals) {  // a file's headings mean nothing to a point
    if (question.goal.empty() && is_round(robot) && goal.size() == 3) goal.resize(2);
  }
  return goals;
}

Answer solve_without_stops(const SolveKind& kind, const SolveRequest& request) {
  const bool is_open = !kind.chooses_goal && !rule_of(request.scene, request.question).empty();
  return is_open ? ToGoal(kind, request).run() : kind.solve(request);
}

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
