// SPDX-License-Identifier: BSD-3-Clause
// Values of options, read strictly: the whole text must be one value inside its range, or a UsageError names the
// option, the range and what was found. NaN and infinities are never values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// One finite number, read as C reads it but independent of the locale.
std::optional<double> number_in(std::string_view text);

/// A number in [low, high].
double number_value(std::string_view option, std::string_view text, double low, double high);
/// A number > 0.
double positive_value(std::string_view option, std::string_view text);
/// A share, >= 0: "1%", "0.01".
double share_value(std::string_view option, std::string_view text);
/// Radians, "90deg" too; finite.
double angle_value(std::string_view option, std::string_view text);
/// A whole number in [low, high].
std::uint64_t count_value(std::string_view option, std::string_view text, std::uint64_t low, std::uint64_t high);
/// "auto" gives none.
std::optional<std::uint64_t> auto_or_count_value(std::string_view option, std::string_view text, std::uint64_t low,
                                                 std::uint64_t high);
/// Seconds, > 0: "20s", "500ms", "2min", "1.5h".
double duration_value(std::string_view option, std::string_view text);
/// Bytes, >= 1: "20GiB", "512MiB", "1e9B"; also KiB, TiB, kB, MB, GB, TB.
std::size_t memory_value(std::string_view option, std::string_view text);
/// Numbers apart by commas or blanks, at most largest_coordinate each; 1 to 14 of them.
std::vector<double> state_value(std::string_view option, std::string_view text);
/// Such states apart by semicolons: one or more.
std::vector<std::vector<double>> states_value(std::string_view option, std::string_view text);
/// Words apart by commas; none is empty or there twice.
std::vector<std::string> list_value(std::string_view option, std::string_view text);
/// One of the words; a misspelt one is told the closest.
std::size_t choice_value(std::string_view option, std::string_view text, std::span<const std::string_view> words);
/// The enumerator of that name; a misspelt one is told the closest.
template <NamedEnum E>
E choice_value(std::string_view option, std::string_view text) {
  const auto words = enum_names(E{});
  return static_cast<E>(choice_value(option, text, words));
}

template <NamedEnum E>
inline constexpr auto choice_text = [] {
  std::pair<std::array<char, 128>, std::size_t> joined{};
  auto& [text, size] = joined;
  for (const std::string_view name : enum_names(E{})) {
    if (size > 0) text[size++] = ' ';
    for (const char c : name) text[size++] = c;
  }
  return joined;
}();
/// The names of an enum, apart by blanks, as OptionSpec::choices has them.
template <NamedEnum E>
inline constexpr std::string_view choices_of{choice_text<E>.first.data(), choice_text<E>.second};

/// What is wrong with data that stands in an option is wrong with the command line.
template <class Read>
auto as_usage(const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

/// What `read`, one of the functions above, makes of an option's value; nothing where the option is not given.
template <class Read, class... Limits>
auto given_value(const Arguments& arguments, std::string_view option, const Read& read, Limits... limits) {
  const auto text = arguments.value(option);
  return text ? std::optional(read(option, *text, limits...)) : std::nullopt;
}
/// A whole number in [low, high], which 32 bits hold.
std::optional<std::uint32_t> given_count(const Arguments& arguments, std::string_view option, std::uint32_t low,
                                         std::uint32_t high);
template <NamedEnum E>
std::optional<E> given_choice(const Arguments& arguments, std::string_view option) {
  return given_value(arguments, option, choice_value<E>);
}
/// The words of a list; none where the option is not given.
std::vector<std::string> given_list(const Arguments& arguments, std::string_view option);

/// What `read` makes of each word of a list; `option` is what errors name.
template <class Read>
auto given_values(const Arguments& arguments, std::string_view list, std::string_view option, const Read& read) {
  std::vector<decltype(read(option, list))> values;
  for (const std::string& word : given_list(arguments, list)) values.push_back(read(option, word));
  return values;
}

}  // namespace warren::tools
