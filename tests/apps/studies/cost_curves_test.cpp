// SPDX-License-Identifier: BSD-3-Clause
// Curves of planners that get better with time, of runs that are made up.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/studies/comparison_report.hpp"

namespace warren::studies {
namespace {

using Steps = std::vector<Vec2>;  // seconds, cost

ComparedRun run_with(const Steps& steps, double time_s) {
  ComparedRun run;
  run.time_s = time_s;
  run.outcome = steps.empty() ? Outcome::stopped : Outcome::solved;
  for (const Vec2 s : steps) run.improvements.push_back({.seconds = s.x, .cost = s.y, .length = s.y, .by = "tree"});
  if (run.solved()) run.length = steps.back().y;
  return run;
}

Contender planner(std::string name, const std::vector<Steps>& runs, double time_s) {
  Contender contender;
  contender.planner = std::move(name);
  contender.library = "warren";
  for (const Steps& steps : runs) {
    contender.runs.push_back(run_with(steps, time_s));
    contender.runs.back().seed = contender.runs.size();
  }
  return contender;
}

Comparison compared(std::vector<Contender> contenders) {
  Comparison comparison;
  comparison.problems = {{"town", "", 0, 0}};
  comparison.contenders = std::move(contenders);
  return comparison;
}

/// What a curve says at that moment: its last point until then.
double at(const std::vector<Vec2>& curve, double seconds) {
  double value = -1.0;
  for (const Vec2 p : curve) {
    if (p.x <= seconds) value = p.y;
  }
  return value;
}

TEST(CostCurve, IsTheMedianOfTheBestPathsUntilThen) {
  const Contender c = planner("anytime", {{{0.1, 30}, {0.4, 20}}, {{0.2, 50}, {0.3, 10}}, {{0.1, 40}}}, 1.0);
  const CostCurve curve = cost_curve(c, 0.1, 1.0);
  EXPECT_DOUBLE_EQ(at(curve.median, 0.25), 40.0);
  EXPECT_DOUBLE_EQ(at(curve.median, 0.35), 30.0);
  EXPECT_DOUBLE_EQ(at(curve.median, 1.0), 20.0);
  EXPECT_DOUBLE_EQ(curve.median.back().x, 1.0) << "it holds until the end of the longest run";
  EXPECT_DOUBLE_EQ(curve.quartiles.back().x, 15.0);
  EXPECT_DOUBLE_EQ(curve.quartiles.back().y, 30.0);
}

TEST(CostCurve, ARunWithoutAPathYetCostsInfinitelyMuch) {
  const Contender c = planner("anytime", {{{0.1, 10}}, {{0.2, 20}}, {{0.3, 30}}, {}}, 1.0);
  const CostCurve curve = cost_curve(c, 0.1, 1.0);
  EXPECT_TRUE(std::isinf(at(curve.median, 0.15)));
  EXPECT_TRUE(std::isinf(at(curve.median, 0.25))) << "half of the runs: between 20 and infinity";
  EXPECT_DOUBLE_EQ(at(curve.median, 1.0), 25.0);
  EXPECT_TRUE(std::isinf(curve.quartiles.back().y));
  EXPECT_DOUBLE_EQ(curve.quartiles.back().x, 17.5);
  EXPECT_DOUBLE_EQ(curve.solved.front().y, 0.0);
  EXPECT_DOUBLE_EQ(at(curve.solved, 0.15), 25.0);
  EXPECT_DOUBLE_EQ(at(curve.solved, 0.25), 50.0);
  EXPECT_DOUBLE_EQ(at(curve.solved, 1.0), 75.0);
}

TEST(CostCurve, OfManyPathsSomeHundredMomentsAreToldAndTheLastIsExact) {
  Steps steps;
  for (int i = 1; i <= 100'000; ++i) steps.push_back({1e-5 * i, 100.0 + 1.0 / i});
  const CostCurve curve = cost_curve(planner("anytime", {steps}, 2.0), 1e-5, 2.0);
  EXPECT_LE(curve.median.size(), 1'100U);
  EXPECT_GE(curve.median.size(), 300U);
  EXPECT_DOUBLE_EQ(curve.median.back().y, steps.back().y);
  for (std::size_t i = 1; i < curve.median.size(); ++i) {
    ASSERT_LE(curve.median[i - 1].x, curve.median[i].x);
    ASSERT_GE(curve.median[i - 1].y, curve.median[i].y);
  }
}

TEST(CostCurve, TheBestBoundOfAllIsDrawnElseTheBestPath) {
  Comparison comparison =
      compared({planner("anytime", {{{0.1, 30}, {0.4, 20}}}, 1.0), planner("rrt-connect", {{{0.01, 25}}}, 0.01)});
  EXPECT_NE(curve_panels(comparison)[0].svg().find("best of all: 20<"), std::string::npos);
  comparison.contenders[0].runs[0].lower_bound = 16.0;
  comparison.contenders[1].runs[0].lower_bound = 10.0;
  const std::string text = curve_panels(comparison)[0].svg();
  EXPECT_NE(text.find("lower bound: 16<"), std::string::npos);
  for (const char* name : {">anytime<", ">rrt-connect<"}) EXPECT_NE(text.find(name), std::string::npos) << name;
  comparison.contenders[0].runs[0].lower_bound = 9.0;
  comparison.contenders[1].runs[0].lower_bound = 5.0;
  EXPECT_NE(curve_panels(comparison)[0].svg().find("best of all: 20, bound 9<"), std::string::npos) << "too far below";
  comparison.contenders[0].dealt = {{"clearance", "0.1"}};
  EXPECT_NE(curve_panels(comparison)[0].svg().find("best of all: 20<"), std::string::npos) << "other questions";
}

TEST(CostCurve, WhereNobodyFindsAPathThereArePlotsAllTheSame) {
  for (const Comparison& comparison :
       {compared({planner("anytime", {{}, {}}, 1.0)}), compared({planner("anytime", {}, 1.0)}),
        compared({planner("anytime", {{{0.0, 0.0}}}, 0.0)})}) {
    const std::vector<PlotSheet> panels = curve_panels(comparison);
    ASSERT_EQ(panels.size(), 2U);
    for (const PlotSheet& panel : panels) {
      const std::string text = panel.svg();
      EXPECT_NE(text.find(">anytime<"), std::string::npos);
      EXPECT_EQ(text.find("nan"), std::string::npos) << text;
      EXPECT_EQ(text.find("inf"), std::string::npos) << text;
    }
  }
}

TEST(SolvedShare, WhereNobodyFindsAPathTheAxisReachesFromNoneToAll) {
  for (const char* name : {"anytime", "prm"}) {
    const std::vector<PlotSheet> panels = comparison_panels(compared({planner(name, {{}, {}}, 1.0)}));
    ASSERT_EQ(panels.back().title(), "town: solved");
    EXPECT_NE(panels.back().svg().find(">100<"), std::string::npos) << name;
  }
}

TEST(CostCurve, AsCsvItHasEveryPathAndALineForEachRunWithoutOne) {
  Comparison comparison = compared({planner("anytime", {{{0.1, 30}, {0.4, 20.5}}, {}}, 1.0)});
  comparison.contenders[0].runs[0].lower_bound = 16.0;
  comparison.contenders[0].options = {{"gap", "0.01"}};
  EXPECT_EQ(comparison_curves(comparison),
            "planner,seed,seconds,cost,length,by,lower_bound,options\n"
            "anytime,1,0.1,30,30,tree,16,gap 0.01\n"
            "anytime,1,0.4,20.5,20.5,tree,16,gap 0.01\n"
            "anytime,2,1,,,,,gap 0.01\n");
}

TEST(CostCurve, PlotsOfAComparisonBeginWithItWhereSomebodyGetsBetter) {
  const Comparison one_answer = compared({planner("prm", {{{0.1, 30}}}, 0.1)});
  const Comparison better = compared({planner("rrt-star", {{{0.1, 30}}}, 1.0)});
  EXPECT_EQ(comparison_panels(better).front().title(), "town: cost against time");
  EXPECT_EQ(comparison_panels(one_answer).front().title(), "town: solved");
}

}  // namespace
}  // namespace warren::studies
