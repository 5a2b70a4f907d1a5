// SPDX-License-Identifier: BSD-3-Clause
// What an answer claims: a path that was verified, or nothing.
#include "solve/kinds/solve_steps.hpp"

#include <gtest/gtest.h>

#include <new>
#include <nlohmann/json.hpp>
#include <string>

#include "pictures/answer_summary.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/answer/write_answer_io.hpp"

namespace warren::tools {
namespace {

using Json = nlohmann::ordered_json;

/// As a solve leaves it when its path has just been verified.
Answer solved() {
  Answer answer;
  answer.outcome = Outcome::solved;
  answer.verified = true;
  answer.optimal = true;
  answer.length = 5.0;
  answer.min_clearance = 0.5;
  answer.raw_length = 6.0;
  answer.cost = 7.0;
  answer.turn_rad = 1.0;
  answer.path_figures.push_back({"axis_length", 5.5});
  answer.figures.push_back({"free_states", std::uint64_t{12}});
  answer.path = {{0, 0}, {3, 4}};
  answer.world.source = "a.scene";
  answer.world.kind = "walls";
  return answer;
}

Json json_of(const Answer& answer) {
  std::string text;
  write_answer_json(answer, {}, [&](std::string_view piece) { text.append(piece); });
  return Json::parse(text);
}

void expect_no_claim(const Json& json) {
  EXPECT_EQ(json["verified"], false);
  for (const char* key : {"length", "min_clearance", "raw_length"}) EXPECT_TRUE(json[key].is_null()) << key;
  for (const char* key : {"optimal", "cost", "turn_rad", "axis_length"}) EXPECT_FALSE(json.contains(key)) << key;
  EXPECT_EQ(json["path"], Json::array());
}

TEST(VerifiedAnswer, OneThatIsVerifiedClaimsItsPath) {
  Answer answer;
  answer_within_limits(answer, [&] { answer = solved(); });
  const Json json = json_of(answer);
  EXPECT_EQ(json["status"], "solved");
  EXPECT_EQ(json["length"], 5.0);
  EXPECT_EQ(json["axis_length"], 5.5);
  EXPECT_EQ(json["path"], Json::parse("[[0.0, 0.0], [3.0, 4.0]]"));
}

TEST(VerifiedAnswer, OneThatIsStoppedAfterItsVerificationClaimsNothing) {
  for (const bool by_memory : {false, true}) {
    Answer answer;
    answer_within_limits(answer, [&] {
      answer = solved();
      if (by_memory) throw std::bad_alloc();
      throw Stopped{StopReason::time};
    });
    const Json json = json_of(answer);
    EXPECT_EQ(json["status"], "stopped");
    EXPECT_EQ(json["stopped_by"], by_memory ? "memory" : "budget");
    EXPECT_EQ(json["free_states"], 12);
    expect_no_claim(json);
  }
}

TEST(VerifiedAnswer, OneWithoutAVerifiedPathClaimsNothing) {
  for (const Outcome outcome : {Outcome::not_connected, Outcome::start_blocked, Outcome::infeasible}) {
    Answer answer;
    answer_within_limits(answer, [&] {
      answer = solved();
      answer.verified = false;
      answer.outcome = outcome;
    });
    const Json json = json_of(answer);
    EXPECT_EQ(json["status"], name_of(outcome));
    expect_no_claim(json);
  }
}

TEST(VerifiedAnswer, ARefutedPathStandsUnderAKeyOfItsOwn) {
  Answer answer;
  answer_within_limits(answer, [&] {
    answer = solved();
    refute(answer, {.length = 5.25, .first_violation = Violation{3, 0.25, "wall 1"}});
  });
  const Json json = json_of(answer);
  EXPECT_EQ(json["status"], "refuted");
  expect_no_claim(json);
  EXPECT_FALSE(json.contains("components"));
  EXPECT_EQ(json["refuted"]["length"], 5.25);
  EXPECT_EQ(json["refuted"]["cost"], 7.0);
  EXPECT_EQ(json["refuted"]["first_violation"], Json::parse(R"({"leg": 3, "distance": 0.25, "obstacle": "wall 1"})"));
  EXPECT_EQ(json["refuted"]["path"].size(), 2U);
  const std::string text = summary_of(answer, Palette(false), {});
  EXPECT_NE(text.find("refuted: the path meets wall 1"), std::string::npos) << text;
  EXPECT_EQ(text.find("length"), text.find("length        5.25, of the refuted path")) << text;
}

}  // namespace
}  // namespace warren::tools
