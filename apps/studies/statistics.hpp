// SPDX-License-Identifier: BSD-3-Clause
// What a sample says about what it was drawn from: quantiles, mean, and 95 % intervals. Every function takes the values
// in any order. Quantiles interpolate linearly between order statistics (R's type 7, numpy's default).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/types.hpp"

namespace warren::studies {

/// Both ends included.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// A sample in short.
struct Distribution {
  double least = 0.0;
  double q1 = 0.0;
  double median = 0.0;
  double q3 = 0.0;
  double most = 0.0;
  double mean = 0.0;
  /// Student's t for the mean's logarithm, of values >= 0 as times are; none of fewer than two values.
  std::optional<Interval> mean_ci95;
  /// Of order statistics, free of any assumption: where the percentile bootstrap of the median ends, without its draws.
  /// None of fewer than six values.
  std::optional<Interval> median_ci95;
};

/// Nothing of no values. All values finite and >= 0. O(n log n).
std::optional<Distribution> distribution_of(std::span<const double> values);

/// The quantile at `share` (0 to 1) of sorted values, at least one.
double sorted_quantile(std::span<const double> sorted, double share);

/// The middle of the values, at least one.
double median_of(std::span<const double> values);

/// Of both coordinates; of no points 0.
Vec2 mean_logarithms(std::span<const Vec2> points);

/// The least-squares slope of log y over log x that the groups have in common, each with a level of its own; none
/// where no group has two different x. All coordinates > 0.
std::optional<double> common_exponent(std::span<const std::vector<Vec2>> groups);

/// Where the chance of success lies: Wilson's score interval (1927), 95 %, within [0, 1]. trials >= 1.
Interval wilson_interval(std::uint64_t successes, std::uint64_t trials);

/// The 97.5 % point of Student's t with so many degrees of freedom, >= 1.
double student_t(std::uint64_t degrees);

/// Ranks (from 0) of the two sorted values that enclose the median of any distribution with at least 95 %; none of
/// fewer than six values.
std::optional<std::pair<std::size_t, std::size_t>> median_ranks(std::size_t count);

}  // namespace warren::studies
