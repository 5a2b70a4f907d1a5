// SPDX-License-Identifier: BSD-3-Clause
#include "solve/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/plane/geometry.hpp"
#include "core/plane/se2.hpp"
#include "core/run/trace.hpp"
#include "solve/explain/blocked_end.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/kinds/solve_to_goal.hpp"
#include "solve/question/question_of_arm.hpp"
#include "verify/judges/verify_bound.hpp"
#include "verify/judges/verify_classes.hpp"
#include "verify/judges/verify_price.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {
namespace {

/// What the question says, and where it says nothing what the answer says; the world's word and the defaults come after
/// both.
Question merged(Question question, const Question& answer) {
  if (!question.robot) question.robot = answer.robot;
  if (question.start.empty()) question.start = answer.start;
  const bool has_goal = !question.goal.empty() || question.goal_pose;
  if (!has_goal && question.rule.empty()) question.rule = answer.rule;
  const std::optional<double> unknown = question.prices.unknown;
  if (question.prices.empty()) question.prices = answer.prices;
  if (unknown) question.prices.unknown = unknown;  // which may be no more than that they are blocked
  if (!has_goal) {
    question.goal = answer.goal;
    question.goal_pose = answer.goal_pose;
  }
  if (!question.clearance) question.clearance = answer.clearance;
  if (!question.contact) question.contact = answer.contact;
  return question;
}

/// The scene as it is planned in where prices close and open places of it; none: as it is.
std::optional<Scene> restricted_copy(const Scene& scene, const Question& question, const Execution& execution) {
  const Prices prices = prices_of(scene, question);
  return restricts(prices) ? std::optional(restricted_scene(scene, prices, execution)) : std::nullopt;
}

/// What an answer says may be rounded by so much of it.
constexpr double as_told = 1e-9;

Violation untrue(std::string what) {
  return {.leg = 0, .distance = 0.0, .obstacle = std::move(what), .kind = ViolationKind::claim};
}

void refute(Verdict& verdict, std::string what) {
  verdict.verified = false;
  verdict.first_violation = untrue(std::move(what));
}

/// Cost and price that an answer claims are a part of what is verified.
void check_price(Verdict& verdict, const Scene& judged, const Prices& prices, const RecordedAnswer& answer,
                 const Execution& execution) {
  if (!verdict.verified) return;
  const auto asked = judged_price(judged, prices, verdict.problem.robot, answer, execution);
  const auto driving = driving_price(answer, verdict, asked.has_value());
  if (!asked && !(answer.price && driving)) {
    if (answer.price) refute(verdict, "price: the answer claims one, its question has none");
    return;
  }
  PriceParts price = asked.value_or(PriceParts{});
  if (driving) {
    price.turning = driving->turning;
    price.cusps = driving->cusps;
    price.reverse = driving->reverse;
  }
  const auto check = [&](std::string_view name, double said, double found) {
    if (!verdict.verified || std::abs(said - found) <= as_told * (1.0 + std::abs(found))) return;
    refute(verdict, fmt::format("{}: the answer says {}, its path has {}", name, said, found));
  };
  if (answer.price) {
    check("price: clearance", answer.price->clearance, price.clearance);
    check("price: areas", answer.price->areas, price.areas);
    check("price: turning", answer.price->turning, price.turning);
    check("price: cusps", answer.price->cusps, price.cusps);
    check("price: reverse", answer.price->reverse, price.reverse);
    check("cost_error", answer.price->error, price.error);
  }
  if (answer.cost) check("cost", *answer.cost, verdict.length + price.sum());
}

/// Where a leg of the path passes there, from a place on. With a heading, or of an arm or a car, whose legs may be
/// arcs, a state of it has to be that one; an arm's may have been moved onto a limit. Of the last state: the leg that
/// would begin there.
std::optional<PlaceOnPath> passed(const RobotSpec& robot, const ClaimedPath& claimed, const std::vector<double>& place,
                                  const Execution& execution, PlaceOnPath from = {}) {
  const double rounding = is_arm(robot) ? 2e-5 : 1e-9;
  if (place.size() == 2 && !is_arm(robot) && robot.kind != RobotKind::car) {
    const Vec2 at{place[0], place[1]};
    const Path<Vec2>& path = claimed.path;
    for (std::size_t k = from.leg; k < path.size(); ++k) {
      execution.poll(k);
      const Segment leg{path[k], path[std::min(k + 1, path.size() - 1)]};
      if (!(distance(at, leg) <= rounding * (1.0 + norm(at)))) continue;
      const double length = norm(leg.b - leg.a);
      const double share = length > 0.0 ? norm(at - leg.a) / length : 0.0;
      if (k > from.leg || share >= from.share - rounding) return PlaceOnPath{k, share};
    }
    return std::nullopt;
  }
  const auto is_there = [&](std::span<const double> state) {
    for (std::size_t i = 0; i < place.size(); ++i) {
      const bool is_heading = i == 2 && !is_arm(robot);
      const double off = is_heading ? turn_between(state[i], place[i]) : state[i] - place[i];
      if (!(std::abs(off) <= rounding * (1.0 + std::abs(place[i])))) return false;
    }
    return true;
  };
  if (claimed.state_width() < place.size()) return std::nullopt;
  for (std::size_t k = from.leg + (from.share > rounding ? 1 : 0); k < claimed.state_count(); ++k) {
    execution.poll(k);
    if (is_there(claimed.state(k))) return PlaceOnPath{k, 0.0};
  }
  return std::nullopt;
}

/// What of the rule, and of the way-points in their order, the path does not do; empty: it does.
std::string left_undone(const RobotSpec& robot, const GoalRule& rule, std::span<const std::vector<double>> via,
                        const ClaimedPath& claimed, const Execution& execution) {
  for (std::size_t i = 0; i < rule.visit.size(); ++i) {
    if (!passed(robot, claimed, rule.visit[i], execution))
      return fmt::format("visit: the path passes place {} by", i + 1);
  }
  PlaceOnPath place;
  for (std::size_t i = 0; i < via.size(); ++i) {
    const std::optional<PlaceOnPath> next = passed(robot, claimed, via[i], execution, place);
    if (!next) return fmt::format("via: the path passes place {} by, or out of its turn", i + 1);
    place = *next;
  }
  if (!rule.back) return {};
  const std::size_t count = claimed.state_count();
  const bool returns = count > 0 && passed(robot, claimed, claimed.state(0), execution, {count - 1, 0.0});
  return returns ? "" : "return: the path does not end where it starts";
}

void check_length(Verdict& verdict, const RecordedAnswer& answer) {
  if (!verdict.verified || !answer.length) return;
  if (std::abs(*answer.length - verdict.length) <= as_told * verdict.length) return;
  refute(verdict, fmt::format("length: the answer says {}, its path has {}", *answer.length, verdict.length));
}

/// The classes that an answer tells, its own path's first, and the holes that they name.
void check_classes(Verdict& verdict, const OccupancyMap& judged, const RecordedAnswer& answer,
                   const Execution& execution) {
  const Problem& problem = verdict.problem;
  std::vector<Path<Vec2>> paths{answer.path};
  std::vector<std::vector<std::int32_t>> claimed{answer.passed};
  for (const AlternativePath& other : answer.alternatives) {
    paths.push_back(other.path);
    claimed.push_back(other.passed);
  }
  OccupancyMap map = judged;
  map.blocked = closed_cells(map, {problem.start[0], problem.start[1]});
  const ClassRule rule{problem.robot.radius + problem.clearance, answer.hole_size.value_or(2.0 * problem.robot.radius)};
  const JudgedClasses found = judged_classes(map, rule, paths, execution);
  if (const auto same = same_class(found.classes)) {
    return refute(verdict, fmt::format("alternatives: paths {} and {} are of one class", same->first, same->second));
  }
  for (std::size_t i = 0; i < claimed.size(); ++i) {
    if (claimed[i] != found.told[i]) return refute(verdict, fmt::format("class: of path {} it is another", i));
  }
  for (const MapHole& hole : answer.holes) {
    bool is_there = hole.id >= 1 && hole.id <= found.holes.size();
    if (is_there) {
      const Box box = world_box(map, found.holes[hole.id - 1]);
      const double off = distance(box.min, hole.box.min) + distance(box.max, hole.box.max);
      is_there = off <= as_told * (map.cell + norm(box.min) + norm(box.max));
    }
    if (!is_there) return refute(verdict, fmt::format("holes: there is no hole {} in this box", hole.id));
  }
}

/// Other paths are verified as the answer's own is: free, as long and as dear as they say, each of a class of its own,
/// the cheapest first.
void check_alternatives(Verdict& verdict, const Scene& judged, const Question& asked, const Prices& prices,
                        const RecordedAnswer& answer, const Execution& execution) {
  if (!verdict.verified || (answer.alternatives.empty() && answer.passed.empty())) return;
  if (!judged.map || !is_round(verdict.problem.robot))
    return refute(verdict, "alternatives: classes are of points and discs on maps");
  const auto same = [](double said, double found) {
    return said == found || std::abs(said - found) <= as_told * (1.0 + std::abs(found));
  };
  double before = answer.price ? answer.cost.value_or(verdict.length) : verdict.length;
  for (std::size_t i = 0; i < answer.alternatives.size(); ++i) {
    const AlternativePath& other = answer.alternatives[i];
    const std::string name = fmt::format("alternatives: path {}: ", i + 1);
    if (other.path.empty()) return refute(verdict, name + "it has no points");
    if (other.path.front() != answer.path.front() || other.path.back() != answer.path.back()) {
      return refute(verdict, name + "it leads from or to another place");
    }
    RecordedAnswer record;
    record.file = answer.file;
    record.path = other.path;
    record.length = other.length;
    record.goal_index = answer.goal_index;
    record.cost = other.cost;
    if (answer.price) record.price = other.price;
    Verdict one = verifying_kind(judged, asked).verify(judged, asked, record, execution);
    check_length(one, record);
    check_price(one, judged, prices, record, execution);
    if (one.verified && !same(other.cost, other.length + other.price.sum()))
      refute(one, "cost: not the sum of its parts");
    if (one.verified && !same(other.min_clearance, one.min_clearance)) refute(one, "min_clearance: it is another");
    if (one.verified && other.cost < before && !same(other.cost, before))
      refute(one, "cost: less than of the one before");
    if (!one.verified) {
      return refute(verdict, name + one.first_violation.value_or(Violation{}).obstacle);
    }
    before = other.cost;
  }
  check_classes(verdict, *judged.map, answer, execution);
}

void take_bound(Verdict& verdict, const JudgedBound& judged) {
  verdict.bound = judged.verdict;
  if (judged.verdict == BoundVerdict::refuted) refute(verdict, "lower_bound: " + judged.what);
}

/// A bound of all paths on a map, with its proof.
void check_certificate(Verdict& verdict, const Scene& scene, const RecordedAnswer& answer, const Execution& execution) {
  const Problem& problem = verdict.problem;
  if (!scene.map || !is_round(problem.robot))
    throw UsageError("@certificate: proves bounds of points and discs on maps");
  if (!problem.rule.others.empty() || problem.rule.region) {  // of one goal
    verdict.bound = BoundVerdict::unchecked;
    return;
  }
  PotentialClaim claim{.start = {problem.start[0], problem.start[1]},
                       .goal = answer.path.back(),
                       .keeps = problem.robot.radius + problem.clearance,
                       .radius = problem.robot.radius,
                       .lower_bound = *answer.lower_bound};
  if (const auto& clearance = problem.prices.clearance; clearance && clearance->price > 0.0) {
    claim.price = clearance->price;
    claim.reach = clearance->reach.value_or(2.0 * problem.robot.radius);
  }
  OccupancyMap map = *scene.map;
  map.blocked = closed_cells(map, claim.start);
  JudgedBound judged = verify_potential(map, claim, *answer.certificate, execution);
  const double cost = answer.price ? answer.cost.value_or(verdict.length) : verdict.length;
  if (*answer.lower_bound > cost * (1.0 + as_told)) judged = {BoundVerdict::refuted, "above the path's cost"};
  take_bound(verdict, judged);
}

/// Of the goals that an answer was asked for the first: that a tolerance or region was about, or that is reached.
const std::vector<double>& first_goal(const RecordedAnswer& answer, const std::vector<double>& goal) {
  return answer.goal_reached ? answer.goal_reached->asked : goal;
}

/// Of several goals, and of what a tolerance or region takes, the judge of the kind asks for the place where the path
/// ends, if it may end there; what is wrong with that, else.
std::string take_end(Question& asked, const Question& question, const Scene& scene, const RecordedAnswer& answer) {
  if (answer.path.empty() || asked.goal_pose) return {};
  const bool is_said = !question.goal.empty() || asked.goal.empty();  // by the question or the world
  const GoalRule rule = rule_of(scene, asked);
  const bool takes_others = rule.region || rule.tolerance;
  if ((!is_said && !takes_others) || rule.back) return {};
  std::vector<double> end = answer.state(answer.state_count() - 1);
  if (question.rule.heading_rad && end.size() == 2) {
    throw UsageError(fmt::format("@{}: its angle is for bodies that turn, and this path has no headings",
                                 rule.region ? "goal_region" : "goal_tolerance"));
  }
  const std::vector<double>& said = asked.goal.empty() ? scene.goal : asked.goal;
  auto goals = rule.goals(is_said ? said : first_goal(answer, said));
  const bool of_arm = is_arm(robot_of(scene, asked));
  if (of_arm && takes_others) return "goal_tolerance: an arm's goal is met as it stands";
  const auto is_state = [&](const std::vector<double>& goal) {
    return of_arm ? goal.size() == end.size() : std::min(goal.size(), end.size()) >= 2;
  };
  if (!std::ranges::all_of(goals, is_state)) return {};  // the kind's judge says so
  const auto reached = reached_goal(end, goals, rule);
  if (takes_others) {
    asked.goal = std::move(end);
    if (reached) return {};
    return fmt::format("{}: the path ends farther from every goal", rule.region ? "goal_region" : "goal_tolerance");
  }
  if (!reached) return {};                                                                 // so says the kind's judge
  for (std::vector<double>& some : goals) some.resize(std::min(some.size(), end.size()));  // headings of a file
  asked.goal = std::move(goals[reached->number]);
  goals.erase(goals.begin() + static_cast<std::ptrdiff_t>(reached->number));
  asked.rule.others = std::move(goals);
  return {};
}

/// So is what an answer says of the goal that it reaches, and of the order of places to visit.
void check_goal_told(Verdict& verdict, const RecordedAnswer& answer, const Execution& execution) {
  if (!verdict.verified || answer.path.empty()) return;
  const GoalRule& rule = answer.problem.rule;
  if (answer.goal_index && *answer.goal_index > rule.others.size()) {
    return refute(verdict, fmt::format("goal_index: the answer has no goal {}", *answer.goal_index));
  }
  if (const auto& told = answer.goal_reached) {
    if (!rule.region && !rule.tolerance) return refute(verdict, "goal_reached: no tolerance or region was asked for");
    if (told->asked.size() < 2) return refute(verdict, "goal_reached: `asked` is no place");
    const std::vector<double>& goal = answer.problem.goal;
    const Vec2 end = answer.path.back();
    const double rounding = 1e-9 * (1.0 + norm(end));
    const double off_end = goal.size() < 2 ? 0.0 : distance(end, Vec2{goal[0], goal[1]});
    if (off_end > rounding) return refute(verdict, "goal: the path ends elsewhere");
    const double off = distance(end, Vec2{told->asked[0], told->asked[1]});
    if (std::abs(off - told->distance) > rounding) {
      return refute(verdict,
                    fmt::format("goal_reached: the answer says {}, its path ends {} off", told->distance, off));
    }
    if (told->distance_bound && *told->distance_bound > off + rounding) {
      return refute(verdict, "goal_reached: `distance_bound` is above the distance");
    }
  }
  if (answer.order.empty()) return;
  std::vector<std::uint64_t> sorted = answer.order;
  std::sort(sorted.begin(), sorted.end());
  bool is_whole = sorted.size() == rule.visit.size();
  for (std::size_t i = 0; is_whole && i < sorted.size(); ++i) is_whole = sorted[i] == i;
  PlaceOnPath place;
  for (std::size_t i = 0; is_whole && i < answer.order.size(); ++i) {
    const auto next = passed(verdict.problem.robot, answer, rule.visit[answer.order[i]], execution, place);
    is_whole = next.has_value();
    place = next.value_or(place);
  }
  if (!is_whole) refute(verdict, "order: the path visits the places in another one");
}

/// What may end anywhere near its goals is at least as long as the straight way to the nearest, but for so much. What
/// is priced costs as much at least.
BoundVerdict bound_near(const Problem& problem, const RecordedAnswer& answer, double off) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& goal : answer.problem.rule.goals(first_goal(answer, problem.goal))) {
    least = std::min(least, distance(Vec2{problem.start[0], problem.start[1]}, Vec2{goal[0], goal[1]}) - off);
  }
  const bool is_straight = *answer.lower_bound <= std::max(0.0, least) * (1.0 + as_told);
  return is_straight ? BoundVerdict::checked : BoundVerdict::unchecked;
}

