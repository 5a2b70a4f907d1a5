// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

__extension__ using Wide = __int128;

/// A point with integer coordinates, the exact twin of a Vec2 that is a multiple of some power of two.
struct Lattice {
  std::int64_t x;
  std::int64_t y;
};

int sign(Wide v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }
int exact_orientation(Lattice a, Lattice b, Lattice c) {
  return sign(Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x));
}
Vec2 scaled(Lattice p, double unit) { return {static_cast<double>(p.x) * unit, static_cast<double>(p.y) * unit}; }

std::int64_t within(SequentialRng& rng, std::int64_t bound) {  // in [-bound, bound]
  return static_cast<std::int64_t>(rng.next() % static_cast<std::uint64_t>(2 * bound + 1)) - bound;
}

TEST(Orient2d, EqualsIntegerArithmeticOnNearlyCollinearTriples) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    for (int i = 0; i < 5000; ++i) {
      const std::int64_t reach = std::int64_t{1} << (2 + rng.below(51));  // up to 2^52: all 53 bits of a double
      const Lattice a{within(rng, reach), within(rng, reach)};
      const Lattice b{within(rng, reach), within(rng, reach)};
      const double t = 1.5 * uniform(seed, static_cast<std::uint64_t>(i), 0) - 0.25;
      const Lattice c{std::clamp<std::int64_t>(a.x + std::llround(t * static_cast<double>(b.x - a.x)) + within(rng, 1),
                                               -reach, reach),
                      std::clamp<std::int64_t>(a.y + std::llround(t * static_cast<double>(b.y - a.y)) + within(rng, 1),
                                               -reach, reach)};
      const int expected = exact_orientation(a, b, c);
      for (const double unit : {1.0, 0x1.0p-53, 0x1.0p-300, 0x1.0p+140}) {
        ASSERT_EQ(orient2d(scaled(a, unit), scaled(b, unit), scaled(c, unit)), expected);
        ASSERT_EQ(orient2d(scaled(b, unit), scaled(a, unit), scaled(c, unit)), -expected);
        ASSERT_EQ(orient2d(scaled(b, unit), scaled(c, unit), scaled(a, unit)), expected);
      }
    }
  }
}

TEST(Orient2d, IsExactFarFromTheOrigin) {
  constexpr std::int64_t offset = std::int64_t{1'000'000} << 33;  // 10^6 in units of 2^-33: still 53 bits
  SequentialRng rng(3);
  for (int i = 0; i < 50000; ++i) {
    const auto point = [&] { return Lattice{offset + within(rng, 40), offset + within(rng, 40)}; };
    const Lattice a = point();
    const Lattice b = point();
    const Lattice c = point();
    ASSERT_EQ(orient2d(scaled(a, 0x1.0p-33), scaled(b, 0x1.0p-33), scaled(c, 0x1.0p-33)), exact_orientation(a, b, c));
  }
}

TEST(Orient2d, IsExactWhereDifferencesRound) {
  // A line past the origin from far away to far away, and points near it with bits that the differences lose.
  SequentialRng rng(5);
  for (int i = 0; i < 50000; ++i) {
    const auto rounded = [](std::int64_t x) { return static_cast<std::int64_t>(static_cast<double>(x)); };
    const std::int64_t dx = within(rng, std::int64_t{1} << 57);
    const std::int64_t dy = within(rng, std::int64_t{1} << 57);
    const Lattice a{rounded(-dx), rounded(-dy)};
    const Lattice b{rounded(3 * dx), rounded(3 * dy)};
    const Lattice c{within(rng, 200), within(rng, 200)};
    const int expected = exact_orientation(a, b, c);
    ASSERT_EQ(orient2d(scaled(a, 1.0), scaled(b, 1.0), scaled(c, 1.0)), expected);
    ASSERT_EQ(orient2d(scaled(c, 1.0), scaled(a, 1.0), scaled(b, 1.0)), expected);
    ASSERT_EQ(orient2d(scaled(b, 1.0), scaled(a, 1.0), scaled(c, 1.0)), -expected);
  }
}

