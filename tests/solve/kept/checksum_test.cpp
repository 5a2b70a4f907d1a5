// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/checksum.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace warren {
namespace {

std::uint64_t checksum_of_text(std::string_view text) { return checksum(std::as_bytes(std::span(text))); }

// Figures of libxxhash's plain code for bytes i * 7 + i / 256, one for each way that the function goes by length.
TEST(Checksum, IsXxh3) {
  EXPECT_EQ(checksum_of_text(""), 0x2d06800538d394c2U);
  EXPECT_EQ(checksum_of_text("abc"), 0x78af5f94892f3950U);
  std::string bytes(std::size_t{1} << 20, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7 + i / 256);
  const std::array<std::pair<std::size_t, std::uint64_t>, 8> expected{{{8, 0xb88dee77f6bf6980U},
                                                                       {16, 0x9da23836adf2be1eU},
                                                                       {100, 0x6dbb812cf19d012eU},
                                                                       {200, 0x7c64f3b17285e96aU},
                                                                       {241, 0x541b19226f0052e8U},
                                                                       {1024, 0x71bee625238addb4U},
                                                                       {4099, 0x345ea5f06bacf3d9U},
                                                                       {1048576, 0xa7f4639f0ccbfda9U}}};
  for (const auto& [size, sum] : expected) EXPECT_EQ(checksum_of_text(std::string_view(bytes).substr(0, size)), sum);
}

}  // namespace
}  // namespace warren
