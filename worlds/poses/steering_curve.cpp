// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/steering_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace warren {
namespace {

/// The pose after driving the way `length` (signed) from `from`, in units of which the turning radius has `radius`.
Se2 driven(const Se2& from, Steer steer, double length, double radius) {
  const double c = std::cos(from.theta);
  const double s = std::sin(from.theta);
  if (steer == Steer::straight) return {from.x + length * c, from.y + length * s, from.theta};
  const double side = static_cast<double>(steer);
  const double theta = from.theta + side * length / radius;
  const double r = side * radius;
  return {from.x + r * (std::sin(theta) - s), from.y + r * (c - std::cos(theta)), theta};
}

}  // namespace

Se2 seen_from(const Se2& a, const Se2& b, double turning_radius) noexcept {
  const double c = std::cos(a.theta);
  const double s = std::sin(a.theta);
  const double dx = (b.x - a.x) / turning_radius;
  const double dy = (b.y - a.y) / turning_radius;
  return {c * dx + s * dy, c * dy - s * dx, turn_between(a.theta, b.theta)};
}

Se2 after_piece(const Se2& from, const SteeringPiece& piece) noexcept {
  return driven(from, piece.steer, piece.length, 1.0);
}

bool ends_at(const SteeringWord& word, const Se2& goal) noexcept {
  constexpr double rounding = 1e-11;
  Vec2 at;
  Vec2 ahead{1.0, 0.0};
  double theta = 0.0;
  for (const SteeringPiece& piece : word.used()) {
    if (piece.steer == Steer::straight) {
      at = at + piece.length * ahead;
      continue;
    }
    const double side = static_cast<double>(piece.steer);
    theta += side * piece.length;
    const Vec2 next{std::cos(theta), std::sin(theta)};
    at = at + side * Vec2{next.y - ahead.y, ahead.x - next.x};
    ahead = next;
  }
  const double allowed = rounding * (1.0 + std::abs(goal.x) + std::abs(goal.y));
  return std::abs(at.x - goal.x) <= allowed && std::abs(at.y - goal.y) <= allowed &&
         std::abs(turn_between(theta, goal.theta)) <= rounding;
}

SteeringCurve::SteeringCurve(const Se2& a, const Se2& b, const SteeringWord& word, double turning_radius) noexcept
    : radius_(turning_radius) {
  constexpr double nothing = 1e-12;
  joints_[0] = a;
  for (const SteeringPiece& piece : word.used()) {
    if (std::abs(piece.length) < nothing) continue;
    pieces_[count_] = piece;
    joints_[count_ + 1] = driven(joints_[count_], piece.steer, radius_ * piece.length, radius_);
    length_ += piece_length(count_++);
  }
  joints_[count_] = b;
}

Se2 SteeringCurve::at(double s) const noexcept {
  if (s <= 0.0) return joints_.front();
  if (s >= length_) return joints_[count_];
  for (std::size_t i = 0; i < count_; ++i) {
    const double length = piece_length(i);
    if (s < length) {
      Se2 pose = driven(joints_[i], pieces_[i].steer, std::copysign(s, pieces_[i].length), radius_);
      pose.theta = wrapped_angle(pose.theta);
      return pose;
    }
    s -= length;
  }
  return joints_[count_];
}

Box SteeringCurve::box() const noexcept {
  constexpr double quarter = 0.5 * std::numbers::pi;
  Box box;
  box.include(joints_[0].position());
  for (std::size_t i = 0; i < count_; ++i) {
    box.include(joints_[i + 1].position());
    if (pieces_[i].steer == Steer::straight) continue;
    // An arc is farthest along an axis where its heading is a multiple of a quarter turn.
    const double side = static_cast<double>(pieces_[i].steer);
    const double from = joints_[i].theta;
    const double to = from + side * pieces_[i].length;
    const Vec2 center = joints_[i].position() + side * radius_ * Vec2{-std::sin(from), std::cos(from)};
    const double last = std::floor(std::max(from, to) / quarter);
    for (double k = std::ceil(std::min(from, to) / quarter); k <= last; k += 1.0) {
      const double theta = k * quarter;
      box.include(center + side * radius_ * Vec2{std::sin(theta), -std::cos(theta)});
    }
  }
  return box;
}

}  // namespace warren
