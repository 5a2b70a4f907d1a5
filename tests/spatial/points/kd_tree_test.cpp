// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/kd_tree.hpp"

#include <gtest/gtest.h>

#include "spatial/points/neighbours.hpp"
#include "tests/seeds.hpp"
#include "tests/spatial/points/point_sets.hpp"

namespace warren {
namespace {

using test::all_by_distance;

template <class Dimension>
class KdTreeIn : public ::testing::Test {};

template <int D>
struct Dimensions {
  static constexpr int value = D;
};
using AllDimensions = ::testing::Types<Dimensions<2>, Dimensions<3>, Dimensions<4>, Dimensions<16>>;
TYPED_TEST_SUITE(KdTreeIn, AllDimensions);

template <int D>
std::vector<std::pair<PointOf<D>, VertexId>> queries(const std::vector<PointOf<D>>& points, std::uint64_t seed) {
  std::vector<std::pair<PointOf<D>, VertexId>> all{{PointOf<D>{}, no_vertex},
                                                   {test::make_point<D>({-1e7, 3e8}), no_vertex}};
  for (std::uint64_t q = 0; q < 3 && !points.empty(); ++q) {
    const auto i = static_cast<VertexId>(random_bits(seed, q) % points.size());
    all.push_back({points[i], i});
    all.push_back({points[i], no_vertex});
  }
  return all;
}

template <int D>
std::vector<PointOf<D>> even_points(std::size_t n) {
  std::vector<PointOf<D>> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::array<double, 16> v{};
    for (std::size_t axis = 0; axis < D; ++axis) v[axis] = uniform(11, i, axis);
    points[i] = test::make_point<D>(v);
  }
  return points;
}

template <int D, class Index>
void expect_nearest(const Index& index, const std::vector<PointOf<D>>& points, std::uint64_t seed) {
  std::vector<Neighbour> found;
  for (const auto& [p, except] : queries<D>(points, seed)) {
    const std::vector<Neighbour> all = all_by_distance<D>(points, p, except);
    for (const std::size_t k : {0, 1, 8, 24, 70, 1000}) {
      index.nearest(p, k, except, found);
      const auto count = static_cast<std::ptrdiff_t>(std::min(k, all.size()));
      ASSERT_EQ(found, std::vector<Neighbour>(all.begin(), all.begin() + count)) << "k " << k;
    }
  }
}

template <int D, class Index>
void expect_within(const Index& index, const std::vector<PointOf<D>>& points, std::uint64_t seed) {
  std::vector<Neighbour> found;
  for (const auto& [p, except] : queries<D>(points, seed)) {
    const std::vector<Neighbour> all = all_by_distance<D>(points, p, except);
    std::vector<double> radii{-1.0, 0.0, 0.1, 1e300, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < all.size(); i += 37) {
      radii.push_back(all[i].distance);
      radii.push_back(std::nextafter(all[i].distance, 0.0));
    }
    for (const double radius : radii) {
      index.within(p, radius, except, found);
      const auto end = std::find_if(all.begin(), all.end(), [&](const Neighbour& n) { return n.distance > radius; });
      ASSERT_EQ(found, std::vector<Neighbour>(all.begin(), end)) << "radius " << radius;
    }
  }
}

template <int D, class Index>
void expect_later(const Index& index, const std::vector<PointOf<D>>& points, double radius) {
  std::vector<std::pair<VertexId, VertexId>> expected;
  for (VertexId i = 0; i < points.size(); ++i) {
    for (VertexId j = i + 1; j < points.size(); ++j) {
      if (test::plain_distance<D>(points[i], points[j]) <= radius) expected.emplace_back(i, j);
    }
  }
  std::vector<std::pair<VertexId, VertexId>> found;
  index.for_each_later_pair({0, points.size()}, radius, [&](VertexId i, VertexId j) { found.emplace_back(i, j); });
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found, expected);
}

TYPED_TEST(KdTreeIn, AllQueriesEqualBruteForce) {
  constexpr int D = TypeParam::value;
  for (const std::uint64_t seed : test::seeds(20, 5, 0)) {
    for (const auto& set : test::point_sets<D>(seed, 150 + seed % 7 * 30)) {
      SCOPED_TRACE(set.name + ", seed " + std::to_string(seed));
      const KdTree<D> tree(set.points, {});
      ASSERT_EQ(tree.size(), set.points.size());
      expect_nearest<D>(tree, set.points, seed);
      expect_within<D>(tree, set.points, seed);
      expect_later<D>(tree, set.points, 0.3);
    }
  }
}

