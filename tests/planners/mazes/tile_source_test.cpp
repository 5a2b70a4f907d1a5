// SPDX-License-Identifier: BSD-3-Clause
// A world of one tile is filed in one pass: as the partition in two files it, and what is asked for near a place is
// near it.
#include "planners/mazes/tile_source.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <span>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

constexpr double halo = 1.2;

template <class Wall>
std::vector<char> bytes_of(std::span<const Wall> walls) {
  const auto* const first = reinterpret_cast<const char*>(walls.data());
  return walls.empty() ? std::vector<char>() : std::vector<char>(first, first + walls.size_bytes());
}

void expect_same(const TileWalls& found, const TileWalls& expected) {
  EXPECT_EQ(bytes_of(found.narrow), bytes_of(expected.narrow));
  EXPECT_EQ(bytes_of(found.wide), bytes_of(expected.wide));
  EXPECT_EQ(found.more.data(), expected.more.data());
}

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

void check_world(const WallSet& walls, const TileGrid& grid) {
  const Segment frame{{0, 0}, {60, 0}};
  const Execution execution;
  const std::span<const Segment> more(&frame, 1);
  const auto source = held_tiles(walls, more, grid, halo, 0, execution);
  const WallPartition partition(walls, more, grid, halo, execution);
  expect_same(source->reader()->read(0), partition.of(0));
  EXPECT_EQ(source->box().min, partition.box().min);
  EXPECT_EQ(source->box().max, partition.box().max);
  EXPECT_EQ(source->begin_band(0, execution), std::vector<std::size_t>{0});
  std::size_t visited = 0;
  source->for_each_near({{1, 1}, {2, 2}}, [&](const Segment&) { ++visited; });
  EXPECT_EQ(visited, walls.size() + 1);
}

TEST(TileSource, AWorldOfOneTileIsFiledAsThePartitionFilesIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    for (const LatticeSize lattice : {LatticeSize{41, 41}, LatticeSize{64, 64}, LatticeSize{1, 3}}) {
      const TileGrid grid = TileGrid::of(lattice);
      check_world(WallSet::narrowest(some_walls(seed, false)), grid);
      check_world(WallSet::narrowest(some_walls(seed, true)), grid);
    }
    RawVector<PackedWall> packed;
    SequentialRng rng(seed);
    const auto steps = [&](std::uint64_t most) { return static_cast<std::int32_t>(rng.below(most)) - 20; };
    for (int i = 0; i < 200; ++i) {
      packed.push_back(i % 2 == 0 ? PackedWall::level(steps(300), steps(300), steps(40))
                                  : PackedWall::upright(steps(300), steps(300), steps(i % 5 == 0 ? 2000 : 40)));
    }
    check_world(WallSet(std::move(packed)), TileGrid::of({50, 60}));
  }
  check_world(WallSet(), TileGrid::of({5, 5}));
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
