// SPDX-License-Identifier: BSD-3-Clause
// Lower bounds, proved: no path of a problem is shorter, whoever plans it. What is proved of which body, why, and what
// rounding is allowed for: docs/algorithms.md, "Lower bounds"; beside it 1e-12 for lengths of car's curves and 1e-9 for
// the reach of an arm, which have longer formulae. Beyond largest_bounded_corners, and where time or memory end, the
// simple bound is left.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "planners/grid/price_potential.hpp"
#include "planners/visibility/disc_path.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/question/question_of_arm.hpp"
#include "worlds/arms/arm_kinematics.hpp"
#include "worlds/poses/steering_curve.hpp"
#include "worlds/prices/map_prices.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

/// The sum of so many legs without what rounding may have added.
double below_rounding(double sum, std::size_t legs) {
  return sum * (1.0 - 0x1p-48 - 0x1p-50 * static_cast<double>(std::min(legs, std::size_t{1} << 40)));
}

/// A map's blocked cells are closed by their borders: what keeps off the cells crosses none of these, and borders that
/// meet at a corner let nothing through. Who starts on water may stay there.
std::vector<Segment> borders_from(const OccupancyMap& map, Vec2 start, const Execution& execution) {
  if (map.water.empty()) return border_walls(map, execution);
  execution.reserve(2 * map.blocked.size() / 8);
  OccupancyMap closed = map;
  closed.blocked = closed_cells(map, start);
  return border_walls(closed, execution);
}

/// Of what the reference point can't pass; nothing where that has too many corners.
std::optional<PlaneObstacles> bounding_obstacles(const Scene& scene, Vec2 start, const Execution& execution) {
  if (scene.map && scene.walls.size() == 0) {
    PlaneObstacles borders;
    borders.walls = borders_from(*scene.map, start, execution);
    if (2 * borders.walls.size() > largest_bounded_corners) return std::nullopt;
    return borders;
  }
  if (corner_count(scene) > largest_bounded_corners) return std::nullopt;
  return plane_obstacles(scene, execution);
}

/// The shortest way of a disc's middle, rounded down; nothing where it isn't found. A point may touch what it goes
/// around, so that its way is not longer than any that keeps off.
std::optional<double> shortest_way(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, double radius,
                                   const Execution& execution) {
  if (radius > 0.0) {
    const DiscGround ground(obstacles, execution);
    const double length = shortest_disc_path(ground, start, goal, radius, execution).lower_bound;
    return std::isfinite(length) ? std::optional(length) : std::nullopt;
  }
  const VisibilityOptions options{.lazy = true};
  const Solution<Vec2> found = confined_visibility_path(obstacles, start, goal, options, execution);
  if (found.outcome != Outcome::solved) return std::nullopt;
  const double length = path_length(found.path, [](Vec2 a, Vec2 b) { return distance(a, b); });
  return below_rounding(length, found.roadmap.milestones);
}

double least_way(const Scene& scene, const Problem& problem, BoundEffort effort, const Execution& execution) {
  const Vec2 start{problem.start[0], problem.start[1]};
  const Vec2 goal{problem.goal[0], problem.goal[1]};
  const double straight = below_rounding(distance(start, goal), 1);
  const std::optional<double> radius = held_radius(problem.robot);
  if (effort == BoundEffort::simple || !radius || straight == 0.0 || is_unmade(scene)) return straight;
  Execution quiet = execution.quiet();
  quiet.account = nullptr;  // its stages are none of the answer's
  double least = straight;
  stopped_by([&] {
    const std::optional<PlaneObstacles> obstacles = bounding_obstacles(scene, start, quiet);
    if (!obstacles) return;
    // A disc may go around a map's outermost cells, as far from them as the map is wide: there its middle counts alone.
    const double kept = scene.map ? 0.0 : *radius + problem.clearance;
    least = std::max(straight, shortest_way(*obstacles, start, goal, kept, quiet).value_or(0.0));
  });
  return least;
}

bool names_heading(const Problem& problem) { return problem.start.size() == 3 && problem.goal.size() == 3; }

/// On any path the ways (of the reference point, of the weighed turn) add up to a vector that is at least (way, turn).
double with_turn(double way, const Problem& problem) {
  if (!names_heading(problem)) return way;
  constexpr double rounding_rad = 1e-12;  // of headings that were turned by full turns
  const double turn = std::abs(turn_between(problem.start[2], problem.goal[2])) - rounding_rad;
  const double weighed = extent_of(problem.robot) * std::max(0.0, turn);
  return below_rounding(std::sqrt(way * way + weighed * weighed), 1);
}

