// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/run_of_verb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace warren::tools {
namespace {

constexpr ExpectedStage three[] = {{"read", 1.0}, {"connect", 6.0}, {"search", 3.0}};

TEST(WholeRun, SaysWhatIsLeftOfAllStagesByTheTimeThatHasPassed) {
  WholeRun run(three);
  // This machine takes 2 s a share: 20 s in all.
  EXPECT_NEAR(run.seconds_left({"read", 50, 100, 1.0}).value(), 19.0, 1e-9);
  EXPECT_NEAR(run.seconds_left({"connect", 500, 1000, 8.0}).value(), 12.0, 1e-9);
  EXPECT_NEAR(run.seconds_left({"search", 0, 0, 14.0}).value(), 6.0, 1e-9);
  EXPECT_NEAR(run.seconds_left({"search", 0, 0, 17.0}).value(), 3.0 * 17.0 / 17.0, 1e-9) << "by the clock";
}

TEST(WholeRun, StagesThatPassedUnseenCount) {
  WholeRun run(three);
  EXPECT_NEAR(run.seconds_left({"connect", 1, 2, 4.0}).value(), 6.0, 1e-9);
}

TEST(WholeRun, ThePartThatIsDoneNeverFalls) {
  WholeRun run(three);
  double before = 0.0;
  const std::vector<RunMoment> moments = {{"read", 9, 10, 1.0},    {"read", 2, 10, 1.1},    {"connect", 0, 10, 1.2},
                                          {"connect", 8, 10, 5.0}, {"connect", 3, 10, 6.0}, {"search", 0, 0, 7.0},
                                          {"search", 0, 0, 8.0},   {"search", 0, 0, 8.5}};
  for (const RunMoment& moment : moments) {
    const double part = run.part_done(moment).value();
    EXPECT_GE(part, before);
    EXPECT_LE(part, 1.0);
    before = part;
  }
}

TEST(WholeRun, SaysNothingRatherThanNonsense) {
  WholeRun early(three);
  EXPECT_FALSE(early.seconds_left({"read", 1, 100, 1.0}).has_value()) << "a hundredth tells too little";
  WholeRun slow(three);
  EXPECT_TRUE(slow.seconds_left({"search", 0, 0, 7.0}).has_value());
  EXPECT_FALSE(slow.seconds_left({"search", 0, 0, 14.0}).has_value()) << "3 were its share, and 7 have passed";
  WholeRun other(three);
  EXPECT_TRUE(other.seconds_left({"connect", 1, 2, 4.0}).has_value());
  EXPECT_FALSE(other.seconds_left({"proof", 1, 2, 5.0}).has_value()) << "nobody expected it";
  EXPECT_FALSE(other.seconds_left({"search", 0, 0, 6.0}).has_value()) << "what else may come?";
}

TEST(ProgressLine, TellsOfStageAndWholeAndFits) {
  const RunMoment moment{"connect", 43, 100, 2.0};
  const std::string line = progress_line(moment, 19.0, "about 12.0 s left in all", 100);
  EXPECT_NE(line.find(" 43 %  19/s  3.00 s left of it, about 12.0 s left in all"), line.npos) << line;
  for (const std::size_t width : {10U, 40U, 60U, 100U, 200U})
    EXPECT_LT(progress_line(moment, 19.0, line, width).size(), width);
  EXPECT_EQ(progress_line({"search", 0, 0, 1.0}, 0.0, "", 80), "search    ");
  EXPECT_EQ(progress_line({"search", 0, 0, 1.0}, 0.0, "--budget ends in 5.00 s", 80),
            "search     --budget ends in 5.00 s");
}

TEST(ImprovementText, SaysCostBoundGapAndTurn) {
  Improvement best{.iterations = 120, .cost = 12.5, .length = 12.0, .by = "tree"};
  EXPECT_EQ(improvement_text(best), "cost 12.5, turn 120");
  best.lower_bound = 12.0;
  EXPECT_EQ(improvement_text(best), "cost 12.5, bound 12, gap 4.2 %, turn 120");
  best.lower_bound = 5.0;
  EXPECT_EQ(improvement_text(best), "cost 12.5, bound 5, gap 150 %, turn 120");
}

}  // namespace
}  // namespace warren::tools