TYPED_TEST(KdTreeIn, AForestOfManyTreesEqualsBruteForceForAnyThreadCount) {
  constexpr int D = TypeParam::value;
  const auto points = even_points<D>(50'000);
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    SCOPED_TRACE(threads);
    const KdTree<D> tree(points, {.threads = threads});
    std::vector<Neighbour> found;
    for (std::uint64_t q = 0; q < 4; ++q) {
      const auto i = static_cast<VertexId>(random_bits(2, q) % points.size());
      const std::vector<Neighbour> all = all_by_distance<D>(points, points[i], i);
      for (const std::size_t k : {1, 24, 500}) {
        tree.nearest(points[i], k, i, found);
        ASSERT_EQ(found, std::vector<Neighbour>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(k)));
        tree.within(points[i], all[k].distance, i, found);
        ASSERT_EQ(found, std::vector<Neighbour>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(k) + 1));
      }
    }
  }
}

TYPED_TEST(KdTreeIn, AForestKeepsThePointsAndTiesAcrossTrees) {
  constexpr int D = TypeParam::value;
  auto points = even_points<D>(40'000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = points[i % 13];  // each place 3000 times
  const KdTree<D> tree(points, {});
  for (VertexId i = 0; i < points.size(); i += 1000) ASSERT_EQ(tree.point(i), points[i]);
  std::vector<Neighbour> found;
  tree.nearest(points[5], 4, 5, found);
  EXPECT_EQ(found, (std::vector<Neighbour>{{18, 0.0}, {31, 0.0}, {44, 0.0}, {57, 0.0}}));
}

TEST(KdTree, OfPointsOnFewAxesTakesPlacesBesideThem) {
  std::vector<PointOf<16>> points = even_points<16>(500);
  for (PointOf<16>& p : points) std::fill(p.begin() + 6, p.end(), 0.0);
  const KdTree<16> tree(points, {});
  std::vector<Neighbour> found;
  for (const std::size_t axis : {5, 6, 15}) {
    PointOf<16> beside = points[7];
    beside[axis] = 3.0;
    const std::vector<Neighbour> all = all_by_distance<16>(points, beside, no_vertex);
    tree.nearest(beside, 20, no_vertex, found);
    EXPECT_EQ(found, std::vector<Neighbour>(all.begin(), all.begin() + 20)) << axis;
    tree.within(beside, all[20].distance, no_vertex, found);
    EXPECT_EQ(found, std::vector<Neighbour>(all.begin(), all.begin() + 21)) << axis;
  }
}

TYPED_TEST(KdTreeIn, NeighboursEqualBruteForce) {
  constexpr int D = TypeParam::value;
  for (const std::uint64_t seed : test::seeds(5, 2, 0)) {
    for (const auto& set : test::point_sets<D>(seed, 200)) {
      SCOPED_TRACE(set.name);
      const Execution execution;
      for (const auto kind : {NeighbourIndex::kd_tree, NeighbourIndex::grid, NeighbourIndex::brute}) {
        const Neighbours<D> one(set.points, execution, kind);
        expect_nearest<D>(one, set.points, seed);
        expect_within<D>(one, set.points, seed);
        expect_later<D>(one, set.points, 0.3);
      }
      const Neighbours<D> neighbours(set.points, execution);
      std::vector<Neighbour> found;
      for (VertexId i = 0; i < set.points.size(); ++i) {
        neighbours.nearest(set.points[i], 5, i, found);
        const auto all = all_by_distance<D>(set.points, set.points[i], i);
        const auto count = static_cast<std::ptrdiff_t>(std::min<std::size_t>(5, all.size()));
        ASSERT_EQ(found, std::vector<Neighbour>(all.begin(), all.begin() + count));
      }
    }
  }
}

TEST(Neighbours, TakesTheGridForEvenPointsAndTreesForCrowdedOnes) {
  EXPECT_FALSE(Neighbours<2>(even_points<2>(5000), {}).uses_tree());
  auto crowded = even_points<2>(5000);
  crowded[0] = {1e6, 1e6};
  EXPECT_TRUE(Neighbours<2>(crowded, {}).uses_tree());
  EXPECT_FALSE(Neighbours<2>(crowded, {}, NeighbourIndex::grid).uses_tree());
  EXPECT_TRUE(Neighbours<3>(even_points<3>(100), {}).uses_tree());
  EXPECT_FALSE(Neighbours<2>({}, {}).uses_tree());
}

TEST(KdTree, StopsAtTheDeadline) {
  const Deadline ended(0.0);
  EXPECT_THROW(KdTree<3>(even_points<3>(10), {.deadline = &ended}), Stopped);
}

}  // namespace
}  // namespace warren
