// SPDX-License-Identifier: BSD-3-Clause
// Numbers as bytes of a file, the least significant first.
#pragma once

#include <bit>
#include <string>
#include <string_view>
#include <type_traits>

namespace warren {

template <class Number>
void append_little_endian(std::string& bytes, Number number) {
  static_assert(std::is_arithmetic_v<Number>);
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

}  // namespace warren
