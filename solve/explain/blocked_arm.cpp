// SPDX-License-Identifier: BSD-3-Clause
// Why an arm does not fit where it shall start or end.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/explain/blocked_end.hpp"
#include "solve/explain/nearest_free.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/question/question_of_arm.hpp"
#include "worlds/arms/arm_kinematics.hpp"
#include "worlds/arms/convex_motion.hpp"
#include "worlds/arms/puma560.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

double norm_between(std::span<const double> a, std::span<const double> b) {
  double square = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square);
}

/// Of a segment.
double distance_from_box(const Vec3& a, const Vec3& b, const SolidBox& box) {
  const Vec3 low(box.low[0], box.low[1], box.low[2]);
  const Vec3 high(box.high[0], box.high[1], box.high[2]);
  const ConvexBody spine({SolidKind::hull, Eigen::Isometry3d::Identity(), Vec3::Zero(), {a, b}});
  const ConvexBody body(
      {SolidKind::box, Eigen::Isometry3d(Eigen::Translation3d(0.5 * (low + high))), 0.5 * (high - low)});
  return std::max(0.0, plane_between(spine, {}, body, {}, std::numeric_limits<double>::infinity()).below);
}

/// Unit vectors: both ways along each joint first, then others of even density, of six joints at a time.
std::vector<JointState> joint_directions(std::size_t width) {
  constexpr std::size_t at_once = 6;
  constexpr std::size_t random_directions = 180;
  static const std::vector<Numbers<at_once>> directions = directions_around<at_once>(random_directions);
  std::vector<JointState> spread;
  for (std::size_t k = at_once; k < width; ++k) {
    for (const double sign : {1.0, -1.0}) spread.emplace_back()[k] = sign;
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::size_t first = i < 2 * at_once || width <= at_once ? 0 : i % width;
    JointState& direction = spread.emplace_back();
    for (std::size_t k = 0; k < at_once; ++k) direction[(first + k) % std::max(width, at_once)] = directions[i][k];
  }
  return spread;
}

class BlockedArm {
 public:
  BlockedArm(const Scene& scene, const Problem& problem, const Execution& execution)
      : scene_(scene), execution_(execution), kinematics_(arm_model_of(problem.robot, problem.clearance, execution)) {
    problem_.robot = problem.robot;
    if (!problem.robot.files) problem_.table = table_of(problem.robot, execution);
    problem_.model = kinematics_.model();
    problem_.start = joint_state(problem.start);
    problem_.goal = problem.goal;
    problem_.clearance = problem.clearance;
    reach_ = reach_of(problem_);
    margin_ = end_margin(scene, problem.robot, problem.clearance, reach_, execution);
  }