/// What passes places on its way is at least as long as the straight way over all of them and to the goal. A goal that
/// is one of them may be where a path without one ends.
BoundVerdict bound_over_stops(const Problem& problem, const RecordedAnswer& answer) {
  const GoalRule& rule = answer.problem.rule;
  if (*answer.lower_bound <= 0.0) return BoundVerdict::checked;
  if (is_arm(problem.robot) || rule.visit.size() > most_judged_stops) return BoundVerdict::unchecked;
  const Vec2 start{problem.start[0], problem.start[1]};
  std::optional<Vec2> end = rule.back ? std::optional(start) : plane_point(problem.goal);
  std::vector<Vec2> stops;
  for (const std::vector<double>& place : rule.visit) {
    const std::optional<Vec2> stop = plane_point(place);
    if (!stop) return BoundVerdict::unchecked;
    stops.push_back(*stop);
    if (!rule.back && end && distance(*end, *stop) <= as_told * (1.0 + norm(*stop))) end.reset();
  }
  const bool is_straight = *answer.lower_bound <= straight_tour(start, stops, end) * (1.0 + as_told);
  return is_straight ? BoundVerdict::checked : BoundVerdict::unchecked;
}

/// What an answer says of its bound follows from that.
std::string wrong_gap(const RecordedAnswer& answer, double cost) {
  constexpr double slack = 1e-5;  // arcs are told as lines
  const double bound = *answer.lower_bound;
  if (answer.optimal && !(cost - bound <= slack * cost + as_told)) {
    return fmt::format("optimal: the lower bound is {}, the path's cost {}", bound, cost);
  }
  const double gap = bound > 0.0 ? std::max(0.0, cost / bound - 1.0) : cost > 0.0 ? -1.0 : 0.0;  // -1: there is none
  if (!answer.gap || std::abs(*answer.gap - gap) <= slack * (1.0 + gap)) return {};
  return fmt::format("gap: the answer says {}, its cost and bound are {} and {}", *answer.gap, cost, bound);
}

