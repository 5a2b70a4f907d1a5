// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/sides_near_legs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/rng.hpp"

namespace warren {
namespace {

constexpr double bend = 1e-13;

void expect_cover(const std::vector<PoseRun>& runs, std::size_t poses) {
  ASSERT_FALSE(runs.empty());
  EXPECT_EQ(runs.front().first, 0U);
  EXPECT_EQ(runs.back().last, poses - 1);
  for (std::size_t i = 1; i < runs.size(); ++i) EXPECT_EQ(runs[i].first, runs[i - 1].last);
}

TEST(PoseRuns, RoundedLatticePathsAreFewRunsInEveryDirection) {
  constexpr int steps[][2] = {{1, 0}, {0, -1}, {1, 1}, {-1, 1}, {2, -1}};
  for (const auto& step : steps) {
    std::vector<Se2> path;
    for (int i = 0; i <= 1000; ++i) path.push_back({-7.3 + 0.05 * i * step[0], 11.1 + 0.05 * i * step[1], 0.7});
    const std::vector<PoseRun> runs = pose_runs(path, bend, {});
    expect_cover(runs, path.size());
    EXPECT_LE(runs.size(), 7U);  // 512 legs, 256, 128, ...
  }
}

TEST(PoseRuns, EndWhereThePathBendsBacktracksOrTurns) {
  const auto runs = [](const std::vector<Se2>& path) { return pose_runs(path, bend, {}); };
  using Runs = std::vector<PoseRun>;
  EXPECT_EQ(runs({{0, 0, 0}}), (Runs{{0, 0}}));
  EXPECT_EQ(runs({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), (Runs{{0, 2}}));
  EXPECT_EQ(runs({{0, 0, 0}, {1, 1e-9, 0}, {2, 0, 0}}), (Runs{{0, 1}, {1, 2}}));
  EXPECT_EQ(runs({{0, 0, 0}, {3, 0, 0}, {2, 0, 0}}), (Runs{{0, 1}, {1, 2}}));
  EXPECT_EQ(runs({{0, 0, 0}, {3, 0, 0}, {0, 0, 0}}), (Runs{{0, 1}, {1, 2}}));
  EXPECT_EQ(runs({{0, 0, 0}, {1, 0, 0.1}, {2, 0, 0.2}}), (Runs{{0, 1}, {1, 2}}));  // turns on the way
  EXPECT_EQ(runs({{0, 0, 0}, {1, 0, 0}, {1, 0, 0.1}}), (Runs{{0, 1}, {1, 2}}));
  EXPECT_EQ(runs({{0, 0, 0.0}, {0, 0, 0.1}, {0, 0, 0.2}}), (Runs{{0, 2}}));
  EXPECT_EQ(runs({{0, 0, 0.0}, {0, 0, 0.1}, {0, 0, 0.0}}), (Runs{{0, 1}, {1, 2}}));
  EXPECT_EQ(runs({{0, 0, 3.1}, {0, 0, -3.1}, {0, 0, -3.0}}), (Runs{{0, 2}}));        // through the wrap
  EXPECT_EQ(runs({{0, 0, 0.0}, {0, 0, 1.6}, {0, 0, 3.2}}), (Runs{{0, 1}, {1, 2}}));  // the shorter way would be back
  EXPECT_EQ(runs({{2, 1, 0}, {2, 1, 0}, {2, 1, 0}}), (Runs{{0, 2}}));
}

TEST(PoseRuns, ATurnIsTheSumOfItsTurns) {
  std::vector<Se2> path;
  for (int k = 0; k <= 32; ++k) path.push_back({1, 2, 6.0 + 0.08 * k});
  const std::vector<PoseRun> runs = pose_runs(path, bend, {});
  ASSERT_EQ(runs.size(), 1U);
  const Leg leg = leg_of(path, runs[0]);
  EXPECT_EQ(leg.way, (Vec2{0, 0}));
  EXPECT_NEAR(leg.turn, 32 * 0.08, 1e-13);
}

/// Every pose of a run lies on the run's motion: checked by hand for random walks over a lattice.
TEST(PoseRuns, LeaveNoPoseOut) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    std::vector<Se2> path{{1, 1, 0}};
    while (path.size() < 3000) {
      const auto kind = rng.below(4);
      for (auto n = rng.below(seed % 2 == 0 ? 6 : 300); n > 0; --n) {
        Se2 next = path.back();
        if (kind == 0) next.x += 0.1;
        if (kind == 1) next.y -= 0.1;
        if (kind == 2) next.x -= 0.1, next.y += 0.1;
        if (kind == 3) next.theta += 0.0625;
        path.push_back(next);
      }
    }
    const std::vector<PoseRun> runs = pose_runs(path, bend, {});
    expect_cover(runs, path.size());
    EXPECT_LT(runs.size(), path.size());
    for (const PoseRun& run : runs) {
      EXPECT_LE(run.legs(), 1024U);
      const Leg leg = leg_of(path, run);
      const double length = norm(leg.way);
      for (std::size_t i = run.first; i <= run.last; ++i) {
        const Vec2 p = path[i].position() - leg.a.position();
        const double share = length > 0.0 ? dot(p, leg.way) / (length * length) : 0.0;
        EXPECT_NEAR(norm(p - share * leg.way), 0.0, 2.0 * bend);
        EXPECT_GE(share, -1e-12);
        EXPECT_LE(share, 1.0 + 1e-12);
        const double turned = shorter_turn(leg.a.theta, path[i].theta);
        EXPECT_TRUE(leg.turn < 0.0 ? turned <= 0.0 && turned >= leg.turn : turned >= 0.0 && turned <= leg.turn);
      }
    }
  }
}

}  // namespace
}  // namespace warren
