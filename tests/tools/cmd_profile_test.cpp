// SPDX-License-Identifier: BSD-3-Clause
// The chain as users see it: `warren profile`, the stages of an answer, the columns of `compare --runs`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/tools/process.hpp"

namespace warren {
namespace {

using test::joined;
using test::run;
using Json = nlohmann::ordered_json;

std::set<std::string> stages_of(const Json& profile) {
  std::set<std::string> names;
  for (const Json& stage : profile["stages"]) names.insert(stage["name"].get<std::string>());
  return names;
}

TEST(Profile, ShowsEachLinkOfTheChainWithItsCount) {
  const std::vector<std::string> maze{"maze:20x20,seed=2", "--sampler", "uniform"};
  const std::vector<std::string> town{test::world_file("town.geojson"), "--start", "1.5,1.5", "--goal", "9.5,8.5"};
  const std::vector<std::string> car{test::world_file("car-20.scene"), "--samples", "200"};
  const std::vector<std::string> arm{test::world_file("puma.scene"), "--samples", "100"};
  for (const auto& world : {maze, town, car, arm}) {
    for (const char* planner : {"prm", "lazy-prm"}) {
      const auto words = joined(world, {"--planner", planner, "--runs", "1", "--threads", "2", "--json", "-"});
      const auto ran = run(joined({"profile"}, words));
      SCOPED_TRACE(world[0] + " " + planner + ran.err);
      ASSERT_LE(ran.code, 1);
      const Json profile = Json::parse(ran.out);
      EXPECT_EQ(profile["schema"], "warren.profile/1");
      const std::set<std::string> names = stages_of(profile);
      for (const char* link : {"sample", "neighbours", "queries", "checks", "rest"}) {
        EXPECT_TRUE(names.contains(link)) << link;
      }
      double sum_s = 0.0;
      for (const Json& stage : profile["stages"]) {
        sum_s += stage["wall_s"].get<double>();
        EXPECT_TRUE(stage["one_thread_s"].is_number());
        if (stage["name"] == "sample") {
          EXPECT_GT(stage["count"], 0);
        }
      }
      EXPECT_NEAR(sum_s, profile["solve"]["wall_s"].get<double>(), 1e-9);
    }
  }
}

TEST(Profile, OfAnyPlannerWithAPicture) {
  const auto ran = run({"profile", "maze:30x30", "--runs", "2", "--picture", "-"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("<svg"), std::string::npos);
  EXPECT_NE(ran.out.find("verified"), std::string::npos);
  EXPECT_EQ(run({"profile", "maze:30x30", "--runs", "0"}).code, 2);
}

/// A run takes half a minute: no machine ends it within the budget.
TEST(Profile, SaysWhatWasAskedWhereTheFirstRunIsCut) {
  // A small world, which is read in time on any machine, and a run that none ends in time.
  const auto ran = run({"profile", "maze:100x100", "--sampler", "uniform", "--planner", "prm", "--samples", "5000000",
                        "--threads", "2", "--budget", "300ms", "--json", "-"});
  const Json profile = Json::parse(ran.out);
  EXPECT_EQ(profile["status"], "stopped");
  EXPECT_EQ(profile["threads"], 2);
  EXPECT_EQ(profile["runs"], 0);
  EXPECT_TRUE(profile["solve"].is_null());
}

TEST(StagesOfAnAnswer, LinksAddUpToThePromisedStages) {
  const auto ran = run({"solve", "maze:40x40,seed=2", "--sampler", "uniform", "--planner", "prm", "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json answer = Json::parse(ran.out);
  const Json& s = answer["stages_s"];
  const auto sum = [&](const char* a, const char* b) { return s[a].get<double>() + s[b].get<double>(); };
  EXPECT_NEAR(sum("queries", "checks"), s["connect"].get<double>(), 1e-9);
  EXPECT_NEAR(sum("rows", "components"), s["graph"].get<double>(), 1e-9);
  EXPECT_NEAR(sum("reduction", "expansion") + s["proof"].get<double>(), s["search"].get<double>(), 1e-9);
  EXPECT_GE(answer["counters"]["pushes"], answer["counters"]["expanded"]);
  EXPECT_GE(answer["counters"]["row_bytes"], 8 * answer["roadmap"]["edges"].get<std::uint64_t>());
}

TEST(StagesOfAnAnswer, LazilyTheyTakeTurnsInTheSearch) {
  const auto ran = run({"solve", "maze:40x40,seed=2", "--sampler", "uniform", "--planner", "lazy-prm", "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json s = Json::parse(ran.out)["stages_s"];
  EXPECT_GT(s["checks"], 0.0);
  EXPECT_NEAR(
      s["queries"].get<double>() + s["checks"].get<double>() + s["expansion"].get<double>() + s["proof"].get<double>(),
      s["search"].get<double>() + s["connect"].get<double>(), 1e-9);
}

TEST(StagesOfAnAnswer, AreColumnsOfEachRunOfAComparison) {
  const auto ran =
      run({"compare", "maze:9x9", "--planners", "prm,lazy-prm", "--sampler", "uniform", "--seeds", "2", "--runs", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string head = ran.out.substr(0, ran.out.find('\n'));
  for (const char* column : {"stage_queries_s", "stage_checks_cpu_s", "stage_rows_s", "stage_expansion_cpu_s"}) {
    EXPECT_NE(head.find(column), std::string::npos) << column;
  }
}

}  // namespace
}  // namespace warren
