// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/error.hpp"
#include "core/plane/se2.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/question/asked_words.hpp"
#include "solve/question/question_of_arm.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

constexpr double clearance_in_mazes = 0.1;

Vec2 plane_state(std::string_view option, const std::vector<double>& given, const std::vector<double>& in_file) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  if (state.empty()) throw UsageError(fmt::format("{0}: the world has none; say {0} X,Y", option));
  const bool heading_too = given.empty() && state.size() == 3;
  if (state.size() != 2 && !heading_too) {
    throw UsageError(fmt::format("{}: a point or disc takes X,Y (found: {} numbers)", option, state.size()));
  }
  return {state[0], state[1]};
}

/// A footprint as Nav2 has it, [[x, y], [x, y], ...], in the words of a polygon; nothing else is changed.
std::string without_brackets(std::string_view text) {
  const std::size_t first = text.find('[');
  if (first == std::string_view::npos) return std::string(text);
  std::string words(text);
  int depth = 0;
  for (char& c : words) {
    if (c != '[' && c != ']') continue;
    depth += c == '[' ? 1 : -1;
    if (depth < 0 || depth > 2) return std::string(text);
    c = ' ';
  }
  if (depth != 0) return std::string(text);
  return text.find_first_not_of(' ') == first ? "polygon " + words : words;
}

/// Is there anything that only bodies of the plane can meet?
bool is_flat(const Scene& scene) {
  return scene.walls.size() > 0 || !scene.polygons.empty() || scene.bounds || scene.map || is_unmade(scene);
}

}  // namespace

RobotSpec robot_value(const std::string& where, std::string_view text) {
  const bool names_files = text.starts_with("arm ") || text.starts_with("urdf ");  // which may have brackets
  const std::string words = names_files ? std::string(text) : without_brackets(text);
  if (words.find_first_of("[]") != std::string::npos && !names_files)
    throw InputError(where, "expected [[X, Y], [X, Y], [X, Y], ...]; here brackets are missing", std::string(text));
  scene_text::Fields fields(words, {where, 0});
  return read_robot(fields, {});
}

RobotSpec robot_of(const Scene& scene, const Question& options) {
  return with_what_is_said(options.robot ? *options.robot : scene.robot.value_or(RobotSpec{}), scene);
}

double clearance_of(const Scene& scene, const Question& options) {
  if (options.clearance) return *options.clearance;
  if (scene.clearance) return *scene.clearance;
  return scene.maze ? clearance_in_mazes : 0.0;
}

double least_width(const RobotSpec& robot) {
  if (robot.outline.empty()) return 2.0 * robot.radius;
  const ConvexPiece hull = convex_hull(robot.outline);
  const std::size_t n = hull.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, far = 0; i < n; ++i) {  // the farthest corner goes around with the side
    const Vec2 side = hull[(i + 1) % n] - hull[i];
    const auto off = [&](std::size_t corner) { return cross(side, hull[corner % n] - hull[i]) / norm(side); };
    far = std::max(far, i);
    while (off(far + 1) > off(far)) ++far;
    least = std::min(least, off(far));
  }
  return least;
}

void add_prices(Prices& prices, const Prices& asked) {
  const auto add = [](auto& to, const auto& more, const auto& is_same) {
    for (const auto& one : more) {
      if (std::ranges::none_of(to, [&](const auto& there) { return is_same(there, one); })) to.push_back(one);
    }
  };
  add(prices.areas, asked.areas,
      [](const PricedArea& a, const PricedArea& b) { return a.factor == b.factor && a.corners == b.corners; });
  add(prices.masks, asked.masks, [](const PriceMask& a, const PriceMask& b) {
    return a.kind == b.kind && a.file == b.file && a.factor == b.factor && a.base == b.base &&
           a.multiplier == b.multiplier;
  });
  add(prices.keep_out, asked.keep_out, [](const auto& a, const auto& b) { return a.corners == b.corners; });
  if (asked.clearance) prices.clearance = asked.clearance;
  if (asked.unknown) prices.unknown = asked.unknown;
}

