// SPDX-License-Identifier: BSD-3-Clause
// Stops on the way (solve_to_goal.hpp): legs that are planned and joined, and the order of places to visit.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <variant>

#include "core/base/error.hpp"
#include "planners/grid/visiting_order.hpp"
#include "solve/kinds/goals_on_map.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/kinds/solve_to_goal.hpp"
#include "solve/question/question_of_arm.hpp"

namespace warren {
namespace {

std::vector<double> start_of(const SolveRequest& request) {
  return request.question.start.empty() ? request.scene.start : request.question.start;
}

std::vector<double> end_of(const Answer& answer) { return answer.state(answer.state_count() - 1); }

/// Sums, and of what is a distance kept all along the least.
void add_figures(std::vector<NamedFigure>& figures, const std::vector<NamedFigure>& before) {
  for (NamedFigure& figure : figures) {
    const Figure* other = figure_named(before, figure.name);
    if (other == nullptr || other->index() != figure.value.index()) continue;
    if (auto* count = std::get_if<std::uint64_t>(&figure.value)) *count += std::get<std::uint64_t>(*other);
    auto* number = std::get_if<double>(&figure.value);
    if (number == nullptr) continue;
    const double held = std::get<double>(*other);
    *number = figure.name.ends_with("clearance") ? std::min(*number, held) : *number + held;
  }
}

void add_work(Answer& answer, const Answer& before) {
  answer.counters += before.counters;
  answer.seconds += before.seconds;
  answer.solve_s += before.solve_s;
  answer.roadmap.milestones += before.roadmap.milestones;
  answer.roadmap.edges += before.roadmap.edges;
}

/// Of what ended the searches of two legs the one that leaves more to be found.
bool is_worse_end(std::string_view end, std::string_view other) {
  constexpr std::array<std::string_view, 7> best_first{"",    "optimum",  "goal",       "lattice",
                                                       "gap", "goal_gap", "lattice_gap"};
  return std::ranges::find(best_first, end) >= std::ranges::find(best_first, other);
}

void add_path(Answer& answer, const Answer& before) {
  Path<Vec2> path = before.path;
  if (!answer.path.empty()) path.insert(path.end(), answer.path.begin() + 1, answer.path.end());
  answer.path = std::move(path);
  StateList states = before.states;
  for (std::size_t i = 1; i < answer.states.size(); ++i) states.add(answer.states[i]);
  answer.states = std::move(states);
  if (answer.raw_length || before.raw_length)
    answer.raw_length = answer.raw_length.value_or(answer.length) + before.raw_length.value_or(before.length);
  for (Improvement& better : answer.improvements) {
    better.cost += told_cost(before);
    better.length += before.length;
    better.seconds += before.solve_s;
    better.lower_bound = 0.0;
  }
  if (answer.cost || before.cost) answer.cost = told_cost(answer) + told_cost(before);
  answer.length += before.length;
  answer.min_clearance = std::min(answer.min_clearance, before.min_clearance);
  if (answer.turn_rad && before.turn_rad) *answer.turn_rad += *before.turn_rad;
  if (answer.iterations && before.iterations) answer.iterations = std::max(*answer.iterations, *before.iterations);
  if (!before.ended_by.empty() && is_worse_end(before.ended_by, answer.ended_by)) {
    answer.ended_by = before.ended_by;
    answer.stop_reason = before.stop_reason;
  }
  add_figures(answer.path_figures, before.path_figures);
}

void add_by_products(ByProducts& whole, ByProducts made) {
  const bool wanted = whole.wants_certificate;
  std::swap(whole, made);
  whole.wants_certificate = wanted;
  const auto put_before = [](auto& list, auto& before) { list.insert(list.begin(), before.begin(), before.end()); };
  put_before(whole.trees, made.trees);
  put_before(whole.pose_roadmaps, made.pose_roadmaps);
  for (NamedLines& lines : made.lines) {
    const auto is_same = [&](const NamedLines& other) { return other.name == lines.name; };
    if (std::ranges::none_of(whole.lines, is_same)) whole.lines.push_back(std::move(lines));
  }
  put_before(whole.arcs.points, made.arcs.points);
  put_before(whole.arcs.turns, made.arcs.turns);
}

[[noreturn]] void refuse_stop(const SolveRequest& request, std::pair<std::string_view, std::string_view> stop,
                              std::size_t number) {
  throw UsageError(fmt::format("{}: the {} does not fit at {} {}", stop.first,
                               name_of(robot_of(request.scene, request.question).kind), stop.second, number + 1));
}

class ThroughStops {
 public:
  ThroughStops(const SolveRequest& request, std::span<const std::vector<double>> stops,
               std::pair<std::string_view, std::string_view> stop,
               const std::function<Answer(const SolveRequest&)>& solve_leg)
      : request_(request), stops_(stops), stop_(stop), solve_leg_(solve_leg), options_(request.options) {
    options_.trees.via.clear();
  }

