// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"

namespace warren::studies {
namespace {

TEST(Statistics, QuantilesAreNumpysDefault) {
  // numpy.percentile([7, 1, 3, 9], [25, 50, 75]) = 2.5, 5.0, 7.5
  const auto d = distribution_of(std::vector<double>{7, 1, 3, 9});
  ASSERT_TRUE(d);
  EXPECT_DOUBLE_EQ(d->q1, 2.5);
  EXPECT_DOUBLE_EQ(d->median, 5.0);
  EXPECT_DOUBLE_EQ(d->q3, 7.5);
  EXPECT_DOUBLE_EQ(d->least, 1.0);
  EXPECT_DOUBLE_EQ(d->most, 9.0);
  EXPECT_DOUBLE_EQ(d->mean, 5.0);
  EXPECT_DOUBLE_EQ(median_of(std::vector<double>{3, 1, 2}), 2.0);
}

TEST(Statistics, MeanIntervalIsStudentsOnTheLogarithmsScale) {
  // t.test(c(5.1, 4.9, 6.2, 5.8, 5.5)): mean 5.5, standard error sqrt(0.275 / 5), t 2.77645.
  const auto d = distribution_of(std::vector<double>{5.1, 4.9, 6.2, 5.8, 5.5});
  ASSERT_TRUE(d && d->mean_ci95);
  const double log_half_width = 2.77645 * std::sqrt(0.275 / 5) / 5.5;
  EXPECT_NEAR(std::log(d->mean_ci95->low), std::log(5.5) - log_half_width, 1e-5);
  EXPECT_NEAR(std::log(d->mean_ci95->high), std::log(5.5) + log_half_width, 1e-5);
}

TEST(Statistics, NoIntervalOfTimesEndsBelowZero) {
  std::vector<double> times(20, 1e-6);
  times.push_back(40e-6);  // somebody else had the processor: Student's interval of the mean would begin at -1 us
  const auto d = distribution_of(times);
  ASSERT_TRUE(d && d->mean_ci95 && d->median_ci95);
  EXPECT_GT(d->mean_ci95->low, 0.0);
  EXPECT_GT(d->mean_ci95->high, d->mean);
  EXPECT_EQ(d->median_ci95->low, 1e-6);
  EXPECT_EQ(d->median_ci95->high, 1e-6);
  const auto zeros = distribution_of(std::vector<double>{0.0, 0.0, 0.0});
  ASSERT_TRUE(zeros && zeros->mean_ci95);
  EXPECT_EQ(zeros->mean_ci95->high, 0.0);
}

/// The 2.5 and 97.5 per cent points of the medians of many samples drawn from the sample, as ranks.
std::pair<double, double> bootstrap_ranks(std::size_t count, std::uint64_t seed) {
  std::vector<double> ranks(count);
  std::iota(ranks.begin(), ranks.end(), 0.0);
  SequentialRng rng(seed);
  std::vector<double> medians;
  for (int draw = 0; draw < 4000; ++draw) {
    std::vector<double> sample;
    for (std::size_t i = 0; i < count; ++i) sample.push_back(ranks[rng.below(count)]);
    medians.push_back(median_of(sample));
  }
  std::sort(medians.begin(), medians.end());
  return {sorted_quantile(medians, 0.025), sorted_quantile(medians, 0.975)};
}

TEST(Statistics, MedianIntervalEndsWhereThePercentileBootstrapDoes) {
  for (const std::size_t n : {7, 10, 20, 31, 60, 100, 401}) {
    SCOPED_TRACE(n);
    const auto ranks = median_ranks(n);
    ASSERT_TRUE(ranks);
    const auto [low, high] = bootstrap_ranks(n, n);
    EXPECT_NEAR(static_cast<double>(ranks->first), low, 1.0);
    EXPECT_NEAR(static_cast<double>(ranks->second), high, 1.0);
  }
}

TEST(Statistics, SmallSamplesClaimNoInterval) {
  EXPECT_FALSE(distribution_of({}));
  const auto one = distribution_of(std::vector<double>{4.0});
  ASSERT_TRUE(one);
  EXPECT_FALSE(one->mean_ci95);
  EXPECT_DOUBLE_EQ(one->q1, 4.0);
  const auto five = distribution_of(std::vector<double>{1, 2, 3, 4, 5});
  ASSERT_TRUE(five);
  EXPECT_TRUE(five->mean_ci95);
  EXPECT_FALSE(five->median_ci95) << "even least and most enclose the median of five values with 94 % only";
}

TEST(Statistics, StudentsTIsThatOfTheTables) {
  const std::vector<std::pair<std::uint64_t, double>> table{{1, 12.7062}, {2, 4.3027},  {4, 2.7764},  {5, 2.5706},
                                                            {6, 2.4469},  {10, 2.2281}, {30, 2.0423}, {1000, 1.9623}};
  for (const auto& [degrees, t] : table) EXPECT_NEAR(student_t(degrees), t, 5e-5) << degrees;
}

TEST(Statistics, WilsonsIntervalIsThatOfTheTables) {
  // statsmodels.stats.proportion.proportion_confint(..., method="wilson")
  const Interval half = wilson_interval(5, 10);
  EXPECT_NEAR(half.low, 0.23659, 1e-5);
  EXPECT_NEAR(half.high, 0.76341, 1e-5);
  const Interval all = wilson_interval(50, 50);
  EXPECT_NEAR(all.low, 0.92865, 1e-5);
  EXPECT_DOUBLE_EQ(all.high, 1.0);
  const Interval none = wilson_interval(0, 50);
  EXPECT_DOUBLE_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 1.0 - 0.92865, 1e-5);
  EXPECT_NEAR(wilson_interval(57, 60).low, 0.86299, 1e-5);
}

/// P(Binomial(n, 1/2) < k), summed by logarithms of factorials.
double binomial_below(std::size_t n, std::size_t k) {
  double sum = 0.0;
  for (std::size_t i = 0; i < k; ++i) {
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) - n * std::log(2.0));
  }
  return sum;
}

