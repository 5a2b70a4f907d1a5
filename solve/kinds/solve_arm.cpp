// SPDX-License-Identifier: BSD-3-Clause
// Joins ArmWorld with the planners that take it: an arm among spheres and boxes. A goal of three numbers is a place of
// the tool and is met in any posture within the limits: trees have all of them as goals at once, roadmaps try them one
// after the other, the nearest to the start first. Roadmaps join start and goal within a radius that grows. Every
// failure says its cause in the answer's `cause`.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/base/error.hpp"
#include "pictures/draw_arm.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/shorten/shortcut.hpp"
#include "planners/trees/rrt.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "planners/trees/through_way_points.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/question_of_arm.hpp"
#include "solve/question/settled_ends.hpp"
#include "solve/question/solve_steps.hpp"
#include "solve/question/tree_choice.hpp"
#include "solve/question/write_answer_io.hpp"
#include "tools/words/option_values.hpp"
#include "worlds/arms/arm_world.hpp"

namespace warren {
namespace {

constexpr OptionSpec attach_specs[] = {
    {"--attach", "R[,STEP]",
     "arms: join start and goal to a roadmap within R, and while that fails within STEP more, 10 times in all "
     "(default: as far as the K nearest, and half of that)"},
};

GrowingAttach attach_option(const Arguments& arguments) {
  GrowingAttach attach;
  const auto text = arguments.value("--attach");
  if (!text) return attach;
  const std::size_t comma = text->find(',');
  attach.radius = positive_value("--attach", text->substr(0, comma));
  if (comma != std::string::npos) attach.step = positive_value("--attach", text->substr(comma + 1));
  return attach;
}

/// One solve: the steps share the question and fill in the answer.
class ArmSolve {
 public:
  explicit ArmSolve(const SolveRequest& request)
      : request_(request), problem_(arm_problem(request.scene, request.problem, request.execution)) {
    answer_.problem = problem_.general();
    answer_.planner = name_of(request.planner);
    is_roadmap_planner(request.planner) ? describe_roadmap() : describe_trees();
  }

  void run() {
    index();
    plan();
    if (answer_.outcome == Outcome::solved) {
      finish_path();
    } else if (answer_.outcome != Outcome::stopped) {
      answer_.figures.emplace_back("cause", json_string(cause()));
    }
    if (request_.drawing != nullptr) *request_.drawing = arm_drawing(request_.scene, problem_, path_);
  }
  Answer& answer() { return answer_; }

 private:
  const Execution& execution() const { return request_.execution; }
  void describe_roadmap();
  void describe_trees();
  void index();
  void plan();
  void plan_roadmaps();
  void plan_trees();
  std::vector<std::vector<JointState>> stops();
  void take(Solution<JointState> solution);
  bool stands_free(const JointState& q) const;
  void settle_blocked_ends();
  std::string_view cause() const;
  std::string_view cause_of_blocked_goal() const;
  void finish_path();
  void verify();
  double length(const JointState& a, const JointState& b) const;

