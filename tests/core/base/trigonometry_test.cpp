// SPDX-License-Identifier: BSD-3-Clause
// Against the same functions in long double, whose errors are a thousandth of a double's last place or less.
#include "core/base/trigonometry.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

/// The error in units of the last place of a double near the wanted number.
double units_off(double got, long double wanted) {
  const auto near = std::abs(static_cast<double>(wanted));
  const double unit = std::nextafter(near, infinity) - near;
  return static_cast<double>(std::abs(static_cast<long double>(got) - wanted) / unit);
}

/// Numbers of either sign, as many of each size from 2^lowest to 2^highest.
double number_of_any_size(std::uint64_t index, std::uint64_t axis, double lowest, double highest) {
  const double sign = random_bits(5, index, axis + 1) % 2 == 0 ? 1.0 : -1.0;
  return sign * std::exp2(lowest + (highest - lowest) * uniform(5, index, axis));
}

struct Case {
  const char* name;
  double bound;
  std::function<double(std::uint64_t)> argument;
  double (*ours)(double);
  long double (*wanted)(long double);
};

TEST(Trigonometry, ErrorsAreWithinTheirBounds) {
  const auto turns = [](std::uint64_t i) { return 2.0 * pi * (2.0 * uniform(1, i, 0) - 1.0); };
  const auto headings = [](std::uint64_t i) { return 6283.0 * (2.0 * uniform(2, i, 0) - 1.0); };
  const auto any = [](std::uint64_t i) { return number_of_any_size(i, 0, -60.0, 20.0); };
  const auto near_quarters = [](std::uint64_t i) {
    double x = 0.5 * pi * (static_cast<double>(i % 4001) - 2000.0);
    for (std::uint64_t k = 0; k < i % 5; ++k) x = std::nextafter(x, infinity);
    return x;
  };
  const auto unit = [](std::uint64_t i) { return 2.0 * uniform(3, i, 0) - 1.0; };
  const auto near_one = [](std::uint64_t i) { return 1.0 - std::exp2(-53.0 * uniform(4, i, 0)); };
  const auto above_zero = [](std::uint64_t i) { return std::abs(number_of_any_size(i, 0, -1000.0, 1000.0)); };
  const auto near_two = [](std::uint64_t i) { return 2.0 * uniform(6, i, 0) + 0x1p-60; };
  const std::vector<Case> cases{
      {"sin", 1.0, turns, portable::sin, std::sin},
      {"sin", 1.0, headings, portable::sin, std::sin},
      {"sin", 1.0, any, portable::sin, std::sin},
      {"sin", 1.0, near_quarters, portable::sin, std::sin},
      {"cos", 1.0, turns, portable::cos, std::cos},
      {"cos", 1.0, headings, portable::cos, std::cos},
      {"cos", 1.0, any, portable::cos, std::cos},
      {"cos", 1.0, near_quarters, portable::cos, std::cos},
      {"tan", 4.0, turns, portable::tan, std::tan},
      {"atan", 1.5, any, portable::atan, std::atan},
      {"atan", 1.5, [](std::uint64_t i) { return 4.0 * uniform(7, i, 0); }, portable::atan, std::atan},
      {"asin", 1.0, unit, portable::asin, std::asin},
      {"asin", 1.0, near_one, portable::asin, std::asin},
      {"acos", 1.0, unit, portable::acos, std::acos},
      {"acos", 1.0, near_one, portable::acos, std::acos},
      {"log", 1.0, above_zero, portable::log, std::log},
      {"log", 1.0, near_two, portable::log, std::log},
      {"log1p", 4.0, [](std::uint64_t i) { return uniform(8, i, 0) - 0.9; }, portable::log1p, std::log1p},
      {"asinh", 4.0, any, portable::asinh, std::asinh},
  };
  for (const Case& c : cases) {
    double worst = 0.0;
    double where = 0.0;
    for (std::uint64_t i = 0; i < 100000; ++i) {
      const double x = c.argument(i);
      const double off = units_off(c.ours(x), c.wanted(x));
      if (off > worst) {
        worst = off;
        where = x;
      }
    }
    EXPECT_LE(worst, c.bound) << c.name << " of " << where;
  }
}

