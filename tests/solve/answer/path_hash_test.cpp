// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/write_answer_io.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace warren {
namespace {

/// FNV-1a as its authors give it, byte by byte.
std::string by_bytes(const std::vector<double>& numbers) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const double number : numbers) {
    for (unsigned shift = 0; shift < 64; shift += 8) {
      hash = (hash ^ (std::bit_cast<std::uint64_t>(number) >> shift & 0xffU)) * 0x100000001b3U;
    }
  }
  return fmt::format("{:016x}", hash);
}

TEST(PathHash, IsFnv1aOfTheNumbersBytes) {
  std::mt19937_64 random(3);
  std::vector<double> numbers{0.0, -0.0, 1.0, 2.0, 0.5, 4095.0, 8191.0, 8193.0, 10000.0, 65537.0, 1e60, -0.1, 5e-324};
  for (unsigned i = 0; i < 2000; ++i) {
    const double cell = static_cast<double>(random() % 40000);
    numbers.push_back(i % 3 == 0 ? cell / 3.0 : cell);
    numbers.push_back(std::bit_cast<double>(random() << 8 * (random() % 8)));
  }
  PathHash hash;
  EXPECT_EQ(hash.text(), by_bytes({}));
  std::vector<double> so_far;
  for (const double number : numbers) {
    hash.add(number);
    so_far.push_back(number);
    if (so_far.size() % 97 < 14) {
      ASSERT_EQ(hash.text(), by_bytes(so_far)) << so_far.size();
    }
  }
  EXPECT_EQ(hash.text(), by_bytes(numbers));
}

}  // namespace
}  // namespace warren