  Answer run() {
    for (std::size_t leg = 0; leg <= stops_.size(); ++leg) {
      Answer here = whole_;
      if (!plan(leg) && !plan_turned(leg, here)) return fail(leg);
      before_ = std::move(here);
    }
    take_work();
    judge();
    return std::move(whole_);
  }

 private:
  /// Adds a leg; false: there is no way, and the answer is that of the leg. turned: the stop with a heading.
  bool plan(std::size_t leg, const std::vector<double>* turned = nullptr) {
    const bool is_last = leg == stops_.size();
    Question question = request_.question;
    if (leg > 0) question.start = end_of(whole_);
    if (!is_last || question.rule.back) {
      question.goal = turned != nullptr ? *turned : is_last ? whole_.problem.start : stops_[leg];
      question.goal_pose.reset();
      question.rule = {};
    }
    Execution execution = request_.execution;
    std::optional<Deadline> share;
    double seconds = 0.0;
    const std::function<bool(const Improvement&)> forward = [&](const Improvement& leg_is_better) {
      Improvement better = leg_is_better;
      better.cost += told_cost(whole_);
      better.length += whole_.length;
      better.lower_bound = 0.0;
      return !is_last || (*request_.execution.on_improvement)(better);
    };
    if (improves()) {  // the legs share the time
      seconds = execution.seconds_left() / static_cast<double>(stops_.size() + 1 - leg);
      execution.deadline = &share.emplace(request_.execution.deadline, seconds);
      if (execution.on_improvement != nullptr) execution.on_improvement = &forward;
    }
    ByProducts made;
    ByProducts* const keep = request_.keep;
    const SolveRequest of_leg{options_,         request_.scene, question,
                              request_.planner, execution,      keep != nullptr ? &made : nullptr};
    Answer answer = solve_leg_(of_leg);
    // Where a share brings no path, more of what is left does.
    while (share && answer.stop_reason == StopReason::time && answer.outcome == Outcome::stopped &&
           !request_.execution.should_stop()) {
      add_work(work_, answer);
      made = {};
      seconds = std::min(2.0 * seconds, request_.execution.seconds_left());
      share.emplace(request_.execution.deadline, seconds);
      answer = solve_leg_(of_leg);
    }
    if (keep != nullptr) add_by_products(*keep, std::move(made));
    if (!is_last && turned == nullptr && answer.outcome == Outcome::goal_blocked) refuse_stop(request_, stop_, leg);
    const bool goes_on = answer.outcome == Outcome::solved && answer.verified;
    is_timed_ |= enum_named<StopReason>(answer.ended_by).has_value();
    add_work(work_, answer);
    if (leg > 0) {
      answer.problem.start = whole_.problem.start;
      if (goes_on) add_path(answer, whole_);
      // A heading was chosen on the way, or the planner keeps more room than the judge asks for.
      const bool is_doubtful = answer.outcome == Outcome::infeasible && !is_whole(leg);
      if (is_doubtful || answer.outcome == Outcome::start_blocked) answer.outcome = Outcome::not_connected;
    }
    whole_ = std::move(answer);
    return goes_on;
  }

  /// Nothing was found on from the heading that was chosen at an open stop: the leg to it is planned to others, eighths
  /// of a turn apart, until one leads on. here: the path to that stop.
  bool plan_turned(std::size_t leg, Answer& here) {
    const bool is_open = leg > 0 && stops_[leg - 1].size() == 2 && here.states.width == 3 && turns();
    const bool is_end = whole_.outcome == Outcome::stopped || whole_.outcome == Outcome::goal_blocked;
    if (!is_open || is_end || gets_better(request_.planner)) return false;
    Answer failed = std::move(whole_);
    std::vector<double> turned = end_of(here);
    for (int eighth = 1; eighth < 8; ++eighth) {
      turned[2] = wrapped_angle(turned[2] + 0.25 * std::numbers::pi);
      whole_ = before_;
      bool goes_on = plan(leg - 1, &turned);
      if (goes_on) {
        here = whole_;
        goes_on = plan(leg);
      }
      if (goes_on || whole_.outcome == Outcome::stopped) return goes_on;
    }
    whole_ = std::move(failed);
    return false;
  }

