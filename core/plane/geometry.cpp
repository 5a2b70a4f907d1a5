// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/geometry.hpp"

#include <cstddef>

namespace warren {
namespace {

struct TwoTerms {
  double high;
  double low;
};

TwoTerms exact_sum(double a, double b) noexcept {
  const double s = a + b;
  const double bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

TwoTerms exact_product(double a, double b) noexcept {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

/// A sum of doubles kept exactly as non-overlapping terms of growing magnitude (Shewchuk's GROW-EXPANSION).
class Expansion {
 public:
  void add(double term) noexcept {
    double carry = term;
    for (std::size_t i = 0; i < size_; ++i) {
      const TwoTerms t = exact_sum(carry, terms_[i]);
      terms_[i] = t.low;
      carry = t.high;
    }
    terms_[size_++] = carry;
  }
  void add_product(double a, double b) noexcept {
    const TwoTerms p = exact_product(a, b);
    add(p.low);
    add(p.high);
  }
  int sign() const noexcept {
    for (std::size_t i = size_; i-- > 0;) {
      if (terms_[i] != 0.0) return terms_[i] > 0.0 ? 1 : -1;
    }
    return 0;
  }

 private:
  std::array<double, 12> terms_{};
  std::size_t size_ = 0;
};

int exact_orient2d(Vec2 a, Vec2 b, Vec2 c) noexcept {
  Expansion sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.x, c.y);
  sum.add_product(-c.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(a.y, c.x);
  sum.add_product(c.y, b.x);
  return sum.sign();
}

/// Error of a - b, which rounds to `difference`.
double difference_error(double a, double b, double difference) noexcept {
  const double back = a - difference;
  return (a - (difference + back)) + (back - b);
}

}  // namespace

int orient2d(Vec2 a, Vec2 b, Vec2 c) noexcept {
  constexpr double error_bound = 3.3306690738754716e-16;  // (3 + 16 eps) eps with eps = 2^-53: Shewchuk's ccwerrboundA
  const double acx = a.x - c.x;
  const double acy = a.y - c.y;
  const double bcx = b.x - c.x;
  const double bcy = b.y - c.y;
  const double left = acx * bcy;
  const double right = acy * bcx;
  const double area = left - right;
  const double bound = error_bound * (std::abs(left) + std::abs(right));
  if (area > bound) return 1;
  if (area < -bound) return -1;
  if (left == 0.0 && right == 0.0) return 0;  // a factor of each is: within the coordinates' limits nothing underflows
  const bool exact_differences = difference_error(a.x, c.x, acx) == 0.0 && difference_error(a.y, c.y, acy) == 0.0 &&
                                 difference_error(b.x, c.x, bcx) == 0.0 && difference_error(b.y, c.y, bcy) == 0.0;
  if (!exact_differences) return exact_orient2d(a, b, c);
  // Rounding is monotone: where the rounded products differ, so do the products, the same way.
  const double difference = left != right ? area : std::fma(acx, bcy, -left) - std::fma(acy, bcx, -right);
  return difference > 0.0 ? 1 : difference < 0.0 ? -1 : 0;
}

bool on_segment(Vec2 p, const Segment& s) noexcept { return box_of(s).contains(p) && orient2d(s.a, s.b, p) == 0; }

bool segments_touch(const Segment& s, const Segment& t) noexcept {
  if (!box_of(s).meets(box_of(t))) return false;
  const int s_a = orient2d(t.a, t.b, s.a);
  const int s_b = orient2d(t.a, t.b, s.b);
  if (s_a * s_b > 0) return false;
  const int t_a = orient2d(s.a, s.b, t.a);
  const int t_b = orient2d(s.a, s.b, t.b);
  // With all four on one line the boxes decide; a segment of length zero sees both of the other's ends "on its line"
  // and is decided by its own two signs, which are equal, and its box.
  return t_a * t_b <= 0;
}

bool segments_cross(const Segment& s, const Segment& t) noexcept {
  return orient2d(t.a, t.b, s.a) * orient2d(t.a, t.b, s.b) < 0 && orient2d(s.a, s.b, t.a) * orient2d(s.a, s.b, t.b) < 0;
}

Vec2 nearest_point(Vec2 p, const Segment& s) noexcept {
  const Vec2 along = s.b - s.a;
  const double length_sq = dot(along, along);
  if (length_sq == 0.0) return s.a;
  const double t = std::clamp(dot(p - s.a, along) / length_sq, 0.0, 1.0);
  return t == 1.0 ? s.b : s.a + t * along;
}

double distance_sq(Vec2 p, const Segment& s) noexcept {
  const Vec2 along = s.b - s.a;
  const Vec2 to_p = p - s.a;
  const double length_sq = dot(along, along);
  const double t = dot(to_p, along);
  if (t <= 0.0 || length_sq == 0.0) return dot(to_p, to_p);
  if (t >= length_sq) return dot(p - s.b, p - s.b);
  const double c = cross(along, to_p);
  return c * c / length_sq;
}

double distance(Vec2 p, const Segment& s) noexcept { return std::sqrt(distance_sq(p, s)); }

double distance(const Segment& s, const Segment& t) noexcept {
  if (segments_touch(s, t)) return 0.0;
  const double of_s = std::min(distance_sq(s.a, t), distance_sq(s.b, t));
  const double of_t = std::min(distance_sq(t.a, s), distance_sq(t.b, s));
  return std::sqrt(std::min(of_s, of_t));
}

}  // namespace warren
