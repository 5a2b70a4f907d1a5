// SPDX-License-Identifier: BSD-3-Clause
// The shortest way of a car that only drives forwards: Dubins, Amer. J. Math. 79 (1957). It is one of six words, C an
// arc of the turning radius (left or right), S straight: LSL RSR LSR RSL LRL RLR. All six are tried, since the
// published classifications that would spare some of them contain errors; the shortest whose end is the goal up to
// rounding is taken. Closed forms; right turns are left turns in the mirror. bench/steering_bench.cpp: some 200 ns a
// pair.
//
// The length jumps where an arc shrinks to nothing and starts again as a full circle. There rounding must not decide:
// an arc that is a full circle but for some 1e-6 is tried as none first, and is taken as none where that ends at the
// goal. So a rest of a shortest curve is as long as it was on the whole, and planners may cut curves anywhere.
//
// In turning radii, from the origin with heading 0 to (x, y, phi). A car that turns left circles around (0, 1) at its
// begin and around (x - sin phi, y + cos phi) at its end; to the right around (x + sin phi, y - cos phi).
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// The angle in [0, 2 pi).
double positive_angle(double angle) {
  angle -= full_turn * std::floor(angle / full_turn);
  return angle < full_turn ? angle : 0.0;
}

enum class Shape : std::uint8_t { lsl, lsr, lrl };

/// A word of the shape, mirrored or not: first arc, middle, last arc. The last arc follows from the headings, or, where
/// the last one is given, the first.
struct Candidate {
  Shape shape;
  bool mirrored;
  double phi;  // of the goal, in the mirror where mirrored
  double first;
  double middle;
  double last;

  double length() const { return first + middle + last; }
  /// The heading at the goal is first - last for lsr, first - middle + last for lrl, first + last for lsl.
  double last_for(double arc) const { return shape == Shape::lsr ? positive_angle(arc - phi) : beside(arc); }
  double first_for(double arc) const { return shape == Shape::lsr ? positive_angle(phi + arc) : beside(arc); }
  double beside(double arc) const { return positive_angle(shape == Shape::lsl ? phi - arc : phi - arc + middle); }
  SteeringWord word() const {
    const Steer left = mirrored ? Steer::right : Steer::left;
    const Steer right = mirrored ? Steer::left : Steer::right;
    SteeringWord word;
    word.add(left, first);
    word.add(shape == Shape::lrl ? right : Steer::straight, middle);
    word.add(shape == Shape::lsr ? right : left, last);
    return word;
  }
};

/// All words of a pair of poses, and what rounding may have made of them.
class Candidates {
 public:
  Candidates(const Se2& goal, double off) : goal_(goal), off_(off) {
    const auto [s, c] = portable::sin_and_cos(goal.theta);
    add(false, goal.y, goal.theta, s, c);
    add(true, -goal.y, -goal.theta, -s, c);
  }

  /// The shortest that ends at the goal.
  SteeringWord best() {
    const auto shorter = [](const Candidate& a, const Candidate& b) { return a.length() < b.length(); };
    for (;;) {
      const auto end = list_.begin() + as_whole<std::ptrdiff_t>(count_);
      const auto candidate = std::min_element(list_.begin(), end, shorter);
      const SteeringWord word = candidate->word();
      if (count_ == 1 || ends_at(word, goal_, off_)) return word;
      *candidate = list_[--count_];
    }
  }

 private:
  /// y, phi, its sine and cosine: in the mirror where mirrored.
  void add(bool mirrored, double y, double phi, double s, double c) {
    const double x = goal_.x;
    const Vec2 to_left{x - s, y + c - 1.0};  // from the first circle's centre to the last one's
    const Vec2 to_right{x + s, y - c - 1.0};
    const double left_distance = norm(to_left);
    const double left_angle = portable::atan2(to_left.y, to_left.x);
    const double one_circle = 1e-9 + 4.0 * off_;
    const double touching = 1e-11 + 8.0 * off_;   // distances and their squares, of circles at most four apart
    const double unsure = 4.0 * std::sqrt(off_);  // of directions where circles all but touch
    add({Shape::lsl, mirrored, phi, 0.0, left_distance, 0.0}, left_angle, 4.0 * off_ / std::max(left_distance, 1e-300));
    if (left_distance <= one_circle) add({Shape::lsl, mirrored, phi, 0.0, 0.0, 0.0}, 0.0, 0.0);
    const double straight_sq = dot(to_right, to_right) - 4.0;
    if (straight_sq >= -touching) {  // circles that touch: two arcs and nothing between
      const double straight = std::sqrt(std::max(straight_sq, 0.0));
      add({Shape::lsr, mirrored, phi, 0.0, straight, 0.0},
          portable::atan2(to_right.y, to_right.x) + portable::atan2(2.0, straight), unsure);
    }
    if (left_distance <= 4.0 + touching) {
      const double middle = full_turn - 2.0 * portable::asin(std::min(0.25 * left_distance, 1.0));
      add({Shape::lrl, mirrored, phi, 0.0, middle, 0.0}, left_angle + 0.5 * middle, unsure);
    }
  }
  /// Adds it with this first arc, which may be `unsure` by rounding; where an arc is so nearly a full circle, also
  /// without that arc.
  void add(Candidate candidate, double first, double unsure) {
    const double nearly_full = full_turn - std::clamp(unsure, 1e-6, 1.0);
    candidate.first = positive_angle(first);
    candidate.last = candidate.last_for(candidate.first);
    list_[count_++] = candidate;
    const bool first_is_full = candidate.first > nearly_full;
    const bool last_is_full = candidate.last > nearly_full;
    if (first_is_full) {
      candidate.first = 0.0;
      candidate.last = candidate.last_for(0.0);
      list_[count_++] = candidate;
    }
    if (last_is_full) {
      candidate.last = 0.0;
      candidate.first = candidate.first_for(0.0);
      list_[count_++] = candidate;
    }
    if (first_is_full && last_is_full) {
      candidate.first = 0.0;
      list_[count_++] = candidate;
    }
  }

  Se2 goal_;
  double off_;                      // what rounding put it off by
  std::array<Candidate, 32> list_;  // of each of eight words at most four
  std::size_t count_ = 0;
};

}  // namespace

SteeringWord DubinsCurve::shortest(const Se2& a, const Se2& b, double turning_radius) noexcept {
  if (a == b) return {};
  return Candidates(seen_from(a, b, turning_radius), off_by_rounding(a, b, turning_radius)).best();
}

}  // namespace warren