/// Without obstacles; a goal without heading may be met in the best.
double free_curve(const Problem& problem) {
  if (!names_heading(problem) || problem.robot.steering == SteeringKind::differential) return 0.0;
  const Se2 start{problem.start[0], problem.start[1], problem.start[2]};
  const Se2 goal{problem.goal[0], problem.goal[1], problem.goal[2]};
  const double radius = problem.robot.turning_radius;
  const auto shortest =
      problem.robot.steering == SteeringKind::dubins ? DubinsCurve::shortest : ReedsSheppCurve::shortest;
  // Rounding of the curve, and of poses along it where these are far from the origin.
  const double places = std::abs(start.x) + std::abs(start.y) + std::abs(goal.x) + std::abs(goal.y) +
                        radius * (std::abs(start.theta) + std::abs(goal.theta));
  return std::max(0.0, radius * shortest(start, goal, radius).length * (1.0 - 1e-12) - 0x1p-46 * places);
}

/// In joint space. A tool whose place is the goal goes no farther than its distance from each axis times the turn about
/// it, all told: so its way is at most the root of the sum of these distances' squares times the way in joint space.
double least_turns(const ArmModel& model, const Problem& problem, const std::vector<double>& goal) {
  const JointState start = joint_state(problem.start);
  double sum = 0.0;
  if (!problem.goal_pose && goal.size() == model.variables.size()) {
    for (std::size_t j = 0; j < goal.size(); ++j) {
      const double way = variable_way(model.variables[j], start[j], goal[j]);
      sum += way * way;
    }
    return below_rounding(std::sqrt(sum), most_joints);
  }
  const ArmKinematics kinematics(model);
  for (std::size_t j = 0; j < model.variables.size(); ++j) {
    const double reach = kinematics.tool_reach(j);
    sum += reach * reach;
  }
  const Vec3 place = problem.goal_pose ? Vec3(problem.goal_pose->translation()) : Vec3(goal[0], goal[1], goal[2]);
  constexpr double tolerance = 1e-9;  // of the judge, and more than what rounding does to either
  const double way = (place - kinematics.tool_pose(start).translation()).norm();
  return sum > 0.0 ? std::max(0.0, way - tolerance) / std::sqrt(sum) * (1.0 - tolerance) : 0.0;
}

/// To the goal that is nearest by that.
double least_turns(const Problem& problem, const Execution& execution) {
  const ArmModel model = arm_model_of(problem.robot, problem.clearance, execution);
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& goal : problem.rule.goals(problem.goal))
    least = std::min(least, least_turns(model, problem, goal));
  return least;
}

/// Beyond, cells are not cut any smaller.
constexpr std::uint64_t most_parts_of_cells = std::uint64_t{1} << 26U;

/// May the path end at another place than that of a goal, or with another heading? Others may be as near then.
bool ends_near(const Answer& answer) {
  return answer.goal_reached && (answer.goal_reached->distance > 0.0 || answer.problem.rule.heading_rad);
}

bool has_one_way(const Problem& problem) {
  const GoalRule& rule = problem.rule;
  return rule.others.empty() && !rule.region && rule.visit.empty() && !rule.back && problem.start.size() == 2 &&
         problem.goal.size() == 2;
}

struct Proved {
  double bound = 0.0;
  CellPotential proof;
};

Proved proved_by_potential(const Answer& answer, const OccupancyMap& map, std::optional<double> gap,
                           const Execution& execution) {
  const Problem& problem = answer.problem;
  const Vec2 start{problem.start[0], problem.start[1]};
  const Vec2 goal{problem.goal[0], problem.goal[1]};
  const Bitmap closed = closed_cells(map, start);
  const double radius = problem.robot.radius / map.cell;
  PotentialQuestion question{closed, map_point(map, start), map_point(map, goal), radius + problem.clearance / map.cell,
                             radius};
  if (const auto& clearance = problem.prices.clearance; clearance && clearance->price > 0.0) {
    question.price = clearance->price;
    question.reach = clearance_reach(*clearance, problem.robot.radius) / map.cell;
  }
  const double cost = answer.cost.value_or(answer.length);
  const double enough = gap ? cost / (1.0 + *gap) / map.cell : 0.0;
  const std::uint32_t most_parts = gap ? 3 : 2;
  // A place in cells is rounded by less than this times its distance from the origin.
  constexpr double misplaced = 1e-13;
  const double lost =
      misplaced * (norm(start) + norm(goal) + 2.0 * norm(map.origin) + 2.0 * map.cell) * (1.0 + question.price);
  Proved best;
  stopped_by([&] {
    for (std::uint32_t parts = 1; parts <= most_parts && closed.size() * parts * parts <= most_parts_of_cells;
         ++parts) {
      auto found = price_potential(question, {.parts = parts, .sweeps = 12, .enough = enough}, execution);
      if (!found) return;
      const double bound = found->bound * map.cell * (1.0 - 1e-10) - lost;
      if (!(bound > best.bound)) continue;
      for (double& value : found->values.values) value *= map.cell;
      best = {bound, std::move(found->values)};
      if (gap && best.bound >= enough * map.cell) return;
    }
  });
  return best;
}

}  // namespace