TEST(Orient2d, SeesTheSmallestCoordinateBesideTheLargest) {
  const double large = largest_coordinate;
  const double small = smallest_coordinate;
  EXPECT_EQ(orient2d({-large, -large}, {large, large}, {0.0, small}), 1);
  EXPECT_EQ(orient2d({-large, -large}, {large, large}, {0.0, -small}), -1);
  EXPECT_EQ(orient2d({-large, -large}, {large, large}, {small, small}), 0);
  EXPECT_EQ(orient2d({small, 0.0}, {large, large}, {0.0, 0.0}), 1);
}

TEST(Orient2d, OfRepeatedPointsIsZero) {
  EXPECT_EQ(orient2d({0.1, 0.7}, {0.1, 0.7}, {5.0, -3.0}), 0);
  EXPECT_EQ(orient2d({0.1, 0.7}, {5.0, -3.0}, {0.1, 0.7}), 0);
}

/// All the closed segments whose ends lie on a 4 x 4 grid, those of length zero included.
struct GridSegment {
  Lattice a;
  Lattice b;
};
std::vector<GridSegment> grid_segments() {
  std::vector<GridSegment> all;
  for (int i = 0; i < 256; ++i) all.push_back({{i % 4, i / 4 % 4}, {i / 16 % 4, i / 64}});
  return all;
}

/// Is p / d on the closed (open: inside the) segment?
bool holds(const GridSegment& s, Lattice p, std::int64_t d, bool open) {
  const Lattice along{d * (s.b.x - s.a.x), d * (s.b.y - s.a.y)};
  const Lattice to{p.x - d * s.a.x, p.y - d * s.a.y};
  if (along.x * to.y != along.y * to.x) return false;
  const std::int64_t at = along.x * to.x + along.y * to.y;
  const std::int64_t end = along.x * along.x + along.y * along.y;
  if (end == 0) return to.x == 0 && to.y == 0 && !open;
  return open ? at > 0 && at < end : at >= 0 && at <= end;
}
/// Tries every point of s that can be the only common one (its parameter is a multiple of 1 / determinant), and the
/// ends.
bool shares_point(const GridSegment& s, const GridSegment& t, bool open) {
  const Lattice u{s.b.x - s.a.x, s.b.y - s.a.y};
  const Lattice v{t.b.x - t.a.x, t.b.y - t.a.y};
  const std::int64_t det = std::abs(u.x * v.y - u.y * v.x);
  if (open && det == 0) return false;
  const std::int64_t d = std::max<std::int64_t>(1, det);
  for (std::int64_t k = open ? 1 : 0; k <= (open ? d - 1 : d); ++k) {
    if (holds(t, {d * s.a.x + k * u.x, d * s.a.y + k * u.y}, d, open)) return true;
  }
  return !open && (holds(s, t.a, 1, false) || holds(s, t.b, 1, false));
}

TEST(SegmentsTouch, EqualsEnumerationOnAllPairsOfAGrid) {
  const auto all = grid_segments();
  for (const double unit : {1.0, 0x1.0p-40}) {
    for (const double offset : {0.0, 1048576.0 * unit}) {
      const Vec2 shift{offset, -offset};
      for (const GridSegment& s : all) {
        const Segment first{scaled(s.a, unit) + shift, scaled(s.b, unit) + shift};
        for (const GridSegment& t : all) {
          const Segment second{scaled(t.a, unit) + shift, scaled(t.b, unit) + shift};
          ASSERT_EQ(segments_touch(first, second), shares_point(s, t, false))
              << s.a.x << s.a.y << s.b.x << s.b.y << " " << t.a.x << t.a.y << t.b.x << t.b.y;
          ASSERT_EQ(segments_cross(first, second), shares_point(s, t, true))
              << s.a.x << s.a.y << s.b.x << s.b.y << " " << t.a.x << t.a.y << t.b.x << t.b.y;
        }
      }
    }
  }
}

