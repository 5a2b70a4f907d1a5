// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/run/execution.hpp"
#include "core/search/search_queues.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "planners/roadmap/build_roadmap.hpp"
#include "tests/core/search/search_graphs.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using test::PlaneGraph;

// The margin keeps rounded heuristics consistent.
constexpr double margin = 1.0 - 1e-12;

SearchResult one_sided(const PlaneGraph& g, VertexId start, VertexId goal) {
  SearchState state;
  IndexedHeap<4> heap;
  state.resize(g.at.size());
  heap.resize(g.at.size());
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : g.graph.neighbours(v)) visit(w, g.length(v, w));
  };
  return best_first(
      start, goal, neighbours, [](VertexId) { return 0.0; }, heap, state, NeverStop());
}

/// How often each side looked at an edge before it wanted it.
struct Looks {
  std::uint64_t forward = 0;
  std::uint64_t backward = 0;
  friend bool operator==(const Looks&, const Looks&) = default;
};

template <class Queue = IndexedHeap<4>>
SearchResult two_sided(const PlaneGraph& g, VertexId start, VertexId goal, unsigned threads, bool use_heuristic = true,
                       Looks* looks = nullptr) {
  const auto counting = [&](std::uint64_t* count) {
    return [&g, count](VertexId v, const auto& visit) {  // as a lazily checked roadmap does
      for (const VertexId w : g.graph.neighbours(v)) {
        if (!visit.wants(w, distance(g.at[v], g.at[w]))) continue;
        if (count != nullptr) ++*count;
        visit(w, g.length(v, w));
      }
    };
  };
  const auto to_goal = [&](VertexId v) { return use_heuristic ? margin * distance(g.at[v], g.at[goal]) : 0.0; };
  const auto to_start = [&](VertexId v) { return use_heuristic ? margin * distance(g.at[v], g.at[start]) : 0.0; };
  const auto ahead = counting(looks != nullptr ? &looks->forward : nullptr);
  const auto back = counting(looks != nullptr ? &looks->backward : nullptr);
  Queue queues[2];
  SearchState states[2];
  SearchSide forward(start, g.at.size(), ahead, to_goal, to_start, queues[0], states[0]);
  SearchSide backward(goal, g.at.size(), back, to_start, to_goal, queues[1], states[1]);
  Execution execution;
  execution.threads = threads;
  return bidirectional(forward, backward, execution);
}

void expect_exact(const PlaneGraph& g, VertexId start, VertexId goal) {
  const SearchResult oracle = one_sided(g, start, goal);
  for (const bool use_heuristic : {true, false}) {
    SCOPED_TRACE(use_heuristic ? "with heuristic" : "without heuristic");
    Looks looks[2];
    const SearchResult one = two_sided(g, start, goal, 1, use_heuristic, &looks[0]);
    ASSERT_EQ(one.status, oracle.status);
    const SearchResult two = two_sided(g, start, goal, 2, use_heuristic, &looks[1]);
    ASSERT_EQ(one.path, two.path);
    ASSERT_EQ(one.length, two.length);
    ASSERT_EQ(one.expanded, two.expanded);
    ASSERT_EQ(looks[0], looks[1]);
    if (oracle.status != SearchStatus::found) continue;
    ASSERT_NEAR(one.length, oracle.length, 1e-9 * oracle.length);
    ASSERT_EQ(one.path.front(), start);
    ASSERT_EQ(one.path.back(), goal);
    double length = 0.0;
    for (std::size_t i = 1; i < one.path.size(); ++i) {
      const auto row = g.graph.neighbours(one.path[i - 1]);
      ASSERT_TRUE(std::binary_search(row.begin(), row.end(), one.path[i]));
      length += g.length(one.path[i - 1], one.path[i]);
    }
    ASSERT_NEAR(length, one.length, 1e-9 * one.length);
  }
}

TEST(Bidirectional, IsAsShortAsDijkstraOnRandomGraphsReachableOrNot) {
  int unreachable = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t n = 10 + 8 * (seed % 60);
    const PlaneGraph g = test::random_graph(seed, n, n + n * (seed % 7) / 4);
    expect_exact(g, 0, static_cast<VertexId>(n - 1));
    unreachable += one_sided(g, 0, static_cast<VertexId>(n - 1)).status == SearchStatus::exhausted ? 1 : 0;
  }
  EXPECT_GT(unreachable, 5);
}

TEST(Bidirectional, IsAsShortAsDijkstraOnMazesWithLoops) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const std::uint32_t side = 8 + static_cast<std::uint32_t>(seed % 30);
    const PlaneGraph g =
        test::random_maze(seed, side, static_cast<double>(seed % 5) / 8.0, seed % 2 == 0, seed % 10 == 0 ? 0.02 : 0.0);
    expect_exact(g, 0, side * side - 1);
    expect_exact(g, side * side / 2, static_cast<VertexId>(seed));
  }
}

TEST(Bidirectional, IsAsShortAsDijkstraWhereBothThreadsRunForManyRounds) {
  for (const std::uint64_t seed : test::seeds(12, 3)) {
    SCOPED_TRACE(seed);
    const std::uint32_t side = 150;
    const PlaneGraph g = seed % 3 == 0 ? test::random_maze(seed, side, 0.0, false)
                                       : test::shaken_lattice(seed, side, seed % 3 == 1 ? 0.8 : 0.6);
    expect_exact(g, side + 1, side * side - side - 2);
  }
}

TEST(Bidirectional, TakesTheSameStepsWithALazyHeap) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneGraph g = test::shaken_lattice(seed, 40, 0.7);
    const SearchResult indexed = two_sided(g, 0, 1599, 1);
    const SearchResult lazy = two_sided<LazyHeap>(g, 0, 1599, 1);
    EXPECT_EQ(indexed.status, lazy.status);
    EXPECT_EQ(indexed.length, lazy.length);
  }
}

