// SPDX-License-Identifier: BSD-3-Clause
// The sweep against all pairs of sides in plain integers, on small grids where contacts of every kind are common.
#include "scenes/scene/plane_obstacles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using Whole = std::int64_t;

Whole turn(Vec2 a, Vec2 b, Vec2 c) {
  const auto whole = [](double x) { return static_cast<Whole>(x); };
  return whole(b.x - a.x) * whole(c.y - a.y) - whole(b.y - a.y) * whole(c.x - a.x);
}
int sign(Whole x) { return (x > 0) - (x < 0); }
bool on(Vec2 a, Vec2 b, Vec2 p) {
  return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return true;
  return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

bool is_simple(const std::vector<Vec2>& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = p[i];
    const Vec2 b = p[(i + 1) % n];
    const Vec2 c = p[(i + 2) % n];
    if (on(a, b, c) || on(b, c, a)) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n != i && meet(a, b, p[j], p[(j + 1) % n])) return false;
    }
  }
  return true;
}

std::vector<Vec2> star(std::uint64_t seed, std::size_t n, double radius) {
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 6.283185307 * (static_cast<double>(i) + 0.5 * uniform(seed, i, 0)) / static_cast<double>(n);
    const double r = radius * (0.3 + 0.7 * uniform(seed, i, 1));
    corners.push_back({std::round(r * std::cos(angle)), std::round(r * std::sin(angle))});
  }
  return corners;
}

bool has_repetitions(const std::vector<Vec2>& p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p[i] == p[(i + 1) % p.size()]) return true;
  }
  return false;
}

void expect_agreement(std::vector<Vec2> outline) {
  if (has_repetitions(outline)) return;
  for (int turned = 0; turned < 4; ++turned) {
    const auto contact = self_contact(outline, {});
    ASSERT_EQ(!contact, is_simple(outline));
    if (contact) {
      const std::size_t n = outline.size();
      ASSERT_NE(contact->first, contact->second);
      ASSERT_TRUE(meet(outline[contact->first], outline[(contact->first + 1) % n], outline[contact->second],
                       outline[(contact->second + 1) % n]));
    }
    for (Vec2& p : outline) p = {-p.y, p.x};
    std::rotate(outline.begin(), outline.begin() + 1, outline.end());
    if (turned == 1) std::reverse(outline.begin(), outline.end());
  }
}

TEST(SimpleOutline, AgreesWithAllPairsOnStarsAndOnStarsWithACornerMoved) {
  std::size_t simple = 0;
  std::size_t moved_simple = 0;
  for (const std::uint64_t seed : test::seeds(400, 100, 0)) {
    SCOPED_TRACE(seed);
    const std::size_t n = 3 + seed % 60;
    std::vector<Vec2> outline = star(seed, n, 6.0 + static_cast<double>(n));
    simple += is_simple(outline) ? 1 : 0;
    expect_agreement(outline);
    const auto moved = static_cast<std::size_t>(uniform(seed, 77, 0) * static_cast<double>(n));
    const auto near = static_cast<std::size_t>(uniform(seed, 77, 1) * static_cast<double>(n));
    outline[moved] =
        outline[near] + Vec2{std::floor(3 * uniform(seed, 78, 0)) - 1, std::floor(3 * uniform(seed, 78, 1)) - 1};
    moved_simple += is_simple(outline) ? 1 : 0;
    expect_agreement(outline);
  }
  EXPECT_GT(simple, test::share(200, 40));
  EXPECT_GT(moved_simple, test::share(10, 1));
  EXPECT_LT(moved_simple, test::share(300, 85));
}

TEST(SimpleOutline, AgreesWithAllPairsOnWalksOverATinyGrid) {
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Vec2> outline;
    const std::size_t n = 3 + seed % 40;
    for (std::size_t i = 0; i < n; ++i) {
      outline.push_back({std::floor(12 * uniform(seed, i, 0)), std::floor(12 * uniform(seed, i, 1))});
    }
    expect_agreement(outline);
  }
}

/// Up and down between two combs: many vertical sides, corners at equal x.
std::vector<Vec2> comb(std::size_t teeth) {
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < teeth; ++i) {
    const double x = 4.0 * static_cast<double>(i);
    for (const Vec2 p : {Vec2{x, 0}, Vec2{x, 10}, Vec2{x + 2, 10}, Vec2{x + 2, 0}}) outline.push_back(p);
  }
  outline.push_back({4.0 * static_cast<double>(teeth), 0});
  outline.push_back({4.0 * static_cast<double>(teeth), -1});
  outline.push_back({-1, -1});
  outline.push_back({-1, 0});
  return outline;
}

TEST(SimpleOutline, CombsAreSimpleUntilATipTouches) {
  std::vector<Vec2> outline = comb(50);
  EXPECT_FALSE(self_contact(outline, {}));
  expect_agreement(outline);
  outline[21] = {outline[21].x - 2, 10};  // a tip meets the corner of the tooth before
  expect_agreement(outline);
  EXPECT_TRUE(self_contact(outline, {}));
}

TEST(SimpleOutline, AHundredThousandCornersTakeNoTime) {
  std::vector<Vec2> outline = comb(25'000);
  EXPECT_FALSE(self_contact(outline, {}));
  outline[50'001] = {outline[50'001].x, -2};
  EXPECT_TRUE(self_contact(outline, {}));
}

}  // namespace
}  // namespace warren