  /// Does it go on until it is stopped?
  bool improves() const {
    const bool drives = robot_of(request_.scene, request_.question).kind == RobotKind::car;
    return gets_better(request_.planner) || (drives && request_.planner == PlannerKind::grid);
  }
  /// Of a body with a heading: does the planner change that?
  bool turns() const { return request_.planner != PlannerKind::visibility && request_.planner != PlannerKind::cells; }

  /// Do the stops before a leg leave nothing to choose?
  bool is_whole(std::size_t leg) const {
    const std::size_t width = whole_.problem.start.size();
    return !turns() || std::all_of(stops_.begin(), stops_.begin() + static_cast<std::ptrdiff_t>(leg),
                                   [&](const std::vector<double>& stop) { return stop.size() == width; });
  }

  /// All that was done, for legs that lead nowhere, too.
  void take_work() {
    whole_.counters = work_.counters;
    whole_.seconds = work_.seconds;
    whole_.solve_s = work_.solve_s;
    whole_.roadmap.milestones = work_.roadmap.milestones;
    whole_.roadmap.edges = work_.roadmap.edges;
    std::erase_if(whole_.figures, [](const NamedFigure& figure) { return figure.name.starts_with("lattice_"); });
  }

  Answer fail(std::size_t leg) {
    take_work();
    claim_nothing(whole_);
    whole_.figures.push_back({"stops_reached", std::uint64_t{leg}});
    const std::vector<double>& goal = request_.question.goal.empty() ? request_.scene.goal : request_.question.goal;
    whole_.problem.goal = goal.empty() ? whole_.problem.start : goal;
    return std::move(whole_);
  }

  void judge() {
    take_bound_of_choice(whole_, std::nullopt);
    if (is_timed_) whole_.iterations.reset();  // no number is that of each leg
    const double spent_s = whole_.solve_s;
    Execution execution = request_.execution;
    std::optional<Deadline> untimed;
    if (improves()) untime(execution, untimed);
    answer_within_limits(whole_, [&] {
      const StageTimer timer(execution, "verify", whole_.seconds.verify, path_points(whole_));
      const Question asked = whole_.problem.question();
      const Verdict found =
          verifying_kind(request_.scene, asked).verify(request_.scene, asked, recorded(whole_), execution);
      if (!found.verified) fail_verification(whole_, found.first_violation);
      whole_.length = found.length;
      whole_.min_clearance = found.min_clearance;
      for (NamedFigure& figure : whole_.path_figures) {  // where legs meet gears may change
        if (figure.name == "cusps") figure.value = std::uint64_t{found.cusps};
      }
    });
    whole_.solve_s += spent_s;
  }

  const SolveRequest& request_;
  std::span<const std::vector<double>> stops_;
  std::pair<std::string_view, std::string_view> stop_;
  const std::function<Answer(const SolveRequest&)>& solve_leg_;
  SolveOptions options_;
  Answer whole_;
  Answer before_;          // without the last leg
  Answer work_;            // of all legs, what they took
  bool is_timed_ = false;  // did time or a signal end a leg's search?
};

/// The cheapest order of the places to visit, over the ways that are found between all of them.
class Visits {
 public:
  Visits(const SolveKind& kind, const SolveRequest& request)
      : kind_(kind),
        request_(request),
        rule_(request.question.rule),
        question_(request.question),
        options_(request.options) {
    question_.rule = {};
    question_.goal_pose.reset();
    if (question_.goal.empty() && !request.question.goal_pose) question_.goal = request.scene.goal;
    options_.optimise = request.planner != PlannerKind::grid;  // of a car's that would price what nobody asked for
    options_.anytime = {};
    const Scene& scene = request.scene;
    const bool has_goal =
        !question_.goal.empty() || request.question.goal_pose || scene.goal_pose || !scene.named_goals.empty();
    is_open_ = !rule_.back && !has_goal;
  }