/// So is the lower bound. others: goals beside the one that is reached.
void check_bound(Verdict& verdict, const Scene& scene, const RecordedAnswer& answer,
                 const std::vector<std::vector<double>>& others, const Execution& execution) {
  if (!verdict.verified) return;
  if (!answer.lower_bound) {
    if (answer.optimal || answer.gap) refute(verdict, "optimal, gap: the answer tells no lower bound");
    return;
  }
  const Problem& problem = verdict.problem;
  const ClaimedBound claim{*answer.lower_bound, answer.price ? std::nullopt : answer.cost, verdict.length,
                           answer.state_width(), answer.states.numbers};
  const auto judged_to = [&](const std::vector<double>& goal) {
    return verify_bound(scene, {problem.robot, problem.start, goal, problem.clearance}, claim, execution);
  };
  const double priced = answer.price ? answer.price->sum() : 0.0;
  const double cost = answer.cost.value_or(verdict.length + priced);
  JudgedBound judged = answer.price ? JudgedBound{} : judged_to({});  // against its own path
  if (answer.price && *answer.lower_bound > cost * (1.0 + as_told)) {
    judged = {BoundVerdict::refuted, "above the path's cost"};
  }
  if (judged.verdict == BoundVerdict::refuted) return take_bound(verdict, judged);
  if (std::string wrong = wrong_gap(answer, cost); !wrong.empty()) return refute(verdict, std::move(wrong));
  const GoalRule& rule = answer.problem.rule;
  const auto& told = answer.goal_reached;
  const double off = rule.region.value_or(told && rule.tolerance ? told->distance : 0.0);
  const bool has_headings = told && problem.goal.size() == 3;
  const bool is_turned =
      has_headings && (told->asked.size() < 3 || std::abs(turn_between(problem.goal[2], told->asked[2])) > as_told);
  const bool is_near = off > 0.0 || is_turned;
  if (answer.certificate && !is_near) return check_certificate(verdict, scene, answer, execution);
  if (!rule.visit.empty()) {  // a way that passes the stops by would be shorter
    verdict.bound = bound_over_stops(problem, answer);
    return;
  }
  verdict.bound = BoundVerdict::unchecked;
  if (is_near || answer.price) {  // of costs the judge's search knows none
    const bool is_plane = !is_arm(problem.robot) && !rule.back && !answer.certificate;
    if (is_plane) verdict.bound = bound_near(problem, answer, off);
    if (answer.price || is_turned || !is_plane) return;
    judged = judged_to(problem.goal);  // a free way to an end that does is one
    if (judged.verdict == BoundVerdict::refuted) take_bound(verdict, judged);
    return;
  }
  take_bound(verdict, judged_to(problem.goal));
  for (const std::vector<double>& other : others) {  // a nearer one may be blocked, which nobody judges
    if (verdict.bound != BoundVerdict::checked) break;
    if (judged_to(other).verdict != BoundVerdict::checked) verdict.bound = BoundVerdict::unchecked;
  }
}

