// SPDX-License-Identifier: BSD-3-Clause
#include "solve/paths/path_legs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/se2.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {
namespace {

LegShape shape_of(RobotKind kind) {
  switch (kind) {
    case RobotKind::point:
    case RobotKind::disc:
      return LegShape::straight;
    case RobotKind::polygon:
      return LegShape::turning;
    case RobotKind::car:
      return LegShape::driven;
    case RobotKind::puma560:
    case RobotKind::arm:
      return LegShape::joints;
  }
  return LegShape::straight;
}

}  // namespace

PathLegs::PathLegs(const Answer& answer)
    : answer_(&answer),
      shape_(answer.states.empty() ? LegShape::straight : shape_of(answer.problem.robot.kind)),
      width_(answer.states.empty() ? 2 : answer.states.width),
      state_count_(answer.states.empty() ? answer.path.size() : answer.states.size()) {
  for (const Vec2 corner : answer.problem.robot.outline) reach_ = std::max(reach_, norm(corner));
}

double PathLegs::number(std::size_t state, std::size_t k) const {
  if (!answer_->states.empty()) return answer_->states[state][k];
  return k == 0 ? answer_->path[state].x : answer_->path[state].y;
}

std::array<double, 6> PathLegs::direction(std::size_t leg) const {
  std::array<double, 6> way{};
  for (std::size_t k = 0; k < width_; ++k) way[k] = number(leg + 1, k) - number(leg, k);
  if (shape_ == LegShape::turning || shape_ == LegShape::driven) {
    way[2] = reach_ * turn_between(number(leg, 2), number(leg + 1, 2));
  }
  return way;
}

double PathLegs::length(std::size_t i) const {
  const std::array<double, 6> way = direction(i);
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
  const std::array<double, 6> in = direction(i);
  const std::array<double, 6> out = direction(j);
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
  state.width = width_;
  if (shape_ == LegShape::driven) {
    const Se2 pose = pose_on_leg(this->pose(i), this->pose(i + 1), share);
    state.numbers = {pose.x, pose.y, pose.theta};
    return state;
  }
  for (std::size_t k = 0; k < width_; ++k) {
    const double from = number(i, k);
    const double to = number(i + 1, k);
    state.numbers[k] = share >= 1.0 ? to : from + share * (to - from);
  }
  if (shape_ == LegShape::turning && share > 0.0 && share < 1.0) {
    state.numbers[2] = wrapped_angle(number(i, 2) + share * turn_between(number(i, 2), number(i + 1, 2)));
  }
  return state;
}

}  // namespace warren