  const ArmProblem& problem() const { return problem_; }
  /// What ends have beyond the clearance.
  double margin() const { return margin_; }
  /// With so much more room than is asked for.
  std::optional<Violation> met(const JointState& q, double more) const {
    execution_.check();
    const ArmVerifyOptions options{.clearance = problem_.clearance + more};
    return verify_arm(scene_, kinematics_.model(), std::span(&q, 1), options, execution_).first_violation;
  }
  /// Of the deepest link in the solid that is named, or of two links in one another. Nobody knows it of arms of files.
  std::optional<double> depth_in(const Violation& violation, const JointState& q) const {
    if (!problem_.table) return std::nullopt;
    const std::string_view name = violation.obstacle;
    const auto numbered = [&](std::string_view word, std::size_t count) {
      const auto number = number_after(name, word);
      return number && *number < count ? number : std::nullopt;
    };
    double depth = 0.0;
    if (const auto i = numbered("sphere ", scene_.spheres.size())) {
      const Sphere& s = scene_.spheres[*i];
      depth = deepest(q, [&](const Vec3& a, const Vec3& b) {
        const Vec3 way = b - a;
        const Vec3 to = Vec3(s.x, s.y, s.z) - a;
        return s.radius - (to - std::clamp(to.dot(way) / way.squaredNorm(), 0.0, 1.0) * way).norm();
      });
    } else if (const auto k = numbered("box ", scene_.boxes.size())) {
      const SolidBox& box = scene_.boxes[*k];
      depth = deepest(q, [&](const Vec3& a, const Vec3& b) {
        const double inside = depth_in_box(a, b, box);
        return inside > 0.0 ? inside : -distance_from_box(a, b, box);
      });
    } else if (name.starts_with("link ")) {
      depth = -violation.distance;
    }
    return depth > 0.0 ? std::optional(depth) : std::nullopt;
  }
  std::optional<JointState> free_posture(const JointState& q) const {
    const std::vector<JointState> directions = joint_directions(problem_.width());
    constexpr double digits = 1e3;
    JointState within = q;
    for (std::size_t k = 0; k < problem_.width(); ++k) {
      const ArmVariable& variable = kinematics_.model().variables[k];
      const double low = std::ceil(variable.low * digits) / digits;
      const double high = std::floor(variable.high * digits) / digits;
      if (variable.continuous || low > high) continue;
      if (q[k] < variable.low || q[k] > variable.high) within[k] = std::clamp(q[k], low, high);
    }
    const auto is_free = [this](const JointState& state, double spare) {
      return kinematics_.variable_outside_limits(state) == most_joints && !met(state, margin_ + spare);
    };
    const double size = std::max(problem_.robot.radius, 0.1 * reach_);
    if (is_free(within, 1e-2 * size)) return within;
    const FreeSearchRange range{1e-3, 2.0 * std::numbers::pi, 1e-3 * norm_between(q, within)};
    return nearest_free_in_few_digits<most_joints>(within, directions, range, size, is_free);
  }
  /// Postures with the tool there; empty: out of reach.
  std::vector<JointState> postures(const Vec3& place) const {
    ArmProblem there = problem_;
    there.goal = {place.x(), place.y(), place.z()};
    return goal_states(there, execution_);
  }
  /// One of them, sought where the quickly found ones are none.
  std::optional<JointState> posture(const Vec3& place) const {
    std::vector<JointState> states = postures(place);
    if (states.empty() && problem_.table && has_puma560_shape(SerialChain(*problem_.table))) {
      states = tool_postures(SerialChain(*problem_.table), place, problem_.start[5], 1, execution_).states;
    }
    return states.empty() ? std::nullopt : std::optional(states.front());
  }
  /// Which some posture reaches that is free.
  std::optional<Numbers<3>> free_tool_place(const Vec3& place) const {
    static const std::vector<Numbers<3>> directions = directions_around<3>(60);
    const auto is_free = [this](const Numbers<3>& p, double spare) {
      const std::vector<JointState> states = postures({p[0], p[1], p[2]});
      return std::ranges::any_of(states, [&](const JointState& q) { return !met(q, margin_ + spare); });
    };
    const FreeSearchRange range{1e-3 * reach_, reach_};
    return nearest_free_in_few_digits<3>({place.x(), place.y(), place.z()}, directions, range, 0.1 * reach_, is_free);
  }

 private:
  template <class DepthOfLink>
  double deepest(const JointState& q, const DepthOfLink& depth_of) const {
    double most = -std::numeric_limits<double>::infinity();
    ArmPosture posture;
    kinematics_.place(q, posture);
    for (const ArmLink& link : kinematics_.model().links) {
      const MovingFrame& frame = ArmKinematics::frame(posture, link.frame);
      for (const Solid& capsule : link.solids) {
        const Vec3 middle = frame.at + frame.turn * capsule.pose.translation();
        const Vec3 half = frame.turn * (capsule.pose.linear() * Vec3(0.0, 0.0, capsule.half.z()));
        most = std::max(most, depth_of(middle - half, middle + half) + capsule.half.x());
      }
    }
    return most;
  }

  const Scene& scene_;
  const Execution& execution_;
  ArmKinematics kinematics_;
  ArmProblem problem_;
  double reach_ = 0.0;
  double margin_ = 0.0;
};

