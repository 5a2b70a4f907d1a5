// SPDX-License-Identifier: BSD-3-Clause
// What is asked for near a place is near it.
#include "planners/mazes/tile_source.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

constexpr double halo = 1.2;

/// Walls in, around and far from a tile: multiples of 1/128 or not, short or long.
std::vector<Segment> some_walls(std::uint64_t seed, bool doubles) {
  SequentialRng rng(seed);
  std::vector<Segment> walls;
  const auto number = [&](std::uint64_t steps, double low) {
    return low + static_cast<double>(rng.below(steps)) / 128;
  };
  for (int i = 0; i < 200; ++i) {
    const Vec2 from{number(8000, -10), number(8000, -10)};
    const double reach = i % 20 == 0 ? 150.0 : 2.0;
    Vec2 to{from.x + number(512, -2) * reach / 2, from.y + number(512, -2) * reach / 2};
    if (i % 3 == 0) to.x = from.x;
    if (i % 7 == 0) to.y += 1e-3F;
    walls.push_back({from, to});
  }
  if (doubles) walls.push_back({{0.1, 0.2}, {10.3, 20.4}});
  return walls;
}

TEST(TileWalls, AroundAPlaceAreThoseWhoseBoxMeetsIt) {
  const TileGrid grid = TileGrid::of({60, 60});
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    const WallSet walls = WallSet::narrowest(some_walls(seed, seed % 2 == 0));
    const WallPartition partition(walls, {}, grid, halo, {});
    const TileWalls tile = partition.of(0);
    for (int i = 0; i < 100; ++i) {
      const Vec2 at{static_cast<double>(rng.below(60 * 128)) / 128, static_cast<double>(rng.below(60 * 128)) / 128};
      const Box around = Box{at, at}.grown(i % 4 == 0 ? 0.0 : 1.1);
      std::vector<Segment> found;
      std::vector<Segment> expected;
      const auto take = [&](std::vector<Segment>& into) {
        return [&](const Segment& wall) {
          if (around.meets(box_of(wall))) into.push_back(wall);
        };
      };
      tile.for_each_around(grid, 0, around, take(found));
      tile.for_each(grid, 0, take(expected));
      EXPECT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace warren