Prices prices_of(const Scene& scene, const Question& question) {
  Prices prices = scene.prices;
  add_prices(prices, question.prices);
  if (!prices.opens_unknown()) prices.unknown.reset();
  if (prices.clearance && !prices.clearance->reach) {
    const RobotSpec robot = robot_of(scene, question);
    prices.clearance->reach = least_width(robot);
    if (!(*prices.clearance->reach > 0.0)) {
      throw UsageError(fmt::format("@clearance_price: a {} has no width from which nothing is to be paid; say P,D",
                                   name_of(robot.kind)));
    }
  }
  return prices;
}

GoalRule rule_of(const Scene& scene, const Question& question) {
  GoalRule rule = question.rule;
  if (question.goal.empty() && !question.goal_pose && rule.others.empty()) rule.others = scene.other_goals;
  return rule;
}

void take_goal(Problem& problem, std::vector<double> reached, const std::optional<std::uint64_t>& number) {
  std::vector<double> first = std::exchange(problem.goal, std::move(reached));
  if (number && *number > 0 && *number <= problem.rule.others.size())
    problem.rule.others[*number - 1] = std::move(first);
}

std::optional<PathEnd> reached_goal(std::span<const double> end, const std::vector<std::vector<double>>& goals,
                                    const GoalRule& rule) {
  constexpr double rounding = 1e-9;
  const auto is_there = [&](const std::vector<double>& goal) {
    for (std::size_t i = 0; i < std::min(end.size(), goal.size()); ++i) {
      const double off = end.size() == 3 && i == 2 ? turn_between(end[i], goal[i]) : end[i] - goal[i];
      if (std::abs(off) > rounding * (1.0 + std::abs(goal[i]))) return false;
    }
    return true;
  };
  std::optional<PathEnd> nearest;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const std::vector<double>& goal = goals[i];
    if (is_there(goal)) return PathEnd{i, 0.0};
    if (!rule.region && !rule.tolerance) continue;
    const bool is_turned = goal.size() == 3 && end.size() == 3;
    if (is_turned && !(std::abs(turn_between(end[2], goal[2])) <= rule.heading_rad.value_or(0.0) + rounding)) continue;
    const double off = distance(Vec2{end[0], end[1]}, Vec2{goal[0], goal[1]});
    // Far from the origin places are rounded more.
    const double misplaced = 0x1p-45 * (std::abs(goal[0]) + std::abs(goal[1]));
    if (!(off <= rule.region.value_or(rule.tolerance.value_or(0.0)) * (1.0 + 1e-12) + misplaced)) continue;
    if (!nearest || off < nearest->distance) nearest = PathEnd{i, off};
  }
  return nearest;
}

void Question::validate() const {
  for (const auto& [name, state] : {std::pair{"start", &start}, std::pair{"goal", &goal}}) {
    if (std::ranges::all_of(*state, is_coordinate)) continue;
    throw UsageError(fmt::format("@{}: coordinates are numbers of at most 1e60", name));
  }
  if (clearance && !(*clearance >= 0.0 && *clearance <= largest_coordinate)) {
    throw UsageError(fmt::format("@clearance: must be a number from 0 to 1e60 (found: {})", *clearance));
  }
  check_prices(prices);
  check_goal_rule(rule);
  check_route_rule(route);
}

void check_headings(const Scene& scene, const Question& question) {
  const bool has_heading = (question.start.empty() && scene.start.size() == 3) ||
                           (question.goal.empty() && !question.rule.back && scene.goal.size() == 3);
  if (!has_heading || question.robot || scene.robot) return;
  throw UsageError(fmt::format("{}: a point has no heading, and no line names the robot; say @robot", scene.source));
}

