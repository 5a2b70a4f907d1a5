// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tile_source.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/rng.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {
namespace {

TEST(WallPartition, KnowsTheBoxOfFloatsAndDoubles) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    std::vector<Segment> segments;
    for (int i = 0; i < 50; ++i) {
      const auto number = [&] { return static_cast<double>(rng.below(4000)) / 16.0 - 100.0; };
      segments.push_back({{number(), number()}, {number(), 3.0 * number()}});
    }
    if (seed % 2 == 0) segments.push_back({{0.1, 0.2}, {0.3, -0.4}});  // no floats: the set holds doubles
    if (seed == 20) segments.clear();
    Scene scene;
    scene.walls = WallSet::narrowest(segments);
    const TileGrid grid = TileGrid::of({70, 90});
    const Box found = WallPartition(scene.walls, {}, grid, 1.2, {}).box();
    const Box box = obstacle_box(scene);
    EXPECT_EQ(found.min, box.min);
    EXPECT_EQ(found.max, box.max);
  }
}

TEST(WallPartition, KnowsTheBoxOfPackedWalls) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    RawVector<PackedWall> walls;
    const std::uint64_t spread = seed % 2 == 0 ? 2000 : 1000000;
    const auto steps = [&] {
      return static_cast<std::int32_t>(rng.below(spread)) - static_cast<std::int32_t>(spread / 3);
    };
    for (int i = 0; i < 3; ++i) {
      walls.push_back(PackedWall::level(steps(), steps(), steps()));
      walls.push_back(PackedWall::upright(steps(), steps(), steps()));
    }
    Scene scene;
    scene.walls = WallSet(std::move(walls));
    const Box found = WallPartition(scene.walls, {}, TileGrid::of({70, 90}), 1.2, {}).box();
    EXPECT_EQ(found.min, obstacle_box(scene).min);
    EXPECT_EQ(found.max, obstacle_box(scene).max);
  }
}

}  // namespace
}  // namespace warren
