// SPDX-License-Identifier: BSD-3-Clause
#include "apps/distributed/band.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "scenes/mazes/maze_generator.hpp"
#include "solve/question/question.hpp"

namespace warren::distributed {
namespace {

TEST(Band, KeepsNoRoomForStepsThatNobodyAsksFor) {
  const Scene scene = unmade_maze_scene({.rows = 300, .cols = 700, .algorithm = MazeAlgorithm::mst, .loops = 0.1});
  const BandTask task{scene, keeping_off(scene, {}, "")};
  Band band(task, {0, task.grid().tile_rows});
  const Execution execution{.threads = 1};
  band.make(execution);
  const std::vector<TileSummary> tiles = band.reduce({}, BandPeeling::none, execution);
  std::size_t chains = 0;
  for (const TileSummary& tile : tiles) {
    chains += tile.chains.size();
    EXPECT_EQ(tile.steps.capacity(), 0U);
  }
  EXPECT_GT(chains, 1000U);
}

}  // namespace
}  // namespace warren::distributed
