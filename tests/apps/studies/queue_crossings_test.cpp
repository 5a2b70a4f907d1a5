// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace warren::studies {
namespace {

SweepCurve curve_of(const std::string& queue, const std::function<double(double)>& seconds) {
  SweepCurve curve{"dijkstra", queue, "warren", {}};
  for (const double size : {10.0, 100.0, 1000.0, 10000.0}) curve.points.push_back({size, seconds(size)});
  return curve;
}

QueueCrossing crossing_with(const std::function<double(double)>& ratio) {
  const auto heap = [](double n) { return 1e-8 * n * std::log(n); };
  const auto crossings =
      queue_crossings({curve_of("heap", heap), curve_of("linear-scan", [&](double n) { return ratio(n) * heap(n); })});
  EXPECT_EQ(crossings.size(), 1U);
  return crossings.at(0);
}

TEST(QueueCrossings, PowerLawsCrossWhereTheyAreEqual) {
  const QueueCrossing c = crossing_with([](double n) { return std::sqrt(n / 250.0); });
  EXPECT_EQ(c.search, "dijkstra");
  EXPECT_EQ(c.array, "linear-scan");
  EXPECT_EQ(c.heap, "heap");
  EXPECT_EQ(c.not_slower_at, 100.0);
  EXPECT_EQ(c.slower_from, 1000.0);
  EXPECT_NEAR(c.crossing.value_or(0.0), 250.0, 1e-6);
  EXPECT_NEAR(c.fitted.value_or(0.0), 250.0, 1e-6);
}

TEST(QueueCrossings, AnArrayThatIsSlowerEverywhereCrossesNowhere) {
  const QueueCrossing c = crossing_with([](double n) { return 2.0 + n; });
  EXPECT_FALSE(c.not_slower_at);
  EXPECT_EQ(c.slower_from, 10.0);
  EXPECT_FALSE(c.crossing);
}

TEST(QueueCrossings, AnArrayThatIsNeverSlowerCrossesNowhere) {
  const QueueCrossing c = crossing_with([](double) { return 0.5; });
  EXPECT_EQ(c.not_slower_at, 10000.0);
  EXPECT_FALSE(c.slower_from);
  EXPECT_FALSE(c.crossing);
  EXPECT_FALSE(c.fitted) << "a level ratio rises through nothing";
}

TEST(QueueCrossings, OfSeveralCrossingsTheLastCounts) {
  const QueueCrossing c = crossing_with([](double n) { return n < 50 ? 1.2 : n < 500 ? 0.9 : 3.0; });
  EXPECT_EQ(c.not_slower_at, 100.0);
  EXPECT_EQ(c.slower_from, 1000.0);
}

TEST(QueueCrossings, ArraysMeetEveryHeapOfTheirSearchAndNoOther) {
  std::vector<SweepCurve> curves;
  for (const char* queue : {"heap", "lazy-heap", "sorted-array", "linear-scan"}) {
    curves.push_back(curve_of(queue, [](double n) { return 1e-9 * n; }));
  }
  SweepCurve other = curve_of("sorted-array", [](double n) { return 1e-9 * n; });
  other.search = "astar";
  curves.push_back(other);
  SweepCurve peer = curve_of("", [](double n) { return 1e-9 * n; });
  peer.library = "boost";
  curves.push_back(peer);
  EXPECT_EQ(queue_crossings(curves).size(), 4U);
}

Contender contender_of(std::size_t problem, const std::string& queue, const std::vector<double>& seconds) {
  Contender c;
  c.problem = problem;
  c.search = "dijkstra";
  c.queue = queue;
  c.library = "warren";
  for (const double s : seconds) {
    ComparedRun run;
    run.outcome = Outcome::solved;
    run.time_s = s;
    c.runs.push_back(run);
  }
  return c;
}

TEST(SweepCurves, APointIsTheGeometricMeanOfTheMediansOfItsGraphs) {
  Comparison comparison;
  comparison.problems = {
      {"geometric:300", "geometric", 300, 0}, {"geometric:300", "geometric", 300, 0}, {"maze:4x4", "prm", 16, 0}};
  comparison.contenders = {contender_of(0, "heap", {1.0, 2.0, 90.0}), contender_of(1, "heap", {8.0}),
                           contender_of(2, "heap", {5.0}), contender_of(0, "lazy-heap", {3.0})};
  comparison.contenders.back().runs.back().outcome = Outcome::stopped;
  const auto curves = sweep_curves(comparison);
  ASSERT_EQ(curves.size(), 1U) << "worlds are no random graphs, and what was cut has no time";
  ASSERT_EQ(curves[0].points.size(), 1U);
  EXPECT_EQ(curves[0].points[0].x, 300.0);
  EXPECT_NEAR(curves[0].points[0].y, 4.0, 1e-12);
}

}  // namespace
}  // namespace warren::studies
