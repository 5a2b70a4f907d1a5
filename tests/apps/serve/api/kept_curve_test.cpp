// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/kept_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"

namespace warren::serve {
namespace {

/// From cell to cell, any way.
Path<Vec2> wander(std::size_t points, std::uint64_t seed) {
  constexpr double motion[][2] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
  Path<Vec2> path{{50'000.0, 70'000.0}};
  while (path.size() < points) {
    const auto step = static_cast<std::size_t>(4.0 * uniform(seed, path.size(), 0));
    path.push_back({path.back().x + motion[step][0], path.back().y + motion[step][1]});
  }
  return path;
}

Path<Vec2> by_blocks(const KeptCurve& curve) {
  Path<Vec2> path;
  std::vector<Vec2> room;
  for (std::size_t block = 0; block < curve.block_count(); ++block) {
    if (!path.empty()) path.pop_back();  // the next block's first
    for (const Vec2 p : curve.points(block, room)) {
      EXPECT_TRUE(curve.box(block).contains(p));
      path.push_back(p);
    }
  }
  return path;
}

void expect_kept(const Path<Vec2>& path, const char* what) {
  SCOPED_TRACE(what);
  for (const unsigned threads : {1U, 3U}) {
    const KeptCurve curve(path, {.threads = threads});
    EXPECT_EQ(curve.size(), path.size());
    EXPECT_EQ(curve.whole({.threads = threads}), path);
    EXPECT_EQ(by_blocks(curve), path);
  }
}

TEST(KeptCurve, GivesBackEveryPathToTheBit) {
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    for (const std::size_t points : {1U, 2U, 3U, 4U, 5U, 33U, 4095U, 4096U, 4097U, 4098U, 8193U, 30'000U}) {
      SCOPED_TRACE(points);
      Path<Vec2> path = wander(points, seed);
      expect_kept(path, "steps");
      path.front() = {path.front().x + 0.3, path.front().y};
      path.back() = {path.back().x, path.back().y - 0.1};
      expect_kept(path, "ends beside the lattice");
      path[path.size() / 2] = {path[path.size() / 2].x, 0.1};
      expect_kept(path, "a point beside it");
    }
  }
}

TEST(KeptCurve, HoldsStepsInBits) {
  Path<Vec2> path = wander(100'000, 1);
  EXPECT_LT(KeptCurve(path, {}).bytes(), 30'000U);
  path.front() = {path.front().x + 0.3, path.front().y};
  EXPECT_LT(KeptCurve(path, {}).bytes(), 30'000U);
  path[77'777].x += 0x1p-30;
  EXPECT_GE(KeptCurve(path, {}).bytes(), 1'600'000U);
}

TEST(KeptCurve, KeepsTheSignOfZero) {
  const Path<Vec2> path{{0.5, 1.0}, {1.0, 1.0}, {1.0, -0.0}, {2.0, -0.0}, {2.0, 1.0}, {3.0, 1.0}};
  const Path<Vec2> found = KeptCurve(path, {}).whole({});
  for (std::size_t i = 0; i < path.size(); ++i) EXPECT_EQ(std::signbit(found[i].y), std::signbit(path[i].y)) << i;
}

}  // namespace
}  // namespace warren::serve
