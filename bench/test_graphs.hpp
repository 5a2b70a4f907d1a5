// SPDX-License-Identifier: BSD-3-Clause
// Graphs that the benchmarks share: a perfect maze over a square lattice, with vertices numbered tile by tile or at
// random, and a random geometric graph. Both from a seed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"
#include "core/search/graph.hpp"

namespace warren::bench {

/// A graph in the plane: positions and edges (from < to, ascending).
struct PlaneGraph {
  std::vector<Vec2> at;
  RawVector<Edge> edges;
  VertexId start = 0;
  VertexId goal = 0;
};

/// Numbers of the cells of a side x side square, 32 x 32 tiles one after the other.
inline std::vector<VertexId> tile_order(std::uint32_t side) {
  std::vector<VertexId> number(std::size_t{side} * side);
  VertexId next = 0;
  for (std::uint32_t ty = 0; ty < side; ty += 32) {
    for (std::uint32_t tx = 0; tx < side; tx += 32) {
      for (std::uint32_t y = ty; y < std::min(side, ty + 32); ++y) {
        for (std::uint32_t x = tx; x < std::min(side, tx + 32); ++x) number[std::size_t{y} * side + x] = next++;
      }
    }
  }
  return number;
}

inline void shuffle(std::vector<VertexId>& numbers, std::uint64_t seed) {
  SequentialRng rng(seed);
  for (std::size_t i = numbers.size(); i > 1; --i) std::swap(numbers[i - 1], numbers[rng.below(i)]);
}

/// Turns pairs of cells into sorted edges of numbered vertices.
inline void number_edges(PlaneGraph& graph, const std::vector<VertexId>& number) {
  std::vector<Vec2> at(graph.at.size());
  for (std::size_t c = 0; c < at.size(); ++c) at[number[c]] = graph.at[c];
  graph.at = std::move(at);
  for (Edge& e : graph.edges) {
    const VertexId a = number[e.from];
    const VertexId b = number[e.to];
    e = {std::min(a, b), std::max(a, b)};
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  graph.start = number[graph.start];
  graph.goal = number[graph.goal];
}

/// The whole lattice (2 edges a cell), or a spanning tree of it by random weights (Kruskal) plus a share of the rest.
inline PlaneGraph lattice(std::uint32_t side, bool as_maze, double loops, bool random_numbers, std::uint64_t seed = 1) {
  PlaneGraph graph;
  const std::size_t n = std::size_t{side} * side;
  graph.at.resize(n);
  std::vector<std::pair<std::uint64_t, Edge>> doors;
  for (VertexId c = 0; c < n; ++c) {
    graph.at[c] = {static_cast<double>(c % side), static_cast<double>(c / side)};
    if (c % side + 1 < side) doors.push_back({random_bits(seed, c, 0), {c, c + 1}});
    if (c + side < n) doors.push_back({random_bits(seed, c, 1), {c, c + side}});
  }
  std::vector<VertexId> parent(n);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](VertexId v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  if (as_maze) std::sort(doors.begin(), doors.end());
  for (const auto& [weight, e] : doors) {
    const VertexId a = root(e.from);
    const VertexId b = root(e.to);
    if (as_maze && a == b && static_cast<double>(weight % 1000) >= 1000 * loops) continue;
    parent[a] = b;
    graph.edges.push_back(e);
  }
  graph.goal = static_cast<VertexId>(n - 1);
  std::vector<VertexId> number = tile_order(side);
  if (random_numbers) shuffle(number, seed);
  number_edges(graph, number);
  return graph;
}

/// n uniform points, joined where closer than a radius that gives about `degree` neighbours; numbered row by row of a
/// bucket grid (spatial order), or at random.
inline PlaneGraph random_geometric(std::size_t n, double degree, bool random_numbers, std::uint64_t seed = 1) {
  PlaneGraph graph;
  const double side = std::sqrt(static_cast<double>(n));
  const double radius = std::sqrt(degree / 3.14159265358979);
  const auto cells = static_cast<std::size_t>(side / radius) + 1;
  std::vector<std::vector<VertexId>> bucket(cells * cells);
  const auto cell = [&](double x) { return std::min(cells - 1, static_cast<std::size_t>(x / radius)); };
  for (VertexId v = 0; v < n; ++v) {
    graph.at.push_back({side * uniform(seed, v, 0), side * uniform(seed, v, 1)});
    bucket[cell(graph.at[v].y) * cells + cell(graph.at[v].x)].push_back(v);
  }
  std::vector<VertexId> number(n);
  VertexId next = 0;
  for (const auto& members : bucket) {
    for (const VertexId v : members) number[v] = next++;
  }
  graph.start = bucket.front().empty() ? 0 : bucket.front().front();
  graph.goal = bucket.back().empty() ? static_cast<VertexId>(n - 1) : bucket.back().front();
  for (VertexId v = 0; v < n; ++v) {
    const std::size_t cx = cell(graph.at[v].x);
    const std::size_t cy = cell(graph.at[v].y);
    for (std::size_t y = cy == 0 ? 0 : cy - 1; y < std::min(cells, cy + 2); ++y) {
      for (std::size_t x = cx == 0 ? 0 : cx - 1; x < std::min(cells, cx + 2); ++x) {
        for (const VertexId w : bucket[y * cells + x]) {
          if (v < w && distance(graph.at[v], graph.at[w]) <= radius) graph.edges.push_back({v, w});
        }
      }
    }
  }
  if (random_numbers) shuffle(number, seed);
  number_edges(graph, number);
  return graph;
}

/// The edges cut into parts as a parallel loop over vertices leaves them.
inline std::vector<RawVector<Edge>> parts_of(const PlaneGraph& graph, std::size_t span = 4096) {
  std::vector<RawVector<Edge>> parts(graph.at.size() / span + 1);
  for (const Edge& e : graph.edges) parts[e.from / span].push_back(e);
  return parts;
}

}  // namespace warren::bench
