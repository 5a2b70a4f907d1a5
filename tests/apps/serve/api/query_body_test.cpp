// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "apps/serve/api/request_bodies_io.hpp"
#include "apps/serve/http/http_message.hpp"
#include "tests/refusals.hpp"

namespace warren::serve {
namespace {

TEST(QueryBody, SaysWhatIsAsked) {
  const QueryBody body = read_query_body(
      "{\"start\": [1, 2.5], \"goal\": [-3e2, 4, 0.5],\n \"optimise\": true, \"planner\": \"lazy-prm\", \"budget_ms\": "
      "250, \"path\": false, \"robot\": \"disc 0.5\", \"clearance\": 0.25}");
  EXPECT_EQ(body.question.robot->radius, 0.5);
  EXPECT_EQ(body.question.clearance, 0.25);
  EXPECT_EQ(body.question.start, (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(body.question.goal, (std::vector<double>{-300.0, 4.0, 0.5}));
  EXPECT_TRUE(body.question.optimise);
  EXPECT_EQ(body.question.planner, PlannerKind::lazy_prm);
  EXPECT_EQ(body.question.budget_s, 0.25);
  EXPECT_FALSE(body.tells_path);
  EXPECT_TRUE(read_query_body("{}").tells_path);
}

TEST(QueryBody, TakesPricesAndChoicesByTheNamesOfAnAnswer) {
  const ServedQuestion asked =
      read_query_body(
          R"({"prices": ["clearance-price 3 0.5", "area 4 1 1 2 1 2 2", "keep-out 5 5 6 5 6 6", "unknown 2"],
      "goals": [[1, 2], [3, 4]], "goal_tolerance": "inf", "goal_heading_rad": 0.5, "visit": [[7, 8]],
      "alternatives": 3, "hole": 0.25, "stretch": 2, "keep_to": [[0, 0], [1, 2]], "unless_gain": 0.1})")
          .question;
  EXPECT_EQ(asked.prices.clearance->price, 3.0);
  EXPECT_EQ(asked.prices.clearance->reach, 0.5);
  EXPECT_EQ(asked.prices.areas.at(0).factor, 4.0);
  EXPECT_EQ(asked.prices.keep_out.at(0).corners.size(), 3U);
  EXPECT_EQ(asked.prices.unknown, 2.0);
  EXPECT_EQ(asked.goal, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(asked.rule.others, (std::vector<std::vector<double>>{{3.0, 4.0}}));
  EXPECT_TRUE(std::isinf(*asked.rule.tolerance));
  EXPECT_EQ(asked.rule.heading_rad, 0.5);
  EXPECT_EQ(asked.rule.visit.size(), 1U);
  EXPECT_EQ(asked.route.alternatives, 3U);
  EXPECT_EQ(asked.route.hole, 0.25);
  EXPECT_EQ(asked.route.stretch, 2.0);
  EXPECT_EQ(asked.route.keep_to.size(), 2U);
  EXPECT_EQ(asked.route.unless_gain, 0.1);
  EXPECT_EQ(read_query_body(R"({"goal_region": 2})").question.rule.region, 2.0);
  EXPECT_TRUE(read_query_body(R"({"visit": [[7, 8]], "return": true})").question.rule.back);
}

TEST(QueryBody, AFileIsNotForWhoeverAsksToChoose) {
  for (const char* line : {"mask /etc/passwd areas 2", "mask a.yaml keep-out"})
    EXPECT_THROW(read_query_body(fmt::format(R"({{"prices": ["{}"]}})", line)), HttpError) << line;
}

TEST(QueryBody, RefusesEverythingElse) {
  for (const std::string& text : {std::string(),
                                  std::string("[]"),
                                  std::string("1"),
                                  std::string("{"),
                                  std::string("{}{}"),
                                  std::string("nul"),
                                  std::string("{\"start\": 1}"),
                                  std::string("{\"start\": [\"1\"]}"),
                                  std::string("{\"start\": [null]}"),
                                  std::string("{\"start\": [1e999]}"),
                                  std::string("{\"start\": [NaN]}"),
                                  std::string("{\"start\": [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15]}"),
                                  std::string("{\"optimise\": 1}"),
                                  std::string("{\"planner\": \"magic\"}"),
                                  std::string("{\"planner\": 1}"),
                                  std::string("{\"budget_ms\": 0}"),
                                  std::string("{\"budget_ms\": -1}"),
                                  std::string("{\"budget_ms\": \"1\"}"),
                                  std::string("{\"prices\": \"unknown 2\"}"),
                                  std::string("{\"prices\": [2]}"),
                                  std::string("{\"goals\": []}"),
                                  std::string("{\"goals\": [1, 2]}"),
                                  std::string("{\"goal_tolerance\": \"far\"}"),
                                  std::string("{\"alternatives\": 0}"),
                                  std::string("{\"alternatives\": 1e9}"),
                                  std::string("{\"alternatives\": 2.7}"),
                                  std::string("{\"goal\": [1,2], \"goals\": [[3,4]]}"),
                                  std::string("{\"goals\": [[3,4]], \"goal\": [1,2]}"),
                                  std::string("{\"visit\": [[3,4]], \"return\": true, \"goal\": [1,2]}"),
                                  std::string("{\"return\": 1}"),
                                  std::string("{\"file\": \"/etc/passwd\"}"),
                                  std::string("{\"start\": [1,2], }"),
                                  std::string("{\"start\": [1,2], \"start\": [3,4]}"),
                                  std::string("\xff\xfe{}"),
                                  std::string("{\"a\": ") + std::string(9, '[') + std::string(9, ']') + "}",
                                  std::string(60'000, '[')}) {
    SCOPED_TRACE(text.substr(0, 40));
    EXPECT_THROW(read_query_body(text), HttpError);
  }
}

TEST(QueryBody, ARefusalSaysWhatIsExpected) {
  const std::pair<const char*, std::string> cases[] = {
      {"{\"start\": [1, 2],\n\"goal\": [1, 2}", "line 2: expected JSON"},
      {"{\"start\": [1e400, 2]}", "body: expected JSON whose numbers a double can hold"},
      {"{\"start\": [1, 2], \"start\": [3, 4]}", "body: expected each key of an object once"},
      {"{\"start\": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]}",
       "start: expected a list of at most 14 numbers"},
  };
  for (const auto& [text, said] : cases) {
    EXPECT_EQ(test::refusal<HttpError>([&, &text = text] { read_query_body(text); }), said) << text;
  }
}

TEST(QueryBody, ARefusalHoldsItsPlaceWhenTheBodyIsGone) {
  const std::pair<const char*, std::string> cases[] = {
      {R"({"stretch": "x"})", "stretch"},    {R"({"goal_tolerance": "far"})", "goal_tolerance"},
      {R"({"prices": [2]})", "prices[0]"},   {R"({"goals": [[0, 0], 2]})", "goals[1]"},
      {R"({"visit": [["x"]]})", "visit[0]"}, {R"({"return": 1})", "return"},
  };
  for (const auto& [text, where] : cases) {
    try {
      read_query_body(text);
      ADD_FAILURE() << text;
    } catch (const HttpError& error) {
      EXPECT_EQ(error.where, where) << text;
    }
  }
}

TEST(QueryBody, NestingIsOfTheDeepestLineAndNotOfTexts) {
  EXPECT_EQ(nesting_of(""), 0U);
  EXPECT_EQ(nesting_of("{\"a\": [1]}"), 2U);
  EXPECT_EQ(nesting_of("{\"[[[[\": 1}"), 1U);
  EXPECT_EQ(nesting_of("{\"\\\"[[[[\": 1}"), 1U);
  EXPECT_EQ(nesting_of("]]]]{}"), 1U);
  EXPECT_EQ(nesting_of("[\n[[\n\"[\n[[["), 3U);
  EXPECT_EQ(nesting_of(std::string(100'000, '[')), 100'000U);
}

}  // namespace
}  // namespace warren::serve