  Answer run() {
    if (std::optional<Answer> failed = find_order()) return *std::move(failed);
    std::vector<std::vector<double>> stops;
    for (const std::uint64_t place : order_) stops.push_back(rule_.visit[place]);
    Question question = question_;
    question.rule.back = rule_.back;
    if (!rule_.back) question.goal_pose = request_.question.goal_pose;
    if (is_open_) {
      question.goal = std::move(stops.back());
      stops.pop_back();
    }
    const SolveRequest in_order{request_.options, request_.scene,     question,
                                request_.planner, request_.execution, request_.keep};
    Answer answer = ThroughStops(in_order, stops, visited_place, [this](const SolveRequest& leg) {
                      return solve_without_stops(kind_, leg);
                    }).run();
    add_work(answer, work_);
    answer.problem.rule = rule_;
    answer.goal_index.reset();  // the rule has the places alone
    if (!answer.verified) return answer;
    answer.order = order_;
    const bool in_metric = gets_better(request_.planner);
    if (is_arm(answer.problem.robot) || (answer.cost && !answer.price && !in_metric)) return answer;
    answer.lower_bound = bound_of_choice(*plane_point(answer.problem.start), *plane_point(answer.problem.goal), rule_,
                                         is_open_, off_goal(answer));
    return answer;
  }

 private:
  /// A way between two places, the second one none: the goal. Its end stands for the second one. Where the planner gets
  /// better, all of them have half of the time.
  Answer way(const std::vector<double>& from, const std::vector<double>& to) {
    Question question = question_;
    question.start = from;
    if (!to.empty()) question.goal = to;
    if (to.empty()) question.goal_pose = request_.question.goal_pose;
    Execution execution = request_.execution;
    std::optional<Deadline> share;
    if (gets_better(request_.planner)) {
      const double ways = static_cast<double>((rule_.visit.size() + 2) * (rule_.visit.size() + 1));
      execution.deadline = &share.emplace(request_.execution.deadline, execution.seconds_left() / ways);
    }
    const PlannerKind planner = gets_better(request_.planner) ? PlannerKind::rrt_connect : request_.planner;
    Answer found = kind_.solve({options_, request_.scene, question, planner, execution});
    add_work(work_, found);
    return found;
  }

  /// none: it is found; else there is no way to one of the places.
  std::optional<Answer> find_order() {
    const std::size_t count = rule_.visit.size();
    order_.assign(1, 0);
    if (count == 1) return std::nullopt;
    start_ = start_of(request_);  // none: the file names it
    std::vector<std::vector<double>> at;
    std::vector<double> first;
    for (std::size_t i = 0; i < count; ++i) {
      Answer found = way(start_, rule_.visit[i]);
      if (found.outcome == Outcome::goal_blocked) refuse_stop(request_, visited_place, i);
      start_ = found.problem.start;
      const bool is_cut = found.outcome == Outcome::stopped && !request_.execution.should_stop();
      if (!found.verified && !is_cut) return fail(std::move(found));
      first.push_back(is_cut ? none : paid_for(found, request_));
      at.push_back(is_cut ? rule_.visit[i] : end_of(found));
      at.back().resize(start_.size(), 0.0);
    }
    // Of cars the way back may be another one.
    const bool one_way = robot_of(request_.scene, question_).kind == RobotKind::car;
    std::vector<std::vector<double>> between(count, std::vector(count, none));
    std::vector<double> last(count, is_open_ ? 0.0 : none);
    std::optional<Answer> stopped;
    const auto cost = [&](const std::vector<double>& from, const std::vector<double>& to) {
      if (stopped) return none;
      Answer found = way(from, to);
      const double paid = found.verified ? paid_for(found, request_) : none;
      const bool is_over = found.outcome == Outcome::stopped && request_.execution.should_stop();
      if (is_over) stopped = std::move(found);
      return paid;
    };
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        if (i != j) between[i][j] = j > i || one_way ? cost(at[i], rule_.visit[j]) : between[j][i];
      }
      if (!is_open_)
        last[i] = rule_.back && !one_way ? first[i] : cost(at[i], rule_.back ? start_ : std::vector<double>{});
    }
    if (stopped) return fail(std::move(*stopped));
    take_order(first, between, last);
    return std::nullopt;
  }

  /// What was not found is the dearest by far: other headings may lead on there.
  void take_order(const std::vector<double>& first, const std::vector<std::vector<double>>& between,
                  const std::vector<double>& last) {
    std::vector<std::vector<double>> all = between;
    all.insert(all.end(), {first, last});
    double longest = 0.0;
    for (const std::vector<double>& row : all) {
      for (const double cost : row) longest = std::max(longest, cost == none ? 0.0 : cost);
    }
    const double unit = longest > 0.0 ? longest * 0x1p-40 : 1.0;
    const auto units = [&](const std::vector<double>& list) {
      constexpr std::uint64_t not_found = std::uint64_t{1} << 50U;
      std::vector<std::uint64_t> row;
      for (const double cost : list) row.push_back(cost == none ? not_found : static_cast<std::uint64_t>(cost / unit));
      return row;
    };
    TourCosts costs{units(first), {}, units(last)};
    for (const auto& row : between) costs.between.push_back(units(row));
    order_ = best_order(costs)->order;
  }

