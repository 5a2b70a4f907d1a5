// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/search_contest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace warren::studies {
namespace {

constexpr QueuePolicy all_queues[] = {QueuePolicy::heap, QueuePolicy::lazy_heap, QueuePolicy::sorted_array,
                                      QueuePolicy::resorted_array, QueuePolicy::linear_scan};

std::vector<SearchVariant> all_variants() {
  std::vector<SearchVariant> variants{{SearchKind::bfs}, {SearchKind::dfs}};
  for (const QueuePolicy queue : all_queues) {
    variants.push_back({SearchKind::dijkstra, queue});
    variants.push_back({SearchKind::astar, queue});
  }
  for (const SearchKind search : {SearchKind::bfs, SearchKind::dfs, SearchKind::dijkstra, SearchKind::astar}) {
    variants.push_back({search, std::nullopt, SearchLibrary::boost});
  }
  return variants;
}

/// Shortest lengths from the start by relaxing every edge until nothing changes (Bellman 1958).
std::vector<double> relaxed_lengths(const SearchGraph& g) {
  std::vector<double> length(g.at.size(), std::numeric_limits<double>::infinity());
  length[g.start] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (VertexId v = 0; v < g.at.size(); ++v) {
      for (const VertexId w : g.graph.neighbours(v)) {
        const double through = length[v] + distance(g.at[v], g.at[w]);
        if (through >= length[w]) continue;
        length[w] = through;
        changed = true;
      }
    }
  }
  return length;
}

/// Fewest edges from the start, level by level.
std::size_t fewest_hops(const SearchGraph& g) {
  std::set<VertexId> reached{g.start};
  for (std::size_t hops = 0;; ++hops) {
    if (reached.contains(g.goal)) return hops;
    std::set<VertexId> next = reached;
    for (const VertexId v : reached) {
      for (const VertexId w : g.graph.neighbours(v)) next.insert(w);
    }
    reached = std::move(next);
  }
}

TEST(GeometricGraph, JoinsExactlyThePairsWithinTheRadius) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const double degree = 6.0;
    const SearchGraph g = geometric_graph(150, degree, seed, {});
    ASSERT_EQ(g.at.size(), 150U);
    for (VertexId v = 0; v < g.at.size(); ++v) {
      const auto row = g.graph.neighbours(v);
      for (VertexId w = 0; w < g.at.size(); ++w) {
        const double apart = std::hypot(g.at[v].x - g.at[w].x, g.at[v].y - g.at[w].y);
        const bool joined = std::binary_search(row.begin(), row.end(), w);
        const double radius = std::sqrt(degree / 3.14159265358979323846);
        if (std::abs(apart - radius) > 1e-9) {
          EXPECT_EQ(joined, v != w && apart < radius);
        }
      }
    }
  }
}

TEST(GeometricGraph, StartAndGoalAreJoinedAndInOppositeCorners) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const SearchGraph g = geometric_graph(400, 12.0, seed, {});
    EXPECT_TRUE(std::isfinite(relaxed_lengths(g)[g.goal]));
    EXPECT_LT(g.at[g.start].x + g.at[g.start].y, 10.0);
    EXPECT_GT(g.at[g.goal].x + g.at[g.goal].y, 30.0);
  }
}

TEST(GraphSearch, EveryVariantFindsWhatTheOraclesSay) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const SearchGraph g = geometric_graph(120, 8.0, seed, {});
    const double shortest = relaxed_lengths(g)[g.goal];
    for (const SearchVariant& v : all_variants()) {
      SCOPED_TRACE(static_cast<int>(v.search));
      const auto search = graph_search(g, v);
      for (int again = 0; again < 2; ++again) {  // the second run finds the memory of the first
        const SearchResult result = search({});
        ASSERT_EQ(result.status, SearchStatus::found);
        EXPECT_EQ(result.path.front(), g.start);
        EXPECT_EQ(result.path.back(), g.goal);
        const double length = path_length(g, result.path);
        if (has_queue(v.search)) {
          EXPECT_NEAR(length, shortest, 1e-9);
          EXPECT_NEAR(result.length, shortest, 1e-9);
        }
        EXPECT_GE(length, shortest - 1e-9);
        if (v.search == SearchKind::bfs) {
          EXPECT_EQ(result.path.size() - 1, fewest_hops(g));
        }
      }
    }
  }
}

TEST(GraphSearch, APeerSettlesWhatBreadthAndDepthFirstSettle) {
  const SearchGraph g = geometric_graph(500, 10.0, 3, {});
  for (const SearchKind kind : {SearchKind::bfs, SearchKind::dfs}) {
    const SearchResult ours = graph_search(g, {kind})({});
    const SearchResult theirs = graph_search(g, {kind, std::nullopt, SearchLibrary::boost})({});
    EXPECT_EQ(ours.path, theirs.path);
    EXPECT_EQ(ours.expanded, theirs.expanded);
  }
}

/// Two parts that nothing joins.
SearchGraph parted_graph() {
  SearchGraph g = geometric_graph(2, 1e-9, 1, {});
  g.start = 0;
  g.goal = 1;
  return g;
}