TEST(OnSegment, EqualsEnumerationOnAGrid) {
  for (const GridSegment& s : grid_segments()) {
    for (int i = 0; i < 16; ++i) {
      const Lattice p{i % 4, i / 4};
      ASSERT_EQ(on_segment(scaled(p, 1.0), {scaled(s.a, 1.0), scaled(s.b, 1.0)}), holds(s, p, 1, false));
    }
  }
}

/// The least value of a convex function on [0, 1], by golden section: knows nothing of geometry.
template <class F>
double least(const F& f) {
  constexpr double ratio = 0.6180339887498949;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 90; ++i) {
    const double a = high - ratio * (high - low);
    const double b = low + ratio * (high - low);
    (f(a) <= f(b) ? high : low) = f(a) <= f(b) ? b : a;
  }
  return std::min({f(0.0), f(1.0), f((low + high) / 2)});
}
Vec2 at(const Segment& s, double t) { return (1.0 - t) * s.a + t * s.b; }

TEST(Distance, EqualsNumericMinimisation) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    for (int i = 0; i < 60; ++i) {
      const auto point = [&] {  // half of them on a coarse grid: parallel, touching and zero-length cases
        const bool coarse = rng.below(2) == 0;
        const double x = static_cast<double>(coarse ? 25 * rng.below(5) : rng.below(101)) / 25.0;
        return Vec2{x, static_cast<double>(coarse ? 25 * rng.below(5) : rng.below(101)) / 25.0};
      };
      const Segment s{point(), point()};
      const Segment t{point(), point()};
      const double to_point = least([&](double u) { return distance(at(s, u), t.a); });
      ASSERT_NEAR(distance(t.a, s), to_point, 1e-7);
      ASSERT_NEAR(distance_sq(t.a, s), to_point * to_point, 1e-6);
      ASSERT_NEAR(norm(nearest_point(t.a, s) - t.a), to_point, 1e-7);
      const double between =
          least([&](double u) { return least([&](double v) { return distance(at(s, u), at(t, v)); }); });
      ASSERT_NEAR(distance(s, t), between, 1e-6);
      ASSERT_EQ(distance(s, t), distance(t, s));
      ASSERT_EQ(distance(s, t) == 0.0, segments_touch(s, t));
    }
  }
}

TEST(Distance, KeepsItsRelativeErrorFarFromTheOriginAndAtTinyScale) {
  const Vec2 far{1e6, 1e6};
  EXPECT_DOUBLE_EQ(distance(far + Vec2{0.5, 0.25}, {far, far + Vec2{1.0, 0.0}}), 0.25);
  EXPECT_DOUBLE_EQ(distance(Vec2{3e-90, 4e-90}, {{0.0, 0.0}, {-1e-90, 0.0}}), 5e-90);
  EXPECT_DOUBLE_EQ(distance(Vec2{2.0, 3.0}, {{2.0, 1.0}, {2.0, 1.0}}), 2.0);
}

TEST(Box, MeetsAndContainsAreClosed) {
  const Box box{{0.0, 0.0}, {2.0, 1.0}};
  EXPECT_TRUE(box.contains({2.0, 1.0}));
  EXPECT_FALSE(box.contains({2.0, std::nextafter(1.0, 2.0)}));
  EXPECT_TRUE(box.meets({{2.0, 1.0}, {3.0, 3.0}}));
  EXPECT_FALSE(box.meets({{std::nextafter(2.0, 3.0), 0.0}, {3.0, 3.0}}));
  EXPECT_TRUE(Box{}.empty());
  Box grown;
  grown.include(Vec2{1.0, -1.0});
  EXPECT_FALSE(grown.empty());
  EXPECT_EQ(grown.min, (Vec2{1.0, -1.0}));
}

}  // namespace
}  // namespace warren
