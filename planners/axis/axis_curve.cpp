// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/axis_curve.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

constexpr double largest_turn = 1.0 / 32.0;  // radians between two tangents

Vec2 unit(Vec2 v) {
  const double length = norm(v);
  return length > 0.0 ? (1.0 / length) * v : Vec2{1.0, 0.0};
}

}  // namespace

AxisCurve::AxisCurve(const AxisSite& one, const AxisSite& other, Vec2 from, Vec2 to) : from_(from), to_(to) {
  if (one.is_point() != other.is_point()) {
    const Vec2 focus = one.is_point() ? one.a : other.a;
    const AxisSite& directrix = one.is_point() ? other : one;
    along_ = unit(directrix.b - directrix.a);
    origin_ = directrix.a + dot(focus - directrix.a, along_) * along_;
    const double side = cross(along_, focus - directrix.a);
    upwards_ = side < 0.0 ? Vec2{along_.y, -along_.x} : Vec2{-along_.y, along_.x};
    focal_ = std::abs(side);
    waist_ = 0.0;
  }
  if (focal_ == 0.0) {
    origin_ = from;
    along_ = unit(to - from);
    if (one.is_point() && other.is_point()) waist_ = parameter_beside(one.a);
  }
  first_ = parameter_beside(from);
  last_ = parameter_beside(to);
}

Vec2 AxisCurve::at(double parameter) const {
  const Vec2 foot = origin_ + parameter * along_;
  if (focal_ == 0.0) return foot;
  return foot + (0.5 * (parameter / focal_ * parameter + focal_)) * upwards_;
}

AxisCurve AxisCurve::part(double from, double to) const {
  AxisCurve result = *this;
  result.first_ = from;
  result.last_ = to;
  result.from_ = from == first_ ? from_ : from == last_ ? to_ : at(from);
  result.to_ = to == first_ ? from_ : to == last_ ? to_ : at(to);
  return result;
}

AxisCurve AxisCurve::between(Vec2 from, Vec2 to) const {
  AxisCurve result = *this;
  result.from_ = from;
  result.to_ = to;
  return result;
}

double AxisCurve::length() const {
  if (focal_ == 0.0) return std::abs(last_ - first_);
  const auto from_apex = [&](double t) {
    const double slope = t / focal_;
    return 0.5 * (t * std::sqrt(1.0 + slope * slope) + focal_ * portable::asinh(slope));
  };
  return std::abs(from_apex(last_) - from_apex(first_));
}

double AxisCurve::slope_angle(double parameter) const { return portable::atan(parameter / focal_); }

void AxisCurve::append_polyline(std::vector<Vec2>& path) const {
  if (focal_ > 0.0) {
    const auto append = [&](double t0, double t1) {
      const double turn = slope_angle(t1) - slope_angle(t0);
      const double count = std::max(1.0, std::ceil(std::abs(turn) / largest_turn));
      double touches = t0;
      for (double i = 1.0; i <= count; i += 1.0) {
        const double next = i == count ? t1 : focal_ * portable::tan(slope_angle(t0) + turn * (i / count));
        const double height = 0.5 * (touches / focal_ * next + focal_);  // where the tangents of both meet
        path.push_back(origin_ + (0.5 * (touches + next)) * along_ + height * upwards_);
        touches = next;
      }
    };
    const bool over_apex = std::min(first_, last_) < 0.0 && std::max(first_, last_) > 0.0;
    if (over_apex) append(first_, 0.0);  // a tangent at the narrowest point keeps its clearance exactly
    append(over_apex ? 0.0 : first_, last_);
  }
  path.push_back(to_);
}

}  // namespace warren
