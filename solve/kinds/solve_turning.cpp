// SPDX-License-Identifier: BSD-3-Clause
// A polygon among walls, polygons and bounds, or on a map: joins Se2World with the planners that turn it, and has those
// that keep it at one angle.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "worlds/plane/polygon_world.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {
namespace {

/// Verifies the path of a polygon that may turn, whichever planner found it, and fills it into the answer with what is
/// said of it. A leg of about half a turn, which could be read either way, gets a pose in its middle. Throws as
/// take_verdict().
void judge_polygon(const PoseJudge& judge, const Path<Se2>& path, Answer& answer) {
  constexpr double most_rad = 3.0;
  Path<Se2> poses;
  for (const Se2& pose : path) {
    if (!poses.empty() && std::abs(turn_between(poses.back().theta, pose.theta)) > most_rad) {
      poses.push_back(interpolate(Se2(poses.back()), pose, 0.5));
    }
    poses.push_back(pose);
  }
  const StageTimer timer(judge.execution, "verify", answer.seconds.verify, poses.size());
  take_poses(answer, judge.judged(poses, verify_options(judge.problem)), poses);
}

class TurningPolygon : public PoseBody {
 public:
  using World = Se2World;
  static constexpr bool has_cost = true;

  explicit TurningPolygon(const SolveRequest& request)
      : PoseBody(request, pose_problem(request.scene, request.question)) {}

