// SPDX-License-Identifier: BSD-3-Clause
#include "verify/exact/exact_segments.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"

namespace warren::exact {
namespace {

/// A difference of two doubles, and whether it came out without rounding.
struct Difference {
  double value;
  bool is_exact;
};

Difference difference(double a, double b) noexcept {
  const double d = a - b;
  const double back = d - a;
  return {d, (a - (d - back)) + (-b - back) == 0.0};
}

int sign_of(double x) noexcept { return (x > 0.0) - (x < 0.0); }

/// Sign of a * b - c * d. Rounding is monotone: where the rounded products differ, so do the products, the same way.
int compare_products(double a, double b, double c, double d) noexcept {
  const double left = a * b;
  const double right = c * d;
  if (left != right) return left > right ? 1 : -1;
  return sign_of(std::fma(a, b, -left) - std::fma(c, d, -right));
}

using Whole = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

/// number * 2^exponent, whose sums, differences and products are not rounded. A decision takes about a microsecond, so
/// it is only asked where a filter in doubles leaves it open. The exponent is a multiple of 32.
struct Dyadic {
  Whole number;
  int exponent = 0;

  int sign() const { return number.sign(); }
  Whole in_units_of(int lower) const { return number << (exponent - lower); }
};

Dyadic exactly(double finite) {
  int exponent = 0;
  const Whole mantissa = bounded_whole<std::int64_t>(std::ldexp(std::frexp(finite, &exponent), 53));
  exponent -= 53;
  return {mantissa << (exponent & 31), exponent & ~31};
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  const int lower = std::min(a.exponent, b.exponent);
  return {a.in_units_of(lower) + b.in_units_of(lower), lower};
}
Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + Dyadic{-b.number, b.exponent}; }
Dyadic operator*(const Dyadic& a, const Dyadic& b) { return {a.number * b.number, a.exponent + b.exponent}; }

/// As a double, to some roundings: of its highest three words of 32 bits, 65 bits or more where there are as many.
double rounded(const Dyadic& x) {
  if (x.sign() == 0) return 0.0;
  const Whole size = abs(x.number);
  const int words = as_whole<int>(msb(size) / 32) + 1;
  const int lowest = std::max(words - 3, 0);
  double value = 0.0;
  for (int i = words; i-- > lowest;) {
    value = 0x1p32 * value + Whole((size >> (32 * i)) & 0xffffffffU).convert_to<double>();
  }
  return x.sign() * std::ldexp(value, x.exponent + 32 * lowest);
}

/// The same plane without rounding.
struct ExactVec {
  Dyadic x, y;
};
ExactVec between(Vec2 from, Vec2 to) { return {exactly(to.x) - exactly(from.x), exactly(to.y) - exactly(from.y)}; }
Dyadic dot(const ExactVec& a, const ExactVec& b) { return a.x * b.x + a.y * b.y; }
Dyadic cross(const ExactVec& a, const ExactVec& b) { return a.x * b.y - a.y * b.x; }

bool exactly_closer(Vec2 p, const Segment& s, double r) {
  const ExactVec along = between(s.a, s.b);
  const ExactVec to_p = between(s.a, p);
  const Dyadic r_sq = exactly(r) * exactly(r);
  const Dyadic length_sq = dot(along, along);
  const Dyadic t = dot(along, to_p);
  if (t.sign() <= 0) return (dot(to_p, to_p) - r_sq).sign() < 0;
  if ((t - length_sq).sign() >= 0) {
    const ExactVec from_end = between(s.b, p);
    return (dot(from_end, from_end) - r_sq).sign() < 0;
  }
  const Dyadic area = cross(along, to_p);
  return (area * area - r_sq * length_sq).sign() < 0;
}

/// Cross product of a -> b and a -> p to a billionth of itself: where all but a millionth cancels, without rounding.
double area_between(Vec2 a, Vec2 b, Vec2 p) noexcept {
  constexpr double most_cancelled = 1e-6;
  const double left = (b.x - a.x) * (p.y - a.y);
  const double right = (b.y - a.y) * (p.x - a.x);
  const double area = left - right;
  if (std::abs(area) > most_cancelled * (std::abs(left) + std::abs(right))) return area;
  return rounded(cross(between(a, b), between(a, p)));
}

double distance_sq(Vec2 p, const Segment& s) noexcept {
  const Vec2 along = s.b - s.a;
  const Vec2 to_p = p - s.a;
  const Vec2 to_b = s.b - p;
  const double length_sq = dot(along, along);
  if (dot(along, to_p) <= 0.0 || length_sq == 0.0) return dot(to_p, to_p);
  if (dot(along, to_b) <= 0.0) return dot(to_b, to_b);
  const double area = area_between(s.a, s.b, p);
  return area * (area / length_sq);  // in this order nothing underflows for the smallest coordinates
}

bool is_flat(const Segment& s) noexcept { return s.a.x == s.b.x || s.a.y == s.b.y; }

/// The distance of two boxes that face each other along one axis, where it can be had without rounding; else -1.
double exact_facing_gap(const Box& a, const Box& b) noexcept {
  const bool beside = a.min.x <= b.max.x && b.min.x <= a.max.x;
  const bool level = a.min.y <= b.max.y && b.min.y <= a.max.y;
  if (beside == level) return -1.0;
  const double low = beside ? std::min(a.max.y, b.max.y) : std::min(a.max.x, b.max.x);
  const double high = beside ? std::max(a.min.y, b.min.y) : std::max(a.min.x, b.min.x);
  const Difference gap = difference(high, low);
  return gap.is_exact ? gap.value : -1.0;
}

}  // namespace

