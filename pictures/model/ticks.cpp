// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace warren {

double tick_step(double range, double count) {
  const double wish = range / count;
  const double power = std::pow(10.0, std::floor(std::log10(wish)));
  const double digit = wish / power;
  return power * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

std::vector<double> ticks_between(double low, double high, double step) {
  std::vector<double> ticks;
  constexpr double nearly = 1e-9;
  for (double i = std::ceil(low / step - nearly) + 0.0; i * step <= high + nearly * step; i += 1.0) {
    ticks.push_back(i * step);
  }
  return ticks;
}

std::string tick_text(double value, double step) {
  const double largest = std::abs(value);
  if (largest < 0.5 * step) return "0";
  if (largest >= 1e7 || step < 1e-5) return fmt::format("{:.6g}", value);
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 5);
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace warren