TEST(Trigonometry, ErrorsOfTwoArgumentsAreWithinTheirBounds) {
  double worst_angle = 0.0;
  double worst_length = 0.0;
  for (std::uint64_t i = 0; i < 300000; ++i) {
    const double spread = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 60.0 : 990.0;
    const double x = number_of_any_size(i, 0, -spread, spread);
    const double y = number_of_any_size(i, 2, -spread, spread);
    const double z = number_of_any_size(i, 4, -spread, spread);
    const auto length = std::hypot(static_cast<long double>(x), static_cast<long double>(y));
    const auto length_3 = std::hypot(length, static_cast<long double>(z));
    const long double angle = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    if (std::abs(angle) > 0x1p-1000L) worst_angle = std::max(worst_angle, units_off(portable::atan2(y, x), angle));
    worst_length = std::max({worst_length, units_off(portable::hypot(x, y), length)});
    EXPECT_LE(units_off(portable::hypot(x, y, z), length_3), 2.0);
  }
  EXPECT_LE(worst_angle, 1.5);
  EXPECT_LE(worst_length, 1.5);
}

/// The same bits wherever this test passes: of sums and of bits, so that no difference cancels out.
TEST(Trigonometry, BitsAreTheSameOnEveryMachine) {
  std::uint64_t hash = 0;
  const auto add = [&](double x) { hash = mix64(hash * 0x9e3779b97f4a7c15U + std::bit_cast<std::uint64_t>(x)); };
  for (std::uint64_t i = 0; i < 200000; ++i) {
    const double x = 20.0 * (uniform(1, i, 0) - 0.5);
    const double y = 20.0 * (uniform(1, i, 1) - 0.5);
    add(portable::sin(x));
    add(portable::cos(x * 100.0));
    add(portable::tan(y));
    add(portable::atan2(y, x));
    add(portable::atan(x));
    add(portable::asin(0.1 * x));
    add(portable::acos(0.1 * y));
    add(portable::hypot(x, y));
    add(portable::log(std::abs(x)));
    add(portable::log1p(std::abs(x)));
    add(portable::asinh(y));
  }
  EXPECT_EQ(hash, 14532973031075428371U);
}

TEST(Trigonometry, SineAndCosineTogetherAreEachAlone) {
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const double x = number_of_any_size(i, 0, -60.0, 60.0);
    const auto [sine, cosine] = portable::sin_and_cos(x);
    EXPECT_EQ(sine, portable::sin(x));
    EXPECT_EQ(cosine, portable::cos(x));
    EXPECT_EQ(portable::sin(-x), -sine);
    EXPECT_EQ(portable::cos(-x), cosine);
    EXPECT_LE(std::abs(sine * sine + cosine * cosine - 1.0), 1e-15);
  }
}

bool same(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(Trigonometry, ZerosInfinitiesAndNansAreAsInTheStandardLibrary) {
  const double ends[] = {0.0, 1.0, 5e-324, 1e-310, 1e300, std::numeric_limits<double>::max(), infinity, not_a_number};
  for (const double size_x : ends) {
    for (const double x : {size_x, -size_x}) {
      SCOPED_TRACE(x);
      const bool angle = std::abs(x) <= 1.0 || !std::isfinite(x);
      if (angle) {
        EXPECT_TRUE(same(portable::sin(x), std::sin(x)));
        EXPECT_TRUE(same(portable::cos(x), std::cos(x)));
        EXPECT_TRUE(same(portable::asin(x), std::asin(x)));
        EXPECT_TRUE(same(portable::acos(x), std::acos(x)));
      }
      EXPECT_TRUE(same(portable::atan(x), std::atan(x)));
      if (std::abs(x) != 1.0) {
        EXPECT_TRUE(same(portable::asinh(x), std::asinh(x)));
      }
      EXPECT_TRUE(same(portable::log1p(std::abs(x)), std::log1p(std::abs(x))));
      EXPECT_TRUE(same(portable::log(x), std::log(x)));
      for (const double size_y : ends) {
        for (const double y : {size_y, -size_y}) {
          EXPECT_TRUE(same(portable::atan2(y, x), std::atan2(y, x))) << y << " " << portable::atan2(y, x);
          EXPECT_TRUE(same(portable::hypot(y, x), std::hypot(y, x))) << y << " " << portable::hypot(y, x);
        }
      }
    }
  }
  EXPECT_TRUE(std::isnan(portable::asin(1.0000000000000002)));
  EXPECT_TRUE(std::isnan(portable::acos(-1.0000000000000002)));
  EXPECT_TRUE(same(portable::log1p(-1.0), -infinity));
  EXPECT_LE(std::abs(portable::sin(1e22)), 1.0);
}

}  // namespace
}  // namespace warren
