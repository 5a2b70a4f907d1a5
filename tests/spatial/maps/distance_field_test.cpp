// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/maps/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/rng.hpp"

namespace warren {
namespace {

Bitmap random_map(std::uint64_t seed) {
  const auto width = static_cast<std::uint32_t>(1 + random_bits(seed, 0, 0) % 90);
  const auto height = static_cast<std::uint32_t>(1 + random_bits(seed, 0, 1) % 60);
  const double share = std::pow(uniform(seed, 0, 2), 3.0);  // many maps are nearly empty
  Bitmap map(width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      if (uniform(seed, 1 + x, y) < share) map.set(x, y);
    }
  }
  return map;
}

/// By definition: every cell against every blocked cell, the ring around the map included if it counts.
std::uint64_t brute_force(const Bitmap& map, CellDistance kind, bool outside, int x, int y) {
  std::uint64_t best = DistanceField::far;
  const auto width = static_cast<int>(map.width());
  const auto height = static_cast<int>(map.height());
  for (int v = -1; v <= height; ++v) {
    for (int u = -1; u <= width; ++u) {
      const bool inside = u >= 0 && v >= 0 && u < width && v < height;
      if (!(inside ? map.holds(u, v) : outside)) continue;
      const auto part = [&](int d) {
        const int a = kind == CellDistance::centres ? std::abs(d) : std::max(2 * std::abs(d) - 1, 0);
        return static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(a);
      };
      best = std::min(best, part(x - u) + part(y - v));
    }
  }
  return best;
}

TEST(DistanceField, EqualsBruteForceOnTwoHundredMaps) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed);
    const CellDistance kind = seed % 2 == 0 ? CellDistance::centres : CellDistance::squares;
    const bool outside = seed / 2 % 2 == 0;
    const DistanceField field(map, kind, outside, {.threads = 1 + static_cast<unsigned>(seed % 3)});
    const int step = seed % 5 == 0 ? 1 : 3;  // every cell of some maps, every ninth of the others
    for (int y = 0; y < static_cast<int>(map.height()); y += step) {
      for (int x = 0; x < static_cast<int>(map.width()); x += step) {
        ASSERT_EQ(field.squared(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)),
                  brute_force(map, kind, outside, x, y))
            << x << " " << y;
      }
    }
  }
}

TEST(DistanceField, RenewedAfterChangesItIsANewOneThatIsCutOffAlike) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Bitmap map = random_map(seed);
    const CellDistance kind = seed % 2 == 0 ? CellDistance::centres : CellDistance::squares;
    const bool outside = seed / 2 % 2 == 0;
    const double cut = 1.0 + 9.0 * uniform(seed, 0, 3);
    const double radius = cut * uniform(seed, 0, 4);
    DistanceField field(map, kind, outside, {});
    field.cut_off(cut, {});
    Bitmap wide = blocked_for_disc(map, field, radius, {});
    const Cell low{static_cast<std::uint32_t>(random_bits(seed, 0, 5) % map.width()),
                   static_cast<std::uint32_t>(random_bits(seed, 0, 6) % map.height())};
    const Cell high{std::min(map.width() - 1, low.x + static_cast<std::uint32_t>(seed % 7)),
                    std::min(map.height() - 1, low.y + static_cast<std::uint32_t>(seed % 3))};
    for (std::uint32_t y = low.y; y <= high.y; ++y) {
      for (std::uint32_t x = low.x; x <= high.x; ++x) {
        random_bits(seed, 100 + x, y) % 2 == 0 ? map.set(x, y) : map.clear(x, y);
      }
    }
    field.renew(map, low, high, {});
    renew_for_disc(wide, map, field, radius, low, high, {});
    DistanceField fresh(map, kind, outside, {});
    fresh.cut_off(cut, {});
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x)
        ASSERT_EQ(field.squared(x, y), fresh.squared(x, y)) << x << " " << y;
    }
    if (kind == CellDistance::squares) ASSERT_EQ(wide, blocked_for_disc(map, fresh, radius, {}));
  }
}

TEST(DistanceField, NothingBlockedIsFarEverywhere) {
  const DistanceField field(Bitmap(70, 3), CellDistance::centres, false, {});
  for (std::uint32_t x = 0; x < 70; ++x) EXPECT_EQ(field.squared(x, 1), DistanceField::far);
}

TEST(DistanceField, LongMapsSaturateInsteadOfWrappingAround) {
  Bitmap map(100'000, 1);
  map.set(0, 0);
  const DistanceField field(map, CellDistance::centres, false, {});
  EXPECT_EQ(field.squared(65'535, 0), 65'535U * 65'535U);
  EXPECT_EQ(field.squared(65'536, 0), DistanceField::far);
  EXPECT_EQ(field.squared(99'999, 0), DistanceField::far);
}

TEST(BlockedForDisc, ADiscThatFitsExactlyIsFreeAndAWiderOneIsNot) {
  Bitmap map(5, 3);
  for (std::uint32_t x = 0; x < 5; ++x) {
    map.set(x, 0);
    map.set(x, 2);
  }
  const auto free_middle = [&](double radius) { return !blocked_for_disc(map, radius, {}).test(2, 1); };
  EXPECT_TRUE(free_middle(0.0));
  EXPECT_TRUE(free_middle(0.5));  // distance from the middle of the cell to the squares above and below
  EXPECT_FALSE(free_middle(0.5000001));
  EXPECT_TRUE(blocked_for_disc(map, 0.0, {}).test(2, 0));
  const Bitmap room(7, 7);
  EXPECT_FALSE(blocked_for_disc(room, 3.5, {}).test(3, 3));  // the outside is blocked: 3.5 cells away
  EXPECT_TRUE(blocked_for_disc(room, 3.500001, {}).test(3, 3));
}

}  // namespace
}  // namespace warren
