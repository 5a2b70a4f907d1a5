// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

std::size_t frame_number(int frame) { return as_whole<std::size_t>(frame); }

/// Whoever made the model has told users what is wrong with their files; here no number may name what is not there.
void check_model(const ArmModel& model) {
  const std::size_t variables = model.variables.size();
  const int joints = as_whole<int>(model.joints.size());
  bool is_whole = variables >= 1 && variables <= most_joints && model.joints.size() <= most_frames &&
                  model.tool_frame >= base_frame && model.tool_frame < joints;
  for (const ArmVariable& variable : model.variables) is_whole &= variable.low <= variable.high;
  for (int j = 0; j < joints; ++j) {
    const ArmJoint& joint = model.joints[frame_number(j)];
    is_whole &= joint.parent >= base_frame && joint.parent < j && joint.variable < variables;
    is_whole &= std::abs(joint.axis.norm() - 1.0) < 1e-9;
  }
  for (const ArmLink& link : model.links) is_whole &= link.frame >= base_frame && link.frame < joints;
  for (const LinkPair& pair : model.pairs) is_whole &= pair[0] < pair[1] && pair[1] < model.links.size();
  if (!is_whole) throw InputError("arm", "must be a tree of at most 32 joints that 1 to 14 variables move", model.name);
}

/// The turn about an axis of length 1.
Eigen::Matrix3d turn_about(const Vec3& axis, double angle) {
  const auto [sine, cosine] = portable::sin_and_cos(angle);
  const Vec3 swept = sine * axis;
  Eigen::Matrix3d turn = ((1.0 - cosine) * axis) * axis.transpose();
  turn.diagonal().array() += cosine;
  turn(0, 1) -= swept.z();
  turn(1, 0) += swept.z();
  turn(0, 2) += swept.y();
  turn(2, 0) -= swept.y();
  turn(1, 2) -= swept.x();
  turn(2, 1) += swept.x();
  return turn;
}

/// From the frame before a joint to the one behind it.
void pass_joint(const ArmJoint& joint, const JointState& q, Eigen::Matrix3d& turn, Vec3& at) {
  const double value = joint.multiplier * q[joint.variable] + joint.offset;
  at = turn * joint.origin.translation() + at;
  turn *= joint.origin.linear();
  if (joint.slides) {
    at += turn * (value * joint.axis);
  } else {
    turn *= turn_about(joint.axis, value);
  }
}

// Which states bring an arm's tool to a place, or to a pose? By numbers, for any tree of joints: from the seed and from
// random states within the limits, steps of least squares (Levenberg, Marquardt, with the damping of Sugihara: in
// proportion to the square of what is missing), with variables held at a limit that a step would leave. Errors are
// angles, and lengths in units of the arm's own. Cost: 0.4 us a step and joint, 10 to 60 steps a start.

/// What is missing: a way, in units of the arm's length, and a turn.
using ToolError = std::array<double, 6>;

/// The turn from one frame to another as axis times angle.
Vec3 turn_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::Matrix3d turn = to * from.transpose();
  const Vec3 twice_sine(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  const double sine = 0.5 * twice_sine.norm();
  const double cosine = 0.5 * (turn.trace() - 1.0);
  if (sine > 1e-6) return (0.5 * portable::atan2(sine, cosine) / sine) * twice_sine;
  if (cosine > 0.0) return 0.5 * twice_sine;
  Eigen::Index most = 0;  // half a turn: the axis is any column of turn + 1
  turn.diagonal().maxCoeff(&most);
  return portable::acos(-1.0) * (turn.col(most) + Vec3::Unit(most)).normalized();
}

/// Solves a x = b for a symmetric matrix that is positive; its lower half is overwritten.
ToolError solved(std::array<ToolError, 6>& a, ToolError b) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      a[i][j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / a[j][j];
    }
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

class ToolSearch {
 public:
  ToolSearch(const ArmKinematics& arm, const ToolGoal& goal) : arm_(arm), goal_(goal) {
    const ArmModel& model = arm.model();
    length_ = model.tool.translation().norm();
    for (int at = model.tool_frame; at != base_frame; at = model.joints[frame_number(at)].parent)
      length_ += model.joints[frame_number(at)].origin.translation().norm();
    if (!(length_ > 0.0)) length_ = 1.0;
  }

  /// From q downhill; is the goal reached?
  bool descend(JointState& q) {
    constexpr int most_steps = 80;
    double damping = 1.0;
    double square = look(q);
    for (int step = 0; step < most_steps && std::isfinite(square); ++step) {
      if (is_reached()) return true;
      if (damping > 1e6) return false;
      const Jacobian before = columns_;
      const ToolError missing = error_;
      const JointState next = stepped(q, damping * square + 1e-18);
      const double now = look(next);
      if (now < square) {
        if (now > 0.999 * square && step > 20) return false;
        q = next;
        square = now;
        damping = std::max(0.2 * damping, 1e-6);
      } else {
        columns_ = before;
        error_ = missing;
        damping *= 6.0;
      }
    }
    return false;
  }

