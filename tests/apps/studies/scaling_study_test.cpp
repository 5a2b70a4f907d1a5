// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/scaling_study.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace warren::studies {
namespace {

ScalingRun run_of(std::uint32_t side, unsigned threads, double seconds, std::uint64_t seed = 1) {
  MazeTrial t;
  t.rows = t.cols = side;
  t.seed = seed;
  t.threads = threads;
  t.planner = "prm";
  t.sampler = "lattice";
  t.outcome = Outcome::solved;
  t.verified = true;
  t.solve_s = seconds;
  t.seconds.index = seconds / 2;
  return {t, 0};
}

TEST(CommonExponent, IsTheSlopeOfAPowerLaw) {
  const std::array<std::vector<Vec2>, 1> law{{{{10, 3e-3 * 10}, {100, 3e-3 * 100}, {1e6, 3e-3 * 1e6}}}};
  EXPECT_NEAR(common_exponent(law).value_or(0.0), 1.0, 1e-12);
  std::vector<Vec2> other;
  for (const double x : {2.0, 7.0, 55.0}) other.push_back({x, 4.0 * std::pow(x, 1.37)});
  EXPECT_NEAR(common_exponent(std::array{other}).value_or(0.0), 1.37, 1e-12);
}

TEST(CommonExponent, GroupsHaveLevelsOfTheirOwn) {
  const std::array<std::vector<Vec2>, 2> groups{{{{1, 1}, {10, 10}}, {{100, 1}, {1000, 10}}}};
  EXPECT_NEAR(common_exponent(groups).value_or(0.0), 1.0, 1e-12) << "pooled without levels it would be far less";
}

TEST(CommonExponent, NeedsTwoSizes) {
  EXPECT_FALSE(common_exponent({}));
  EXPECT_FALSE(common_exponent(std::array{std::vector<Vec2>{{5, 1}, {5, 2}}}));
}

TEST(ScalingRows, GiveMinimumMedianSpreadAndSpeedUp) {
  ScalingResult result;
  for (const double seconds : {4.0, 2.0, 3.0}) result.runs.push_back(run_of(100, 1, seconds));
  for (const double seconds : {1.5, 1.0, 1.1}) result.runs.push_back(run_of(100, 2, seconds));
  result.runs.push_back(run_of(200, 1, 8.0));
  ScalingRun failed = run_of(200, 2, 0.001);
  failed.trial.verified = false;
  result.runs.push_back(failed);
  const auto rows = scaling_rows(result);
  ASSERT_EQ(rows.size(), 3U) << "what was not solved is no row";
  EXPECT_EQ(rows[0].runs, 3U);
  EXPECT_DOUBLE_EQ(rows[0].fastest.solve_s, 2.0);
  EXPECT_DOUBLE_EQ(rows[0].median_s, 3.0);
  EXPECT_DOUBLE_EQ(rows[0].spread, 1.0);
  EXPECT_DOUBLE_EQ(rows[0].speed_up, 1.0);
  EXPECT_DOUBLE_EQ(rows[1].speed_up, 2.0);
  EXPECT_DOUBLE_EQ(rows[2].speed_up, 1.0) << "another size is no base";
}

TEST(ScalingRows, SeedsAreDifferentMazesAndNoNoise) {
  ScalingResult result;
  result.runs = {run_of(100, 1, 1.0, 1), run_of(100, 1, 3.0, 2), run_of(100, 1, 1.1, 1), run_of(100, 1, 3.0, 2)};
  EXPECT_NEAR(scaling_rows(result).at(0).spread, 0.1, 1e-12);
}

TEST(StageExponents, TellStagesApartAndLeaveOutWhatIsTooShort) {
  ScalingResult result;
  for (const std::uint32_t side : {100U, 1000U}) {
    ScalingRun run = run_of(side, 1, 1e-7 * side * side);
    run.trial.seconds.verify = 1e-12 * side * side;
    run.trial.seconds.index = 1e-4 * side;
    result.runs.push_back(run);
  }
  std::vector<std::string> names;
  for (const auto& [stage, exponent] : stage_exponents(scaling_rows(result))) {
    names.push_back(stage);
    EXPECT_NEAR(exponent, stage == "index" ? 0.5 : 1.0, 1e-9);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"index", "solve"}));
}

TEST(ScalingPage, AStageHasOneColourInAllPlots) {
  ScalingResult result;
  for (const std::uint32_t side : {100U, 200U}) {
    for (const char* planner : {"prm", "lazy-prm"}) {
      ScalingRun run = run_of(side, 1, side / 100.0);
      run.trial.planner = planner;
      run.trial.seconds.verify = 0.1;
      if (run.trial.planner == "prm") run.trial.seconds.connect = 0.2;  // a stage between the others, of one alone
      result.runs.push_back(run);
    }
  }
  const std::string page = scaling_page(result, "warren scale");
  const auto color_of_verify = [&](const std::string& planner) {
    const std::size_t plot = page.find("<title>Stages of " + planner);
    const std::size_t name = page.find(">verify", plot);
    EXPECT_LT(name, page.find("</svg>", plot));
    const std::size_t line = page.find("stroke=\"#", page.rfind("<path", name));  // marks are hollow or filled
    return page.substr(line, 15);
  };
  EXPECT_EQ(color_of_verify("prm lattice"), color_of_verify("lazy-prm lattice"));
}

}  // namespace
}  // namespace warren::studies
