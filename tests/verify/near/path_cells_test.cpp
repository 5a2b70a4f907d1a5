// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/path_cells.hpp"

#include <gtest/gtest.h>

#include "tests/worlds/plane/near_walls.hpp"

namespace warren {
namespace {

using test_screens::distances_of;
using test_screens::random_world;
using test_screens::Real;

TEST(PathBoxes, NoNearWallIsClear) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    std::size_t clear = 0;
    for (const auto& [name, w, unit, error] : variants(random_world(seed, seed % 2 == 0), seed)) {
      SCOPED_TRACE(name + " by " + std::to_string(unit));
      const std::vector<Real> distances = distances_of(w);
      PathBoxes boxes(LegBoxes(w.path, {}), unit, {});
      for (const auto& [least, clearance] : {std::pair{0.5, 0.1}, {0.3, 0.0}, {0.05, 0.7}, {2.5, 0.0}, {0.0, 0.0}}) {
        SCOPED_TRACE(testing::Message() << "reach " << least << " " << clearance);
        boxes.set_reach(unit * least, unit * clearance);
        const Real reach = unit * std::max(least, clearance);
        for (std::size_t i = 0; i < w.walls.size(); ++i) {
          std::size_t budget = 1'000'000;
          if (!boxes.is_clear(box_of(w.walls[i]), budget)) continue;
          ++clear;
          EXPECT_GE(distances[i], reach - error) << i;
          EXPECT_GT(distances[i], 0.0L) << i;
        }
      }
    }
    EXPECT_GT(clear, 1000U);
  }
}

TEST(PathBoxes, WallsBesideLegsAlongTheAxesAreClear) {
  std::vector<Vec2> path;  // stairs, off the lattice: both legs of a corner lie in its cell
  for (int i = 0; i < 20; ++i) path.push_back({0.3 + ((i + 1) / 2), 0.3 + (i / 2)});
  PathBoxes boxes(LegBoxes(path, {}), 1.0, {});
  boxes.set_reach(0.25, 0.0);
  std::size_t budget = 1'000'000;
  EXPECT_TRUE(boxes.is_clear({{3.6, 3.56}, {3.9, 4.04}}, budget));
  EXPECT_FALSE(boxes.is_clear({{3.6, 3.54}, {3.9, 4.04}}, budget));
  EXPECT_FALSE(boxes.is_clear({{3.6, 3.56}, {4.1, 4.04}}, budget));
}

TEST(PathBoxes, AnEmptyBudgetClearsNothing) {
  const std::vector<Vec2> path{{0.0, 0.0}, {200.0, 0.0}};
  PathBoxes boxes(LegBoxes(path, {}), 1.0, {});
  boxes.set_reach(0.1, 0.0);
  const Box wall{{0.0, -0.4}, {200.0, -0.3}};
  std::size_t budget = 1;
  EXPECT_FALSE(boxes.is_clear(wall, budget));
  budget = 100;
  EXPECT_TRUE(boxes.is_clear(wall, budget));
  EXPECT_LT(budget, 100U);
}

}  // namespace
}  // namespace warren
