// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/kd_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

template <int D>
PointOf<D> random_point(std::uint64_t seed, std::uint64_t index, double scale = 1.0, double off = 0.0) {
  // On a coarse grid for some seeds, so that points and distances tie.
  const auto coordinate = [&](std::uint64_t axis) {
    const double u = uniform(seed, index, axis);
    return off + scale * (seed % 3 == 0 ? std::floor(8.0 * u) : u);
  };
  if constexpr (D == 2) {
    return {coordinate(0), coordinate(1)};
  } else {
    PointOf<D> point;
    for (std::size_t axis = 0; axis < D; ++axis) point[axis] = coordinate(axis);
    return point;
  }
}

template <int D>
double plain_distance(const PointOf<D>& a, const PointOf<D>& b) {
  if constexpr (D == 2) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
  } else {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < D; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return std::sqrt(sum);
  }
}

/// After every insertion, of many after each eighth, one query of each kind, against a plain loop.
template <int D>
void expect_as_brute_force(std::uint64_t seed, std::size_t count, double scale = 1.0, double off = 0.0) {
  SCOPED_TRACE(testing::Message() << "D " << D << " seed " << seed << " scale " << scale << " off " << off);
  GrowingTree<D> tree;
  std::vector<PointOf<D>> points;
  std::vector<Neighbour> all;
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(random_point<D>(seed, i, scale, off));
    tree.insert(points.back());
    ASSERT_EQ(tree.size(), points.size());
    if (i > 700 && i % 8 != 0) continue;
    const PointOf<D> query = random_point<D>(seed + 100, i, scale, off);
    all.clear();
    for (std::size_t j = 0; j < points.size(); ++j) {
      all.push_back({static_cast<VertexId>(j), plain_distance<D>(points[j], query)});
    }
    std::sort(all.begin(), all.end());
    ASSERT_EQ(tree.nearest(query), all.front()) << i;

    const std::size_t k = i % 5 == 0 ? 200 : i % 12;
    tree.nearest(query, k, found);
    ASSERT_EQ(found, std::vector(all.begin(), all.begin() + static_cast<long>(std::min(k, all.size())))) << i;
  }
}

TEST(GrowingTree, FindsTheNearestAtEverySizeAsBruteForceDoes) {
  for (const std::uint64_t seed : test::seeds(20, 4)) {
    expect_as_brute_force<2>(seed, 700);
    expect_as_brute_force<4>(seed, 700);
  }
  expect_as_brute_force<3>(1, 1500);
  expect_as_brute_force<16>(1, 4400);
  expect_as_brute_force<16>(3, 2200);
}

TEST(GrowingTree, IsExactWhereFloatsAreNot) {
  expect_as_brute_force<16>(1, 300, 1e-3, 1e6);
  expect_as_brute_force<16>(1, 300, 1e-2, 1e3);
  expect_as_brute_force<16>(3, 300, 1e-9, 1.0);
  for (const double scale : {1e-25, 1e-22, 1e-21, 1e17, 1e18, 1e19, 1e60})
    expect_as_brute_force<16>(1, 200, scale, -0.5 * scale);
}

}  // namespace
}  // namespace warren
