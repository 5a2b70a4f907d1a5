// SPDX-License-Identifier: BSD-3-Clause
// A share of `tools/campaign --solves 10000`.
#include "tests/solve/bodies_far_away.hpp"

#include <gtest/gtest.h>

#include "tests/seeds.hpp"

namespace warren {
namespace {

TEST(BodiesFarAway, KeepTheRoomThatTheirJudgeTakesForRounding) {
  test::FarTally tally;
  const std::vector<std::uint64_t> seeds = test::seeds(240, 40);
  for (const std::uint64_t seed : seeds) test::solve_far_away(seed, tally);
  EXPECT_GE(tally.solved, seeds.size() / 4);
  for (const std::string& complaint : tally.refuted) ADD_FAILURE() << complaint;
}

/// A body of 1 mm at UTM, pulled taut along walls.
TEST(BodiesFarAway, AreNotPulledNearerToWallsThanTheirJudgeLetsThem) {
  Scene scene;
  scene.walls = WallSet::narrowest(
      std::vector<Segment>{{{450000.0795083646, 5400000.003893356}, {450000.0795083646, 5400000.005364379}},
                           {{450000.03559308336, 5400000.052697645}, {450000.0010932304, 5400000.02800329}},
                           {{450000.0247327161, 5400000.063079122}, {450000.0403033998, 5400000.06614799}},
                           {{450000.0600256309, 5400000.051482094}, {450000.0600256309, 5400000.033116126}},
                           {{450000.0093632423, 5400000.021283343}, {450000.0212335632, 5400000.0624223715}},
                           {{450000.00964081194, 5400000.004294619}, {450000.00964081194, 5400000.04487496}},
                           {{450000.03662263654, 5400000.052599066}, {449999.98872602655, 5400000.047461903}},
                           {{450000.08034962026, 5400000.052987634}, {450000.0786658009, 5400000.056796535}}});
  const RobotSpec robot{.kind = RobotKind::polygon,
                        .outline = {{-0.0005, -0.00025}, {0.0005, -0.00025}, {0.0005, 0.00025}, {-0.0005, 0.00025}}};
  const Question question{.robot = robot,
                          .start = {450000.06797583983, 5400000.008951189, -0.39248551710080326},
                          .goal = {450000.0227974497, 5400000.056511105, -2.5993481275097396}};
  EXPECT_TRUE(solve(scene, question, {.optimise = true}, {.threads = 1}).verified);
}

}  // namespace
}  // namespace warren
