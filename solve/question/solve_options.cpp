// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/solve_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "core/base/error.hpp"
#include "solve/question/question.hpp"

namespace warren {
namespace {

/// Throws UsageError for a value that the option can't have, whatever the world; what has no numbers is as it may be.
struct OptionCheck {
  template <class T>
  void operator()(Option, OptionRange, const T&) const {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(Option option, OptionRange range, const std::optional<T>& value) const {
    const bool above_zero = std::isinf(range.high);
    const auto number = static_cast<double>(value.value_or(T{1}));
    if (!value || (above_zero ? number > 0.0 && number < range.high : number >= range.low && number <= range.high))
      return;
    const std::string expected = above_zero ? "above 0" : fmt::format("from {} to {}", range.low, range.high);
    throw UsageError(fmt::format("@{}: must be a {} {} (found: {})", name_of(option),
                                 std::is_integral_v<T> ? "whole number" : "number", expected, *value));
  }
  void operator()(Option option, OptionRange range, const std::optional<GrowingAttach>& attach) const {
    if (!attach) return;
    (*this)(option, range, attach->radius);
    (*this)(option, range, attach->step);
    (*this)(option, {1, 10'000}, std::optional(attach->tries));
  }
  void operator()(Option, OptionRange, const std::vector<std::vector<double>>& via) const {
    for (const std::vector<double>& state : via) {
      const bool known = !state.empty() && state.size() <= most_joints;
      if (known && std::ranges::all_of(state, is_coordinate)) continue;
      throw UsageError("@via: a way-point is 2 or 3 numbers, of an arm one a joint, of at most 1e60");
    }
  }
};

}  // namespace

void SolveOptions::validate() const { visit_options(OptionCheck{}, *this); }

OptionSet given(const SolveOptions& options) {
  OptionSet set;
  if (const auto star = star_option(options)) set = {*star};
  const auto add = [&]<class T>(Option option, OptionRange, const T& field) {
    if (field != T{}) set = set | OptionSet{option};
  };
  visit_options(add, options);
  return set;
}

void copy_option(Option option, SolveOptions& to, const SolveOptions& from) {
  const auto copy = [&](Option each, OptionRange, auto& there, const auto& field) {
    if (each == option) there = field;
  };
  visit_options(copy, to, from);
  if (star_option(from) == option) to.roadmap.star = from.roadmap.star;
}

}  // namespace warren
