// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/point_grid.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

TEST(NearBits, AreThoseOfPlainDistancesOnEveryProcessor) {
  for (std::uint32_t count = 1; count <= 64; ++count) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      // On a lattice, so that many distances are those of the disc's rim; behind the last point lies one in its middle.
      std::vector<double> x;
      std::vector<double> y;
      for (std::uint64_t i = 0; i < count; ++i) {
        x.push_back(static_cast<double>(random_bits(seed, i, 0) % 7));
        y.push_back(static_cast<double>(random_bits(seed, i, 1) % 7));
      }
      x.push_back(3.0);
      y.push_back(3.0);
      std::uint64_t expected = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        const Vec2 off{x[i] - 3.0, y[i] - 3.0};
        if (dot(off, off) <= 5.0) expected |= std::uint64_t{1} << i;
      }
      EXPECT_EQ(detail::near_bits(x.data(), y.data(), count, {3.0, 3.0}, 5.0), expected) << count << " " << seed;
      EXPECT_EQ(detail::near_bits_plain(x.data(), y.data(), count, {3.0, 3.0}, 5.0), expected) << count << " " << seed;
    }
  }
}

}  // namespace
}  // namespace warren