Answer kept_and_solved(Scene scene, const Question& question, const SolveOptions& options, const Execution& execution,
                       Roadmap& roadmap, ByProducts* keep) {
  SolveOptions built_by = options;
  built_by.planner = choose_solver(options, scene, question).planner;
  for (const Option option : question_options.members()) copy_option(option, built_by, {});
  if (const AskedWords words = words_in(rule_of(scene, question)); !words.empty()) {
    throw UsageError(fmt::format("{}: kept roadmaps are asked for one goal; solve takes it without @save_roadmap",
                                 place_of_word(words.members().front(), scene, question)));
  }
  check_buildable(scene, question, built_by);
  const bool by_question = is_roadmap_planner(*built_by.planner) && grows(built_by, scene, robot_of(scene, question));
  Answer solved;
  if (by_question) {
    solved = solve_within(scene, question, options, execution, keep);
    if (solved.outcome == Outcome::stopped) return solved;
    // As many samples as the last round drew, unless nobody has drawn any or they are all the places that there are.
    const auto sampler = enum_named<SamplerKind>(solved.sampler);
    const bool all_places = sampler && takes_all_places(*sampler);
    if (solved.roadmap.samples > 0 && !all_places) built_by.roadmap.samples = solved.roadmap.samples;
  }
  BuildAccount account;
  roadmap = build_within(std::move(scene), question, built_by, execution, IndexChoice::where_it_pays, &account);
  if (by_question && built_by.planner != PlannerKind::lazy_prm) return solved;
  const RoadmapQuery query(roadmap, execution, Questions::one);
  SolveOptions how = options;
  if (!roadmap.arrays.hierarchy.empty() && !how.search) how.search = SearchMethod::astar;  // as solve searches
  QuestionScratch scratch;
  Answer answer =
      query.ask_within(question.start, question.goal, how, execution, scratch, by_question ? nullptr : keep);
  if (answer.outcome == Outcome::stopped) return answer;
  learn(roadmap, query, execution);
  if (by_question) return solved;
  answer.counters += account.counters;
  answer.seconds += account.seconds;
  return answer;
}

