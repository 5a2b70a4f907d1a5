// SPDX-License-Identifier: BSD-3-Clause
// Words for enumerators, to and from, and sets of enumerators that have words. The words stand once, beside the enum,
// as a function found by its argument:
//
//   constexpr auto enum_names(Fruit) { return std::array<std::string_view, 2>{"apple", "pear"}; }
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

namespace warren {

/// An enumeration whose enumerators have words, counted from 0.
template <class E>
concept NamedEnum = requires {
  enum_names(E{}).size();
};

/// The word of an enumerator.
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

/// A set of enumerators, of at most 64 that there are.
template <NamedEnum E>
class EnumSet {
 public:
  /// Those of the list.
  constexpr EnumSet(std::initializer_list<E> members = {}) {
    for (const E member : members) bits_ |= bit(member);
  }
  /// All that there are.
  static constexpr EnumSet all() {
    EnumSet set;
    set.bits_ = ~std::uint64_t{0} >> (64 - enum_names(E{}).size());
    return set;
  }
  /// Is it in the set?
  constexpr bool has(E member) const { return (bits_ & bit(member)) != 0; }
  /// Are there none?
  constexpr bool empty() const { return bits_ == 0; }
  /// Those of either.
  constexpr EnumSet operator|(EnumSet more) const {
    more.bits_ |= bits_;
    return more;
  }
  friend constexpr bool operator==(EnumSet, EnumSet) = default;
  /// In the order of the enumeration.
  std::vector<E> members() const {
    std::vector<E> list;
    for (std::size_t i = 0; i < enum_names(E{}).size(); ++i) {
      if (has(static_cast<E>(i))) list.push_back(static_cast<E>(i));
    }
    return list;
  }

 private:
  static constexpr std::uint64_t bit(E member) { return std::uint64_t{1} << static_cast<unsigned>(member); }
  std::uint64_t bits_ = 0;
};

}  // namespace warren