/// Of a place that no posture brings the tool to: how far it is from the base, and how far all links would reach in a
/// line.
void explain_reach(Answer& answer, const Vec3& place, const ArmProblem& problem) {
  double reach = problem.table ? problem.table->tool.translation().norm() : reach_of(problem);
  if (!problem.table && !(place.norm() > reach)) return;  // what others might reach
  if (problem.table) {
    for (const DhJoint& joint : problem.table->joints) reach += portable::hypot(joint.a, joint.d);
  }
  answer.blocked = BlockedEnd{.is_start = false, .by = "outside of what the tool reaches within the joints' limits"};
  answer.blocked->hint =
      fmt::format("it is {} from the base, and {} {}", human_number(place.norm()),
                  problem.table ? "all links in a line are as long as" : "no point of the arm gets farther than",
                  human_number(reach));
}

/// Angles that no joint has: degrees are meant.
std::string degrees_hint(std::span<const double> angles) {
  constexpr double a_turn_and_a_bit = 6.3;
  const auto large = std::ranges::find_if(angles, [](double a) { return std::abs(a) > a_turn_and_a_bit; });
  return large == angles.end() ? "" : fmt::format("angles are in radians: {0} degrees are {0}deg", *large);
}

void tell(Answer& answer, bool is_start, const Violation& met, const BlockedArm& arm, const JointState& q) {
  answer.blocked = BlockedEnd{.is_start = is_start,
                              .by = met.obstacle,
                              .room = met.distance,
                              .needed = answer.problem.clearance,
                              .depth = arm.depth_in(met, q)};
}

/// Of all postures there, the one that the tool's place is asked about is as good as any: the first.
void explain_tool_place(Answer& answer, const BlockedArm& arm, const Vec3& place) {
  const std::optional<JointState> posture = arm.posture(place);
  if (!posture) return explain_reach(answer, place, arm.problem());
  const auto met = arm.met(*posture, arm.margin());
  if (!met) return;
  tell(answer, false, *met, arm, *posture);
  const std::optional<Numbers<3>> free = arm.free_tool_place(place);
  if (!free) return;
  answer.blocked->free_place.assign(free->begin(), free->end());
  answer.blocked->distance = norm_between(*free, answer.problem.goal);
}

}  // namespace

double depth_in_box(const Vec3& a, const Vec3& b, const SolidBox& box) {
  // A box and a segment are apart along one of six directions, or not at all: the box's axes, and what is square to one
  // of them and the segment.
  const Vec3 low(box.low[0], box.low[1], box.low[2]);
  const Vec3 half = 0.5 * (Vec3(box.high[0], box.high[1], box.high[2]) - low);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(k);
    for (const Vec3& square : {axis, Vec3(axis.cross(b - a))}) {
      const double size = square.norm();
      if (!(size > 1e-12 * (b - a).norm())) continue;
      const Vec3 normal = square / size;
      const double from = normal.dot(a - low - half);
      const double to = normal.dot(b - low - half);
      const double reach = half.dot(normal.cwiseAbs());
      least = std::min({least, std::max(from, to) + reach, reach - std::min(from, to)});
    }
  }
  return least;
}

void explain_blocked_arm(const Scene& scene, Answer& answer, const Execution& execution) {
  const bool is_start = answer.outcome == Outcome::start_blocked;
  const std::vector<double>& asked = is_start ? answer.problem.start : answer.problem.goal;
  const BlockedArm arm(scene, answer.problem, execution);
  if (!is_start && asked.empty()) return explain_reach(answer, answer.problem.goal_pose->translation(), arm.problem());
  if (arm.problem().any_posture() && !is_start) return explain_tool_place(answer, arm, {asked[0], asked[1], asked[2]});
  const JointState q = joint_state(asked);
  auto met = arm.met(q, 0.0);
  const bool only_touches = !met;
  if (only_touches) met = arm.met(q, arm.margin());
  if (!met) return;
  tell(answer, is_start, *met, arm, q);
  answer.blocked->hint = only_touches ? std::string(touching_hint) : degrees_hint(asked);
  std::optional<JointState> free = arm.free_posture(q);
  if (!free) return;
  answer.blocked->free_place.assign(free->begin(), free->begin() + as_whole<std::ptrdiff_t>(asked.size()));
  answer.blocked->distance = norm_between(*free, q);
}

}  // namespace warren
