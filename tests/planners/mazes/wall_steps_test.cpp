// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tile_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/rng.hpp"

namespace warren {
namespace {

using detail::WallSteps;

/// One coordinate after the other.
class PlainWallSteps {
 public:
  template <class T>
  explicit PlainWallSteps(const WallOf<T>& w) {
    constexpr T limit = detail::most_steps;
    const std::array<T, 4> ends{w.x1, w.y1, w.x2, w.y2};
    for (std::size_t i = 0; i < 4; ++i) {
      const T scaled = ends[i] * narrow_unit;
      const T below = scaled < limit ? scaled : limit;
      steps_[i] = static_cast<std::int32_t>(below > -limit ? below : -limit);
      exact_ = exact_ && static_cast<T>(steps_[i]) == scaled;
    }
  }
  explicit PlainWallSteps(const PackedWall& w) {
    const PackedWall::Ends e = w.ends();
    constexpr std::int32_t steps = 1 << detail::packed_shift;
    steps_ = {e.x1 * steps, e.y1 * steps, e.x2 * steps, e.y2 * steps};
  }

  bool exact() const { return exact_; }
  float number(std::size_t i) const { return static_cast<float>(steps_[i]); }
  bool is_short(std::int32_t longest) const {
    return std::abs(steps_[0] - steps_[2]) <= longest && std::abs(steps_[1] - steps_[3]) <= longest;
  }
  detail::TileCorner first(std::int32_t less, int log2) const {
    return {(std::min(steps_[0], steps_[2]) - less) >> log2, (std::min(steps_[1], steps_[3]) - less) >> log2};
  }
  detail::TileCorner last(std::int32_t more, int log2) const {
    return {(std::max(steps_[0], steps_[2]) + more) >> log2, (std::max(steps_[1], steps_[3]) + more) >> log2};
  }
  NarrowWall from(std::uint64_t origin) const {
    const auto x = static_cast<std::int32_t>(origin);
    const auto y = static_cast<std::int32_t>(origin >> 32);
    return {narrow(steps_[0] - x), narrow(steps_[1] - y), narrow(steps_[2] - x), narrow(steps_[3] - y)};
  }

 private:
  static std::int16_t narrow(std::int32_t x) {
    return static_cast<std::int16_t>(std::clamp<std::int32_t>(x, std::numeric_limits<std::int16_t>::min(),
                                                              std::numeric_limits<std::int16_t>::max()));
  }

  std::array<std::int32_t, 4> steps_;  // x1 y1 x2 y2
  bool exact_ = true;
};

bool same(const detail::TileCorner& a, const detail::TileCorner& b) { return a.col == b.col && a.row == b.row; }
bool same(const NarrowWall& a, const NarrowWall& b) {
  return a.x1 == b.x1 && a.y1 == b.y1 && a.x2 == b.x2 && a.y2 == b.y2;
}

template <class Wall>
void expect_alike(const Wall& wall, bool is_whole) {
  const WallSteps steps(wall);
  const PlainWallSteps plain(wall);
  EXPECT_EQ(steps.exact(), is_whole);
  EXPECT_EQ(plain.exact(), is_whole);
  if (!is_whole) return;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(steps.numbers()[i], plain.number(static_cast<std::size_t>(i))) << i;
  for (const std::int32_t longest : {0, 127, 128, 8192, 1 << 30}) {
    EXPECT_EQ(steps.is_short(longest), plain.is_short(longest)) << longest;
  }
  for (const int log2 : {7, 13, 15}) {
    for (const std::int32_t halo : {0, 64, 1000}) {
      EXPECT_TRUE(same(steps.first(halo, log2), plain.first(halo, log2)));
      EXPECT_TRUE(same(steps.last(halo - 64, log2), plain.last(halo - 64, log2)));
    }
  }
  for (const std::uint64_t origin : {std::uint64_t{0}, (std::uint64_t{70000} << 32) | 100U}) {
    EXPECT_TRUE(same(steps.from(origin), plain.from(origin)));
  }
}

TEST(WallSteps, AreAlikeOnEveryProcessor) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double spread = i % 3 == 0 ? 8.0 : i % 3 == 1 ? 512.0 : 4e6;
    const bool is_whole = i % 5 != 0;
    const auto end = [&](std::uint64_t axis) {
      const double x = spread * (2.0 * uniform(1, i, axis) - 1.0);
      return static_cast<float>(std::round(x)) + static_cast<float>(random_bits(2, i, axis) % 4) * 0.25F;
    };
    FloatWall wall{end(0), end(1), end(2), end(3)};
    if (!is_whole) wall.x2 = 0.3F;
    expect_alike(wall, is_whole);
    DoubleWall same_wall{wall.x1, wall.y1, wall.x2, wall.y2};
    if (!is_whole) same_wall.y1 = i % 2 == 0 ? 1e300 : 1.0 / 3.0;
    expect_alike(same_wall, is_whole);
  }
}

TEST(WallSteps, OfPackedWallsAreThoseOfTheirFloats) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const std::int32_t spread = i % 3 == 0 ? 40 : i % 3 == 1 ? 4000 : PackedWall::most;
    const auto steps = [&](std::uint64_t axis) {
      return static_cast<std::int32_t>(random_bits(5, i, axis) % (2 * static_cast<std::uint32_t>(spread) + 1)) - spread;
    };
    const PackedWall wall = i % 2 == 0 ? PackedWall::upright(steps(0), steps(1), steps(2))
                                       : PackedWall::level(steps(0), steps(1), steps(2));
    expect_alike(wall, true);
    const WallSteps expected(unpacked(wall));
    const WallSteps found(wall);
    for (const int log2 : {7, 13, 15}) {
      EXPECT_TRUE(same(found.first(64, log2), expected.first(64, log2)));
      EXPECT_TRUE(same(found.last(-64, log2), expected.last(-64, log2)));
    }
    EXPECT_TRUE(same(found.from(1000), expected.from(1000)));
    EXPECT_EQ(found.is_short(8192), expected.is_short(8192));
  }
}

TEST(WallSteps, CoordinatesWhoseDifferencesDoNotFitAreNotExact) {
  for (const float size : {8388608.0F, 1e30F, std::numeric_limits<float>::infinity()}) {
    expect_alike(FloatWall{-size, 0.0F, size, 0.0F}, false);
    expect_alike(DoubleWall{0.0, size, 0.0, -size}, false);
  }
  expect_alike(FloatWall{-4194304.0F, 0.0F, 4194304.0F, 0.0F}, true);
  EXPECT_FALSE(WallSteps(FloatWall{-4194304.0F, 0.0F, 4194304.0F, 0.0F}).is_short(8192));
}

TEST(WallShapes, AreAlikeOnEveryProcessor) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const auto end = [&](std::uint64_t axis) { return static_cast<std::int16_t>(random_bits(3, i, axis)); };
    const NarrowWall walls[] = {{end(0), end(1), end(2), end(3)}, {end(4), end(5), end(6), end(7)}};
    const auto stride = static_cast<std::int16_t>(100 + i % 400);
    for (const bool single : {false, true}) {
      const auto shapes = detail::wall_shapes(walls, single, stride);
      for (const std::size_t k : {0, 1}) {
        const detail::WallShape plain = detail::plain_wall_shape(walls[single ? 0 : k], stride);
        EXPECT_EQ(shapes[k].key, plain.key);
        EXPECT_EQ(shapes[k].place, plain.place);
      }
    }
  }
}

}  // namespace
}  // namespace warren
