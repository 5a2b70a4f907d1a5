// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/nearness.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

/// Distances are compared by their squares.
double squared(const StretchDistance& thing, double t) {
  const double side = thing.at_begin + thing.slope * t;
  return thing.is_side ? side * side : (t - thing.foot) * (t - thing.foot) + thing.apart_sq;
}
double least_squared(const StretchDistance& thing, double from, double to) {
  if (!thing.is_side) return squared(thing, std::clamp(thing.foot, from, to));
  return std::min(squared(thing, from), squared(thing, to));
}

/// The integral of sqrt(v^2 + k) between two places of which `from_d` and `to_d` are the values.
double integral_of_root(double from, double to, double from_d, double to_d, double k) {
  const double plain = to * to_d - from * from_d;
  if (!(k > 0.0)) return 0.5 * plain;
  const double ratio = from >= 0.0 ? (to + to_d) / (from + from_d)
                       : to <= 0.0 ? (from_d - from) / (to_d - to)
                                   : (to + to_d) * (from_d - from) / k;
  return 0.5 * (plain + k * portable::log(ratio));
}

double integral_of_one(const StretchDistance& thing, double from, double to, double reach) {
  const double length = to - from;
  if (thing.is_side) {
    const double a = 1.0 - thing(from) / reach;
    const double b = 1.0 - thing(to) / reach;
    return length * (a * a + a * b + b * b) / 3.0;
  }
  const double a = from - thing.foot;
  const double b = to - thing.foot;
  const double roots = integral_of_root(a, b, thing(from), thing(to), thing.apart_sq);
  const double squares = length * ((a * a + a * b + b * b) / 3.0 + thing.apart_sq);
  return std::max(0.0, length - 2.0 / reach * roots + squares / (reach * reach));
}

/// The roots of a t^2 - 2 b t + c, both; NaN where there are none.
std::pair<double, double> roots_of(double a, double b, double c) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double inside = b * b - a * c;
  if (inside < 0.0) return {none, none};
  const double root = std::sqrt(inside);
  const double larger = b >= 0.0 ? b + root : b - root;
  if (larger == 0.0) return {a == 0.0 ? none : 0.0, none};
  return {c / larger, a == 0.0 ? none : larger / a};
}

/// Where the two are equally far: up to two places, NaN for none.
std::pair<double, double> meetings(const StretchDistance& one, const StretchDistance& other) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (one.is_side && other.is_side) return {(other.at_begin - one.at_begin) / (one.slope - other.slope), none};
  if (!one.is_side && !other.is_side) {
    const double apart = one.foot - other.foot;
    return {0.5 * (one.foot + other.foot + (one.apart_sq - other.apart_sq) / apart), none};
  }
  const StretchDistance& side = one.is_side ? one : other;
  const StretchDistance& corner = one.is_side ? other : one;
  // (t - foot)^2 + apart^2 = (at_begin + slope t)^2, with t from the foot so that the numbers are small
  const double at_foot = side(corner.foot);
  const auto [first, second] =
      roots_of(1.0 - side.slope * side.slope, side.slope * at_foot, corner.apart_sq - at_foot * at_foot);
  return {corner.foot + first, corner.foot + second};
}

/// Where the distance is the reach.
std::pair<double, double> ends_of_reach(const StretchDistance& thing, double reach) {
  if (thing.is_side) return {(reach - thing.at_begin) / thing.slope, std::numeric_limits<double>::quiet_NaN()};
  const double half = std::sqrt(reach * reach - thing.apart_sq);  // NaN where it is farther everywhere
  return {thing.foot - half, thing.foot + half};
}

}  // namespace

double NearnessSum::integral(std::span<const StretchDistance> things, double from, double to, double reach) {
  if (!(to > from)) return 0.0;
  const auto is_all = [&](const StretchDistance& thing) {
    return std::max(squared(thing, from), squared(thing, to)) <= reach * reach;
  };
  if (things.size() == 1 && is_all(things[0])) return integral_of_one(things[0], from, to, reach);  // most often
  double enough = reach * reach;  // what is everywhere farther than this is nowhere the nearest, or beyond the reach
  for (const StretchDistance& thing : things)
    enough = std::min(enough, std::max(squared(thing, from), squared(thing, to)));
  near_.clear();
  for (const StretchDistance& thing : things) {
    if (least_squared(thing, from, to) <= enough) near_.push_back(thing);
  }
  if (near_.size() == 1 && is_all(near_[0])) return integral_of_one(near_[0], from, to, reach);
  cuts_.assign(1, from);
  const auto cut_at = [&](const std::pair<double, double>& both) {
    for (const double t : {both.first, both.second}) {
      if (t > from && t < to) cuts_.push_back(t);
    }
  };
  for (std::size_t i = 0; i < near_.size(); ++i) {
    cut_at(ends_of_reach(near_[i], reach));
    for (std::size_t j = 0; j < i; ++j) cut_at(meetings(near_[i], near_[j]));
  }
  cuts_.push_back(to);
  std::sort(cuts_.begin(), cuts_.end());
  double sum = 0.0;
  for (std::size_t c = 1; c < cuts_.size(); ++c) {
    const double middle = 0.5 * (cuts_[c - 1] + cuts_[c]);
    const StretchDistance* nearest = nullptr;
    double least = reach * reach;
    for (const StretchDistance& thing : near_) {
      const double d = squared(thing, middle);
      if (d < least) {
        least = d;
        nearest = &thing;
      }
    }
    if (nearest != nullptr) sum += integral_of_one(*nearest, cuts_[c - 1], cuts_[c], reach);
  }
  return sum;
}

}  // namespace warren
