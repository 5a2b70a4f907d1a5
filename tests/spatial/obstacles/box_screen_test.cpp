// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/wall_index.hpp"

#include <gtest/gtest.h>

#include "core/base/rng.hpp"

namespace warren {
namespace {

/// A number of which many are equal, some tiny and some huge.
double coordinate(std::uint64_t seed, std::uint64_t index) {
  constexpr double scales[] = {1.0, 1.0, 1e-6, 1e6, 1e-40, 1e30};
  const double scale = scales[static_cast<std::size_t>(uniform(seed, index, 1) * 6.0)];
  return scale * (std::floor(uniform(seed, index, 0) * 9.0) - 4.0);
}

struct Case {
  Box box;
  Segment wall;
};

Case random_case(std::uint64_t seed, std::uint64_t i) {
  Box box;
  box.include(Vec2{coordinate(seed, 8 * i), coordinate(seed, 8 * i + 1)});
  box.include(Vec2{coordinate(seed, 8 * i + 2), coordinate(seed, 8 * i + 3)});
  return {box,
          {{coordinate(seed, 8 * i + 4), coordinate(seed, 8 * i + 5)},
           {coordinate(seed, 8 * i + 6), coordinate(seed, 8 * i + 7)}}};
}

TEST(BoxScreen, IsExactForWallsInDouble) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const auto [box, s] = random_case(seed, i);
      EXPECT_EQ(BoxScreen<double>(box).meets({s.a.x, s.a.y, s.b.x, s.b.y}), box.meets(box_of(s)));
    }
  }
}

TEST(BoxScreen, MissesNoWallInFloatAndPassesNoneThatIsClearlyOutside) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::size_t passed = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      auto [box, s] = random_case(seed, i);
      const FloatWall wall{static_cast<float>(s.a.x), static_cast<float>(s.a.y), static_cast<float>(s.b.x),
                           static_cast<float>(s.b.y)};
      const bool meets = BoxScreen<float>(box).meets(wall);
      if (box.meets(box_of(wall.segment()))) {
        EXPECT_TRUE(meets);
      }
      const double size =
          std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
      if (!box.grown(1e-6 * size + 1e-37).meets(box_of(wall.segment()))) {
        EXPECT_FALSE(meets);
      }
      passed += meets ? 1 : 0;
    }
    EXPECT_GT(passed, 200U);
    EXPECT_LT(passed, 1800U);
  }
}

TEST(BoxScreen, BoxesBeyondFloatMeetWhatTheyHold) {
  const FloatWall wall{-3e38F, 1.0F, 3e38F, 2.0F};
  EXPECT_TRUE(BoxScreen<float>({{-1e60, -1e60}, {1e60, 1e60}}).meets(wall));
  EXPECT_TRUE(BoxScreen<float>({{1e38, 1.5}, {1e60, 1e60}}).meets(wall));
  EXPECT_FALSE(BoxScreen<float>({{-1e60, 3.0}, {1e60, 1e60}}).meets(wall));
}

}  // namespace
}  // namespace warren