  Answer fail(Answer failed) const {
    claim_nothing(failed);
    failed.figures.push_back({"stops_reached", std::uint64_t{0}});
    failed.planner = name_of(request_.planner);
    if (!start_.empty()) failed.problem.start = start_;
    failed.problem.goal = question_.goal.empty() ? failed.problem.start : question_.goal;
    failed.problem.rule = rule_;
    failed.counters = work_.counters;
    failed.seconds = work_.seconds;
    failed.solve_s = work_.solve_s;
    return failed;
  }

  static constexpr double none = std::numeric_limits<double>::infinity();
  const SolveKind& kind_;
  const SolveRequest& request_;
  const GoalRule& rule_;
  Question question_;  // of the ways
  SolveOptions options_;
  bool is_open_ = false;       // no goal: the last place is
  std::vector<double> start_;  // of the first way
  std::vector<std::uint64_t> order_;
  Answer work_;  // what finding the order took
};

/// Throws UsageError for stops that are no states of the body.
void check_stops(const SolveRequest& request) {
  const std::vector<std::vector<double>>& via = request.options.trees.via;
  const std::vector<std::vector<double>>& visit = request.question.rule.visit;
  if (!via.empty() && !visit.empty()) {
    throw UsageError("@visit: finds the order of its places, and @via says one; leave one of them out");
  }
  const bool asks_scene = request.question.goal.empty() && !request.question.goal_pose && !request.question.rule.back;
  if (!visit.empty() && asks_scene && (!request.scene.other_goals.empty() || request.scene.named_goals.size() > 1)) {
    throw UsageError("@visit: is for one goal, and the world has several; say which by @goal");
  }
  const RobotSpec robot = robot_of(request.scene, request.question);
  if (request.question.route.alternatives && !via.empty()) {
    throw UsageError("@alternatives: are of ways from a start to a goal; way-points leave no such two");
  }
  if (request.keep != nullptr && request.keep->wants_certificate && !(via.empty() && visit.empty())) {
    throw UsageError("@certificate: proves the bound of a way to one goal; one over stops has none");
  }
  const std::size_t said = start_of(request).size();
  const bool is_unread = robot.files && !robot.files->read;
  const std::size_t joints = said > 0 || is_unread ? said : state_size(robot);
  const auto check = [&](const std::vector<double>& stop, std::pair<std::string_view, std::string_view> words) {
    const auto& [option, noun] = words;
    if (is_arm(robot)) {
      if (stop.size() == joints || joints == 0) return;  // of a start that is missing the kind speaks
      throw UsageError(robot.files ? fmt::format("{}: this arm takes {} joint values a {}", option, joints, noun)
                                   : fmt::format("{}: an arm takes six joint angles a {}", option, noun));
    }
    if (is_round(robot) && stop.size() != 2) throw UsageError(fmt::format("{}: a point or disc takes X,Y", option));
    if (stop.size() > 3) throw UsageError(fmt::format("{}: a turning body takes X,Y or X,Y,THETA", option));
    check_heading(option, stop);
  };
  for (const std::vector<double>& stop : via) check(stop, way_point);
  for (const std::vector<double>& stop : visit) check(stop, visited_place);
}

}  // namespace

Answer solve_through(const SolveRequest& request, std::span<const std::vector<double>> stops,
                     std::pair<std::string_view, std::string_view> stop,
                     const std::function<Answer(const SolveRequest&)>& solve_leg) {
  return ThroughStops(request, stops, stop, solve_leg).run();
}

Answer solve_to_goal(const SolveKind& kind, const SolveRequest& request) {
  check_stops(request);
  if (kind.chooses_goal) return kind.solve(request);
  if (!request.question.rule.visit.empty()) return Visits(kind, request).run();
  const auto solve_leg = [&](const SolveRequest& leg) { return solve_without_stops(kind, leg); };
  const std::vector<std::vector<double>>& via = request.options.trees.via;
  return via.empty() ? solve_leg(request) : solve_through(request, via, way_point, solve_leg);
}

}  // namespace warren
