// SPDX-License-Identifier: BSD-3-Clause
// Joins ArmWorld with the planners that take it: an arm among convex solids. A goal of three numbers is a place of the
// tool and is met in any posture within the limits.

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question_of_arm.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/convex_motion.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

class Arm : public UsualBody<ArmProblem> {
 public:
  using World = ArmWorld;

  explicit Arm(const SolveRequest& request)
      : UsualBody(request, arm_problem(request.scene, request.question, request.execution)) {}

  /// A place of the tool is met in any posture within the limits; the nearest to the start come first.
  std::vector<JointState> goals(const World& world) {
    std::vector<JointState> goals = postures(world);
    std::ranges::stable_sort(goals, [&](const JointState& a, const JointState& b) {
      return world.distance(problem_.start, a) < world.distance(problem_.start, b);
    });
    return goals;
  }
  std::uint64_t goals_tried() const { return tried_; }
  bool knows_all_goals() const { return knows_all_; }
  static SamplerKind choose_sampler(const SolveOptions& options, const RoadmapOptions& roadmap) {
    if (options.sampler == SamplerKind::lattice) {
      throw UsageError("@sampler: lattice is for points and discs in mazes; an arm takes the others");
    }
    return roadmap.sampler == SamplerKind::lattice ? SamplerKind::uniform : roadmap.sampler;
  }
  /// Start and goal are joined within a radius that grows.
  static std::optional<GrowingAttach> attach(const SolveOptions& options) {
    return options.roadmap.attach.value_or(GrowingAttach{});
  }
  /// Of arms of files, as bench/arm_problems.cpp has it: by sampler and step the 95th of a hundred problems takes a
  /// ninth of the time, by the domain a mean one half of that, or less; of 14 joints by `moving` a sixth.
  void suit(RrtOptions& options) const {
    constexpr double usual_step = 1.0;
    constexpr double usual_domain = 5.0;
    constexpr double usual_moving = 6.0;
    if (problem_.table) return;
    if (!options.sampler) options.sampler = SamplerKind::random;
    if (!options.step) options.step = usual_step;
    options.domain = usual_domain;
    options.moving = usual_moving;
  }
  void index(std::optional<World>& world, SamplerKind) const {
    world.emplace(scene_, problem_.model, ArmOptions{.clearance = problem_.clearance}, execution_);
  }
  bool start_stands_free() const { return goal_stands_free(problem_.start); }
  bool goal_stands_free(const JointState& q) const {
    const double margin = end_margin(scene_, problem_.robot, problem_.clearance, reach_of(problem_), execution_);
    const ArmVerifyOptions options{.clearance = problem_.clearance + margin};
    return verify_arm(scene_, problem_.model, std::span(&q, 1), options, execution_).verified;
  }
  Path<JointState> shortened(const World& world, Path<JointState> path, Answer& answer) const {
    const auto length_of = [&](const JointState& a, const JointState& b) { return length(world, a, b); };
    return with_even_idle_joints(world, shortcut(world, std::move(path), length_of, answer));
  }
  void judge(const World& world, const Path<JointState>& path, Answer& answer) const {
    ArmProblem reached = problem_;
    const std::size_t number = take_reached_goal(reached, path.back());
    answer.problem.goal = reached.goal;
    answer.problem.rule.others = reached.other_goals;
    if (!reached.other_goals.empty()) answer.goal_index = number;
    const StageTimer timer(execution_, "verify", answer.seconds.verify, path.size());
    const Verification found = verify_arm(scene_, problem_.model, path, reached.verify_options(), execution_);
    if (!found.verified) refuse_far_solids(found);
    take_verdict(answer, found);
    answer.states.width = problem_.width();
    for (const JointState& q : path) {
      const Vec3 tool = world.kinematics().tool_pose(q).translation();
      answer.path.push_back({tool.x(), tool.y()});
      answer.states.add(std::span(q).first(problem_.width()));
    }
  }
  std::string_view cause_of_blocked(const World& world, Outcome outcome, const std::vector<JointState>& goals) const {
    const auto is_outside = [&](const JointState& q) {
      return world.kinematics().variable_outside_limits(q) != most_joints;
    };
    if (outcome == Outcome::start_blocked) {
      return is_outside(problem_.start) ? "start_outside_limits" : "start_in_collision";
    }
    if (goals.empty()) return tip_is_blocked() ? "goal_in_collision" : "goal_out_of_reach";
    return std::ranges::all_of(goals, is_outside) ? "goal_outside_limits" : "goal_in_collision";
  }

