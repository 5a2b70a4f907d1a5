// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/npy_header.hpp"

#include <fmt/format.h>

namespace warren {
namespace {

/// As Python writes a tuple: "()", "(28,)", "(28, 4)".
std::string tuple_text(std::span<const std::uint64_t> numbers) {
  std::string text = "(";
  for (const std::uint64_t number : numbers) fmt::format_to(std::back_inserter(text), "{}, ", number);
  if (numbers.size() == 1) text.pop_back();
  if (numbers.size() > 1) text.resize(text.size() - 2);
  return text + ")";
}

}  // namespace

std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape) {
  constexpr std::size_t alignment = 64;
  std::string dictionary =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, tuple_text(shape));
  std::string header("\x93NUMPY\1\0", 8);
  const std::size_t unpadded = header.size() + 2 + dictionary.size() + 1;
  dictionary.append((alignment - unpadded % alignment) % alignment, ' ').push_back('\n');
  header.append({static_cast<char>(dictionary.size() & 0xffU), static_cast<char>(dictionary.size() >> 8U)});
  return header + dictionary;
}

}  // namespace warren
