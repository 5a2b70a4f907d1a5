// SPDX-License-Identifier: BSD-3-Clause
// Joins Se2World with the planners that take it: a polygon that turns among walls, polygons and bounds, or on a map.

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "core/plane/se2.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/pose_body.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/sampled_roadmap.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {
namespace {

class TurningPolygon : public PoseBody {
 public:
  using World = Se2World;
  static constexpr bool has_cost = true;

  explicit TurningPolygon(const SolveRequest& request)
      : PoseBody(request, pose_problem(request.scene, request.question, turning_body)),
        prices_(std::make_unique<PosePrices>(scene_, prices_of(scene_, request.question), problem_.clearance)) {}

  MotionLength<Se2> price_motions(const World& world) const { return motion_cost(world, *prices_); }
  void index(std::optional<World>& world, SamplerKind) const {
    world.emplace(scene_, problem_.robot.outline, Se2Options{.clearance = problem_.clearance}, execution_);
  }
  bool start_stands_free() const { return goal_stands_free(problem_.start); }
  bool goal_stands_free(const Se2& pose) const {
    return turning_stands_free(scene_, problem_, pose, execution_, judged_);
  }
  static double length(const World&, const Se2& a, const Se2& b) { return distance(a.position(), b.position()); }
  Path<Se2> shortened(const World& world, Path<Se2> path, Answer& answer) const {
    if (const auto cost = price_motions(world)) return shortcut(world, std::move(path), cost, answer);
    const auto plane_length = [&](const Se2& a, const Se2& b) { return length(world, a, b); };
    return shortcut(world, std::move(path), plane_length, answer);
  }
  void judge(const World&, const Path<Se2>& path, Answer& answer) const {
    judge_turning(scene_, problem_, path, execution_, answer, judged_);
  }

 private:
  std::unique_ptr<PosePrices> prices_;  // motions refer to it
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

// The planner voronoi for a polygon that could turn: along the medial axis of the scene, or the skeleton of a map, with
// the disc that holds the body in any heading, so the heading of the start serves all the way; where the goal names
// another, the body turns when it is there. A body that fits only in some headings is not found a way: not_connected.

constexpr PlannerChoice turning_axis_planners[] = {
    {PlannerKind::voronoi, OptionSet{Option::objective, Option::search, Option::queue, Option::bound},
     restriction_words | AskedWords{AskedWord::goal}}};

/// The same question for the disc that holds the body.
Question question_of_disc(const PoseProblem& problem) {
  Question options;
  options.robot = RobotSpec{.kind = RobotKind::disc, .radius = extent_of(problem.robot), .outline = {}};
  options.start = {problem.start.x, problem.start.y};
  options.goal = {problem.goal[0], problem.goal[1]};
  options.clearance = problem.clearance;
  return options;
}

SolveRequest request_of_disc(const SolveRequest& request, const Question& disc) {
  SolveRequest of_disc{request.options,   request.scene, disc,         request.planner,
                       request.execution, request.keep,  request.asked};
  of_disc.many = request.many;
  return of_disc;
}

class AxisSolve {
 public:
  explicit AxisSolve(const SolveRequest& request)
      : request_(request), problem_(pose_problem(request.scene, request.question, turning_body)) {}

  Answer run() {
    const Question disc = question_of_disc(problem_);
    const SolveRequest of_disc = request_of_disc(request_, disc);
    answer_ = request_.scene.map ? solve_on_skeleton(of_disc) : solve_on_medial_axis(of_disc);
    answer_.problem = problem_.general();
    if (answer_.outcome == Outcome::stopped) return std::move(answer_);
    const double seconds = answer_.solve_s;
    answer_within_limits(answer_, [&] { finish(); });
    answer_.solve_s += seconds;
    return std::move(answer_);
  }

 private:
  bool stands_free(const Se2& pose) const {
    return turning_stands_free(request_.scene, problem_, pose, request_.execution, request_.asked.judged());
  }
  void finish() {
    if (answer_.outcome != Outcome::solved) settle_blocked_ends();
    if (answer_.outcome == Outcome::solved && request_.scene.map) check_ends_on_map();
    if (answer_.outcome != Outcome::solved) return;
    for (const Vec2 p : answer_.path) poses_.push_back({p.x, p.y, problem_.start.theta});
    turn_at_the_goal();
    judge_turning(request_.scene, problem_, poses_, request_.execution, answer_, request_.asked.judged());
  }

  /// A disc that starts on water may stay there, a polygon may not.
  void check_ends_on_map() {
    const Vec2 goal = answer_.path.back();
    if (!stands_free(problem_.start)) {
      answer_.outcome = Outcome::start_blocked;
    } else if (!stands_free({goal.x, goal.y, problem_.start.theta})) {
      answer_.outcome = Outcome::goal_blocked;
    }
  }

  /// In steps of at most a third of a turn, so that the way round is never in doubt.
  void turn_at_the_goal() {
    if (problem_.any_heading()) return;
    constexpr double most_rad = 2.0 * std::numbers::pi / 3.0;
    const double turn = turn_between(problem_.start.theta, problem_.goal[2]);
    const auto steps = static_cast<int>(std::ceil(std::abs(turn) / most_rad));
    for (int i = 1; i <= steps; ++i) {
      const double theta = i == steps ? problem_.goal[2] : problem_.start.theta + turn * i / steps;
      poses_.push_back({problem_.goal[0], problem_.goal[1], theta});
    }
  }

  /// The disc doesn't fit; the body may.
  void settle_blocked_ends() {
    const bool at_start = answer_.outcome == Outcome::start_blocked;
    const bool is_settled = !is_blocked(answer_.outcome);
    settle_blocked_poses(answer_, request_.scene, problem_, request_.execution,
                         [this](const Se2& pose) { return stands_free(pose); });
    if (is_settled || is_blocked(answer_.outcome)) return;
    if (problem_.is_at_goal()) {
      answer_.outcome = Outcome::solved;
      answer_.path = {problem_.start.position(), problem_.goal_pose().position()};
      return;
    }
    answer_.figures.push_back({"cause", std::string(at_start ? "disc_blocked_at_start" : "disc_blocked_at_goal")});
  }

  const SolveRequest& request_;
  PoseProblem problem_;
  Path<Se2> poses_;
  Answer answer_;
};

Answer solve_turning_axis(const SolveRequest& request) { return AxisSolve(request).run(); }

BuiltArrays build_turning_axis(const SolveRequest& request) {
  const Question disc = question_of_disc(pose_problem(request.scene, request.question, turning_body));
  return build_geometric(request_of_disc(request, disc));
}

std::unique_ptr<RoadmapSession> open_turning_axis(const SolveRequest& request, const RoadmapArrays& arrays,
                                                  const ConnectionRule& rule) {
  const Question disc = question_of_disc(pose_problem(request.scene, request.question, turning_body));
  return open_geometric(request_of_disc(request, disc), arrays, rule);
}

}  // namespace

SolveKind turning_kind() {
  return {"a polygon that turns",
          fits_turning,
          turning_planners,
          usually<PlannerKind::rrt_connect>,
          solve_sampled<TurningPolygon>,
          recheck_turning,
          build_sampled<TurningPolygon>,
          open_sampled<TurningPolygon>};
}

SolveKind turning_axis_kind() {
  return {"a polygon along the medial axis",
          fits_turning,
          turning_axis_planners,
          usually<PlannerKind::voronoi>,
          solve_turning_axis,
          nullptr,
          build_turning_axis,
          open_turning_axis};
}

}  // namespace warren