  /// The same both ways to the last bit.
  MotionLength<Se2> price_motions(const World& world) const {
    if (!pose_prices_->is_priced()) return {};
    return [&world, &prices = *pose_prices_](const Se2& a, const Se2& b) {
      auto query = world.make_query();
      const bool is_forward = std::tie(a.x, a.y, a.theta) <= std::tie(b.x, b.y, b.theta);
      const Se2& from = is_forward ? a : b;
      const Se2& to = is_forward ? b : a;
      return world.distance(from, to) + prices.over(world, distance(a.position(), b.position()), query,
                                                    [&](double t) { return world.interpolate(from, to, t); });
    };
  }
  void index(std::optional<World>& world, SamplerKind) const {
    world.emplace(scene_, problem_.robot.outline, problem_.clearance, execution_);
  }
  static double length(const World&, const Se2& a, const Se2& b) { return distance(a.position(), b.position()); }
  Path<Se2> shortened(const World& world, Path<Se2> path, Answer& answer) const {
    if (const auto cost = price_motions(world)) return shortcut(world, std::move(path), cost, answer);
    const auto plane_length = [&](const Se2& a, const Se2& b) { return length(world, a, b); };
    return shortcut(world, std::move(path), plane_length, answer);
  }
  void judge(const World&, const Path<Se2>& path, Answer& answer) const { judge_polygon(pose_judge(), path, answer); }
};

constexpr AskedWords turning_words = restriction_words | pose_choice_words;
constexpr PlannerChoice turning_planners[] = {{PlannerKind::rrt_connect, rrt_connect_options, turning_words},
                                              {PlannerKind::rrt, rrt_options, turning_words},
                                              {PlannerKind::prm, prm_takes, price_words | turning_words},
                                              {PlannerKind::lazy_prm, lazy_prm_takes, price_words | turning_words},
                                              {PlannerKind::rrt_star, rrt_star_options, turning_words},
                                              {PlannerKind::informed_rrt_star, rrt_star_options, turning_words},
                                              {PlannerKind::anytime, anytime_options, turning_words}};

bool fits_turning(const Scene&, const RobotSpec& robot) { return robot.kind == RobotKind::polygon; }

PoseJudge judge_of(const SolveRequest& request, const PoseProblem& problem) {
  return {request.scene, problem, request.execution, request.asked.judged()};
}

/// Of a planner that doesn't turn the body on its way.
Path<Se2> poses_along(const Path<Vec2>& path, double heading) {
  Path<Se2> poses;
  for (const Vec2 p : path) poses.push_back({p.x, p.y, heading});
  return poses;
}

// The planner voronoi for a polygon that could turn: along the medial axis of the scene, or the skeleton of a map, with
// the disc that holds the body in any heading, so the heading of the start serves all the way; where the goal names
// another, the body turns when it is there. A body that fits only in some headings is not found a way: not_connected.

constexpr PlannerChoice turning_axis_planners[] = {
    {PlannerKind::voronoi, OptionSet{Option::objective, Option::search, Option::queue, Option::bound},
     restriction_words | AskedWords{AskedWord::goal}}};

/// What `solve` makes of the same question for the disc that holds the body.
template <class Solve>
auto of_disc(const SolveRequest& request, Solve solve) {
  const PoseProblem problem = pose_problem(request.scene, request.question);
  Question disc;
  disc.robot = RobotSpec{.kind = RobotKind::disc, .radius = extent_of(problem.robot), .outline = {}};
  disc.start = {problem.start.x, problem.start.y};
  disc.goal = {problem.goal[0], problem.goal[1]};
  disc.clearance = problem.clearance;
  SolveRequest asked{request.options,   request.scene, disc,         request.planner,
                     request.execution, request.keep,  request.asked};
  asked.many = request.many;
  return solve(asked);
}

/// A disc that starts on water may stay there, a polygon may not.
void check_ends_on_map(const PoseJudge& judge, Answer& answer) {
  const Se2& start = judge.problem.start;
  const Vec2 goal = answer.path.back();
  if (!judge.stands_free(start)) {
    answer.outcome = Outcome::start_blocked;
  } else if (!judge.stands_free({goal.x, goal.y, start.theta})) {
    answer.outcome = Outcome::goal_blocked;
  }
}

/// In steps of at most a third of a turn, so that the way round is never in doubt.
void turn_at_the_goal(const PoseProblem& problem, Path<Se2>& poses) {
  if (problem.any_heading()) return;
  constexpr double most_rad = 2.0 * std::numbers::pi / 3.0;
  const double turn = turn_between(problem.start.theta, problem.goal[2]);
  const auto steps = static_cast<int>(std::ceil(std::abs(turn) / most_rad));
  for (int i = 1; i <= steps; ++i) {
    const double theta = i == steps ? problem.goal[2] : problem.start.theta + turn * i / steps;
    poses.push_back({problem.goal[0], problem.goal[1], theta});
  }
}

/// The disc doesn't fit; the body may.
void settle_blocked_ends(const PoseJudge& judge, Answer& answer) {
  const bool at_start = answer.outcome == Outcome::start_blocked;
  const bool is_settled = !is_blocked(answer.outcome);
  answer.outcome = judge.settled(answer.outcome);
  if (is_settled || is_blocked(answer.outcome)) return;
  if (judge.problem.is_at_goal()) {
    answer.outcome = Outcome::solved;
    answer.path = {judge.problem.start.position(), judge.problem.goal_pose().position()};
    return;
  }
  answer.figures.push_back({"cause", std::string(at_start ? "disc_blocked_at_start" : "disc_blocked_at_goal")});
}

Answer solve_along_axis(const SolveRequest& request) {
  const PoseProblem problem = pose_problem(request.scene, request.question);
  Answer answer = of_disc(request, request.scene.map ? solve_on_skeleton : solve_on_medial_axis);
  answer.problem = problem.general();
  if (answer.outcome == Outcome::stopped) return answer;
  const double seconds = answer.solve_s;
  answer_within_limits(answer, [&] {
    const PoseJudge judge = judge_of(request, problem);
    if (answer.outcome != Outcome::solved) settle_blocked_ends(judge, answer);
    if (answer.outcome == Outcome::solved && request.scene.map) check_ends_on_map(judge, answer);
    if (answer.outcome != Outcome::solved) return;
    Path<Se2> poses = poses_along(answer.path, problem.start.theta);
    turn_at_the_goal(problem, poses);
    judge_polygon(judge, poses, answer);
  });
  answer.solve_s += seconds;
  return answer;
}

// The planners that don't turn a polygon, in scenes: on maps, whose cells all touch, they have none. By so little as
// the body keeps off the obstacles (docs/algorithms.md), times the corners that it passes, the path may be longer than
// the shortest.

double world_size(const Scene& scene, const std::vector<Vec2>& outline, const Execution& execution) {
  Box box = obstacle_box(scene, execution);
  if (scene.bounds) box.include(*scene.bounds);
  double largest = outline_reach(outline);
  if (box.empty()) return largest;
  for (const double c : {box.min.x, box.min.y, box.max.x, box.max.y}) largest = std::max(largest, std::abs(c));
  return largest;
}

/// Is there any place where the body, at the start's angle, has its room in the bounds?
bool fits_in_bounds(const std::optional<Box>& bounds, const PoseProblem& problem, double room) {
  if (!bounds) return true;
  Box body;
  for (const Vec2 p : problem.robot.outline) body.include(placed({0.0, 0.0, problem.start.theta}, p));
  return body.width() + 2.0 * room < bounds->width() && body.height() + 2.0 * room < bounds->height();
}

/// The way of the reference point, through cells or, without, by the visibility graph. A body that does not fit in the
/// bounds at this angle starts blocked.
Solution<Vec2> plan_at_fixed_angle(const SolveRequest& request, const PoseProblem& problem,
                                   const std::optional<CellOptions>& cells, Answer& answer) {
  const std::vector<Vec2>& outline = problem.robot.outline;
  const double room = problem.clearance + 1e-10 * world_size(request.scene, outline, request.execution);
  const std::size_t disc_corners = problem.clearance > 0.0 ? 32 : 4;  // of a polygon around the clearance's disc
  Solution<Vec2> solution;
  solution.outcome = Outcome::start_blocked;
  if (!fits_in_bounds(request.scene.bounds, problem, 2.0 * room)) return solution;
  PlaneObstacles obstacles;
  {
    const StageTimer timer(request.execution, "index", answer.seconds.index);
    obstacles =
        translation_obstacles(request.scene, outline, problem.start.theta, room, disc_corners, request.execution);
  }
  const Vec2 start = problem.start.position();
  const Vec2 goal = problem.goal_pose().position();
  CellPlan plan;
  solution = cells ? plan_through_cells(obstacles, start, goal, *cells, request.execution, &plan)
                   : visibility_path(obstacles, start, goal, {}, request.execution);
  if (request.keep == nullptr) return solution;
  if (cells) request.keep->lines.push_back(doors_of(plan.cells, request.execution));
  request.keep->lines.push_back({"blocked", std::move(obstacles.polygons), true});
  return solution;
}

Answer solve_at_fixed_angle(const SolveRequest& request) {
  const PoseProblem problem = pose_problem(request.scene, request.question);
  constexpr double same_rad = 1e-9;
  if (!problem.any_heading() && !(std::abs(turn_between(problem.start.theta, problem.goal[2])) <= same_rad)) {
    throw UsageError(fmt::format("@planner: {} does not turn the body; start and goal have different angles",
                                 name_of(request.planner)));
  }
  const SearchChoice search = search_choice(request.options);
  Answer answer;
  answer.problem = problem.general();
  answer.planner = name_of(request.planner);
  answer.search = name_of(search.search);
  std::optional<CellOptions> cells;
  if (request.planner == PlannerKind::cells) {
    cells = cell_options(request.options, search);
    cells->overlaps = Overlaps::united;
    answer.options.push_back({"doors", std::string(name_of(cells->doors))});
  }
  answer_within_limits(answer, [&] {
    const Solution<Vec2> solution = plan_at_fixed_angle(request, problem, cells, answer);
    if (cells) answer.cells = CellCount{solution.roadmap.milestones, solution.roadmap.edges};
    take_account(answer, solution);
    const PoseJudge judge = judge_of(request, problem);
    answer.outcome = judge.settled(answer.outcome);
    const Path<Se2> poses = poses_along(solution.path, problem.start.theta);
    if (answer.outcome == Outcome::solved) judge_polygon(judge, poses, answer);
  });
  return answer;
}

constexpr AskedWords fixed_words = restriction_words | AskedWords{AskedWord::goal};
constexpr PlannerChoice fixed_angle_planners[] = {
    {PlannerKind::visibility, {Option::bound}, fixed_words},
    {PlannerKind::cells, {Option::doors, Option::search, Option::queue, Option::bound}, fixed_words}};

bool fits_fixed_angle(const Scene& scene, const RobotSpec& robot) { return fits_turning(scene, robot) && !scene.map; }

}  // namespace

SolveKind turning_kind() {
  return {"a polygon that turns",
          fits_turning,
          turning_planners,
          usually<PlannerKind::rrt_connect>,
          solve_sampled<TurningPolygon>,
          recheck_poses,
          build_sampled<TurningPolygon>,
          open_sampled<TurningPolygon>};
}

SolveKind turning_axis_kind() {
  return {"a polygon along the medial axis",
          fits_turning,
          turning_axis_planners,
          usually<PlannerKind::voronoi>,
          solve_along_axis,
          nullptr,
          [](const SolveRequest& request) { return of_disc(request, build_geometric); },
          [](const SolveRequest& request, const RoadmapArrays& arrays, const ConnectionRule& rule) {
            return of_disc(request, [&](const SolveRequest& disc) { return open_geometric(disc, arrays, rule); });
          }};
}

SolveKind fixed_angle_kind() {
  return {"a polygon at a fixed angle", fits_fixed_angle, fixed_angle_planners, usually<PlannerKind::visibility>,
          solve_at_fixed_angle};
}

}  // namespace warren
