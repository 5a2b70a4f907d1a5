// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/read_answer_io.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <limits>

#include "core/base/error.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

std::string repeated(std::string_view head, std::string_view again, std::string_view tail) {
  const std::size_t bytes = test::share(1U << 20U, 1U << 18U);
  std::string text{head};
  while (text.size() < bytes) text += again;
  return text + std::string{tail};
}

TEST(RecordedAnswer, ASignalIsSeenWhateverTheFileIsFullOf) {
  const SignalFlag signal{SIGINT};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  for (const std::string& text : {repeated("{", " ", "x"), repeated(R"({"a": ")", "w", ""),
                                  repeated(R"({"a": )", "[", "x"), repeated(R"({"a": [0)", ",0", "x"),
                                  repeated(R"({"path": [[0,0])", ",[0,0]", "x"), repeated("", R"({"a":)", "x")}) {
    SCOPED_TRACE(text.substr(0, 20));
    const InputFile file = InputFile::of_bytes("a.json", text);
    EXPECT_THROW(read_answer(file, {}), InputError) << "it ends in a mistake";
    EXPECT_THROW(read_answer(file, Execution{1, &deadline}), Stopped);
  }
}

TEST(RecordedAnswer, NumbersThatAreNoStateAreNotKept) {
  const InputFile file =
      InputFile::of_bytes("a.json", repeated(R"({"a": [0)", ",0", R"(], "path": [[1, 2], [3, 4]]})"));
  EXPECT_EQ(read_answer(file, {}).path.size(), 2U);
  EXPECT_THROW(read_answer(InputFile::of_bytes("a.json", repeated(R"({"path": [[0)", ",0", "]]}")), {}), InputError);
  EXPECT_THROW(read_answer(InputFile::of_bytes("a.json", repeated(R"({"start": [0)", ",0", "]}")), {}), InputError);
}

std::string written(const Answer& answer) {
  std::string text;
  write_answer_json(answer, {}, [&](std::string_view piece) { text += piece; });
  return text;
}

/// What a file holds of an answer, in an answer.
Answer answer_of(const RecordedAnswer& record) {
  Answer answer;
  answer.outcome = Outcome::solved;
  answer.verified = true;
  answer.length = *record.length;
  answer.cost = record.cost;
  answer.price = record.price;
  answer.lower_bound = record.lower_bound;
  answer.bound_of = record.bound_of;
  answer.goal_index = record.goal_index;
  answer.goal_reached = record.goal_reached;
  answer.order = record.order;
  answer.alternatives = record.alternatives;
  answer.passed = record.passed;
  answer.holes = record.holes;
  answer.hole_size = record.hole_size;
  answer.keeping = record.keeping;
  answer.path = record.path;
  return answer;
}

TEST(RecordedAnswer, WhatIsToldOfPricesChoicesAndWaysIsWrittenReadAndWrittenAgain) {
  Answer answer;
  answer.outcome = Outcome::solved;
  answer.verified = true;
  answer.length = 7.1;
  answer.price =
      PriceParts{.clearance = 0.1, .areas = 1.0 / 3.0, .turning = 2e-7, .cusps = 3.0, .reverse = 0.7, .error = 1e-4};
  answer.cost = answer.length + answer.price->sum();
  answer.lower_bound = 7.05;
  answer.bound_of = "all";
  answer.goal_index = 2;
  answer.goal_reached = GoalReached{.asked = {9.0, 0.1}, .distance = 0.31, .distance_bound = 0.29};
  answer.order = {2, 0, 1};
  answer.passed = {-3, 1};
  answer.hole_size = 0.3;
  answer.holes = {{1, {{0.1, 0.2}, {0.3, 4.0}}}, {3, {{-1.0, 2.0}, {5.0, 6.5}}}};
  answer.keeping = KeptRoute{.kept = true, .kept_cost = 15.2, .new_cost = 14.9};
  answer.path = {{0.0, 0.0}, {0.1, 7.0}};
  answer.alternatives = {{.cost = 9.0,
                          .length = 8.0,
                          .price = {.clearance = 1.0},
                          .min_clearance = 0.4,
                          .passed = {2},
                          .path = {{0.0, 0.0}, {0.1, 7.0}}},
                         {.cost = 9.5,
                          .length = 8.5,
                          .price = {.areas = 1.0},
                          .min_clearance = 0.25,
                          .passed = {},
                          .path = {{0.0, 0.0}, {3.0, 1.0 / 3.0}, {0.1, 7.0}}}};
  const auto again = [](const Answer& of) {
    return answer_of(read_answer(InputFile::of_bytes("a.json", written(of)), {}));
  };
  EXPECT_EQ(written(again(answer)), written(answer));
  answer.goal_reached->distance_bound.reset();
  answer.keeping = KeptRoute{.kept = false, .kept_cost = {}, .new_cost = 14.9};
  answer.alternatives.clear();
  EXPECT_EQ(written(again(answer)), written(answer));
}

TEST(RecordedAnswer, ListsOfWaysAndHolesThatAreNone) {
  for (const char* text : {R"({"path": [[0,0]], "alternatives": [{"path": [[1, 2, 3]]}]})",
                           R"({"path": [[0,0]], "alternatives": [{"path": [[1e99, 2]]}]})",
                           R"({"path": [[0,0]], "holes": [{"id": 1, "box": [1, 2, 3]}]})",
                           R"({"path": [[0,0]], "holes": [{"id": 1, "box": [1, 2, 3, 4, 5]}]})"}) {
    EXPECT_THROW(read_answer(InputFile::of_bytes("a.json", text), {}), InputError) << text;
  }
  for (const char* text :
       {R"({"path": [[0,0]], "alternatives": {"path": [[1, 2]]}})",
        R"({"path": [[0,0]], "alternatives": 7, "holes": [[3]], "goal_reached": [[1]], "price": [2]})",
        R"({"path": [[0,0]], "alternatives": [[{"price": {"areas": {"areas": 1}}}]]})"}) {
    EXPECT_EQ(read_answer(InputFile::of_bytes("a.json", text), {}).path.size(), 1U) << text;
  }
}

}  // namespace
}  // namespace warren