 private:
  using Jacobian = std::array<ToolError, most_joints>;

  bool is_reached() const {
    constexpr double near = 0.5e-9;
    const double way = std::sqrt(error_[0] * error_[0] + error_[1] * error_[1] + error_[2] * error_[2]);
    const double turn = std::sqrt(error_[3] * error_[3] + error_[4] * error_[4] + error_[5] * error_[5]);
    return way * length_ <= near && turn <= near;
  }

  /// What is missing at q, and what each variable does about it.
  double look(const JointState& q) {
    const ArmModel& model = arm_.model();
    arm_.place(q, posture_);
    const MovingFrame& last = ArmKinematics::frame(posture_, model.tool_frame);
    const Vec3 tip = last.turn * model.tool.translation() + last.at;
    const Vec3 way = (goal_.pose.translation() - tip) / length_;
    Vec3 turn = Vec3::Zero();
    if (!goal_.place_only) turn = turn_between(last.turn * model.tool.linear(), goal_.pose.linear());
    error_ = {way.x(), way.y(), way.z(), turn.x(), turn.y(), turn.z()};
    columns_ = {};
    for (int at = model.tool_frame; at != base_frame; at = model.joints[frame_number(at)].parent) {
      const ArmJoint& joint = model.joints[frame_number(at)];
      const MovingFrame& frame = posture_[frame_number(at)];
      const Vec3 axis = joint.multiplier * (frame.turn * joint.axis);
      const Vec3 by_way = (joint.slides ? axis : Vec3(axis.cross(tip - frame.at))) / length_;
      const Vec3 by_turn = joint.slides || goal_.place_only ? Vec3(Vec3::Zero()) : axis;
      for (int k = 0; k < 3; ++k) {
        columns_[joint.variable][as_whole<std::size_t>(k)] += by_way[k];
        columns_[joint.variable][as_whole<std::size_t>(k) + 3] += by_turn[k];
      }
    }
    return std::inner_product(error_.begin(), error_.end(), error_.begin(), 0.0);
  }

  /// One damped step; what would leave the limits is held there, and the others step again.
  JointState stepped(const JointState& q, double damping) const {
    JointState to = q;
    std::array<bool, most_joints> held{};
    for (int round = 0; round < 3; ++round) {
      ToolError missing = error_;
      std::array<ToolError, 6> square{};
      for (std::size_t v = 0; v < arm_.size(); ++v) {
        const ToolError& column = columns_[v];
        for (std::size_t i = 0; i < 6; ++i) {
          if (held[v]) missing[i] -= column[i] * (to[v] - q[v]);
          for (std::size_t j = 0; j <= i && !held[v]; ++j) square[i][j] += column[i] * column[j];
        }
      }
      for (std::size_t i = 0; i < 6; ++i) square[i][i] += damping;
      const ToolError pull = solved(square, missing);
      bool is_new = false;
      for (std::size_t v = 0; v < arm_.size(); ++v) {
        if (held[v]) continue;
        double step = 0.0;
        for (std::size_t i = 0; i < 6; ++i) step += columns_[v][i] * pull[i];
        to[v] = q[v] + std::clamp(step, -1.0, 1.0);
        const ArmVariable& variable = arm_.model().variables[v];
        if (variable.continuous || (to[v] >= variable.low && to[v] <= variable.high)) continue;
        to[v] = std::clamp(to[v], variable.low, variable.high);
        held[v] = is_new = true;
      }
      if (!is_new) break;
    }
    return to;
  }

  const ArmKinematics& arm_;
  const ToolGoal& goal_;
  double length_ = 0.0;  // of the arm
  ArmPosture posture_;
  ToolError error_{};
  Jacobian columns_{};
};

}  // namespace

