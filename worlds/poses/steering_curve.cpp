// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/steering_curve.hpp"

#include <limits>
#include <numbers>

#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

/// The pose after driving the way `length` (signed) from `from`, in units of which the turning radius has `radius`.
Se2 driven_from(const Se2& from, Steer steer, double length, double radius) {
  const auto [s, c] = portable::sin_and_cos(from.theta);
  if (steer == Steer::straight) return {from.x + length * c, from.y + length * s, from.theta};
  const double side = side_of(steer);
  const double theta = from.theta + side * length / radius;
  if (is_on_spot(steer)) return {from.x, from.y, theta};
  const double r = side * radius;
  const auto [sine, cosine] = portable::sin_and_cos(theta);
  return {from.x + r * (sine - s), from.y + r * (c - cosine), theta};
}

}  // namespace

Se2 seen_from(const Se2& a, const Se2& b, double turning_radius) noexcept {
  const auto [s, c] = portable::sin_and_cos(a.theta);
  const double dx = (b.x - a.x) / turning_radius;
  const double dy = (b.y - a.y) / turning_radius;
  return {c * dx + s * dy, c * dy - s * dx, turn_between(a.theta, b.theta)};
}

Se2 after_piece(const Se2& from, const SteeringPiece& piece) noexcept {
  return driven_from(from, piece.steer, piece.length, 1.0);
}

double off_by_rounding(const Se2& a, const Se2& b, double turning_radius) noexcept {
  // Each pose and each joint before it is off by half an ulp an axis; the judge of cars allows five times as much.
  constexpr double ulps = 8.0 * std::numeric_limits<double>::epsilon();
  return ulps * std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)}) / turning_radius;
}

bool ends_at(const SteeringWord& word, const Se2& goal, double off) noexcept {
  constexpr double rounding = 1e-11;
  Vec2 at;
  Vec2 ahead{1.0, 0.0};
  double theta = 0.0;
  for (const SteeringPiece& piece : word.used()) {
    if (piece.steer == Steer::straight) {
      at = at + piece.length * ahead;
      continue;
    }
    const double side = side_of(piece.steer);
    theta += side * piece.length;
    const auto [sine, cosine] = portable::sin_and_cos(theta);
    const Vec2 next{cosine, sine};
    at = at + side * Vec2{next.y - ahead.y, ahead.x - next.x};
    ahead = next;
  }
  const double allowed = rounding * (1.0 + std::abs(goal.x) + std::abs(goal.y)) + off;
  return std::abs(at.x - goal.x) <= allowed && std::abs(at.y - goal.y) <= allowed &&
         std::abs(turn_between(theta, goal.theta)) <= rounding;
}

SteeringCurve::SteeringCurve(const Se2& a, const Se2& b, const SteeringWord& word, double turning_radius) noexcept
    : radius_(turning_radius) {
  joints_[0] = a;
  for (const SteeringPiece& piece : word.used()) {
    if (std::abs(piece.length) < nothing) continue;
    pieces_[count_] = piece;
    joints_[count_ + 1] = driven_from(joints_[count_], piece.steer, radius_ * piece.length, radius_);
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
      Se2 pose = driven_from(joints_[i], pieces_[i].steer, std::copysign(s, pieces_[i].length), radius_);
      pose.theta = wrapped_angle(pose.theta);
      return pose;
    }
    s -= length;
  }
  return joints_[count_];
}

double SteeringCurve::driven() const {
  double way = 0.0;
  for (std::size_t i = 0; i < count_; ++i) way += is_on_spot(pieces_[i].steer) ? 0.0 : piece_length(i);
  return way;
}

Se2 SteeringCurve::at_driven(double s) const noexcept {
  double turned = 0.0;
  double gone = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (is_on_spot(pieces_[i].steer)) {
      turned += piece_length(i);
    } else if ((gone += piece_length(i)) >= s) {
      break;
    }
  }
  return at(turned + s);
}

