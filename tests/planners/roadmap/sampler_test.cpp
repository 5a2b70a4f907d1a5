// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/sampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/refusals.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

constexpr double clearance = 0.1;

Scene small_maze() { return maze_scene({6, 9, 1, MazeAlgorithm::backtracker, 0.0}, false, {}); }

/// By itself: the others of its range are not drawn.
Vec2 sample_of(const AnyWorld<Vec2>& world, const RoadmapOptions& options, std::size_t index, std::uint64_t count) {
  Vec2 drawn;
  detail::for_each_sample(world, options, {index, index + 1}, count, [&](const Vec2& sample) { drawn = sample; });
  return drawn;
}

TEST(Sampler, SamplesArePureFunctionsInsideTheWorld) {
  const Scene scene = small_maze();
  const MazeWorld maze(scene, clearance, {});
  const WorldView world(maze);
  RoadmapOptions options;
  std::set<std::pair<double, double>> cells;
  for (std::uint64_t i = 0; i < 54; ++i) {
    const Vec2 p = lattice_point({6, 9}, i);
    cells.insert({p.x, p.y});
    EXPECT_TRUE(p.x >= 1 && p.x <= 9 && p.y >= 1 && p.y <= 6);
  }
  EXPECT_EQ(cells.size(), 54U);
  for (const SamplerKind sampler : {SamplerKind::uniform, SamplerKind::halton, SamplerKind::random}) {
    options.sampler = sampler;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      EXPECT_TRUE(world.box().contains(sample_of(world, options, i, 1000)));
      EXPECT_EQ(sample_of(world, options, i, 1000), sample_of(world, options, i, 1000));
    }
  }
}

TEST(Sampler, SamplesOfARangeAreThoseOfTheirIndices) {
  const Scene scene = small_maze();
  const MazeWorld maze(scene, clearance, {});
  const WorldView world(maze);
  for (const SamplerKind sampler : {SamplerKind::uniform, SamplerKind::halton, SamplerKind::random}) {
    RoadmapOptions options;
    options.sampler = sampler;
    for (const Range range : {Range{0, 1}, Range{0, 777}, Range{5, 5}, Range{63, 400}, Range{776, 777}}) {
      std::size_t index = range.first;
      detail::for_each_sample(world, options, range, 777,
                              [&](const Vec2& sample) { ASSERT_EQ(sample, sample_of(world, options, index++, 777)); });
      EXPECT_EQ(index, range.last);
    }
  }
}

TEST(Sampler, StrataHoldOneSampleEach) {
  for (const std::uint64_t count : {1U, 2U, 7U, 100U, 500U, 1001U}) {
    for (const double shape : {0.001, 0.7, 1.0, 1.4, 1000.0}) {
      const auto n = static_cast<double>(count);
      const double rows = std::clamp(std::round(std::sqrt(n * shape)), 1.0, n);
      std::vector<int> in_row(static_cast<std::size_t>(rows), 0);
      const Strata strata(count, shape);
      for (std::uint64_t i = 0; i < count; ++i) {
        const auto [x, y] = strata.point(3, i, strata.row_of(i));
        ASSERT_TRUE(x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0) << x << " " << y;
        ++in_row[static_cast<std::size_t>(y * rows)];
      }
      for (const int samples : in_row) ASSERT_NEAR(samples, n / rows, 1.0) << count << " " << shape;
    }
  }
}

TEST(RoadmapOptions, RefusesValuesOutOfRange) {
  const auto message = [](const RoadmapOptions& options) {
    return test::refusal<InputError>([&] { options.validate(); });
  };
  RoadmapOptions options;
  options.samples = 0;
  EXPECT_EQ(message(options), "samples: must be from 1 to 2^31 (found: 0)");
  options = {};
  options.neighbours = 5000;
  EXPECT_EQ(message(options), "neighbours: must be from 1 to 4096 (found: 5000)");
  options = {};
  options.radius = std::nan("");
  EXPECT_EQ(message(options).substr(0, 33), "radius: must be a positive number");
  options = {};
  options.sampler = SamplerKind::lattice;
  EXPECT_EQ(message(options), "lattice: needs the rows and columns of the maze");
  EXPECT_EQ(message({}), "");
}

}  // namespace
}  // namespace warren
