// SPDX-License-Identifier: BSD-3-Clause
// What the elements of a section are, in NumPy's words: '<' (little-endian; '|' for single bytes), a letter (u
// unsigned, i signed, f IEEE-754), the bytes of one. Four characters in a file, the last one zero.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace warren {

/// Numbers that files hold as they are: fixed widths of at most 8 bytes.
template <class T>
concept FileElement = std::same_as<T, std::byte> ||
    (std::is_arithmetic_v<T> && !std::same_as<T, bool> && sizeof(T) <= 8);

struct ElementType {
  std::array<char, 4> code{};  ///< "<u4", say, and a zero

  constexpr std::string_view name() const { return {code.data(), 3}; }
  constexpr std::size_t bytes() const { return static_cast<std::size_t>(code[2] - '0'); }
  /// Also of types that a later minor version may bring: their size can be told.
  constexpr bool is_legal() const {
    const bool one = code[2] == '1';
    const bool some = one || code[2] == '2' || code[2] == '4' || code[2] == '8';
    return code[0] == (one ? '|' : '<') && code[1] >= 'a' && code[1] <= 'z' && some && code[3] == '\0';
  }
  friend constexpr bool operator==(const ElementType&, const ElementType&) = default;
};

/// char and std::byte are |u1.
template <FileElement T>
constexpr ElementType element_type() {
  constexpr bool is_text = std::same_as<T, char> || std::same_as<T, std::byte>;
  constexpr char letter = std::is_floating_point_v<T> ? 'f' : is_text || std::is_unsigned_v<T> ? 'u' : 'i';
  return {{sizeof(T) == 1 ? '|' : '<', letter, static_cast<char>('0' + sizeof(T)), '\0'}};
}

}  // namespace warren
