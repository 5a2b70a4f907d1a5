// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/point_grid.hpp"

#include <gtest/gtest.h>

#include "spatial/points/neighbours.hpp"
#include "tests/seeds.hpp"
#include "tests/spatial/points/point_sets.hpp"

namespace warren {
namespace {

using test::all_by_distance;
using test::PointSet;

std::vector<Vec2> in_tile_order(const std::vector<Vec2>& points) {
  std::vector<Vec2> sorted;
  for (const std::uint32_t i : tile_order(points, {})) sorted.push_back(points[i]);
  return sorted;
}

/// Every set as it comes and in tile order.
std::vector<PointSet<2>> cases(std::uint64_t seed) {
  std::vector<PointSet<2>> sets = test::point_sets<2>(seed, 150 + seed % 7 * 30);
  const std::size_t count = sets.size();
  for (std::size_t i = 0; i < count; ++i) {
    sets.push_back({sets[i].name + " in tile order", in_tile_order(sets[i].points)});
  }
  return sets;
}

/// A milestone, a point near the set and one far from it.
std::vector<std::pair<Vec2, VertexId>> queries(const std::vector<Vec2>& points, std::uint64_t seed) {
  std::vector<std::pair<Vec2, VertexId>> all{{{0.5, 0.25}, no_vertex}, {{-1e7, 3e8}, no_vertex}};
  for (std::uint64_t q = 0; q < 4 && !points.empty(); ++q) {
    const auto i = static_cast<VertexId>(random_bits(seed, q) % points.size());
    all.push_back({points[i], i});
    all.push_back({points[i], no_vertex});
    const Vec2 other = points[random_bits(seed, q + 100) % points.size()];
    all.push_back({0.5 * (points[i] + other), no_vertex});
  }
  return all;
}

TEST(PointGrid, NearestEqualsBruteForce) {
  for (const std::uint64_t seed : test::seeds(20, 5, 0)) {
    for (const auto& [name, points] : cases(seed)) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      const PointGrid grid(points, {});
      std::vector<Neighbour> found;
      for (const auto& [p, except] : queries(points, seed)) {
        const std::vector<Neighbour> all = all_by_distance<2>(points, p, except);
        for (const std::size_t k : {0, 1, 4, 8, 24, 70, 1000}) {
          grid.nearest(p, k, except, found);
          ASSERT_EQ(found, std::vector<Neighbour>(all.begin(), all.begin() + std::min(k, all.size()))) << "k " << k;
        }
      }
    }
  }
}

TEST(PointGrid, WithinEqualsBruteForceRadiiOfNeighboursIncluded) {
  for (const std::uint64_t seed : test::seeds(20, 5, 0)) {
    for (const auto& [name, points] : cases(seed)) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      const PointGrid grid(points, {});
      std::vector<Neighbour> found;
      for (const auto& [p, except] : queries(points, seed)) {
        const std::vector<Neighbour> all = all_by_distance<2>(points, p, except);
        std::vector<double> radii{-1.0, 0.0, 1e-12, 0.1, 1.0, 1e300, std::numeric_limits<double>::infinity()};
        for (std::size_t i = 0; i < all.size(); i += 37) {
          radii.push_back(all[i].distance);
          radii.push_back(std::nextafter(all[i].distance, 0.0));
        }
        for (const double radius : radii) {
          grid.within(p, radius, except, found);
          const auto end =
              std::find_if(all.begin(), all.end(), [&](const Neighbour& n) { return n.distance > radius; });
          ASSERT_EQ(found, std::vector<Neighbour>(all.begin(), end)) << "radius " << radius;
        }
      }
    }
  }
}

TEST(PointGrid, LaterPairsAreEachPairOnce) {
  using Pairs = std::vector<std::pair<VertexId, VertexId>>;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const auto& [name, points] : cases(seed)) {
      if (points.size() > 200) continue;
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      const PointGrid grid(points, {});
      for (const double radius : {0.0, 1e-3, 0.2, 1.5, 1e61}) {
        Pairs expected;
        for (VertexId i = 0; i < points.size(); ++i) {
          for (VertexId j = i + 1; j < points.size(); ++j) {
            if (test::plain_distance<2>(points[i], points[j]) <= radius) expected.emplace_back(i, j);
          }
        }
        Pairs found;
        const std::size_t step = 1 + seed * 5;  // ranges end inside of cells
        for (std::size_t first = 0; first < points.size(); first += step) {
          grid.for_each_later_pair({first, std::min(first + step, points.size())}, radius,
                                   [&](VertexId i, VertexId j) { found.emplace_back(i, j); });
        }
        if (!grid.in_tile_order()) std::sort(found.begin(), found.end());
        ASSERT_EQ(found, expected) << "radius " << radius;
      }
    }
  }
}

TEST(PointGrid, LaterPairsOfManyPointsInOneDiscAreAllThere) {
  std::vector<Vec2> points(3000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {uniform(1, i, 0), uniform(1, i, 1)};
  points = in_tile_order(points);
  const PointGrid grid(points, {});
  ASSERT_TRUE(grid.in_tile_order());
  std::size_t expected = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      expected += test::plain_distance<2>(points[i], points[j]) <= 0.3 ? 1 : 0;
    }
  }
  std::size_t found = 0;
  grid.for_each_later_pair({0, points.size()}, 0.3, [&](VertexId, VertexId) { ++found; });
  EXPECT_EQ(found, expected);
}

TEST(PointGrid, KeepsPointsThatComeInTileOrderAsTheyAre) {
  for (const auto& [name, points] : test::point_sets<2>(5, 400)) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(PointGrid(in_tile_order(points), {}).in_tile_order());
  }
  std::vector<Vec2> even = in_tile_order(test::point_sets<2>(5, 400)[3].points);
  std::reverse(even.begin(), even.end());
  EXPECT_FALSE(PointGrid(even, {}).in_tile_order());
}

TEST(PointGrid, AnswersTheSameForAnyThreadCount) {
  std::vector<Vec2> points(100'000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {uniform(1, i, 0), uniform(1, i, 1)};
  const PointGrid one(points, {.threads = 1});
  const auto sorted = in_tile_order(points);
  const PointGrid one_sorted(sorted, {.threads = 1});
  for (const unsigned threads : {2U, 3U, 8U}) {
    const PointGrid many(points, {.threads = threads});
    const PointGrid many_sorted(sorted, {.threads = threads});
    std::vector<Neighbour> a;
    std::vector<Neighbour> b;
    for (VertexId i = 0; i < points.size(); i += 997) {
      one.nearest(points[i], 12, i, a);
      many.nearest(points[i], 12, i, b);
      ASSERT_EQ(a, b);
      one_sorted.nearest(points[i], 12, i, a);
      many_sorted.nearest(points[i], 12, i, b);
      ASSERT_EQ(a, b);
    }
  }
}

TEST(PointGrid, StopsAtTheDeadline) {
  const Deadline ended(0.0);
  EXPECT_THROW(PointGrid(std::vector<Vec2>(10), {.deadline = &ended}), Stopped);
}

}  // namespace
}  // namespace warren