Box SteeringCurve::box() const noexcept {
  constexpr double quarter = 0.5 * std::numbers::pi;
  Box box;
  box.include(joints_[0].position());
  for (std::size_t i = 0; i < count_; ++i) {
    box.include(joints_[i + 1].position());
    if (pieces_[i].steer == Steer::straight || is_on_spot(pieces_[i].steer)) continue;
    // An arc is farthest along an axis where its heading is a multiple of a quarter turn.
    const double side = side_of(pieces_[i].steer);
    const double from = joints_[i].theta;
    const double to = from + side * pieces_[i].length;
    const auto [s, c] = portable::sin_and_cos(from);
    const Vec2 center = joints_[i].position() + side * radius_ * Vec2{-s, c};
    const double last = std::floor(std::max(from, to) / quarter);
    for (double k = std::ceil(std::min(from, to) / quarter); k <= last; k += 1.0) {
      const auto [sine, cosine] = portable::sin_and_cos(k * quarter);
      box.include(center + side * radius_ * Vec2{sine, -cosine});
    }
  }
  return box;
}

double pace_of(Steer steer, std::span<const Vec2> outline, double turning_radius) {
  if (steer == Steer::straight) return 1.0;
  const bool on_spot = is_on_spot(steer);
  const double side = side_of(steer);
  const Vec2 center{0.0, on_spot ? 0.0 : side * turning_radius};
  double pace = on_spot ? 0.0 : 1.0;
  for (const Vec2 p : outline) pace = std::max(pace, norm(p - center) / turning_radius);
  return pace;
}

void append_joints(std::vector<Se2>& poses, const SteeringCurve& curve) {
  constexpr double most_rad = 0.5 * std::numbers::pi * (1.0 + 1e-9);
  double begin = 0.0;
  for (std::size_t i = 0; i < curve.piece_count(); ++i) {
    const SteeringPiece& piece = curve.piece(i);
    const double parts =
        piece.steer == Steer::straight ? 1.0 : std::max(1.0, std::ceil(std::abs(piece.length) / most_rad));
    for (double part = 1.0; part < parts; part += 1.0) {
      poses.push_back(curve.at(begin + curve.piece_length(i) * part / parts));
    }
    begin += curve.piece_length(i);
    Se2 joint = curve.joint(i + 1);
    if (i + 1 < curve.piece_count()) joint.theta = wrapped_angle(joint.theta);
    poses.push_back(joint);
  }
}

std::vector<double> leg_turns(std::span<const Se2> poses) {
  std::vector<double> turns(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) turns[i] = turn_between(poses[i - 1].theta, poses[i].theta);
  return turns;
}

std::vector<double> leg_lengths(std::span<const Se2> poses, std::span<const double> turns) {
  std::vector<double> lengths(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double chord = distance(poses[i - 1].position(), poses[i].position());
    const double half = 0.5 * turns[i];
    lengths[i] = half == 0.0 ? chord : chord * half / portable::sin(half);
  }
  return lengths;
}

Se2 pose_on_leg(const Se2& a, const Se2& b, double t) {
  constexpr double no_turn = 1e-9;
  if (t <= 0.0) return a;
  if (t >= 1.0) return b;
  const double turn = turn_between(a.theta, b.theta);
  if (std::abs(turn) < no_turn) return interpolate(a, b, t);
  // A part of an arc is a chord along the heading halfway, as the whole is.
  const double share = portable::sin(0.5 * t * turn) / portable::sin(0.5 * turn);
  const Rotation back(0.5 * (t - 1.0) * turn);
  const Vec2 p = a.position() + share * back(b.position() - a.position());
  return {p.x, p.y, wrapped_angle(a.theta + t * turn)};
}

SteeringWord DifferentialCurve::shortest(const Se2& a, const Se2& b, double turning_radius) noexcept {
  const Se2 goal = seen_from(a, b, turning_radius);
  const double way = portable::hypot(goal.x, goal.y);
  SteeringWord word;
  const auto add_turn = [&](double turn_rad) {
    word.add(turn_rad > 0.0 ? Steer::left_on_spot : Steer::right_on_spot, std::abs(turn_rad));
  };
  if (way <= SteeringCurve::nothing + off_by_rounding(a, b, turning_radius)) {
    add_turn(goal.theta);
    return word;
  }
  const double towards = portable::atan2(goal.y, goal.x);
  const double away = wrapped_angle(towards - std::numbers::pi);
  const double then = turn_between(towards, goal.theta);
  const double then_from_away = turn_between(away, goal.theta);
  const bool forwards =
      std::abs(towards) + std::abs(then) <= std::abs(away) + std::abs(then_from_away) + SteeringCurve::nothing;
  add_turn(forwards ? towards : away);
  word.add(Steer::straight, forwards ? way : -way);
  add_turn(forwards ? then : then_from_away);
  return word;
}

}  // namespace warren