double proved_bound(const Scene& scene, const Problem& problem, BoundOf of, BoundEffort effort,
                    const Execution& execution) {
  if (is_arm(problem.robot)) return least_turns(problem, execution);
  const double way = least_way(scene, problem, effort, execution);
  if (problem.robot.kind == RobotKind::car) return std::max(way, free_curve(problem));
  return of == BoundOf::metric && problem.robot.kind == RobotKind::polygon ? with_turn(way, problem) : way;
}

void tell_bound(Answer& answer, const Scene& scene, const SolveOptions& options, const Execution& execution) {
  if (options.bound && figure_named(answer.options, "bound") == nullptr) answer.options.push_back({"bound", true});
  if (!answer.verified || !options.trees.via.empty()) return;
  const GoalRule& rule = answer.problem.rule;
  const bool is_open = rule.region || ends_near(answer) || (!rule.others.empty() && !is_arm(answer.problem.robot));
  if (!answer.lower_bound && !answer.optimal && is_open) return;  // another goal may be nearer
  const double cost = answer.cost.value_or(answer.length);
  if (answer.lower_bound) {  // the planner's own
  } else if (answer.optimal) {
    answer.lower_bound = below_rounding(cost, answer.roadmap.milestones);
  } else {
    const bool in_metric = gets_better(enum_named<PlannerKind>(answer.planner).value_or(PlannerKind::prm));
    if (answer.cost && !answer.price && !in_metric) return;
    const bool exact = options.bound || options.anytime.gap;
    std::optional<StageTimer> timer;
    if (exact) timer.emplace(execution, "bound", nullptr);
    answer.lower_bound = proved_bound(scene, answer.problem, in_metric ? BoundOf::metric : BoundOf::length,
                                      exact ? BoundEffort::exact : BoundEffort::simple, execution);
  }
  if (answer.price && answer.bound_of.empty()) answer.bound_of = "all";
  constexpr double rounding = 1e-9;
  answer.optimal |= cost - *answer.lower_bound <= rounding * cost;
}

void prove_on_map(Answer& answer, const Scene& scene, const SolveOptions& options, ByProducts* keep,
                  const Execution& execution) {
  const bool keeps = keep != nullptr && keep->wants_certificate;
  const std::optional<double> gap = options.anytime.gap;
  if (!(options.bound || gap || keeps) || !answer.verified || !scene.map || !is_round(answer.problem.robot)) return;
  if (answer.planner != name_of(PlannerKind::grid) || !options.trees.via.empty() || !has_one_way(answer.problem) ||
      ends_near(answer))
    return;
  const StageTimer timer(execution, "bound", nullptr, scene.map->blocked.size());
  if (!answer.price) answer.cost.reset();  // in steps: what is bounded is the length
  const double cost = answer.cost.value_or(answer.length);
  double bound = answer.lower_bound.value_or(0.0);
  bound = std::max(bound, proved_bound(scene, answer.problem, BoundOf::length, BoundEffort::exact, execution));
  const bool is_reached = gap && cost <= bound * (1.0 + *gap);
  if (keeps || !is_reached) {
    Proved proved = proved_by_potential(answer, *scene.map, gap, execution);
    bound = keeps ? proved.bound : std::max(bound, proved.bound);
    if (keeps && !proved.proof.values.empty()) keep->certificate = std::move(proved.proof);
  }
  answer.lower_bound = bound;
  answer.bound_of = "all";
  constexpr double rounding = 1e-9;
  answer.optimal = cost - bound <= rounding * cost;
}

}  // namespace warren
