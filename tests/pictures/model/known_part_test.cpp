// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/rng.hpp"

namespace warren {
namespace {

OccupancyMap unknown_map(std::uint32_t width, std::uint32_t height) {
  OccupancyMap map;
  map.format = MapFormat::ros;
  map.blocked = map.unknown = Bitmap(width, height, true);
  return map;
}

TEST(KnownPart, HoldsAllThatIsKnownAndLittleMore) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    const auto width = static_cast<std::uint32_t>(100 + rng.below(200));
    const auto height = static_cast<std::uint32_t>(100 + rng.below(200));
    OccupancyMap map = unknown_map(width, height);
    Box cells;
    for (int i = 0; i < 5; ++i) {
      const auto x = static_cast<std::uint32_t>(10 + rng.below(60));
      const auto y = static_cast<std::uint32_t>(10 + rng.below(60));
      map.unknown.clear(x, y);
      cells.include(Vec2{static_cast<double>(x), static_cast<double>(y)});
      cells.include(Vec2{x + 1.0, y + 1.0});
    }
    const auto box = known_part(map, {});
    ASSERT_TRUE(box);
    const double margin = std::max(2.0, std::max(cells.width(), cells.height()) / 40.0);
    const Box expected = cells.grown(margin);
    EXPECT_EQ(box->min, expected.min);
    EXPECT_EQ(box->max, expected.max);
  }
}

TEST(KnownPart, IsPlacedInTheWorldAsTheMapIs) {
  OccupancyMap map = unknown_map(100, 100);
  map.unknown.clear(50, 10);
  map.cell = 0.5;
  map.origin = {3.0, -1.0};
  const auto box = known_part(map, {});
  ASSERT_TRUE(box);
  EXPECT_EQ(box->min, (Vec2{27.0, 3.0}));
  EXPECT_EQ(box->max, (Vec2{29.5, 5.5}));
}

TEST(KnownPart, IsTheWholeMapWhereLittleIsGainedOrNothingKnown) {
  OccupancyMap map = unknown_map(100, 70);
  EXPECT_FALSE(known_part(map, {})) << "all is unknown";
  map.unknown.clear(1, 2);
  map.unknown.clear(95, 66);
  EXPECT_FALSE(known_part(map, {}));
  map.unknown = Bitmap();
  EXPECT_FALSE(known_part(map, {})) << "all is known";
}

double area_of(std::span<const Vec2> outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) twice += cross(outline[i], outline[(i + 1) % outline.size()]);
  return 0.5 * twice;
}

TEST(KnownPart, CellsThatReachBeyondThePictureAreCut) {
  const Box box{{0.0, 0.0}, {4.0, 2.0}};
  const auto cut = [&](const std::vector<Vec2>& outline) { return area_of(part_in_box(outline, box)); };
  EXPECT_DOUBLE_EQ(cut({{1, 1}, {2, 1}, {2, 2}, {1, 2}}), 1.0) << "within";
  EXPECT_DOUBLE_EQ(cut({{-5, -5}, {9, -5}, {9, 9}, {-5, 9}}), 8.0) << "all of the box";
  EXPECT_DOUBLE_EQ(cut({{3, 1}, {9, 1}, {9, 9}, {3, 9}}), 1.0);
  EXPECT_DOUBLE_EQ(cut({{-1, 0}, {0, -1}, {1, 0}, {0, 1}}), 0.5) << "a turned map's";
  EXPECT_LT(part_in_box(std::vector<Vec2>{{5, 5}, {6, 5}, {6, 6}, {5, 6}}, box).size(), 3U);
}

}  // namespace
}  // namespace warren
