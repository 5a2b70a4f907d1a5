// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/point_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "core/base/rng.hpp"

namespace warren::detail {
namespace {

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
  if (best_instruction_set() >= InstructionSet::avx2) sets.push_back(InstructionSet::avx2);
  return sets;
}

DiscPoints random_disc(std::uint64_t seed, std::size_t n) {
  DiscPoints disc;
  std::vector<Vec2> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = {uniform(seed, i, 0) - 0.5, uniform(seed, i, 1) - 0.5};
    if (i % 3 == 2) points[i] = {points[i - 1].x * (1.0 + 1e-15), points[i - 1].y};  // ties but for rounding
  }
  disc.add_run({0.0, 0.0}, 0.25, points, 0, static_cast<std::uint32_t>(n), 1);
  return disc;
}

TEST(DiscPoints, GatherThePointsOfTheDiscButOne) {
  const std::vector<Vec2> points{{0.0, 0.0}, {3.0, 4.0}, {1.0, 1.0}, {-2.0, 0.0}, {0.0, 2.0}};
  DiscPoints disc;
  disc.add_run({0.0, 0.0}, 4.0, points, 1, 5, 3);
  ASSERT_EQ(disc.count, 2U);
  EXPECT_EQ(disc.place[0], 2U);
  EXPECT_EQ(disc.square[0], 2.0);
  EXPECT_EQ(disc.place[1], 4U);
  EXPECT_EQ(disc.square[1], 4.0);
}

TEST(DiscPoints, CandidatesHoldTheNearestAndTheirTiesForEveryInstructionSet) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const DiscPoints gathered = random_disc(seed, 3 + 3 * seed);
    std::vector<double> sorted(gathered.square, gathered.square + gathered.count);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 1; k <= std::min<std::size_t>(gathered.count, 48); ++k) {
      const auto needed = static_cast<std::size_t>(std::count_if(
          sorted.begin(), sorted.end(), [&](double square) { return square <= sorted[k - 1] * (1.0 + 1e-14); }));
      for (const InstructionSet set : instruction_sets()) {
        DiscPoints disc = gathered;
        const std::size_t candidates = disc.sort_roughly(k, 4.0, set);
        ASSERT_GE(candidates, needed);
        std::vector<double> found;
        for (std::size_t i = 0; i < candidates; ++i) found.push_back(disc.square[disc.by_rank[i]]);
        std::sort(found.begin(), found.end());
        ASSERT_TRUE(std::equal(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(needed), found.begin()));
      }
    }
  }
}

TEST(DiscPoints, DistancesThatTieAcrossABorderOfTheKeysAreBothCandidates) {
  int ties = 0;
  for (std::uint32_t step = 0; step < 100; ++step) {
    const auto border = static_cast<double>(std::bit_cast<float>(0x3f000000U + 128 * step));
    const double rounds_up = border - (step == 0 ? 0x1p-26 : 0x1p-25);  // halfway between two floats, ties to even
    DiscPoints disc;
    disc.count = 2;
    disc.square[0] = rounds_up;
    disc.square[1] = std::nextafter(rounds_up, 0.0);
    if (std::sqrt(disc.square[0]) != std::sqrt(disc.square[1])) continue;
    ++ties;
    for (const InstructionSet set : instruction_sets()) EXPECT_EQ(disc.sort_roughly(1, 1.0, set), 2U) << step;
  }
  EXPECT_GT(ties, 10);
}

TEST(DiscPoints, OrderIsTheSameForEveryInstructionSet) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    DiscPoints plain = random_disc(seed, 100);
    plain.sort_roughly(1, 4.0, InstructionSet::baseline);
    for (const InstructionSet set : instruction_sets()) {
      DiscPoints disc = random_disc(seed, 100);
      disc.sort_roughly(1, 4.0, set);
      EXPECT_TRUE(std::equal(plain.by_rank, plain.by_rank + plain.count, disc.by_rank));
    }
  }
}

}  // namespace
}  // namespace warren::detail
