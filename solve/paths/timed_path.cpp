// SPDX-License-Identifier: BSD-3-Clause
#include "solve/paths/timed_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/arm_model.hpp"
#include "solve/question/question_of_arm.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {
namespace {

/// One number is for all joints.
double of_joint(const std::vector<double>& limits, std::size_t k) {
  if (limits.empty()) return std::numeric_limits<double>::infinity();
  return limits[limits.size() == 1 ? 0 : k];
}

/// A differential drive goes straight and turns on the spot: legs as those of a polygon that turns.
LegShape shape_of(const RobotSpec& robot) {
  if (is_round(robot)) return LegShape::straight;
  if (is_arm(robot)) return LegShape::joints;
  const bool drives = robot.kind == RobotKind::car && robot.steering != SteeringKind::differential;
  return drives ? LegShape::driven : LegShape::turning;
}

}  // namespace

auto TimedPath::limits_of(std::size_t leg) const -> LegLimits {
  if (legs_->shape() != LegShape::joints) {
    return {std::min(limits_.speed, std::sqrt(limits_.lateral_acceleration * legs_->radius(leg))),
            limits_.acceleration};
  }
  const double length = legs_->length(leg);
  LegLimits least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < legs_->width(); ++k) {
    const double turn = std::abs(legs_->joint_turn(leg, k));
    if (turn == 0.0) continue;
    least.speed = std::min(least.speed, of_joint(limits_.joint_speed, k) * (length / turn));
    least.acceleration = std::min(least.acceleration, of_joint(limits_.joint_acceleration, k) * (length / turn));
  }
  return least;
}

TimedPath::TimedPath(const PathLegs& legs, const TravelLimits& limits, const Execution& execution)
    : legs_(&legs), limits_(limits) {
  const std::size_t count = legs.leg_count();
  execution.reserve(2 * (count + 1) * sizeof(double));
  speeds_.assign(count + 1, 0.0);
  times_.assign(count + 1, 0.0);
  const auto reachable = [](double from, const LegLimits& limit, double length) {
    return std::sqrt(from * from + 2.0 * limit.acceleration * length);
  };
  // Forwards: what acceleration, speed and corners allow. Legs of no length pass on what they are given.
  double speed = 0.0;
  std::size_t before = count;  // the last leg that has a length
  for (std::size_t i = 0; i < count; ++i) {
    execution.poll(i);
    const double length = legs.length(i);
    if (length > 0.0) {
      const LegLimits limit = limits_of(i);
      speed = before < count && legs.goes_on(before, i) ? std::min(speed, limit.speed) : 0.0;
      speeds_[i] = speed;
      speed = std::min(limit.speed, reachable(speed, limit, length));
      before = i;
    }
    speeds_[i + 1] = speed;
  }
  // Backwards: what can be braked down to the stop at the end.
  speed = 0.0;
  for (std::size_t i = count; i-- > 0;) {
    execution.poll(i);
    const double length = legs.length(i);
    speeds_[i + 1] = speed;
    if (length > 0.0) speed = std::min(speeds_[i], reachable(speed, limits_of(i), length));
  }
  speeds_[0] = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    execution.poll(i);
    times_[i + 1] = times_[i] + (legs.length(i) > 0.0 ? ramp(i).duration_s() : 0.0);
  }
}

auto TimedPath::ramp(std::size_t leg) const -> Ramp {
  const double length = legs_->length(leg);
  const LegLimits limit = limits_of(leg);
  Ramp r{speeds_[leg], limit.speed, speeds_[leg + 1], 0.0, 0.0, 0.0, limit.acceleration};
  if (std::isinf(r.rate)) {
    r.level_s = length / r.top;
    return r;
  }
  r.top = std::min(limit.speed, std::sqrt(r.rate * length + 0.5 * (r.from * r.from + r.to * r.to)));
  r.top = std::max({r.top, r.from, r.to});
  r.up_s = (r.top - r.from) / r.rate;
  r.down_s = (r.top - r.to) / r.rate;
  const double ramps = 0.5 * (r.up_s * (r.top + r.from) + r.down_s * (r.top + r.to));
  r.level_s = std::max(0.0, length - ramps) / r.top;
  return r;
}

PathMoment TimedPath::at(double t) const {
  if (t >= times_.back()) return {std::max<std::size_t>(legs_->leg_count(), 1) - 1, 1.0, 0.0, t};
  const auto next = std::upper_bound(times_.begin() + 1, times_.end() - 1, t);
  const auto leg = static_cast<std::size_t>(next - times_.begin()) - 1;
  const double length = legs_->length(leg);
  if (!(length > 0.0)) return {leg, 1.0, 0.0, t};
  const Ramp r = ramp(leg);
  const double s = std::clamp(t - times_[leg], 0.0, r.duration_s());
  const double gear = legs_->gear(leg);
  if (std::isinf(r.rate)) return {leg, std::min(1.0, s / r.level_s), gear * r.top, t};
  const double up = std::min(s, r.up_s);
  const double level = std::min(s - up, r.level_s);
  const double down = s - up - level;
  const double way = up * (r.from + 0.5 * r.rate * up) + level * r.top + down * (r.top - 0.5 * r.rate * down);
  const double speed = r.from + r.rate * up - r.rate * down;
  return {leg, std::clamp(way / length, 0.0, 1.0), gear * std::max(0.0, speed), t};
}

