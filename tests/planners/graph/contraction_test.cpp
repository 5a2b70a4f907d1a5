// SPDX-License-Identifier: BSD-3-Clause
// The hierarchy of a graph answers as a search of the graph does.
#include "planners/graph/hierarchy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "bench/plain_graph.hpp"
#include "core/base/error.hpp"
#include "core/search/search.hpp"
#include "core/search/search_queues.hpp"
#include "tests/refusals.hpp"

namespace warren {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

Graph with_lengths(std::size_t n, const std::vector<Edge>& edges, const std::vector<double>& lengths) {
  const Graph plain = bench::plain_graph(n, edges);
  RawVector<double> all;
  for (VertexId v = 0; v < n; ++v) {
    for (const VertexId w : plain.neighbours(v)) {
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& e = edges[i];
        if (Edge{v, w} == e || Edge{w, v} == e) all.push_back(lengths[i]);
      }
    }
  }
  return {{plain.offsets().begin(), plain.offsets().end()}, {plain.targets().begin(), plain.targets().end()}, all};
}

/// Places in corridors of a comb whose teeth are joined here and there, or anywhere in a square.
Graph random_graph(unsigned seed, bool open) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  constexpr std::size_t n = 400;
  std::vector<Vec2> places(n);
  for (Vec2& p : places) p = {20.0 * unit(), open ? 20.0 * unit() : 3.0 * std::floor(6.0 * unit()) + 0.5 * unit()};
  std::vector<Edge> edges;
  std::vector<double> lengths;
  for (VertexId v = 0; v < n; ++v) {
    for (VertexId w = v + 1; w < n; ++w) {
      const bool crosses = std::floor(places[v].y / 3.0) != std::floor(places[w].y / 3.0);
      const double d = distance(places[v], places[w]);
      if (d > (crosses && !open ? 3.2 : 1.7) || (crosses && !open && random() % 4 != 0)) continue;
      edges.push_back({v, w});
      lengths.push_back(seed % 3 == 0 ? std::floor(4.0 * d) : d);  // ties and zeros, too
    }
  }
  return with_lengths(n, edges, lengths);
}

Hierarchy whole_hierarchy(const Graph& graph, const Execution& execution = {}) {
  ContractionRounds rounds(graph, execution);
  while (rounds.left().size() > 0) rounds.next_round();
  return rounds.hierarchy();
}

double length_of_edge(const Graph& graph, VertexId v, VertexId w) {
  const auto row = graph.neighbours(v);
  const auto found = std::find(row.begin(), row.end(), w);
  return found == row.end() ? nowhere : graph.lengths(v)[static_cast<std::size_t>(found - row.begin())];
}

SearchResult searched(const Graph& graph, VertexId from, VertexId to) {
  SearchState state;
  IndexedHeap<> queue;
  state.resize(graph.vertex_count());
  queue.resize(graph.vertex_count());
  const auto next = [&](VertexId v, const auto& visit) {
    const auto row = graph.neighbours(v);
    for (std::size_t i = 0; i < row.size(); ++i) visit(row[i], graph.lengths(v)[i]);
  };
  return best_first(
      from, to, next, [](VertexId) { return 0.0; }, queue, state, NeverStop{});
}

TEST(Contraction, WaysAreThoseOfASearch) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    const Graph graph = random_graph(seed, seed % 2 == 0);
    const Hierarchy hierarchy = whole_hierarchy(graph);
    check_hierarchy(hierarchy, graph.vertex_count(), "test", {});
    HierarchyScratch scratch;
    const Execution execution;
    HierarchyQuery query(hierarchy, scratch, execution);
    std::mt19937 random(seed);
    for (int i = 0; i < 40; ++i) {
      const HierarchyEnd start{static_cast<VertexId>(random() % graph.vertex_count()), 0.0};
      const HierarchyEnd goal{static_cast<VertexId>(random() % graph.vertex_count()), 0.0};
      const SearchResult expected = searched(graph, start.vertex, goal.vertex);
      ASSERT_EQ(query.search({&start, 1}, {&goal, 1}, nowhere), !expected.path.empty());
      if (expected.path.empty()) continue;
      const RawVector<VertexId> path = query.path();
      double length = 0.0;
      for (std::size_t k = 0; k + 1 < path.size(); ++k) length += length_of_edge(graph, path[k], path[k + 1]);
      EXPECT_EQ(path.front(), start.vertex);
      EXPECT_EQ(path.back(), goal.vertex);
      EXPECT_NEAR(length, expected.length, 1e-12 * expected.length);
      if (seed % 3 != 0) {
        EXPECT_EQ(path, expected.path);  // no two ways are as long
      }
    }
  }
}

TEST(Contraction, EndsBringTheirOwnLengthsAndALimit) {
  const Graph graph = with_lengths(4, {{0, 1}, {1, 2}, {2, 3}}, {1.0, 1.0, 1.0});
  const Hierarchy hierarchy = whole_hierarchy(graph);
  HierarchyScratch scratch;
  const Execution execution;
  HierarchyQuery query(hierarchy, scratch, execution);
  const std::vector<HierarchyEnd> start{{0, 0.5}, {1, 2.0}};
  const std::vector<HierarchyEnd> goal{{3, 0.25}, {2, 1.0}};
  EXPECT_FALSE(query.search(start, goal, 3.5));
  ASSERT_TRUE(query.search(start, goal, 3.6));
  EXPECT_EQ(query.path(), (RawVector<VertexId>{0, 1, 2}));  // 0.5 + 1 + 1 + 1
  EXPECT_FALSE(query.search(start, {}, nowhere));
}

