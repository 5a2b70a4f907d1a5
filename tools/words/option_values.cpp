// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/option_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "apps/studies/comparison.hpp"
#include "core/base/printable.hpp"
#include "scenes/scene/arm_model.hpp"
#include "tools/words/help.hpp"

namespace warren::tools {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view expected, std::string_view found) {
  throw UsageError(fmt::format("{}: expected {} (found: '{}')", option, expected, found));
}

using Unit = std::pair<std::string_view, double>;

/// NUMBER UNIT, the number finite and > 0.
std::optional<double> quantity_in(std::string_view text, std::span<const Unit> units) {
  for (const auto& [name, factor] : units) {
    if (!text.ends_with(name)) continue;
    const auto number = number_in(text.substr(0, text.size() - name.size()));
    if (number && *number > 0.0 && std::isfinite(*number * factor)) return *number * factor;
  }
  return std::nullopt;
}

/// expected: what it must be, "a whole number" or more.
std::uint64_t count_in(std::string_view option, std::string_view text, std::uint64_t low, std::uint64_t high,
                       std::string_view expected) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_count = error == std::errc{} && end == text.data() + text.size();
  if (is_count && value >= low && value <= high) return value;
  refuse(option, fmt::format("{} from {} to {}", expected, low, high), text);
}

std::optional<double> number_or_degrees(std::string_view text) {
  if (!text.ends_with("deg")) return number_in(text);
  const auto degrees = number_in(text.substr(0, text.size() - 3));
  return degrees ? std::optional(*degrees * (std::numbers::pi / 180.0)) : std::nullopt;
}

}  // namespace

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  return studies::number_in_word(text);
}

double number_value(std::string_view option, std::string_view text, double low, double high) {
  const auto number = number_in(text);
  if (!number || *number < low || *number > high) {
    refuse(option, fmt::format("a number from {} to {}", low, high), text);
  }
  return *number;
}

double positive_value(std::string_view option, std::string_view text) {
  const auto number = number_in(text);
  if (!number || !(*number > 0.0) || *number > largest_coordinate) {
    refuse(option, fmt::format("a number above 0, at most {}", largest_coordinate), text);
  }
  return *number;
}

std::uint64_t count_value(std::string_view option, std::string_view text, std::uint64_t low, std::uint64_t high) {
  return count_in(option, text, low, high, "a whole number");
}

std::optional<std::uint64_t> auto_or_count_value(std::string_view option, std::string_view text, std::uint64_t low,
                                                 std::uint64_t high) {
  if (text == "auto") return std::nullopt;
  return count_in(option, text, low, high, "auto, or a whole number");
}

double duration_value(std::string_view option, std::string_view text) {
  constexpr Unit units[] = {{"ms", 1e-3}, {"us", 1e-6}, {"min", 60.0}, {"s", 1.0}, {"h", 3600.0}};
  const auto seconds = quantity_in(text, units);
  if (!seconds) refuse(option, "a time above 0 such as 20s or 500ms", text);
  return *seconds;
}

double share_value(std::string_view option, std::string_view text) {
  const bool percent = text.ends_with('%');
  const auto number = number_in(percent ? text.substr(0, text.size() - 1) : text);
  if (!number || !(*number >= 0.0) || *number > 1e9) refuse(option, "a share such as 1% or 0.01", text);
  return percent ? *number / 100.0 : *number;
}

double angle_value(std::string_view option, std::string_view text) {
  const auto angle = number_or_degrees(text);
  if (!angle || std::abs(*angle) > largest_coordinate) refuse(option, "an angle in radians, or as 90deg", text);
  return *angle;
}

std::size_t memory_value(std::string_view option, std::string_view text) {
  constexpr Unit units[] = {{"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30}, {"TiB", 0x1p40}, {"kB", 1e3},
                            {"MB", 1e6},     {"GB", 1e9},     {"TB", 1e12},    {"B", 1.0}};
  const auto bytes = quantity_in(text, units);
  if (!bytes || *bytes < 1.0 || *bytes >= 0x1p63) refuse(option, "an amount of memory such as 20GiB or 512MiB", text);
  return static_cast<std::size_t>(*bytes);
}

std::vector<double> state_value(std::string_view option, std::string_view text) {
  constexpr std::string_view expected =
      "X,Y (three numbers of bodies that turn, one a joint of arms; angles in radians, or 90deg), each finite and at "
      "most 1e60";
  constexpr std::string_view separators = ", \t";
  std::vector<double> state;
  for (std::size_t at = text.find_first_not_of(separators); at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    const auto number = number_or_degrees(text.substr(at, end - at));
    if (!number || std::abs(*number) > largest_coordinate) refuse(option, expected, text);
    state.push_back(*number + 0.0);  // -0 is 0
    at = text.find_first_not_of(separators, end);
  }
  if (state.empty() || state.size() > most_joints) refuse(option, expected, text);
  return state;
}

std::vector<std::vector<double>> states_value(std::string_view option, std::string_view text) {
  std::vector<std::vector<double>> states;
  for (const std::string_view state : split(text, ";")) states.push_back(state_value(option, state));
  return states;
}

std::vector<std::string> list_value(std::string_view option, std::string_view text) {
  std::vector<std::string> words;
  for (const std::string_view word : split(text, ",")) {
    if (word.empty()) refuse(option, "words separated by commas", text);
    if (std::find(words.begin(), words.end(), word) != words.end()) {
      throw UsageError(fmt::format("{}: {} is there twice", option, word));
    }
    words.emplace_back(word);
  }
  return words;
}

std::size_t choice_value(std::string_view option, std::string_view text, std::span<const std::string_view> words) {
  const auto found = std::ranges::find(words, text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  throw UsageError(
      fmt::format("{}: '{}' is none of {}{}", option, text, fmt::join(words, ", "), suggestion(text, words)));
}

std::optional<std::uint32_t> given_count(const Arguments& arguments, std::string_view option, std::uint32_t low,
                                         std::uint32_t high) {
  const auto text = arguments.value(option);
  if (!text) return std::nullopt;
  return static_cast<std::uint32_t>(count_value(option, *text, low, high));
}

std::vector<std::string> given_list(const Arguments& arguments, std::string_view option) {
  return given_value(arguments, option, list_value).value_or(std::vector<std::string>{});
}

}  // namespace warren::tools
