// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/segment_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

/// Long and short ones, level, upright and slanted, of length zero too.
std::vector<Segment> mixed_segments(std::uint64_t seed) {
  std::vector<Segment> segments;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto u = [&](std::uint64_t axis) { return uniform(seed, i, axis); };
    const double size = i % 2 == 0 ? 10.0 : 0.7;
    const Vec2 a{10.0 * u(0), 10.0 * u(1)};
    Vec2 along{size * (u(2) - 0.5), size * (u(3) - 0.5)};
    if (i % 5 == 1) along.x = 0.0;
    if (i % 5 == 2) along.y = 0.0;
    if (i % 20 == 3) along = {};
    segments.push_back({a, a + along});
  }
  return segments;
}

TEST(SegmentGrid, EveryCellThatASegmentPassesListsIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Segment> segments = mixed_segments(seed);
    const SegmentGrid grid(segments, {});
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      const auto& [a, b] = segments[i];
      for (int step = 0; step <= 200; ++step) {
        const SegmentGrid::Cell cell = grid.cell_of(a + (step / 200.0) * (b - a));
        const auto listed = grid.in_cell(cell);
        ASSERT_TRUE(std::is_sorted(listed.begin(), listed.end()));
        ASSERT_TRUE(std::binary_search(listed.begin(), listed.end(), i)) << i << " in " << cell.col << " " << cell.row;
      }
    }
  }
}

}  // namespace
}  // namespace warren