TEST(Bidirectional, SettlesFewerVerticesThanOneSideOnAnOpenGraph) {
  const PlaneGraph g = test::shaken_lattice(2, 400, 0.9);
  const VertexId start = 200 * 400 + 100;
  const VertexId goal = 200 * 400 + 300;
  const auto settled_by_one = static_cast<double>(one_sided(g, start, goal).expanded);
  EXPECT_LT(static_cast<double>(two_sided(g, start, goal, 1, false).expanded), 0.75 * settled_by_one);
}

TEST(Bidirectional, OfAStartThatIsTheGoalIsOneVertex) {
  const PlaneGraph g = test::random_maze(1, 10, 0.0, false);
  const SearchResult result = two_sided(g, 7, 7, 2);
  EXPECT_EQ(result.path, (RawVector<VertexId>{7}));
  EXPECT_EQ(result.length, 0.0);
}

TEST(Bidirectional, StopsAtItsDeadlineOnOneThreadAndOnTwo) {
  const PlaneGraph g = test::random_maze(1, 200, 0.0, false);
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : g.graph.neighbours(v)) visit(w, 1.0);
  };
  const auto zero = [](VertexId) { return 0.0; };
  const Deadline over(0.0);
  for (const unsigned threads : {1U, 2U}) {
    IndexedHeap<4> heaps[2];
    SearchState states[2];
    SearchSide forward(0, g.at.size(), neighbours, zero, zero, heaps[0], states[0]);
    SearchSide backward(39'999, g.at.size(), neighbours, zero, zero, heaps[1], states[1]);
    Execution execution;
    execution.threads = threads;
    execution.deadline = &over;
    const SearchResult result = bidirectional(forward, backward, execution);
    EXPECT_EQ(result.status, SearchStatus::stopped);
    EXPECT_LE(result.expanded, 128U);
  }
}

TEST(Bidirectional, AnExceptionOfEitherSideArrivesHere) {
  const PlaneGraph g = test::random_maze(1, 200, 0.0, false);
  const auto zero = [](VertexId) { return 0.0; };
  for (const int failing : {0, 1}) {
    std::uint64_t calls[2] = {0, 0};
    const auto failing_late = [&](int side) {
      return [&g, &calls, side, failing](VertexId v, const auto& visit) {
        if (++calls[side] == 5000 && side == failing) throw std::runtime_error("late");
        for (const VertexId w : g.graph.neighbours(v)) visit(w, 1.0);
      };
    };
    const auto ahead = failing_late(0);
    const auto back = failing_late(1);
    IndexedHeap<4> heaps[2];
    SearchState states[2];
    SearchSide forward(0, g.at.size(), ahead, zero, zero, heaps[0], states[0]);
    SearchSide backward(39'999, g.at.size(), back, zero, zero, heaps[1], states[1]);
    Execution execution;
    execution.threads = 2;
    EXPECT_THROW(bidirectional(forward, backward, execution), std::runtime_error);
  }
}

/// Two searches of a lazy roadmap that found no path once took 20 MB that nobody had asked for.
TEST(SearchStates, AreAskedForBeforeTheyGrow) {
  const Graph alone = assemble_graph(1'000'000, std::vector<Edge>{{0, 1}}, {});
  auto nowhere = [](VertexId, const auto&) {};
  const auto zero = [](VertexId) { return 0.0; };
  const auto no_estimate = [](VertexId, VertexId) { return 0.0; };
  std::size_t beyond = 1 << 20;  // of what is held, to the limit
  const auto end = static_cast<VertexId>(alone.vertex_count() - 1);
  const auto is_refused = [&](const auto& search) {
    give_freed_pages_back();  // of other tests: they are given back before anything is refused
    const Deadline deadline(std::numeric_limits<double>::infinity(), resident_bytes() + beyond);
    Execution execution;
    execution.deadline = &deadline;
    return !memory_holds([&] { search(execution); });
  };
  SearchState state;
  std::array<SearchState, 2> states;
  const auto best = [&](const Execution& execution) {
    search_best_first(QueueKind::heap, alone.vertex_count(), 0, end, nowhere, zero, state, execution);
  };
  EXPECT_TRUE(is_refused(best));
  const auto blind = [&](const Execution& execution) {
    search_blindly(SearchKind::dfs, alone, 0, end, state, execution);
  };
  EXPECT_TRUE(is_refused(blind));
  const auto from_both = [&](const Execution& execution) {
    const ImplicitSearch asked{VertexDistance(no_estimate), true, QueueKind::heap, alone.vertex_count(), execution};
    search_implicit_from_both_ends({AnyNeighbours(nowhere), AnyNeighbours(nowhere)}, {0, end}, asked,
                                   {&states[0], &states[1]});
  };
  EXPECT_TRUE(is_refused(from_both));
  EXPECT_TRUE(is_refused([&](const Execution& execution) { reached_and_reaching(alone, 0, end, execution); }));
  beyond = 28'000'000;
  EXPECT_TRUE(is_refused(best)) << "with all vertices in its heap it holds 32 bytes of each";
  EXPECT_FALSE(is_refused(blind)) << "without a heap at most 24";
  beyond = 50'000'000;
  EXPECT_TRUE(is_refused(from_both)) << "and so do both of its sides";
  state.resize(alone.vertex_count());
  EXPECT_FALSE(is_refused([&](const Execution& execution) {
    search_blindly(SearchKind::bfs, alone, 0, end, state, execution);
  })) << "a state that has the room is not asked for again";
}

}  // namespace
}  // namespace warren
