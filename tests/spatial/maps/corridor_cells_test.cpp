// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/maps/free_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/rng.hpp"

namespace warren {
namespace {

/// Free rows first .. last - 1 from column 1 on; all else blocked.
void carve(Bitmap& map, std::uint32_t first, std::uint32_t last, std::uint32_t columns) {
  for (std::uint32_t y = first; y < last; ++y) {
    for (std::uint32_t x = 1; x <= columns; ++x) map.clear(x, y);
  }
}

TEST(CorridorCells, AreTheMiddleRowOfAStraightCorridor) {
  for (const std::uint32_t width : {1U, 3U, 5U, 9U}) {
    SCOPED_TRACE(width);
    Bitmap map(202, width + 2, true);
    carve(map, 1, 1 + width, 200);
    const DistanceField field(map, CellDistance::squares, true, {});
    const CorridorCells cells(field, 0.0, {});
    std::set<std::pair<std::uint32_t, std::uint32_t>> drawn;
    for (int i = 0; i < 2000; ++i) {
      const CorridorCells::Place place = cells.at(i / 2000.0);
      drawn.insert({place.cell.x, place.cell.y});
      if (place.cell.x <= 20 || place.cell.x > 180) continue;  // the ends have corners of their own
      EXPECT_EQ(place.cell.y, 1 + width / 2);
      EXPECT_NEAR(place.distance, 0.5 * width, 1e-6);
    }
    EXPECT_GT(drawn.size(), 150U);
  }
}

TEST(CorridorCells, WideAndNarrowCorridorsGetSamplesByLengthOverWidth) {
  Bitmap map(402, 16, true);
  carve(map, 1, 4, 400);   // three wide
  carve(map, 5, 14, 400);  // nine wide
  const DistanceField field(map, CellDistance::squares, true, {});
  const CorridorCells cells(field, 0.0, {});
  std::map<bool, int> drawn;
  for (int i = 0; i < 10000; ++i) {
    const Cell cell = cells.at(i / 10000.0).cell;
    if (cell.x > 20 && cell.x <= 380) ++drawn[cell.y < 4];  // the ends have corners of their own
  }
  EXPECT_NEAR(static_cast<double>(drawn[true]) / drawn[false], 3.0, 0.2);
  EXPECT_EQ(CorridorCells(field, 4.4, {}).at(0.0).cell.y, 9U);  // the narrow one has not that much room
  EXPECT_TRUE(CorridorCells(field, 5.0, {}).empty());
}

TEST(CorridorCells, KeepTheLeastDistanceAndAreTheSameForAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Bitmap map(150, 170);
    for (std::uint64_t i = 0; i < 200; ++i) {
      map.set(static_cast<std::uint32_t>(random_bits(seed, i, 0) % 150),
              static_cast<std::uint32_t>(random_bits(seed, i, 1) % 170));
    }
    const DistanceField field(map, CellDistance::squares, true, {});
    const CorridorCells one(field, 2.0, {.threads = 1});
    const CorridorCells many(field, 2.0, {.threads = 3});
    ASSERT_EQ(one.size(), many.size());
    ASSERT_FALSE(one.empty());
    for (std::uint64_t i = 0; i < 500; ++i) {
      const double share = uniform(seed, i, 2);
      const CorridorCells::Place place = one.at(share);
      ASSERT_EQ(place.cell, many.at(share).cell);
      ASSERT_GE(field.distance(place.cell.x, place.cell.y), 2.0);
      ASSERT_NEAR(field.distance(place.cell.x, place.cell.y), place.distance, 1e-6);
    }
    one.at(1.0);  // the end counts as the last
  }
}

}  // namespace
}  // namespace warren
