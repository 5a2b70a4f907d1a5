// SPDX-License-Identifier: BSD-3-Clause
#include "verify/exact/leg_cost.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/trigonometry.hpp"

namespace warren::exact {
namespace {

double least_of(const SquaredDistance& q, double length) {
  const double ends = std::min(q.at(0.0), q.at(length));
  const bool turns_inside = !q.is_line && q.b < 0.0 && -q.b < 2.0 * q.a * length;
  return turns_inside ? std::min(ends, q.apart_sq) : ends;
}

/// Adds the places inside where a t^2 + b t + c is 0.
void add_roots(double a, double b, double c, double length, std::vector<double>& cuts) {
  const auto add = [&](double t) {
    if (t > 0.0 && t < length) cuts.push_back(t);  // not NaN
  };
  if (a == 0.0) return add(-c / b);
  const double inside = b * b - 4.0 * a * c;
  if (inside < 0.0) return;
  const double sum = -0.5 * (b + std::copysign(std::sqrt(inside), b));
  add(sum / a);
  add(c / sum);
}

/// The integral of the distance itself.
double integral_of_distance(const SquaredDistance& q, double from, double to) {
  constexpr double no_area = 1e-30;
  if (q.is_line) return (to - from) * std::abs(q.off - 0.5 * q.slope * (from + to));
  const auto until = [&](double t) {
    const double v = t + 0.5 * q.b;
    const double d = std::sqrt(v * v + q.apart_sq);
    const double bend = q.apart_sq > no_area ? q.apart_sq * portable::asinh(v / std::sqrt(q.apart_sq)) : 0.0;
    return 0.5 * (v * d + bend);
  };
  return until(to) - until(from);
}

double integral_of_one(const SquaredDistance& q, double from, double to, double reach) {
  const double length = to - from;
  const double squares = length / 6.0 * (q.at(from) + 4.0 * q.at(0.5 * (from + to)) + q.at(to));
  return length - 2.0 / reach * integral_of_distance(q, from, to) + squares / (reach * reach);
}

}  // namespace

double NearnessCost::over(std::span<const SquaredDistance> things, double length, double reach) {
  double enough = reach * reach;
  for (const SquaredDistance& q : things) enough = std::min(enough, std::max(q.at(0.0), q.at(length)));
  near_.clear();
  for (const SquaredDistance& q : things) {
    if (least_of(q, length) <= enough * (1.0 + 1e-12)) near_.push_back(q);
  }
  if (near_.empty()) return 0.0;
  cuts_.assign({0.0, length});
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const SquaredDistance& q = near_[i];
    add_roots(q.a, q.b, q.c - reach * reach, length, cuts_);
    for (std::size_t j = i + 1; j < near_.size(); ++j) {
      add_roots(q.a - near_[j].a, q.b - near_[j].b, q.c - near_[j].c, length, cuts_);
    }
  }
  std::sort(cuts_.begin(), cuts_.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < cuts_.size(); ++i) {
    const double middle = 0.5 * (cuts_[i - 1] + cuts_[i]);
    const auto nearest = std::min_element(near_.begin(), near_.end(), [&](const auto& one, const auto& other) {
      return one.at(middle) < other.at(middle);
    });
    if (nearest->at(middle) < reach * reach) sum += integral_of_one(*nearest, cuts_[i - 1], cuts_[i], reach);
  }
  return std::max(sum, 0.0);
}

}  // namespace warren::exact