TEST(Contraction, IsTheSameForAnyNumberOfThreads) {
  const Graph graph = random_graph(5, true);
  const Hierarchy one = whole_hierarchy(graph, {.threads = 1});
  for (const unsigned threads : {2U, 3U, 8U}) {
    const Hierarchy other = whole_hierarchy(graph, {.threads = threads});
    EXPECT_EQ(one.first, other.first);
    EXPECT_EQ(one.arcs, other.arcs);
  }
}

/// side x side places, a little off a grid, joined with all within a distance of 1.6; `walled`: rows of places are
/// joined at every tenth column alone.
Graph carpet(std::size_t side, bool walled) {
  std::mt19937 random(3);
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < side * side; ++i) {
    places.push_back({static_cast<double>(i % side) + 1e-9 * static_cast<double>(random()),
                      static_cast<double>(i / side) + 1e-9 * static_cast<double>(random())});
  }
  RawVector<EdgeEnd> offsets{0};
  RawVector<VertexId> targets;
  RawVector<double> lengths;
  for (std::size_t v = 0; v < places.size(); ++v) {
    for (std::size_t row = v / side - std::min<std::size_t>(1, v / side); row <= std::min(v / side + 1, side - 1);
         ++row) {
      if (walled && row != v / side && v % side % 10 != 0) continue;
      for (std::size_t col = v % side - std::min<std::size_t>(2, v % side); col <= std::min(v % side + 2, side - 1);
           ++col) {
        const std::size_t w = row * side + col;
        if (w == v || (walled && row != v / side && col != v % side)) continue;
        targets.push_back(static_cast<VertexId>(w));
        lengths.push_back(distance(places[v], places[w]));
      }
    }
    offsets.push_back(static_cast<EdgeEnd>(targets.size()));
  }
  return {std::move(offsets), std::move(targets), std::move(lengths)};
}

TEST(Contraction, OpenSpaceIsRefusedByCounting) {
  EXPECT_FALSE(contract(carpet(100, false), {}).has_value());
  EXPECT_TRUE(contract(carpet(100, true), {}).has_value());
}

TEST(Contraction, StopsAtTheDeadline) {
  const Deadline past(0.0);
  Execution execution;
  execution.deadline = &past;
  EXPECT_THROW(contract(carpet(100, true), execution), Stopped);
}

template <class Change>
std::string refusal(const Hierarchy& good, const Change& change) {
  Hierarchy bad = good;
  change(bad);
  return test::refusal<InputError>([&] { check_hierarchy(bad, good.vertex_count(), "test", {}); });
}

TEST(Contraction, NumbersThatLeadNowhereAreRefused) {
  const Hierarchy good = whole_hierarchy(random_graph(1, false));
  const std::size_t arcs = good.arcs.size();
  const std::size_t shortcut = static_cast<std::size_t>(
      std::find_if(good.arcs.begin(), good.arcs.end(), [](const HierarchyArc& a) { return a.middle != no_vertex; }) -
      good.arcs.begin());
  ASSERT_LT(shortcut, arcs);
  EXPECT_EQ(refusal(good, [](Hierarchy&) {}), "");
  const auto names = [&](const char* array, const auto& change) {
    EXPECT_NE(refusal(good, change).find(array), std::string::npos) << array;
  };
  names("up.first", [](Hierarchy& h) { h.first.pop_back(); });
  names("up.first", [](Hierarchy& h) { h.first[0] = 1; });
  names("up.first", [&](Hierarchy& h) { h.first[7] = static_cast<EdgeEnd>(arcs + 1); });
  names("up.first", [](Hierarchy& h) { h.arcs.pop_back(); });
  names("up.to", [](Hierarchy& h) { h.arcs[0].to = static_cast<VertexId>(h.vertex_count()); });
  names("up.length", [](Hierarchy& h) { h.arcs[3].length = -0.0; });
  names("up.length", [](Hierarchy& h) { h.arcs[3].length = std::nan(""); });
  names("up.middle", [&](Hierarchy& h) { h.arcs[shortcut].middle = h.arcs[shortcut].to; });
  names("up.middle", [&](Hierarchy& h) { h.arcs[shortcut].middle = static_cast<VertexId>(h.vertex_count()); });
}

/// Three vertices, each of whose arcs is said to lead over the third: what the check lets pass ends nevertheless.
TEST(Contraction, ShortcutsThatGoRoundForEverEnd) {
  Hierarchy ring;
  ring.first = {0, 2, 4, 6};
  ring.arcs = {{1, 2, 1.0}, {2, 1, 1.0}, {0, 2, 1.0}, {2, 0, 1.0}, {0, 1, 1.0}, {1, 0, 1.0}};
  check_hierarchy(ring, 3, "test", {});
  HierarchyScratch scratch;
  const Execution execution;
  HierarchyQuery query(ring, scratch, execution);
  const HierarchyEnd start{0, 0.0};
  const HierarchyEnd goal{1, 0.0};
  ASSERT_TRUE(query.search({&start, 1}, {&goal, 1}, nowhere));
  EXPECT_THROW(query.path(), InputError);
}

}  // namespace
}  // namespace warren
