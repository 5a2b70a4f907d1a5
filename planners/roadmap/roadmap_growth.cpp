// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/roadmap_growth.hpp"

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

/// The volume of the ball of radius 1.
double unit_ball(std::size_t dimension) {
  if (dimension < 2) return dimension == 0 ? 1.0 : 2.0;
  return 2.0 * std::numbers::pi / static_cast<double>(dimension) * unit_ball(dimension - 2);
}

/// The n-th root of x > 0, n >= 1: Newton's steps from above go down until rounding stops them. Not std::pow, whose
/// last bit is the library's affair.
double root(double x, std::size_t n) {
  const auto degree = static_cast<double>(n);
  for (double y = std::max(1.0, x);;) {
    double rest = x;
    for (std::size_t i = 1; i < n; ++i) rest /= y;
    const double next = y + (rest - y) / degree;
    if (!(next < y)) return y;
    y = next;
  }
}

}  // namespace

ConnectionRule star_rule(StarRule rule, std::uint64_t samples, std::size_t dimension, double volume) {
  const double n = std::max(static_cast<double>(samples), 2.0);
  const auto d = static_cast<double>(dimension);
  if (rule == StarRule::neighbours) {
    return {0.0, static_cast<std::uint32_t>(std::ceil(std::numbers::e * (1.0 + 1.0 / d) * portable::log(n)))};
  }
  if (!(volume > 0.0)) throw UsageError("@radius: star: this world doesn't tell its volume; say @neighbours star");
  return {2.0 * root((1.0 + 1.0 / d) * volume / unit_ball(dimension) * portable::log(n) / n, dimension), 0};
}

}  // namespace warren
