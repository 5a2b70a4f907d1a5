// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace warren {

std::vector<double> PlotAxis::ticks() const {
  if (!logarithmic_) {
    const double step = tick_step(high_ - low_, 5.0);
    return ticks_between(low_, high_, whole_ ? std::max(1.0, step) : step);
  }
  std::vector<double> ticks;
  const bool few = high_ - low_ < 2.5;
  for (int decade = static_cast<int>(std::floor(low_)); decade <= static_cast<int>(std::ceil(high_)); ++decade) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10.0, decade);
      const bool inside = scaled(value) > low_ - 1e-9 && scaled(value) < high_ + 1e-9;
      if (inside && (few || digit == 1.0)) ticks.push_back(value);
    }
  }
  return ticks;
}

PlotAxis axis_around(double low, double high, bool logarithmic, bool from_zero, bool whole) {
  if (low > high) low = high = 1.0;
  if (logarithmic) {
    const double room = std::max(1.15, std::pow(high / low, 0.05));
    return {low / room, high * room, true, false};
  }
  if (from_zero) low = std::min(low, 0.0);
  const double room = high > low ? 0.06 * (high - low) : std::max(1.0, 0.5 * std::abs(high));
  return {from_zero && low >= 0.0 ? 0.0 : low - room, high + room, false, whole};
}

std::string short_text(double value) {
  constexpr std::array<std::string_view, 4> units{"", "k", "M", "G"};
  std::size_t unit = 0;
  for (; std::abs(value) >= 1000.0 && unit + 1 < units.size(); ++unit) value /= 1000.0;
  std::string text = fmt::format("{:.4g}{}", value, units[unit]);
  if (const std::size_t at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
  return text;
}

std::string tick_on_axis(double value, std::string_view name) {
  if (!name.starts_with("seconds") || value == 0.0) return short_text(value);
  constexpr std::array<std::string_view, 4> units{"ns", "us", "ms", "s"};
  std::size_t unit = 0;
  for (value *= 1e9; std::abs(value) >= 999.95 && unit + 1 < units.size(); ++unit) value /= 1000.0;
  return fmt::format("{} {}", short_text(value), units[unit]);
}

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