TEST(Statistics, MedianRanksCoverTheMedianWithNinetyFivePercentAndNoMoreThanNeeded) {
  EXPECT_FALSE(median_ranks(5));
  for (const std::size_t n : {6, 7, 10, 20, 25, 100, 101, 999, 1000, 1001, 5000}) {
    SCOPED_TRACE(n);
    const auto ranks = median_ranks(n);
    ASSERT_TRUE(ranks);
    const auto [low, high] = *ranks;
    EXPECT_EQ(low + high, n - 1);
    EXPECT_LE(binomial_below(n, low + 1), 0.025);
    EXPECT_GT(binomial_below(n, low + 2), 0.025);
  }
}

TEST(Statistics, IntervalsCoverTheTruthAboutAsOftenAsTheySay) {
  int mean_inside = 0;
  int median_inside = 0;
  constexpr std::uint64_t samples = 400;
  for (std::uint64_t seed = 1; seed <= samples; ++seed) {
    std::vector<double> values;
    for (std::uint64_t i = 0; i < 25; ++i) values.push_back(uniform(seed, i, 0));
    const auto d = distribution_of(values);
    ASSERT_TRUE(d && d->mean_ci95 && d->median_ci95);
    mean_inside += d->mean_ci95->low <= 0.5 && 0.5 <= d->mean_ci95->high ? 1 : 0;
    median_inside += d->median_ci95->low <= 0.5 && 0.5 <= d->median_ci95->high ? 1 : 0;
  }
  EXPECT_NEAR(mean_inside, 380, 18);
  EXPECT_GE(median_inside, 372);
}

TEST(Statistics, OrderOfTheValuesChangesNothing) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < 101; ++i) values.push_back(uniform(3, i, 0));
  const auto before = distribution_of(values);
  std::reverse(values.begin(), values.end());
  const auto after = distribution_of(values);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->mean, after->mean);
  EXPECT_EQ(before->mean_ci95->low, after->mean_ci95->low);
  EXPECT_EQ(before->median_ci95->high, after->median_ci95->high);
}

}  // namespace
}  // namespace warren::studies