  const SolveRequest& request_;
  ArmProblem problem_;
  RoadmapOptions roadmap_options_;  // of prm and lazy-prm
  RrtOptions tree_options_;         // of the others
  std::vector<std::vector<double>> via_;
  std::optional<ArmWorld> world_;
  std::vector<JointState> goals_;
  Path<JointState> path_;
  Answer answer_;
};

void ArmSolve::describe_roadmap() {
  const PlannerOptions options = planner_options(request_.arguments, request_.scene, WallProblem{});
  roadmap_options_ = options.roadmap;
  if (sampler_asked(request_.arguments) == SamplerKind::lattice) {
    throw UsageError("--sampler: lattice is for points and discs in mazes; an arm takes the others");
  }
  if (roadmap_options_.sampler == SamplerKind::lattice) roadmap_options_.sampler = SamplerKind::uniform;
  roadmap_options_.attach = attach_option(request_.arguments);
  answer_.sampler = name_of(roadmap_options_.sampler);
  answer_.search = name_of(roadmap_options_.search);
  answer_.seed = roadmap_options_.seed;
  answer_.options = options.given;
  if (const auto attach = request_.arguments.value("--attach")) {
    answer_.options.emplace_back("attach", json_string(*attach));
  }
}

void ArmSolve::describe_trees() {
  tree_options_ = tree_options(request_.arguments);
  via_ = way_points(request_.arguments);
  for (const auto& point : via_) {
    if (point.size() != most_joints) throw UsageError("--via: an arm takes six joint angles a way-point");
  }
  answer_.sampler = sampler_name(tree_options_);
  answer_.seed = tree_options_.seed;
  answer_.options = given_tree_options(request_.arguments);
}

void ArmSolve::index() {
  const StageTimer timer(execution(), "index", answer_.seconds.index);
  const ArmOptions options{.radius = problem_.robot.radius,
                           .clearance = problem_.clearance,
                           .self_collision = problem_.robot.self_collision};
  world_.emplace(request_.scene, SerialChain(problem_.table), options);
  goals_ = goal_states(problem_, world_->chain());
  std::stable_sort(goals_.begin(), goals_.end(), [&](const JointState& a, const JointState& b) {
    return world_->distance(problem_.start, a) < world_->distance(problem_.start, b);
  });
}

void ArmSolve::plan() {
  if (goals_.empty()) {
    answer_.outcome = Outcome::goal_blocked;
    return;
  }
  is_roadmap_planner(request_.planner) ? plan_roadmaps() : plan_trees();
  settle_blocked_ends();
}

/// A goal after the other until one is reached; the work is that of all.
void ArmSolve::plan_roadmaps() {
  const auto planner = request_.planner == PlannerKind::prm ? prm<ArmWorld> : lazy_prm<ArmWorld>;
  std::vector<JointState> goals = detail::free_states(*world_, std::span<const JointState>(goals_));
  if (goals.empty()) goals.push_back(goals_.front());
  Counters before;
  for (const JointState& goal : goals) {
    take(planner(*world_, problem_.start, goal, roadmap_options_, execution(), nullptr));
    answer_.counters += before;
    before = answer_.counters;
    if (answer_.outcome != Outcome::not_connected) break;
  }
}

std::vector<std::vector<JointState>> ArmSolve::stops() {
  std::vector<std::vector<JointState>> stops;
  for (const auto& point : via_) {
    const std::vector<JointState> state{joint_state(point)};
    stops.push_back(detail::free_states(*world_, std::span(state)));
    if (stops.back().empty()) {
      throw UsageError(fmt::format("--via: the arm does not fit at way-point {}", stops.size()));
    }
  }
  stops.push_back(goals_);
  return stops;
}

void ArmSolve::plan_trees() {
  const auto planner = request_.planner == PlannerKind::rrt ? rrt<ArmWorld> : rrt_connect<ArmWorld>;
  const auto plan = [&](const JointState& start, std::span<const JointState> goals, std::size_t) {
    return planner(*world_, start, goals, tree_options_, execution(), nullptr);
  };
  take(plan_through<JointState>(problem_.start, stops(), plan));
}

void ArmSolve::take(Solution<JointState> solution) {
  path_ = std::move(solution.path);
  Solution<Vec2> plane{.outcome = solution.outcome,
                       .stop_reason = solution.stop_reason,
                       .path = {},
                       .roadmap = solution.roadmap,
                       .separation = solution.separation,
                       .counters = solution.counters,
                       .seconds = solution.seconds};
  take_solution(answer_, std::move(plane));
}

/// Planning keeps a little more room than it must, so an arm that fits exactly is no blocked one: nobody proved that.
void ArmSolve::settle_blocked_ends() {
  answer_.outcome = settled_ends(
      answer_.outcome, [&] { return stands_free(problem_.start); },
      [&] { return std::any_of(goals_.begin(), goals_.end(), [&](const JointState& q) { return stands_free(q); }); });
}

bool ArmSolve::stands_free(const JointState& q) const {
  ArmVerifyOptions options = problem_.verify_options();
  options.start.reset();
  options.goal.reset();
  options.goal_place.reset();
  return verify_arm(request_.scene, problem_.table, std::span(&q, 1), options, execution()).verified;
}

std::string_view ArmSolve::cause_of_blocked_goal() const {
  if (goals_.empty()) return "goal_out_of_reach";
  const bool outside = std::all_of(goals_.begin(), goals_.end(), [&](const JointState& q) {
    return world_->chain().joint_outside_limits(q) != most_joints;
  });
  return outside ? "goal_outside_limits" : "goal_in_collision";
}

/// Why there is no path, one word a cause.
std::string_view ArmSolve::cause() const {
  if (answer_.outcome == Outcome::start_blocked) {
    const bool outside = world_->chain().joint_outside_limits(problem_.start) != most_joints;
    return outside ? "start_outside_limits" : "start_in_collision";
  }
  if (answer_.outcome == Outcome::goal_blocked) return cause_of_blocked_goal();
  if (is_roadmap_planner(request_.planner) && answer_.roadmap.milestones <= 2) return "no_free_sample";
  if (answer_.separation.start_size <= 1) return "start_unconnected";
  return answer_.separation.goal_size <= 1 ? "goal_unconnected" : "different_components";
}

double ArmSolve::length(const JointState& a, const JointState& b) const { return world_->distance(a, b); }

void ArmSolve::finish_path() {
  if (request_.arguments.has("--optimise")) {
    const StageTimer timer(execution(), "optimise", answer_.seconds.optimise, path_.size());
    const auto length_of = [this](const JointState& a, const JointState& b) { return length(a, b); };
    answer_.raw_length = path_length(path_, length_of);
    path_ = shortcut_path(*world_, path_, length_of, {.seed = answer_.seed}, execution(), answer_.counters);
    path_ = with_even_idle_joints(*world_, std::move(path_));
  }
  verify();
}

void ArmSolve::verify() {
  const StageTimer timer(execution(), "verify", answer_.seconds.verify, path_.size());
  const Verification found = verify_arm(request_.scene, problem_.table, path_, problem_.verify_options(), execution());
  if (!found.verified) fail_verification(answer_, found.first_violation);
  answer_.verified = true;
  answer_.length = found.length;
  answer_.min_clearance = found.min_clearance;
  answer_.states.width = most_joints;
  for (const JointState& q : path_) {
    const Vec3 tool = world_->chain().tool_pose(q).translation();
    answer_.path.push_back({tool.x(), tool.y()});
    answer_.states.add(q);
  }
}

constexpr std::string_view arm_roadmap_options =
    "--sampler --samples --neighbours --radius --attach --search --queue --optimise";
constexpr std::string_view lazy_options =
    "--sampler --samples --neighbours --radius --attach --search --queue --lazy --optimise";
constexpr PlannerChoice arm_planners[] = {{PlannerKind::rrt_connect, rrt_connect_options},
                                          {PlannerKind::rrt, rrt_options},
                                          {PlannerKind::prm, arm_roadmap_options},
                                          {PlannerKind::lazy_prm, lazy_options}};

std::span<const OptionSpec> arm_option_specs() {
  static const std::vector<OptionSpec> specs = [] {
    std::vector<OptionSpec> all(attach_specs, attach_specs + std::size(attach_specs));
    all.insert(all.end(), tree_option_specs().begin(), tree_option_specs().end());
    return all;
  }();
  return specs;
}

bool fits_arm(const Scene&, const RobotSpec& robot) { return is_arm(robot); }

PlannerKind usual_arm_planner(const Arguments&, const Scene&, const ProblemOptions&) {
  return PlannerKind::rrt_connect;
}

Answer solve_arm(const SolveRequest& request) {
  ArmSolve arm(request);
  answer_within_limits(arm.answer(), [&] { arm.run(); });
  return std::move(arm.answer());
}

Verdict recheck_arm(const Scene& scene, const ProblemOptions& options, const RecordedAnswer& answer,
                    const Execution& execution) {
  check_state_width(answer, most_joints, "an arm");
  const ArmProblem problem = arm_problem(scene, options, execution);
  Path<JointState> path;
  for (std::size_t i = 0; i < answer.states.size(); ++i) path.push_back(joint_state(answer.states[i]));
  const Verification found = verify_arm(scene, problem.table, path, problem.verify_options(), execution);
  return {found, problem.general()};
}

}  // namespace

SolveKind arm_kind() {
  return {"an arm", fits_arm, arm_planners, arm_option_specs(), usual_arm_planner, solve_arm, nullptr, recheck_arm};
}

}  // namespace warren
