// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/world_service.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace warren::serve {
namespace {

Improvement at_turn(std::uint64_t turn) {
  return {.iterations = turn, .seconds = 0.5, .cost = 12.0, .length = 11.0, .by = "tree"};
}

nlohmann::json told(const RunningQuestions& running, const std::string& name, std::uint64_t from = 0) {
  return nlohmann::json::parse(running.told(name, from));
}

TEST(RunningQuestions, TellWhatCameSinceTheLastLook) {
  RunningQuestions running;
  RunningQuestions::Entry entry(running, "mine");
  EXPECT_TRUE(told(running, "mine")["improvements"].empty());
  entry.tell(at_turn(3), {{1, 2}, {3, 4}});
  entry.tell(at_turn(4), {});
  const nlohmann::json all = told(running, "mine");
  ASSERT_EQ(all["improvements"].size(), 2U);
  EXPECT_EQ(all["running"], true);
  EXPECT_EQ(all["first"], 0);
  EXPECT_EQ(all["improvements"][0]["iterations"], 3);
  EXPECT_EQ(all["improvements"][0]["chains"], nlohmann::json::parse("[[[1,2],[3,4]]]"));
  EXPECT_TRUE(all["improvements"][0]["lower_bound"].is_null());
  const nlohmann::json more = told(running, "mine", 1);
  ASSERT_EQ(more["improvements"].size(), 1U);
  EXPECT_EQ(more["first"], 1);
  EXPECT_TRUE(told(running, "mine", 1'000'000)["improvements"].empty());
}

TEST(RunningQuestions, AreForgottenWhenTheyEndAndOneNameIsOnesOwn) {
  RunningQuestions running;
  {
    RunningQuestions::Entry first(running, "mine");
    RunningQuestions::Entry second(running, "mine");
    RunningQuestions::Entry unnamed(running, "");
    EXPECT_TRUE(first.is_seen());
    EXPECT_FALSE(second.is_seen());
    EXPECT_FALSE(unnamed.is_seen());
    second.tell(at_turn(1), {});
    unnamed.tell(at_turn(1), {});
    EXPECT_TRUE(told(running, "mine")["improvements"].empty());
    EXPECT_EQ(told(running, "")["running"], false);
  }
  EXPECT_EQ(told(running, "mine")["running"], false);
}

TEST(RunningQuestions, HoldTheLastAndNoLongWays) {
  RunningQuestions running;
  RunningQuestions::Entry entry(running, "mine");
  const std::size_t count = RunningQuestions::most_told + 5;
  for (std::size_t i = 0; i < count; ++i) entry.tell(at_turn(i), std::vector<Vec2>(RunningQuestions::most_points + 1));
  const nlohmann::json all = told(running, "mine");
  EXPECT_EQ(all["improvements"].size(), RunningQuestions::most_told);
  EXPECT_EQ(all["first"], 5);
  EXPECT_EQ(all["improvements"].back()["iterations"], count - 1);
  EXPECT_EQ(all["improvements"][0]["chains"], nlohmann::json::parse("[[]]"));
}

}  // namespace
}  // namespace warren::serve