TEST(GraphSearch, WithoutAPathEveryVariantSaysSo) {
  const SearchGraph g = parted_graph();
  ASSERT_EQ(g.graph.edge_count(), 0U);
  for (const SearchVariant& v : all_variants()) EXPECT_EQ(graph_search(g, v)({}).status, SearchStatus::exhausted);
}

TEST(SearchContest, EveryVariantIsTimedAsOftenAsAsked) {
  const SearchGraph g = geometric_graph(60, 10.0, 1, {});
  Comparison comparison;
  run_search_contest(g, {.variants = all_variants(), .trials = 7}, {}, comparison);
  ASSERT_EQ(comparison.problems.size(), 1U);
  EXPECT_EQ(comparison.problems[0].vertices, 60U);
  ASSERT_EQ(comparison.contenders.size(), all_variants().size());
  for (const Contender& c : comparison.contenders) {
    EXPECT_EQ(c.runs.size(), 7U);
    for (const ComparedRun& run : c.runs) {
      EXPECT_TRUE(run.solved());
      EXPECT_GE(run.time_s, 0.0);
      EXPECT_EQ(run.length, c.runs.front().length);
    }
  }
}

TEST(SearchContest, AutoTrialsLieBetweenFiveAndTenThousand) {
  const SearchGraph g = geometric_graph(30, 10.0, 1, {});
  Comparison comparison;
  run_search_contest(g, {.variants = {{SearchKind::bfs}}}, {}, comparison);
  EXPECT_GE(comparison.contenders[0].runs.size(), 5U);
  EXPECT_LE(comparison.contenders[0].runs.size(), 10'000U);
}

TEST(SearchContest, ASearchBeyondItsBudgetIsMeasuredNoFurther) {
  const SearchGraph g = geometric_graph(3000, 10.0, 1, {});
  Comparison comparison;
  run_search_contest(g, {.variants = {{SearchKind::dijkstra, QueuePolicy::heap}}, .trials = 50, .budget_s = 1e-9}, {},
                     comparison);
  ASSERT_EQ(comparison.contenders[0].runs.size(), 1U);
  EXPECT_EQ(comparison.contenders[0].runs[0].outcome, Outcome::stopped);
  EXPECT_EQ(comparison.notes.size(), 1U);
}

TEST(SearchContest, ASignalThatCameEndsItWithStopped) {
  const SearchGraph g = geometric_graph(60, 10.0, 1, {});
  SignalFlag flag{2};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &flag);
  Execution execution;
  execution.deadline = &deadline;
  Comparison comparison;
  EXPECT_THROW(run_search_contest(g, {.variants = all_variants()}, execution, comparison), Stopped);
}

TEST(Contradictions, AreFound) {
  const SearchClaim best{{SearchKind::dijkstra, QueuePolicy::heap}, true, 10.0, 4, 50};
  const auto with = [&](SearchClaim other) {
    const SearchClaim both[] = {best, other};
    return contradiction_in(both).has_value();
  };
  EXPECT_FALSE(with({{SearchKind::astar, QueuePolicy::heap}, true, 10.0 + 1e-12, 4, 20}));
  EXPECT_TRUE(with({{SearchKind::astar, QueuePolicy::heap}, true, 10.1, 4, 20})) << "longer";
  EXPECT_TRUE(with({{SearchKind::astar, QueuePolicy::heap}, true, 10.0, 4, 51})) << "settles more than Dijkstra";
  EXPECT_TRUE(with({{SearchKind::astar, QueuePolicy::heap}, false, 0.0, 0, 20})) << "finds nothing";
  EXPECT_TRUE(with({{SearchKind::dijkstra, QueuePolicy::linear_scan}, true, 10.0, 4, 49})) << "a queue settles less";
  EXPECT_TRUE(with({{SearchKind::dijkstra, QueuePolicy::linear_scan}, true, 10.0 + 1e-12, 4, 50}))
      << "a queue changes bits";
  EXPECT_FALSE(with({{SearchKind::bfs}, true, 12.0, 3, 50}));
  EXPECT_TRUE(with({{SearchKind::bfs}, true, 9.9, 3, 50})) << "shorter than the shortest";
  EXPECT_TRUE(with({{SearchKind::bfs}, true, 12.0, 5, 50})) << "not the fewest hops";
  EXPECT_FALSE(with({{SearchKind::dfs}, true, 30.0, 15, 50}));
  EXPECT_FALSE(with({{SearchKind::dijkstra, std::nullopt, SearchLibrary::boost}, true, 10.0 + 1e-12, 5, 49}));
  EXPECT_TRUE(with({{SearchKind::dijkstra, std::nullopt, SearchLibrary::boost}, true, 10.1, 4, 50}));
}

TEST(Turns, AreARearrangementThatChangesFromRoundToRound) {
  std::set<std::vector<std::size_t>> orders;
  for (std::uint64_t round = 0; round < 50; ++round) {
    std::vector<std::size_t> order = turns(6, round);
    EXPECT_EQ(order, turns(6, round));
    orders.insert(order);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
  }
  EXPECT_GT(orders.size(), 40U);
}

}  // namespace
}  // namespace warren::studies
