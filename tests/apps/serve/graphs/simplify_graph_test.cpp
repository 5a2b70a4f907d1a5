// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/graphs/route_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"

namespace warren::serve {
namespace {

void lead(RouteGraph& graph, std::uint32_t from, std::uint32_t to, bool back = true) {
  graph.edges.push_back({.id = static_cast<std::uint32_t>(1000 + graph.edges.size()), .from = from, .to = to});
  if (back) lead(graph, to, from, false);
}

/// Nodes 6 cm apart from one end of a bent way to the other.
RouteGraph bent(std::uint32_t count, bool back = true) {
  RouteGraph graph;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double s = 0.06 * i;
    graph.nodes.push_back({.id = i, .at = s < 9.0 ? Vec2{s, 0.01 * std::sin(9.0 * s)} : Vec2{9.0, s - 9.0}});
    if (i > 0) lead(graph, i - 1, i, back);
  }
  return graph;
}

const RouteNode& node(const RouteGraph& graph, std::uint32_t id) {
  return *std::find_if(graph.nodes.begin(), graph.nodes.end(), [&](const RouteNode& n) { return n.id == id; });
}

TEST(SimplifiedGraph, ALongChainBecomesFewEdges) {
  const RouteGraph graph = bent(325);
  const RouteGraph few = simplified(graph, 0.05, {}, {});
  EXPECT_LE(few.nodes.size(), 5U);
  EXPECT_GE(few.nodes.size(), 3U) << "it is bent";
  EXPECT_EQ(few.edges.size(), 2 * (few.nodes.size() - 1));
  EXPECT_EQ(few.nodes.front().id, 0U);
  EXPECT_EQ(few.nodes.back().id, 324U);
  EXPECT_NO_THROW(ends_of(few));
  for (const RouteEdge& edge : few.edges) EXPECT_FALSE(edge.cost) << "it was the length, so it is the edge's own";
  EXPECT_EQ(simplified(bent(325, false), 0.05, {}, {}).edges.size(), few.nodes.size() - 1) << "one way stays one way";
}

TEST(SimplifiedGraph, WhatPeopleWroteStays) {
  RouteGraph graph = bent(30);
  graph.nodes[7].more = R"({"metadata":{"lamps":3}})";
  graph.nodes[9].theta = 0.5;
  graph.edges[2 * 14].more = R"({"operations":[]})";  // 14 -> 15
  const RouteGraph few = simplified(graph, 1.0, {}, {});
  for (const std::uint32_t id : {0U, 7U, 9U, 14U, 15U, 29U}) EXPECT_EQ(node(few, id).id, id);
  EXPECT_EQ(few.nodes.size(), 6U);
}

TEST(SimplifiedGraph, CostsAddUpInEachDirection) {
  RouteGraph graph = bent(10);
  double there = 0.0;
  for (std::size_t e = 0; e < graph.edges.size(); e += 2) {
    graph.edges[e].cost = 1.0 + 0.25 * static_cast<double>(e);
    there += *graph.edges[e].cost;
  }
  const RouteGraph few = simplified(graph, 1.0, {}, {});
  ASSERT_EQ(few.edges.size(), 2U);
  EXPECT_DOUBLE_EQ(few.edges[0].cost.value_or(0.0), there);
  EXPECT_FALSE(few.edges[1].cost);
}

TEST(SimplifiedGraph, NoEdgeLeadsWhereItMayNot) {
  const auto may = [](Vec2 a, Vec2 b) { return distance(a, b) <= 1.0; };
  const RouteGraph few = simplified(bent(325), 0.05, may, {});
  for (const RouteEdge& edge : few.edges) EXPECT_LE(distance(node(few, edge.from).at, node(few, edge.to).at), 1.0);
  EXPECT_GE(few.nodes.size(), 20U);
}

TEST(SimplifiedGraph, RoundsAndTwoWaysBetweenTheSameNodesStayApart) {
  RouteGraph ring;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const double turn = 0.05 * 3.141592653589793 * i;
    ring.nodes.push_back({.id = i, .at = {std::cos(turn), std::sin(turn)}});
  }
  for (std::uint32_t i = 0; i < 40; ++i) lead(ring, i, (i + 1) % 40);
  const RouteGraph few = simplified(ring, 10.0, {}, {});
  EXPECT_GE(few.nodes.size(), 3U);
  EXPECT_LE(few.nodes.size(), 4U);
  EXPECT_EQ(few.edges.size(), 2 * few.nodes.size());
  for (const RouteEdge& edge : few.edges) EXPECT_NE(edge.from, edge.to);
}

/// The least cost from each node to each other, by trying.
std::map<std::pair<std::uint32_t, std::uint32_t>, double> costs_of(const RouteGraph& graph) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> costs;
  const auto at = [&](std::uint32_t a, std::uint32_t b) -> double& {
    return costs.try_emplace({a, b}, a == b ? 0.0 : std::numeric_limits<double>::infinity()).first->second;
  };
  for (const RouteEdge& e : graph.edges) at(e.from, e.to) = std::min(at(e.from, e.to), e.cost.value_or(1e9));
  for (const RouteNode& k : graph.nodes) {
    for (const RouteNode& i : graph.nodes) {
      for (const RouteNode& j : graph.nodes) at(i.id, j.id) = std::min(at(i.id, j.id), at(i.id, k.id) + at(k.id, j.id));
    }
  }
  return costs;
}

TEST(SimplifiedGraph, CostsBetweenNodesThatStayAreAsBefore) {
  for (const std::uint64_t seed : test::seeds(200, 10)) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    RouteGraph graph;
    for (std::uint32_t i = 0; i < 16; ++i)
      graph.nodes.push_back(
          {.id = i, .at = {0.01 * static_cast<double>(rng.below(100)), 0.01 * static_cast<double>(rng.below(100))}});
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> known;
    for (int n = 0; n < 18; ++n) {
      const auto a = static_cast<std::uint32_t>(rng.below(16));
      const auto b = static_cast<std::uint32_t>(rng.below(16));
      if (a == b || known[{a, b}]) continue;
      for (const auto& [from, to] : {std::pair{a, b}, {b, a}}) {
        if (known[{from, to}] || (from == b && rng.below(3) == 0)) continue;
        known[{from, to}] = true;
        lead(graph, from, to, false);
        graph.edges.back().cost = 1.0 + static_cast<double>(rng.below(64)) / 16.0;  // sums without rounding
      }
    }
    if (graph.edges.empty()) continue;
    const RouteGraph few = simplified(graph, 0.5, {}, {});
    const auto before = costs_of(graph);
    for (const auto& [ends, cost] : costs_of(few)) EXPECT_EQ(cost, before.at(ends));
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> times;
    for (const RouteEdge& edge : few.edges) EXPECT_EQ((++times[std::pair{edge.from, edge.to}]), 1);
  }
}

}  // namespace
}  // namespace warren::serve