 private:
  /// Of solids this far away planner and judge know distances only to what rounding leaves: no bug of either.
  void refuse_far_solids(const Verification& found) const {
    constexpr double farthest = 1e5;
    const auto is_far = [](const Solid& solid) {
      double corners = 0.0;
      for (const Vec3& corner : solid.corners) corners = std::max(corners, corner.cwiseAbs().maxCoeff());
      return !(solid.pose.translation().cwiseAbs().maxCoeff() + solid.half.maxCoeff() + corners <= farthest);
    };
    std::vector<Solid> solids = solids_of(scene_, execution_);
    for (const ArmLink& link : problem_.model.links)
      solids.insert(solids.end(), link.solids.begin(), link.solids.end());
    if (std::ranges::none_of(solids, is_far)) return;
    throw InputError(scene_.source,
                     "a solid of it or of its arm is larger or farther away than 1e5 m, where no path can be verified; "
                     "cut it off nearer to the arm",
                     found.first_violation.value_or(Violation{}).obstacle);
  }
  /// Is the goal's place so near an obstacle that no link could end there, whatever the posture? Of arms whose links
  /// are capsules as far as the tool.
  bool tip_is_blocked() const {
    if (!problem_.table || problem_.goal_pose) return false;
    const ConvexBody tip({SolidKind::sphere, Eigen::Isometry3d(Eigen::Translation3d(problem_.goal_place())),
                          Vec3(problem_.robot.radius, 0.0, 0.0)});
    const MovingFrame still;
    return std::ranges::any_of(solids_of(scene_, execution_), [&](const Solid& solid) {
      execution_.check();
      return keep_apart(tip, still, ConvexBody(solid), still, 0.0, problem_.clearance) != Apart::proved;
    });
  }
  /// A few that are quickly found, and where none of these is free others: first those of large pieces of the wrist's
  /// turns, then of smaller ones.
  std::vector<JointState> postures(const World& world) {
    std::vector<JointState> states = goal_states(problem_, execution_);
    auto query = world.make_query();
    const auto free_of = [&](const std::vector<JointState>& all) {
      std::vector<JointState> free;
      std::ranges::copy_if(all, std::back_inserter(free), [&](const JointState& q) {
        execution_.check();
        return world.is_free(q, query);
      });
      return free;
    };
    if (!problem_.any_posture() || !free_of(states).empty()) return states;
    constexpr double beyond_doubt = 1.001;  // places are met to within a tolerance
    const Vec3 place = problem_.goal_pose ? Vec3(problem_.goal_pose->translation()) : problem_.goal_place();
    if ((place - problem_.model.base).norm() > beyond_doubt * world.kinematics().reach()) return {};
    if (problem_.goal_pose || !problem_.table || !has_puma560_shape(SerialChain(*problem_.table))) {
      tried_ = states.size();
      knows_all_ = false;
      return {};
    }
    if (!world.kinematics().moves(4) || tip_is_blocked()) return states;
    for (const std::size_t enough : {std::size_t{64}, std::size_t{16'384}}) {
      const ToolPostures more =
          tool_postures(SerialChain(*problem_.table), problem_.goal_place(), problem_.start[5], enough, execution_);
      if (more.none_is_left) return {};
      tried_ = states.size() + more.states.size();
      if (std::vector<JointState> free = free_of(more.states); !free.empty()) return free;
    }
    knows_all_ = false;
    return {};
  }

  std::uint64_t tried_ = 0;
  bool knows_all_ = true;  // is every posture blocked where none of the goals is free?
};

constexpr OptionSet attach_option{Option::attach};
constexpr AskedWords goals_of_arms{AskedWord::goal};
constexpr PlannerChoice arm_planners[] = {{PlannerKind::rrt_connect, rrt_connect_options, goals_of_arms},
                                          {PlannerKind::rrt, rrt_options, goals_of_arms},
                                          {PlannerKind::prm, prm_takes | attach_option, goals_of_arms},
                                          {PlannerKind::lazy_prm, lazy_prm_takes | attach_option, goals_of_arms},
                                          {PlannerKind::rrt_star, rrt_star_options, goals_of_arms},
                                          {PlannerKind::informed_rrt_star, rrt_star_options, goals_of_arms},
                                          {PlannerKind::anytime, anytime_options, goals_of_arms}};

bool fits_arm(const Scene&, const RobotSpec& robot) { return is_arm(robot); }

Verdict recheck_arm(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                    const Execution& execution) {
  ArmProblem problem = arm_problem(scene, question, execution);
  check_joints(answer, problem.model.variables);
  Path<JointState> path;
  for (const std::vector<double>& state : states_of(answer)) path.push_back(joint_state(state));
  take_reached_goal(problem, path.back());
  Verdict verdict{verify_arm(scene, problem.model, path, problem.verify_options(), execution), problem.general()};
  if (!question.rule.empty()) verdict.problem.rule = question.rule;
  return verdict;
}

}  // namespace

SolveKind arm_kind() {
  return {"an arm",           fits_arm,    arm_planners,       usually<PlannerKind::rrt_connect>,
          solve_sampled<Arm>, recheck_arm, build_sampled<Arm>, open_sampled<Arm>};
}

}  // namespace warren
