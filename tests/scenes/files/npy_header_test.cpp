// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/npy_io.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace warren {
namespace {

TEST(NpyHeader, SpellsShapesAsPythonDoesAndEndsOnAMultipleOf64) {
  using Shape = std::vector<std::uint64_t>;
  const std::string start("\x93NUMPY\1\0\x76\0", 10);
  const auto padded = [&](const std::string& dictionary) {
    return start + dictionary + std::string(0x75 - dictionary.size(), ' ') + "\n";
  };
  EXPECT_EQ(npy_header("|S3", Shape{}), padded("{'descr': '|S3', 'fortran_order': False, 'shape': (), }"));
  EXPECT_EQ(npy_header("<i4", Shape{7}), padded("{'descr': '<i4', 'fortran_order': False, 'shape': (7,), }"));
  EXPECT_EQ(npy_header("<f8", Shape{7, 4}), padded("{'descr': '<f8', 'fortran_order': False, 'shape': (7, 4), }"));
  for (std::uint64_t n = 1; n < 10'000'000'000'000'000'000U / 10; n *= 10) {
    EXPECT_EQ(npy_header("<f8", Shape{n, n, n}).size() % 64, 0U) << n;
  }
}

}  // namespace
}  // namespace warren