WallProblem wall_problem(const Scene& scene, const Question& options, Contact usual) {
  WallProblem problem;
  problem.robot = robot_of(scene, options);
  if (!is_round(problem.robot)) {
    throw UsageError(fmt::format("{}: expected a point or disc", options.robot ? "@robot" : scene.source));
  }
  problem.start = plane_state("@start", options.start, scene.start);
  problem.goal = problem.start;
  check_headings(scene, options);
  const bool ends_anywhere = !options.rule.visit.empty() && options.goal.empty() && scene.goal.empty();
  if (!options.rule.back && !ends_anywhere) problem.goal = plane_state("@goal", options.goal, scene.goal);
  for (const auto& place : options.rule.others) plane_state("@goal", place, {});
  for (const auto& place : options.rule.visit) plane_state("@visit", place, {});
  problem.clearance = clearance_of(scene, options);
  problem.prices = prices_of(scene, options);
  problem.rule = rule_of(scene, options);
  problem.contact = options.contact.value_or(problem.reach() > 0.0 ? Contact::blocked : usual);
  if (problem.contact == Contact::allowed && problem.reach() > 0.0) {
    throw UsageError(
        fmt::format("@contact: a body that keeps {} from every wall never touches one; 'allowed' needs "
                    "@clearance 0 and a point",
                    problem.reach()));
  }
  return problem;
}

WallProblem keeping_off(const Scene& scene, const Question& question, std::string_view how) {
  if (question.contact == Contact::allowed) {
    throw UsageError(fmt::format("@contact: {}, so 'allowed' would change nothing", how));
  }
  return wall_problem(scene, question);
}

std::vector<double> state_or_heading(std::string_view option, const std::vector<double>& given,
                                     const std::vector<double>& in_file) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  if (state.empty()) throw UsageError(fmt::format("{0}: the world has none; say {0} X,Y or X,Y,THETA", option));
  if (state.size() == 2 || state.size() == 3) return state;
  throw UsageError(fmt::format("{}: expected X,Y or X,Y,THETA (found: {} numbers)", option, state.size()));
}

void check_heading(std::string_view option, const std::vector<double>& state) {
  if (state.size() != 3 || std::abs(state[2]) <= largest_heading) return;
  throw UsageError(fmt::format("{}: a heading is at most {} rad (found: {})", option, largest_heading, state[2]));
}

std::optional<Vec2> plane_point(const std::vector<double>& state) {
  if (state.size() < 2) return std::nullopt;
  return Vec2{state[0], state[1]};
}

void check_plannable(const Scene& scene, const Question& problem) {
  const RobotSpec robot = robot_of(scene, problem);
  const std::string where = problem.robot ? fmt::format("@robot: in {}, ", scene.source) : scene.source + ": ";
  if (problem.goal_pose && !is_arm(robot)) {
    throw UsageError(fmt::format("@goal_pose: is of an arm's tool, and a {} has none; say @goal", name_of(robot.kind)));
  }
  if (is_arm(robot)) {
    if (!is_flat(scene)) return;
    throw UsageError(
        fmt::format("{}an arm plans among spheres and boxes; walls, polygons, places to keep out of, bounds and maps "
                    "have no height: they take a point, disc, polygon or car",
                    problem.prices.keep_out.empty() ? where : "@keep_out: "));
  }
  if (has_solids(scene)) {
    throw UsageError(
        fmt::format("{}a {} plans among walls, polygons and bounds or on a map; {} take an arm (puma560, arm, urdf)",
                    where, name_of(robot.kind), scene.solids.empty() ? "spheres and boxes" : "solids"));
  }
  if (is_unmade(scene) && !is_round(robot)) {
    throw UsageError(fmt::format("{}where walls are made tile by tile a point or disc plans; a {} takes a smaller maze",
                                 where, name_of(robot.kind)));
  }
  if (is_flat(scene)) return;
  throw UsageError(fmt::format("{}nothing confines the {}: the world needs bounds, walls, polygons or a map", where,
                               name_of(robot.kind)));
}

}  // namespace warren