PathMoment TimedPath::at_share(std::size_t leg, double share) const {
  const double length = legs_->length(leg);
  const double gear = legs_->gear(leg);
  double time_s = times_[leg];
  if (!(length > 0.0)) return {leg, share, 0.0, time_s};
  const Ramp r = ramp(leg);
  if (std::isinf(r.rate)) return {leg, share, gear * r.top, time_s + share * r.level_s};
  const double way = share * length;
  const double up = 0.5 * r.up_s * (r.from + r.top);
  const double level = r.level_s * r.top;
  double speed = r.top;
  if (way <= up) {
    speed = std::sqrt(r.from * r.from + 2.0 * r.rate * way);
    time_s += (speed - r.from) / r.rate;
  } else if (way <= up + level) {
    time_s += r.up_s + (way - up) / r.top;
  } else {
    speed = std::sqrt(std::max(0.0, r.to * r.to + 2.0 * r.rate * (length - way)));
    time_s += r.up_s + r.level_s + (r.top - speed) / r.rate;
  }
  return {leg, share, gear * speed, time_s};
}

PathLegs::PathLegs(const Answer& answer)
    : answer_(&answer),
      shape_(answer.states.empty() ? LegShape::straight : shape_of(answer.problem.robot)),
      state_count_(answer.state_count()) {
  if (answer.problem.robot.kind == RobotKind::car) reach_ = answer.problem.robot.radius;
  for (const Vec2 corner : answer.problem.robot.outline) reach_ = std::max(reach_, norm(corner));
}

double PathLegs::number(std::size_t state, std::size_t k) const {
  state = std::min(state, state_count_ - 1);
  return answer_->numbers(state)[k];
}

double PathLegs::joint_turn(std::size_t i, std::size_t k) const {
  const auto& files = answer_->problem.robot.files;
  const double way = number(i + 1, k) - number(i, k);
  return files && files->read ? variable_way(files->read->variables[k], 0.0, way) : way;
}

double PathLegs::whole_turns(std::size_t i, std::size_t k) const {
  if (shape_ != LegShape::joints) return 0.0;
  const double numbers = number(i + 1, k) - number(i, k);
  return 2.0 * std::numbers::pi * std::round((joint_turn(i, k) - numbers) / (2.0 * std::numbers::pi));
}

std::array<double, most_joints> PathLegs::direction(std::size_t leg) const {
  std::array<double, most_joints> way{};
  for (std::size_t k = 0; k < width(); ++k) way[k] = joint_turn(leg, k);
  if (shape_ == LegShape::turning || shape_ == LegShape::driven) {
    way[2] = reach_ * turn_between(number(leg, 2), number(leg + 1, 2));
  }
  return way;
}

double PathLegs::length(std::size_t i) const {
  const std::array<double, most_joints> way = direction(i);
  if (shape_ == LegShape::joints) {
    double farthest = 0.0;
    for (const double turn : way) farthest = std::max(farthest, std::abs(turn));
    return farthest;
  }
  const double chord = norm({way[0], way[1]});
  if (shape_ == LegShape::turning) return chord + std::abs(way[2]);
  if (shape_ == LegShape::straight) return chord;
  const double half = 0.5 * turn_between(number(i, 2), number(i + 1, 2));
  return half == 0.0 ? chord : chord * half / portable::sin(half);
}

double PathLegs::radius(std::size_t i) const {
  constexpr double no_turn = 1e-9;
  if (shape_ != LegShape::driven) return std::numeric_limits<double>::infinity();
  const double turn = std::abs(turn_between(number(i, 2), number(i + 1, 2)));
  return turn < no_turn ? std::numeric_limits<double>::infinity() : length(i) / turn;
}

int PathLegs::gear(std::size_t i) const {
  if (shape_ != LegShape::driven) return 1;
  const double turn = turn_between(number(i, 2), number(i + 1, 2));
  const auto [sine, cosine] = portable::sin_and_cos(number(i, 2) + 0.5 * turn);
  return (number(i + 1, 0) - number(i, 0)) * cosine + (number(i + 1, 1) - number(i, 1)) * sine < 0.0 ? -1 : 1;
}

bool PathLegs::goes_on(std::size_t i, std::size_t j) const {
  constexpr double straight_on = 1e-9;  // of a sine
  if (shape_ == LegShape::driven) return gear(i) == gear(j);
  const std::array<double, most_joints> in = direction(i);
  const std::array<double, most_joints> out = direction(j);
  double dot = 0.0;
  double square_in = 0.0;
  double square_out = 0.0;
  for (std::size_t k = 0; k < in.size(); ++k) {
    dot += in[k] * out[k];
    square_in += in[k] * in[k];
    square_out += out[k] * out[k];
  }
  const double scale = dot / square_in;  // of `in`, where it is nearest to `out`
  double off = 0.0;
  for (std::size_t k = 0; k < in.size(); ++k) off += (out[k] - scale * in[k]) * (out[k] - scale * in[k]);
  return dot > 0.0 && off <= straight_on * straight_on * square_out;
}

PathState PathLegs::at(std::size_t i, double share) const {
  PathState state;
  state.width = width();
  if (shape_ == LegShape::driven) {
    const Se2 pose = pose_on_leg(this->pose(i), this->pose(i + 1), share);
    state.numbers = {pose.x, pose.y, pose.theta};
    return state;
  }
  for (std::size_t k = 0; k < state.width; ++k) {
    state.numbers[k] = share >= 1.0 ? number(i + 1, k) : number(i, k) + share * joint_turn(i, k);
  }
  if (shape_ == LegShape::turning && share > 0.0 && share < 1.0) {
    state.numbers[2] = wrapped_angle(number(i, 2) + share * turn_between(number(i, 2), number(i + 1, 2)));
  }
  return state;
}

}  // namespace warren
