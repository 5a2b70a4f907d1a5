// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/relaxable_bits.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/base/rng.hpp"
#include "spatial/points/neighbour.hpp"

namespace warren {
namespace {

using detail::InstructionSet;
using detail::relaxable_bits;

/// On a lattice, so that many distances are those of the disc's rim and many ways are as long as a label.
struct Row {
  std::vector<Vec2> points;
  std::vector<double> labels;
  std::uint64_t expected = 0;
};
constexpr Vec2 middle{3.0, 3.0};
constexpr double through = 2.0;
constexpr double square = 5.0;  // of the radius: some points lie at exactly that

Row row(std::uint32_t count, std::uint64_t seed) {
  Row made;
  for (std::uint64_t i = 0; i < count; ++i) {
    made.points.push_back(
        {static_cast<double>(random_bits(seed, i, 0) % 7), static_cast<double>(random_bits(seed, i, 1) % 7)});
    const double way = through + distance(middle, made.points[i]);
    const double labels[] = {
        std::numeric_limits<double>::infinity(), way, std::nextafter(way, 9.0), through, 1.0, -3.0, -0.0, way + 1.0};
    made.labels.push_back(labels[random_bits(seed, i, 2) % 8]);
    if (square >= dot(made.points[i] - middle, made.points[i] - middle) && way < made.labels[i]) {
      made.expected |= std::uint64_t{1} << i;
    }
  }
  return made;
}

TEST(RelaxableBits, AreThoseOfPlainDistancesOnEveryProcessor) {
  std::uint64_t any = 0;
  for (std::uint32_t count = 1; count <= 64; ++count) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      const Row made = row(count, seed);
      any |= made.expected;
      // What lies behind the last point is not looked at: the vectors have no element more, and no bit is set there.
      for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        if (set > detail::best_instruction_set()) continue;
        const detail::Relaxation by{middle, square, through};
        EXPECT_EQ(relaxable_bits(made.points.data(), made.labels.data(), count, by, set), made.expected)
            << count << " points, seed " << seed << ", set " << static_cast<int>(set);
      }
    }
  }
  EXPECT_EQ(any, ~std::uint64_t{0});
}

TEST(RelaxableBits, AWayThatHasNotBegunIsNoLongerThanZero) {
  const Vec2 there{1.0, 0.0};
  const double settled = -0.0;
  const double open = 1.5;
  EXPECT_EQ(relaxable_bits(&there, &settled, 1, {{0.0, 0.0}, 4.0, 0.0}), 0U);
  EXPECT_EQ(relaxable_bits(&there, &open, 1, {{0.0, 0.0}, 4.0, 0.0}), 1U);
}

}  // namespace
}  // namespace warren