int side_of(Vec2 a, Vec2 b, Vec2 c) noexcept {
  const Difference abx = difference(b.x, a.x);
  const Difference aby = difference(b.y, a.y);
  const Difference acx = difference(c.x, a.x);
  const Difference acy = difference(c.y, a.y);
  const double left = abx.value * acy.value;
  const double right = aby.value * acx.value;
  const double area = left - right;
  constexpr double error_bound = 4.5e-16;  // 4 roundings of half an ulp, generously
  if (std::abs(area) > error_bound * (std::abs(left) + std::abs(right))) return sign_of(area);
  if (abx.is_exact && aby.is_exact && acx.is_exact && acy.is_exact) {
    return compare_products(abx.value, acy.value, aby.value, acx.value);
  }
  return cross(between(a, b), between(a, c)).sign();
}

bool contains(const Segment& s, Vec2 p) noexcept { return box_of(s).contains(p) && side_of(s.a, s.b, p) == 0; }

bool touch(const Segment& s, const Segment& t) noexcept {
  if (!box_of(s).meets(box_of(t))) return false;
  if (side_of(t.a, t.b, s.a) * side_of(t.a, t.b, s.b) > 0) return false;
  if (side_of(s.a, s.b, t.a) * side_of(s.a, s.b, t.b) > 0) return false;
  // Each meets the other's line. Off one common line that is a shared point; on it an end of one lies in the other.
  if (side_of(t.a, t.b, s.a) != 0 || side_of(t.a, t.b, s.b) != 0) return true;
  return contains(s, t.a) || contains(s, t.b) || contains(t, s.a) || contains(t, s.b);
}

bool cross_inside(const Segment& s, const Segment& t) noexcept {
  return side_of(t.a, t.b, s.a) * side_of(t.a, t.b, s.b) < 0 && side_of(s.a, s.b, t.a) * side_of(s.a, s.b, t.b) < 0;
}

double distance(const Segment& s, const Segment& t) noexcept {
  if (is_flat(s) && is_flat(t)) return std::sqrt(gap_sq(box_of(s), box_of(t)));  // each is its own box
  if (touch(s, t)) return 0.0;
  const double ends_sq = std::min({distance_sq(s.a, t), distance_sq(s.b, t), distance_sq(t.a, s), distance_sq(t.b, s)});
  return std::sqrt(std::max(ends_sq, gap_sq(box_of(s), box_of(t))));
}

bool closer_than(const Segment& s, const Segment& t, double r) noexcept {
  const double d = distance(s, t);
  if (d == 0.0 && touch(s, t)) return true;
  Box both = box_of(s);
  both.include(box_of(t));
  const double error_bound = 1e-14 * std::max(both.width(), both.height());
  if (d < r - error_bound) return true;
  if (d > r + error_bound) return false;
  if (is_flat(s) && is_flat(t)) {
    const double gap = exact_facing_gap(box_of(s), box_of(t));
    if (gap >= 0.0) return gap < r;
  }
  return exactly_closer(s.a, t, r) || exactly_closer(s.b, t, r) || exactly_closer(t.a, s, r) ||
         exactly_closer(t.b, s, r);
}

}  // namespace warren::exact

namespace warren {
namespace {
// Arc and segment: nearest points are ends of one or the other, or lie on a line through the centre that is square to
// the segment; or they are one point.

/// Does the arc have a point in this direction from its centre?
bool sweeps(const Arc& arc, Vec2 direction) {
  const Vec2 first = arc.from - arc.center;
  double angle = portable::atan2(cross(first, direction), dot(first, direction));
  if (arc.turn < 0.0) angle = -angle;
  if (angle < 0.0) angle += 2.0 * std::numbers::pi;
  return angle <= std::abs(arc.turn);
}

}  // namespace

Vec2 Arc::at(double angle) const {
  const auto [s, c] = portable::sin_and_cos(angle);
  const Vec2 v = from - center;
  return center + Vec2{c * v.x - s * v.y, s * v.x + c * v.y};
}

double distance(const Arc& arc, const Segment& s) noexcept {
  const Vec2 last = arc.at(arc.turn);
  double least = std::min(exact::distance({arc.from, arc.from}, s), exact::distance({last, last}, s));
  const double radius = portable::hypot(arc.from.x - arc.center.x, arc.from.y - arc.center.y);
  for (const Vec2 end : {s.a, s.b}) {
    const Vec2 off = end - arc.center;
    if (sweeps(arc, off)) least = std::min(least, std::abs(portable::hypot(off.x, off.y) - radius));
  }
  const Vec2 along = s.b - s.a;
  const double square = along.x * along.x + along.y * along.y;
  if (!(square > 0.0)) return least;
  const Vec2 to_center = arc.center - s.a;
  const double foot = (to_center.x * along.x + to_center.y * along.y) / square;
  const double area = along.x * to_center.y - along.y * to_center.x;
  const double height = std::abs(area) / std::sqrt(square);
  if (height * height <= radius * radius) {
    const double half = std::sqrt((radius * radius - height * height) / square);
    for (const double t : {foot - half, foot + half}) {  // where it meets the circle
      if (t >= 0.0 && t <= 1.0 && sweeps(arc, s.a + t * along - arc.center)) return 0.0;
    }
  }
  if (foot > 0.0 && foot < 1.0 && height >= radius && sweeps(arc, s.a + foot * along - arc.center)) {
    least = std::min(least, height - radius);
  }
  return least;
}

}  // namespace warren
