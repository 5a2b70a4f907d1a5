// SPDX-License-Identifier: BSD-3-Clause
// Words for enumerators, to and from. They stand once, beside the enum, as a function found by its argument:
//
//   constexpr auto enum_names(Fruit) { return std::array<std::string_view, 2>{"apple", "pear"}; }
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

namespace warren {

template <class E>
concept NamedEnum = requires {
  enum_names(E{}).size();
};

template <NamedEnum E>
constexpr std::string_view name_of(E value) {
  return enum_names(value)[static_cast<std::size_t>(value)];
}

/// The enumerator of that name, if there is one.
template <NamedEnum E>
constexpr std::optional<E> enum_named(std::string_view word) {
  const auto names = enum_names(E{});
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) return std::nullopt;
  return static_cast<E>(found - names.begin());
}

}  // namespace warren
