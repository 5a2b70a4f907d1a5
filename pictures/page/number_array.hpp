// SPDX-License-Identifier: BSD-3-Clause
// Numbers as pages hold them: {"type": "f32", "data": base64}, little-endian, written in pieces.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/formats/base64.hpp"
#include "pictures/formats/write_picture.hpp"

namespace warren {

static_assert(std::endian::native == std::endian::little, "the arrays of pages are little-endian");

template <class T>
constexpr std::string_view array_type() {
  if constexpr (std::is_same_v<T, float>) return "f32";
  if constexpr (std::is_same_v<T, double>) return "f64";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "u8";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "u16";
  if constexpr (std::is_same_v<T, std::int32_t>) return "i32";
  return "u32";
}

/// A member of a JSON object that has one before it: begun by the constructor, ended by end(). add() throws Stopped.
template <class T>
class NumberArray {
 public:
  NumberArray(std::string_view name, const Execution& execution, const Write& write)
      : execution_(execution), write_(write), base64_(write) {
    write_(fmt::format(",\"{}\":{{\"type\":\"{}\",\"data\":\"", name, array_type<T>()));
  }
  template <class Number>
  void add(Number number) {
    constexpr std::size_t piece = 1U << 16U;
    const auto value = static_cast<T>(number);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    if (bytes_.size() >= piece) flush();
  }
  void add(Vec2 p) {
    add(p.x);
    add(p.y);
  }
  void end() {
    flush();
    base64_.end();
    write_("\"}");
  }

 private:
  void flush() {
    execution_.check();
    base64_.write(bytes_);
    bytes_.clear();
  }

  const Execution& execution_;
  const Write& write_;
  Base64 base64_;
  std::string bytes_;
};

}  // namespace warren