/// Says what an estimate of options cost, where it is not the straight line.
void tell_heuristic(const Scene& scene, const Question& question, const SolveOptions& options,
                    const Execution& execution, Answer& answer) {
  price_heuristic(answer, options.heuristic, [&](HeuristicKind exact) {
    SolveOptions again = options;
    again.heuristic = exact;
    again.optimise = false;
    return solve_within(scene, question, again, execution);
  });
}

}  // namespace

Answer solve_within(const Scene& scene, const Question& question, const SolveOptions& options,
                    const Execution& execution, ByProducts* keep, PathTaker* taker, KeptWays* kept) {
  question.validate();
  options.validate();
  check_solver_options(options);
  StageAccount account;
  Execution accounted = execution;
  accounted.account = &account;
  Answer answer;
  answer.world.source = scene.source;
  const auto reason = stopped_by([&] {
    const std::optional<Scene> copy = restricted_copy(scene, question, execution);
    const Scene& restricted = copy ? *copy : scene;
    const ChosenSolver solver = choose_solver(options, restricted, question);
    WorldAccount world = account_of(scene, execution);
    const std::optional<Scene> walled = planned_copy(restricted, question, solver.planner, execution);
    const Scene& planned = walled ? *walled : restricted;
    SolveRequest request{options, planned, question, solver.planner, accounted, keep};
    request.taker = taker;
    request.kept = kept;
    answer = solve_to_goal(*solver.kind, request);
    answer.problem.prices = prices_of(scene, question);
    answer.problem.via = options.trees.via;
    keep_to_route(answer, restricted, question, options, accounted);
    const bool has_stops = !options.trees.via.empty() || !question.rule.visit.empty();
    if (answer.world.kind.empty()) answer.world = std::move(world);
    judge_prices(answer, scene, question, has_stops, accounted);
    if (answer.verified) {
      std::string undone = left_undone(answer.problem.robot, question.rule, options.trees.via, answer, {});
      if (!undone.empty()) fail_verification(answer, untrue(std::move(undone)));
    }
    tell_bound(answer, planned, options, accounted);
    prove_on_map(answer, planned, options, keep, accounted);
  });
  if (reason) answer.stop_reason = reason;
  answer.costs = account.costs();
  tell_process(answer, execution);
  return answer;
}

