// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/maps/free_cells.hpp"

#include <gtest/gtest.h>

#include "core/base/rng.hpp"

namespace warren {
namespace {

TEST(FreeCells, AgreesWithItsBitmapAndIsBlockedAllAround) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto width = static_cast<std::uint32_t>(1 + random_bits(seed, 0, 0) % 200);
    const auto height = static_cast<std::uint32_t>(1 + random_bits(seed, 0, 1) % 20);
    Bitmap blocked(width, height, seed % 2 == 0);
    for (std::uint32_t i = 0; i < width * height / 2; ++i) {
      const auto x = static_cast<std::uint32_t>(random_bits(seed, i, 2) % width);
      const auto y = static_cast<std::uint32_t>(random_bits(seed, i, 3) % height);
      seed % 2 == 0 ? blocked.clear(x, y) : blocked.set(x, y);
    }
    const FreeCells cells(blocked);
    const auto is_free = [&](int x, int y) {
      return x >= 0 && y >= 0 && x < static_cast<int>(width) && y < static_cast<int>(height) && !blocked.holds(x, y);
    };
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        const VertexId v = cells.number({x, y});
        ASSERT_LT(v, cells.number_end());
        ASSERT_EQ(cells.cell(v), (Cell{x, y}));
        ASSERT_EQ(cells.is_free(v), is_free(static_cast<int>(x), static_cast<int>(y)));
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            ASSERT_EQ((cells.around(v) >> (3 * (dy + 1) + dx + 1) & 1U) != 0,
                      is_free(static_cast<int>(x) + dx, static_cast<int>(y) + dy));
          }
        }
      }
    }
    const Bitmap turned = transposed(blocked, {});
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) ASSERT_EQ(turned.test(y, x), blocked.test(x, y));
    }
  }
}

TEST(AllowedSteps, DiagonalsNeedBothCellsBesideThem) {
  const auto all = [](StepRule rule) { return allowed_steps(rule)[0x1ff]; };
  EXPECT_EQ(all(StepRule::four), 0b01011010);
  EXPECT_EQ(all(StepRule::eight), 0xff);
  const unsigned without_right = 0x1ffU & ~(1U << 5);  // the cell at (+1, 0)
  EXPECT_EQ(allowed_steps(StepRule::eight)[without_right], 0b01101011);
  EXPECT_EQ(allowed_steps(StepRule::eight_squeezing)[without_right], 0b11101111);
}

}  // namespace
}  // namespace warren
