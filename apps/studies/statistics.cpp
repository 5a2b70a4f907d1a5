// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace warren::studies {
namespace {

constexpr double tail = 0.025;                   // beyond either end of an interval
constexpr double normal_95 = 1.959963984540054;  // the 97.5 % point of the normal distribution

/// Student's t on the scale of the logarithm (the delta method), so that it never ends below zero.
Interval mean_interval(std::span<const double> values, double mean) {
  if (!(mean > 0.0)) return {mean, mean};
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto n = static_cast<double>(values.size());
  const double factor = std::exp(student_t(values.size() - 1) * std::sqrt(squares / (n - 1.0) / n) / mean);
  return {mean / factor, mean * factor};
}

}  // namespace

double sorted_quantile(std::span<const double> sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double median_of(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted_quantile(sorted, 0.5);
}

Vec2 mean_logarithms(std::span<const Vec2> points) {
  Vec2 mean;
  for (const Vec2 p : points) mean = mean + Vec2{std::log(p.x), std::log(p.y)};
  return points.empty() ? mean : 1.0 / static_cast<double>(points.size()) * mean;
}

std::optional<double> common_exponent(std::span<const std::vector<Vec2>> groups) {
  double xx = 0.0;
  double xy = 0.0;
  for (const std::vector<Vec2>& group : groups) {
    const Vec2 mean = mean_logarithms(group);
    for (const Vec2 p : group) {
      const Vec2 d = Vec2{std::log(p.x), std::log(p.y)} - mean;
      xx += d.x * d.x;
      xy += d.x * d.y;
    }
  }
  constexpr double least = 1e-20;  // below it all x are the same but for rounding
  return xx > least ? std::optional(xy / xx) : std::nullopt;
}

double student_t(std::uint64_t degrees) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(degrees)), 1.0 - tail);
}

std::optional<std::pair<std::size_t, std::size_t>> median_ranks(std::size_t count) {
  constexpr std::size_t fewest = 6;
  if (count < fewest) return std::nullopt;
  const boost::math::binomial below_median(static_cast<double>(count), 0.5);  // how many values are
  const auto rank = static_cast<std::size_t>(boost::math::quantile(below_median, tail));
  return std::pair{rank, count - 1 - rank};
}

std::optional<Distribution> distribution_of(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  Distribution d{.least = sorted.front(),
                 .q1 = sorted_quantile(sorted, 0.25),
                 .median = sorted_quantile(sorted, 0.5),
                 .q3 = sorted_quantile(sorted, 0.75),
                 .most = sorted.back(),
                 .mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size()),
                 .mean_ci95 = {},
                 .median_ci95 = {}};
  if (sorted.size() > 1) d.mean_ci95 = mean_interval(sorted, d.mean);
  if (const auto ranks = median_ranks(sorted.size())) {
    d.median_ci95 = Interval{sorted[ranks->first], sorted[ranks->second]};
  }
  return d;
}

Interval wilson_interval(std::uint64_t successes, std::uint64_t trials) {
  const auto n = static_cast<double>(trials);
  const double share = static_cast<double>(successes) / n;
  const double z2 = normal_95 * normal_95;
  const double centre = share + z2 / (2.0 * n);
  const double half_width = normal_95 * std::sqrt(share * (1.0 - share) / n + z2 / (4.0 * n * n));
  const double scale = 1.0 + z2 / n;
  return {successes == 0 ? 0.0 : (centre - half_width) / scale,
          successes == trials ? 1.0 : (centre + half_width) / scale};
}

}  // namespace warren::studies