Verdict verify_within(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                      const Execution& execution) {
  question.validate();
  check_same_world(answer, answer.file, scene, execution);
  Question asked = merged(question, answer.problem);
  const Prices prices = prices_of(scene, asked);
  const std::optional<Scene> effective = effective_scene(scene, prices, execution);
  const Scene& judged = effective ? *effective : scene;
  std::string wrong_end = take_end(asked, question, scene, answer);
  Verdict verdict = verifying_kind(judged, asked).verify(judged, asked, answer, execution);
  if (verdict.verified && !wrong_end.empty()) refute(verdict, std::move(wrong_end));
  check_length(verdict, answer);
  if (verdict.verified) {
    std::string undone = left_undone(verdict.problem.robot, asked.rule, answer.via, answer, execution);
    if (!undone.empty()) refute(verdict, std::move(undone));
  }
  check_goal_told(verdict, answer, execution);
  check_price(verdict, judged, prices, answer, execution);
  check_alternatives(verdict, judged, asked, prices, answer, execution);
  const bool is_same = !question.robot && question.start.empty() && question.goal.empty() && !question.clearance &&
                       question.prices.empty() && !question.prices.unknown && question.rule.empty();
  // Whoever asked that unknown cells be blocked where the file opens them is not in the answer: its bound is of that
  // world.
  const bool same_cells = answer.problem.prices.opens_unknown() || !scene.prices.opens_unknown();
  if (is_same && same_cells) check_bound(verdict, judged, answer, asked.rule.others, execution);
  return verdict;
}

