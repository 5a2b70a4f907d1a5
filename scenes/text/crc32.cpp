// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/crc32.hpp"

#include <array>
#include <cstddef>

namespace warren {
namespace {

using Table = std::array<std::array<std::uint32_t, 256>, 8>;

/// Of a byte that so many bytes follow.
constexpr Table make_table() {
  Table table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t sum = byte;
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1U ^ ((sum & 1U) != 0 ? 0xEDB88320U : 0U);
    table[0][byte] = sum;
  }
  for (std::size_t behind = 1; behind < 8; ++behind) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = table[behind - 1][byte];
      table[behind][byte] = before >> 8U ^ table[0][before & 0xffU];
    }
  }
  return table;
}
constexpr Table crc_table = make_table();

}  // namespace

std::uint32_t crc32(std::string_view bytes) noexcept {
  std::uint32_t sum = 0xffffffffU;
  const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());  // NOLINT: numbers of the bytes
  std::size_t left = bytes.size();
  for (; left >= 8; left -= 8, at += 8) {
    const std::uint32_t low = sum ^ (at[0] | at[1] << 8U | at[2] << 16U | std::uint32_t{at[3]} << 24U);
    sum = crc_table[7][low & 0xffU] ^ crc_table[6][low >> 8U & 0xffU] ^ crc_table[5][low >> 16U & 0xffU] ^
          crc_table[4][low >> 24U] ^ crc_table[3][at[4]] ^ crc_table[2][at[5]] ^ crc_table[1][at[6]] ^
          crc_table[0][at[7]];
  }
  for (; left > 0; --left) sum = sum >> 8U ^ crc_table[0][(sum ^ *at++) & 0xffU];
  return ~sum;
}

}  // namespace warren
