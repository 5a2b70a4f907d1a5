// SPDX-License-Identifier: BSD-3-Clause
// What the summary says of planners that get better with time, of answers that are made up.
#include "pictures/answer_summary.hpp"

#include <gtest/gtest.h>

#include <string>

namespace warren {
namespace {

Answer better_answer() {
  Answer answer;
  answer.outcome = Outcome::solved;
  answer.verified = true;
  answer.length = 25.0;
  answer.planner = "anytime";
  answer.iterations = 240;
  answer.ended_by = "budget";
  answer.stop_reason = StopReason::time;
  answer.lower_bound = 24.9;
  answer.improvements = {{.iterations = 2, .seconds = 0.1, .cost = 31.25, .length = 31.25, .by = "tree"},
                         {.iterations = 9, .seconds = 0.2, .cost = 25.0, .length = 25.0, .by = "shorten"}};
  return answer;
}

void expect_line(const Answer& answer, const std::string& line) {
  const std::string text = summary_of(answer, Palette(false), {});
  EXPECT_NE(text.find("\n  " + line + "\n"), std::string::npos) << text;
}

TEST(AnswerSummary, SaysHowAPathGotBetterAndWhatEndedIt) {
  Answer answer = better_answer();
  expect_line(answer, "better        240 turns, cost 31.25 to 25 in 1 step; the time budget ended");
  answer.stop_reason.reset();
  for (const auto& [end, words] :
       {std::pair("optimum", "there is no better one"), std::pair("gap", "as near to the best as --gap asks for"),
        std::pair("iterations", "all turns are done"), std::pair("goal", "there is no better one to this goal"),
        std::pair("goal_gap", "as near to the best to this goal as --gap asks for"),
        std::pair("lattice_gap", "as near to the lattice's best as --gap asks for"),
        std::pair("caller", "the caller had enough")}) {
    answer.ended_by = end;
    expect_line(answer, std::string("better        240 turns, cost 31.25 to 25 in 1 step; ") + words);
  }
}

TEST(AnswerSummary, SaysHowFarFromTheBestThePathIsAtMost) {
  Answer answer = better_answer();
  expect_line(answer, "bound         24.9: within 0.41 % of the best there is, proved");
  answer.lower_bound = 20.0;
  expect_line(answer, "bound         20: at most 25 % longer than the best, proved");
  answer.cost = 40.0;
  expect_line(answer, "bound         20: costs at most 100 % more than the best, proved");
  expect_line(answer, "cost          40, turning counted");
  answer.optimal = true;
  EXPECT_EQ(summary_of(answer, Palette(false), {}).find("bound"), std::string::npos) << "the length says so";
}

TEST(AnswerSummary, SaysWhatBecameOfAChoice) {
  Answer answer = better_answer();
  answer.problem.rule.others = {{3.0, 4.0}, {5.0, 6.0}};
  answer.goal_index = 2;
  expect_line(answer, "goal          number 3 of 3");
  answer.goal_reached = GoalReached{{5.0, 6.0}, 0.25, 0.125};
  expect_line(answer, "goal          number 3 of 3, 0.25 from (5, 6), of which nothing within 0.125 can be reached");
  answer.goal_index.reset();
  answer.goal_reached->distance_bound.reset();
  expect_line(answer, "goal          0.25 from (5, 6)");
  answer.order = {1, 0};
  expect_line(answer, "order         places 2, 1");
  answer.alternatives.resize(2);
  answer.alternatives[0].cost = 26.0;
  answer.alternatives[1].cost = 27.5;
  expect_line(answer, "other ways    26, 27.5");
}

TEST(AnswerSummary, WithoutAPathTheTurnsAreTold) {
  Answer answer = better_answer();
  answer.outcome = Outcome::stopped;
  answer.verified = false;
  expect_line(answer, "better        240 turns; the time budget ended");
  EXPECT_EQ(summary_of(answer, Palette(false), {}).find("bound"), std::string::npos);
}

}  // namespace
}  // namespace warren