Answer solve_explained(const Scene& scene, const Question& question, const SolveOptions& options,
                       const Execution& execution, ByProducts* keep, PathTaker* taker, KeptWays* kept) {
  Answer answer = solve_within(scene, question, options, execution, keep, taker, kept);
  tell_heuristic(scene, question, options, execution, answer);
  const Prices prices = is_blocked(answer.outcome) ? prices_of(scene, question) : Prices{};
  const std::optional<Scene> effective = effective_scene(scene, prices, execution);
  const OccupancyMap* own = effective && scene.map ? &*scene.map : nullptr;
  explain_blocked_end(effective ? *effective : scene, answer, execution, own);
  tell_process(answer, execution);
  return answer;
}

void make_by_products(const Scene& scene, const Question& question, const SolveOptions& options,
                      const Execution& execution, ByProducts& keep) {
  const std::optional<Scene> copy = restricted_copy(scene, question, execution);
  const Scene& restricted = copy ? *copy : scene;
  const ChosenSolver solver = choose_solver(options, restricted, question);
  if (solver.kind->make_by_products == nullptr) return;
  solver.kind->make_by_products({options, restricted, question, solver.planner, execution, &keep});
}

Answer solve_and_keep(Scene scene, const Question& question, const SolveOptions& options, const Execution& execution,
                      Roadmap& roadmap, ByProducts* keep) {
  Answer answer = kept_and_solved(std::move(scene), question, options, execution, roadmap, keep);
  Question asked = question;
  asked.prices = roadmap.prices;  // the kept world has none of its own
  tell_heuristic(roadmap.world.whole(execution), asked, options, execution, answer);
  explain_blocked_end(roadmap, answer, execution);
  return answer;
}

Answer solve(const Scene& scene, const Question& question, const SolveOptions& options, const Limits& limits,
             ByProducts* keep) {
  const LimitedExecution limited(limits);
  Answer answer = solve_explained(scene, question, options, limited.execution(), keep);
  if (keep != nullptr && answer.outcome != Outcome::stopped) {  // what stops this leaves the answer, which came in time
    stopped_by([&] { make_by_products(scene, question, options, limited.execution(), *keep); });
  }
  return answer;
}

Verdict verify(const Scene& scene, const Answer& answer, const Limits& limits) {
  const LimitedExecution limited(limits);
  return verify_within(scene, {}, recorded(answer), limited.execution());
}

Verdict verify(const Scene& scene, const RecordedAnswer& answer, const Question& question, const Limits& limits) {
  const LimitedExecution limited(limits);
  return verify_within(scene, question, answer, limited.execution());
}

}  // namespace warren