ArmKinematics::ArmKinematics(ArmModel model) : model_(std::move(model)) {
  check_model(model_);
  std::vector<double> reach(model_.joints.size(), 0.0);
  for (const ArmLink& link : model_.links) {
    for (const Solid& solid : link.solids) {
      const double half = solid.kind == SolidKind::sphere ? 0.0 : solid.half.z();
      const Vec3 along = half * solid.pose.linear().col(2);
      const Vec3 middle = solid.pose.translation();
      const double rim = solid.kind == SolidKind::cylinder ? solid.half.x() : 0.0;
      const bool is_round = solid.kind != SolidKind::box && solid.kind != SolidKind::hull;
      for (const double end : {-1.0, 1.0})
        if (is_round) add_reach(link.frame, middle + end * along, rim, solid.half.x() - rim, reach);
      for (int corner = 0; corner < 8 && solid.kind == SolidKind::box; ++corner) {
        const Vec3 sides(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
        add_reach(link.frame, placed_point(solid.pose, solid.half.cwiseProduct(sides)), 0.0, 0.0, reach);
      }
      for (const Vec3& corner : solid.corners) add_reach(link.frame, placed_point(solid.pose, corner), 0.0, 0.0, reach);
    }
  }
  std::vector<double> of_tool(reach.size(), 0.0);
  add_reach(model_.tool_frame, model_.tool.translation(), 0.0, 0.0, of_tool);
  for (std::size_t j = 0; j < reach.size(); ++j) {
    const ArmJoint& joint = model_.joints[j];
    tool_reach_[joint.variable] += std::abs(joint.multiplier) * of_tool[j];
    if (std::max(reach[j], of_tool[j]) > 1e-12 && joint.multiplier != 0.0) moving_[joint.variable] = true;
  }
}

/// How far a ball that is fixed in a frame may come from the axes of this frame and those before it, and with its
/// margin from the base.
void ArmKinematics::add_reach(int frame, Vec3 centre, double radius, double margin, std::vector<double>& reach) {
  constexpr double upward = 1.0 + 1e-12;
  while (frame != base_frame) {
    const std::size_t number = frame_number(frame);
    const ArmJoint& joint = model_.joints[number];
    const Vec3 beside = joint.axis.dot(centre) * joint.axis;
    if (joint.slides) {
      const ArmVariable& variable = model_.variables[joint.variable];
      const double middle = 0.5 * (variable.low + variable.high);
      reach[number] = std::max(reach[number], 1.0);
      centre += (joint.multiplier * middle + joint.offset) * joint.axis;
      radius += upward * std::abs(joint.multiplier) * (variable.high - middle);
    } else {
      radius = upward * ((centre - beside).norm() + radius);
      reach[number] = std::max(reach[number], radius);
      centre = beside;
    }
    centre = placed_point(joint.origin, centre);
    frame = joint.parent;
  }
  whole_reach_ = std::max(whole_reach_, margin + ((centre - model_.base).norm() + radius));
}

const MovingFrame& ArmKinematics::frame(const ArmPosture& posture, int number) {
  static const MovingFrame base;
  return number == base_frame ? base : posture[frame_number(number)];
}

void ArmKinematics::place(const JointState& q, ArmPosture& posture) const {
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const MovingFrame& parent = frame(posture, model_.joints[j].parent);
    MovingFrame& own = posture[j];
    own = {.turn = parent.turn, .at = parent.at};
    pass_joint(model_.joints[j], q, own.turn, own.at);
  }
}

Eigen::Isometry3d ArmKinematics::tool_pose(const JointState& q) const {
  std::array<std::size_t, most_frames> behind;  // NOLINT(*-member-init): only what is written is read
  std::size_t count = 0;
  for (int at = model_.tool_frame; at != base_frame; at = model_.joints[frame_number(at)].parent) {
    behind[count++] = frame_number(at);
  }
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 place = Vec3::Zero();
  while (count > 0) pass_joint(model_.joints[behind[--count]], q, turn, place);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn;
  pose.translation() = place;
  return pose * model_.tool;
}

std::size_t ArmKinematics::variable_outside_limits(const JointState& q) const {
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < most_joints; ++i) {
    if (!std::isfinite(q[i])) return i;
    if (i < size() && model_.variables[i].continuous) continue;
    const double low = i < size() ? model_.variables[i].low : 0.0;
    const double high = i < size() ? model_.variables[i].high : 0.0;
    if (q[i] < low - rounding || q[i] > high + rounding) return i;
  }
  return most_joints;
}

std::vector<JointState> postures_of_tool(const ArmKinematics& arm, const ToolGoal& goal, const JointState& seed,
                                         std::size_t enough, const Execution& execution) {
  constexpr std::size_t most_in_vain = 100;
  const std::vector<ArmVariable>& variables = arm.model().variables;
  const auto apart = [&](const JointState& a, const JointState& b) {
    double most = 0.0;
    for (std::size_t v = 0; v < variables.size(); ++v)
      most = std::max(most, std::abs(variable_way(variables[v], a[v], b[v])));
    return most;
  };
  const auto away = [&](const JointState& q) {
    double sum = 0.0;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      const double way = variable_way(variables[v], seed[v], q[v]);
      sum += way * way;
    }
    return sum;
  };
  ToolSearch search(arm, goal);
  std::vector<JointState> found;
  for (std::size_t start = 0; start < std::max(most_in_vain, 10 * enough) && found.size() < enough; ++start) {
    execution.check();
    JointState q = seed;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      const ArmVariable& variable = variables[v];
      if (start > 0) q[v] = variable.low + uniform(2, start, v) * (variable.high - variable.low);
      if (!variable.continuous) q[v] = std::clamp(q[v], variable.low, variable.high);
    }
    if (!search.descend(q)) continue;
    if (std::ranges::none_of(found, [&](const JointState& other) { return apart(other, q) <= 1e-6; })) {
      found.push_back(q);
    }
  }
  std::ranges::stable_sort(found, {}, away);
  return found;
}

}  // namespace warren
