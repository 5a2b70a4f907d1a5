// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/wall_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/rng.hpp"

namespace warren {
namespace {

TEST(WallCells, WholeNumbersAreFoundExactly) {
  for (const double x : {0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 1.5, 2.5, -2.5, 1e-300, -1e-300, 0.49999999999999994,
                         2251799813685247.5, -2251799813685247.5, 1e15 + 0.25, -1e15 - 0.25}) {
    EXPECT_EQ(whole_below(x), std::floor(x)) << x;
    EXPECT_EQ(whole_above(x), std::ceil(x)) << x;
    EXPECT_EQ(whole_below(std::nextafter(x, 1e300)), std::floor(std::nextafter(x, 1e300))) << x;
    EXPECT_EQ(whole_above(std::nextafter(x, -1e300)), std::ceil(std::nextafter(x, -1e300))) << x;
  }
}

TEST(WallCells, HugeNumbersStayInOrder) {
  double last = -std::numeric_limits<double>::infinity();
  for (int e = 1000; e > 40; --e) {
    const double whole = whole_below(-std::ldexp(1.1, e));
    EXPECT_GE(whole, last);
    last = whole;
  }
  for (int e = 40; e < 1000; ++e) {
    const double whole = whole_below(std::ldexp(1.1, e));
    EXPECT_GE(whole, last);
    last = whole;
  }
}

template <class T>
std::vector<WallOf<T>> random_walls(std::uint64_t seed) {
  std::vector<WallOf<T>> walls;
  const auto number = [&](std::uint64_t i, unsigned axis) {
    const double x = (uniform(seed, i, axis) - 0.5) * std::ldexp(1.0, static_cast<int>(i % 40) - 8);
    return static_cast<T>(i % 3 == 0 ? std::round(2.0 * x) / 2.0 : x);
  };
  for (std::uint64_t i = 0; i < WallCells::size; ++i)
    walls.push_back({number(i, 0), number(i, 1), number(i, 2), number(i, 3)});
  return walls;
}

/// The same by definition, in long double: which cell is `units` away from x, rounded outwards?
std::int32_t cell_of(double x, double per_unit, double origin, double grow, double count, bool low) {
  const auto unit = static_cast<long double>(x) * per_unit;
  const long double at = low ? std::floor(unit) - grow - origin : std::ceil(unit) + grow - 1 - origin;
  const long double cell = std::floor(at / 256);
  return static_cast<std::int32_t>(std::clamp<long double>(cell, 0, count - 1));
}

template <class T>
void expect_cells(std::uint64_t seed) {
  const std::vector<WallOf<T>> walls = random_walls<T>(seed);
  const double per_unit = std::ldexp(256.0, static_cast<int>(seed % 5) - 2);
  const double origin = 256.0 * std::floor(1000.0 * (uniform(seed, 0, 5) - 0.5));
  const double grow = 1.0 + std::floor(600.0 * uniform(seed, 0, 6));
  const double count = 5.0 + std::floor(5000.0 * uniform(seed, 0, 7));
  const CellAxis axis{per_unit, origin + grow, origin - grow + 1.0, 256.0 * count - 1.0};
  const WallCellVariants variants = wall_cell_variants();
  ASSERT_GE(variants.count, 1U);
  for (std::size_t k = 0; k < variants.count; ++k) {
    SCOPED_TRACE(variants.list[k].instruction_set);
    WallCells cells;
    BoxLanes<T> lanes;
    variants.list[k].find(walls.data(), axis, axis, cells, lanes);
    Box box;
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const Box wall = box_of(walls[i].segment());
      box.include(wall);
      EXPECT_EQ(cells.column_first[i], cell_of(wall.min.x, per_unit, origin, grow, count, true)) << wall.min.x;
      EXPECT_EQ(cells.column_last[i], cell_of(wall.max.x, per_unit, origin, grow, count, false)) << wall.max.x;
      EXPECT_EQ(cells.row_first[i], cell_of(wall.min.y, per_unit, origin, grow, count, true)) << wall.min.y;
      EXPECT_EQ(cells.row_last[i], cell_of(wall.max.y, per_unit, origin, grow, count, false)) << wall.max.y;
    }
    EXPECT_EQ(lanes.box().min, box.min);
    EXPECT_EQ(lanes.box().max, box.max);
  }
}

TEST(WallCells, AllInstructionSetsFindTheCellsThatTheDefinitionGives) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    expect_cells<float>(seed);
    expect_cells<double>(seed);
  }
}

}  // namespace
}  // namespace warren
