// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/question_words.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"

namespace warren::tools {
namespace {

Question question_of(std::vector<std::string> words) {
  words.insert(words.begin(), "world");
  return question_words(Arguments(command_named("solve"), words));
}

TEST(QuestionWords, PricesAreRead) {
  const Prices prices =
      question_of({"--clearance-price", "3,0.5", "--area", "2 0 0 1 0 1 1", "--area", "3;0,0;2,0;2,2", "--areas",
                   "a,b.yaml,5", "--speed-zones", "s.yaml", "--speed-zones", "s.yaml,80,-0.5", "--keep-out",
                   "k.geojson", "--keep-out", "k.yaml,7", "--unknown", "2"})
          .prices;
  EXPECT_EQ(prices.clearance->price, 3.0);
  EXPECT_EQ(prices.clearance->reach, 0.5);
  ASSERT_EQ(prices.areas.size(), 2U);
  EXPECT_EQ(prices.areas[1].corners[2], (Vec2{2, 2}));
  ASSERT_EQ(prices.masks.size(), 5U);
  EXPECT_EQ(prices.masks[0].file, "a,b.yaml");
  EXPECT_EQ(prices.masks[0].factor, 5.0);
  EXPECT_EQ(prices.masks[1].multiplier, -1.0);
  EXPECT_EQ(prices.masks[2].file, "s.yaml");
  EXPECT_EQ(prices.masks[2].base, 80.0);
  EXPECT_FALSE(prices.masks[3].factor);
  EXPECT_EQ(prices.masks[4].factor, 7.0);
  EXPECT_EQ(prices.unknown, 2.0);
  EXPECT_FALSE(question_of({"--clearance-price", "3"}).prices.clearance->reach);
  EXPECT_FALSE(question_of({"--unknown", "blocked"}).prices.opens_unknown());
}

TEST(QuestionWords, GoalsAndTheirRulesAreRead) {
  const Question several = question_of({"--goal", "1,2", "--goal", "3,4", "--goal", "5,6"});
  EXPECT_EQ(several.goal, (std::vector<double>{1, 2}));
  EXPECT_EQ(question_of({"--goal", "1e-400,+2"}).goal, (std::vector<double>{0, 2}));
  EXPECT_FALSE(std::signbit(question_of({"--start", "1,-0"}).start[1]));
  EXPECT_EQ(several.rule.others, (std::vector<std::vector<double>>{{3, 4}, {5, 6}}));
  EXPECT_TRUE(std::isinf(*question_of({"--goal-tolerance", "inf"}).rule.tolerance));
  const GoalRule near = question_of({"--goal-tolerance", "0.5,90deg"}).rule;
  EXPECT_EQ(near.tolerance, 0.5);
  EXPECT_NEAR(*near.heading_rad, 1.5707963, 1e-6);
  EXPECT_EQ(question_of({"--goal-region", "2"}).rule.region, 2.0);
  const GoalRule visit = question_of({"--visit", "1,2; 3,4", "--return"}).rule;
  EXPECT_EQ(visit.visit, (std::vector<std::vector<double>>{{1, 2}, {3, 4}}));
  EXPECT_TRUE(visit.back);
  EXPECT_EQ(question_of({"--visit", "1,2", "--visit", "3,4"}).rule.visit, visit.visit);
  const RouteRule route = question_of({"--alternatives", "4,0.3", "--stretch", "2"}).route;
  EXPECT_EQ(route.alternatives, 4U);
  EXPECT_EQ(route.hole, 0.3);
  EXPECT_EQ(route.stretch, 2.0);
  for (const char* share : {"10%", "0.1"}) {
    EXPECT_EQ(question_of({"--unless-gain", share, "--keep-to", "old.json"}).route.unless_gain, 0.1) << share;
  }
  EXPECT_EQ(question_of({"--unless-gain", "0.005", "--keep-to", "old.json"}).route.unless_gain, 0.005);
}

TEST(QuestionWords, WrongValuesAreRefusedByName) {
  const std::vector<std::vector<std::string>> wrong{{"--clearance-price", "-1"},
                                                    {"--clearance-price", "1,0"},
                                                    {"--clearance-price", "20000"},
                                                    {"--clearance-price", "1,2,3"},
                                                    {"--area", "2 0 0 1 0"},
                                                    {"--area", "0.5 0 0 1 0 1 1"},
                                                    {"--area", "2 0 0 1 1 2 2"},
                                                    {"--areas", "a.yaml"},
                                                    {"--areas", "a.yaml,0.5"},
                                                    {"--areas", ",5"},
                                                    {"--speed-zones", "s.yaml,80"},
                                                    {"--speed-zones", "s.yaml,1e9,1"},
                                                    {"--keep-out", "k.yaml,0"},
                                                    {"--unknown", "0.5"},
                                                    {"--unknown", "free"},
                                                    {"--goal-tolerance", "-1"},
                                                    {"--goal-tolerance", "nan"},
                                                    {"--goal-region", "inf"},
                                                    {"--visit", ""},
                                                    {"--visit", "1"},
                                                    {"--return"},
                                                    {"--alternatives", "0"},
                                                    {"--alternatives", "65"},
                                                    {"--alternatives", "2,-1"},
                                                    {"--stretch", "0.5"},
                                                    {"--unless-gain", "150%"}};
  for (const std::vector<std::string>& words : wrong) {
    try {
      question_of(words);
      ADD_FAILURE() << words[0] << ' ' << words.back();
    } catch (const UsageError& error) {
      EXPECT_NE(error.spelled("--", '-').find(words[0]), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(question_of({"--goal-region", "1", "--goal-tolerance", "1"}), UsageError);
  EXPECT_THROW(question_of({"--visit", "1,2", "--return", "--goal", "1,2"}), UsageError);
}

}  // namespace
}  // namespace warren::tools
