// SPDX-License-Identifier: BSD-3-Clause
// Random graphs for tests of searches: mazes with loops on a lattice, and graphs without any structure.
#pragma once

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "bench/plain_graph.hpp"
#include "core/base/rng.hpp"
#include "core/search/graph.hpp"

namespace warren::test {

/// A graph in the plane whose edges are at least as long as the distance of their ends.
struct PlaneGraph {
  std::vector<Vec2> at;
  Graph graph;
  double stretch = 1.0;  ///< of every third edge
  double length(VertexId v, VertexId w) const { return distance(at[v], at[w]) * ((v + w) % 3 == 0 ? stretch : 1.0); }
};

/// A spanning tree of a lattice by random choice, plus a share `loops` of the other doors; numbers shuffled or in row
/// order; a share `walled` of the tree's doors is closed, so that some goals can't be reached.
inline PlaneGraph random_maze(std::uint64_t seed, std::uint32_t side, double loops, bool shuffled,
                              double walled = 0.0) {
  SequentialRng rng(seed);
  PlaneGraph maze;
  const std::size_t n = std::size_t{side} * side;
  std::vector<VertexId> number(n);
  std::vector<VertexId> group(n);
  std::iota(number.begin(), number.end(), 0U);
  std::iota(group.begin(), group.end(), 0U);
  for (std::size_t i = n; shuffled && i > 1; --i) std::swap(number[i - 1], number[rng.below(i)]);
  const auto root = [&](VertexId v) {
    while (group[v] != v) v = group[v] = group[group[v]];
    return v;
  };
  std::vector<Edge> doors;
  maze.at.resize(n);
  for (VertexId c = 0; c < n; ++c) {
    maze.at[number[c]] = {static_cast<double>(c % side), static_cast<double>(c / side)};
    if (c % side + 1 < side) doors.push_back({c, c + 1});
    if (c + side < n) doors.push_back({c, c + side});
  }
  for (std::size_t i = doors.size(); i > 1; --i) std::swap(doors[i - 1], doors[rng.below(i)]);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < doors.size(); ++i) {
    const VertexId a = root(doors[i].from);
    const VertexId b = root(doors[i].to);
    group[a] = b;
    if (uniform(seed, i, 5) < (a != b ? 1.0 - walled : loops))
      edges.push_back({number[doors[i].from], number[doors[i].to]});
  }
  maze.graph = bench::plain_graph(n, edges);
  return maze;
}

/// Edges between random vertices; odd seeds stretch, every third seed has its vertices on a coarse grid (many ties).
inline PlaneGraph random_graph(std::uint64_t seed, std::size_t vertices, std::size_t edges) {
  SequentialRng rng(seed);
  PlaneGraph result;
  result.stretch = seed % 2 == 0 ? 1.0 : 1.7;
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto draw = [&](std::uint64_t axis) { return uniform(seed, i, axis); };
    result.at.push_back(seed % 3 == 0 ? Vec2{std::floor(6 * draw(0)), std::floor(6 * draw(1))}
                                      : Vec2{draw(0), draw(1)});
  }
  std::set<Edge> unique;
  for (std::size_t i = 0; i < edges; ++i) {
    const auto a = static_cast<VertexId>(rng.below(vertices));
    const auto b = static_cast<VertexId>(rng.below(vertices));
    if (a != b) unique.insert({std::min(a, b), std::max(a, b)});
  }
  result.graph = bench::plain_graph(vertices, std::vector<Edge>(unique.begin(), unique.end()));
  return result;
}

/// A lattice of side x side with a share of its doors, vertices moved a little: a roadmap-like graph with few ties.
inline PlaneGraph shaken_lattice(std::uint64_t seed, std::uint32_t side, double share) {
  PlaneGraph result = random_maze(seed, side, share, false, 1.0 - share);
  for (std::size_t v = 0; v < result.at.size(); ++v) {
    result.at[v] = result.at[v] + Vec2{0.6 * uniform(seed, v, 7), 0.6 * uniform(seed, v, 8)};
  }
  return result;
}

}  // namespace warren::test
