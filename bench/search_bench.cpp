// SPDX-License-Identifier: BSD-3-Clause
// The four searches on a perfect maze, a maze with loops and a random geometric graph, with vertices in spatial order
// and with random numbers; A* on what peeling and chains leave, the reduction included. Items are vertices settled (of
// the graph, for the reduction). Every length is compared with Dijkstra's once, breadth first with a plain walk by
// levels.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "bench/plain_graph.hpp"
#include "bench/report.hpp"
#include "bench/test_graphs.hpp"
#include "core/search/search.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren::bench {
namespace {

enum GraphOf : int { maze, maze_with_loops, geometric };

/// A graph of about `size` vertices, kept from one benchmark to the next.
struct Case {
  PlaneGraph plane;
  Graph graph;
};
const Case& case_of(std::int64_t kind, std::int64_t size, bool random_numbers) {
  static std::map<std::tuple<std::int64_t, std::int64_t, bool>, Case> kept;
  const auto [at, is_new] = kept.try_emplace({kind, size, random_numbers});
  Case& built = at->second;
  if (is_new) {
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(size)));
    built.plane = kind == geometric ? random_geometric(static_cast<std::size_t>(size), 20.0, random_numbers)
                                    : lattice(side, true, kind == maze ? 0.0 : 0.1, random_numbers);
    built.graph = plain_graph(built.plane.at.size(), built.plane.edges);
    built.plane.edges = {};
  }
  return built;
}

SearchResult best_first_on(const Case& c, bool use_heuristic, IndexedHeap<4>& heap, SearchState& state) {
  const std::vector<Vec2>& at = c.plane.at;
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : c.graph.neighbours(v)) visit(w, distance(at[v], at[w]));
  };
  const auto to_goal = [&](VertexId v) { return use_heuristic ? distance(at[v], at[c.plane.goal]) : 0.0; };
  state.resize(at.size());
  heap.clear();
  return best_first(c.plane.start, c.plane.goal, neighbours, to_goal, heap, state, NeverStop());
}

void check_length(const Case& c, const SearchResult& result) {
  IndexedHeap<4> heap;
  SearchState state;
  heap.resize(c.plane.at.size());
  const double length = best_first_on(c, false, heap, state).length;
  check(std::abs(result.length - length) <= 1e-9 * length, "length of a search");
}

/// Edges of a shortest path without lengths: plain search, level by level.
std::size_t plain_hops(const Case& c) {
  std::vector<bool> seen(c.graph.vertex_count(), false);
  std::vector<VertexId> level{c.plane.start};
  seen[c.plane.start] = true;
  for (std::size_t hops = 0; !level.empty(); ++hops) {
    std::vector<VertexId> next;
    for (const VertexId v : level) {
      if (v == c.plane.goal) return hops;
      for (const VertexId w : c.graph.neighbours(v)) {
        if (!seen[w]) next.push_back(w);
        seen[w] = true;
      }
    }
    level = std::move(next);
  }
  return 0;
}

/// Breadth first gives the fewest edges; depth first some path along edges.
void check_blind(const Case& c, const SearchResult& result, bool breadth) {
  check(!result.path.empty() && result.path.front() == c.plane.start && result.path.back() == c.plane.goal,
        "ends of a blind search");
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const auto row = c.graph.neighbours(result.path[i - 1]);
    check(std::binary_search(row.begin(), row.end(), result.path[i]), "edges of a blind search");
  }
  if (breadth) check(result.path.size() == plain_hops(c) + 1, "breadth_first");
}

constexpr std::size_t state_bytes = sizeof(double) + sizeof(VertexId);  // of a vertex in a SearchState

/// Items are the vertices settled; bytes are held for every vertex.
void report_search(benchmark::State& state, const SearchResult& result, std::size_t bytes, std::size_t vertices) {
  report(state, result.expanded, 0);
  state.counters["bytes/item"] = static_cast<double>(bytes);
  state.counters["settled"] = static_cast<double>(result.expanded) / static_cast<double>(vertices);
}

void bm_best_first(benchmark::State& state) {
  const Case& c = case_of(state.range(1), state.range(2), state.range(3) != 0);
  IndexedHeap<4> heap;
  SearchState search_state;
  heap.resize(c.plane.at.size());
  SearchResult result = best_first_on(c, state.range(0) == 0, heap, search_state);
  if (should_check(state)) check_length(c, result);
  for (auto _ : state) benchmark::DoNotOptimize(result = best_first_on(c, state.range(0) == 0, heap, search_state));
  report_search(state, result, state_bytes + sizeof(VertexId), c.plane.at.size());
}

void bm_blind(benchmark::State& state) {
  const Case& c = case_of(state.range(1), state.range(2), state.range(3) != 0);
  SearchState search_state;
  SearchResult result;
  for (auto _ : state) {
    search_state.resize(c.plane.at.size());
    result = state.range(0) == 2 ? breadth_first(c.graph, c.plane.start, c.plane.goal, search_state)
                                 : depth_first(c.graph, c.plane.start, c.plane.goal, search_state);
    benchmark::DoNotOptimize(result);
  }
  if (should_check(state)) check_blind(c, result, state.range(0) == 2);
  report_search(state, result, state_bytes, c.plane.at.size());
}

void bm_reduced_astar(benchmark::State& state) {
  const Case& c = case_of(state.range(0), state.range(1), false);
  const std::vector<VertexId> keep{c.plane.start, c.plane.goal};
  const std::vector<Vec2>& at = c.plane.at;
  Execution execution;
  execution.threads = static_cast<unsigned>(state.range(2));
  SearchResult result;
  std::size_t bytes = 0;
  for (auto _ : state) {
    const TwiceReducedGraphView reduced(
        c.graph, keep, [&](VertexId v, VertexId w) { return distance(at[v], at[w]); }, execution);
    const Graph& graph = reduced.graph();
    IndexedHeap<4> heap;
    SearchState search_state;
    heap.resize(graph.vertex_count());
    search_state.resize(graph.vertex_count());
    const auto neighbours = [&](VertexId v, const auto& visit) {
      const auto row = graph.neighbours(v);
      const auto lengths = graph.lengths(v);
      for (std::size_t i = 0; i < row.size(); ++i) visit(row[i], lengths[i]);
    };
    const auto to_goal = [&](VertexId v) { return distance(at[reduced.vertex_of(v)], at[c.plane.goal]); };
    result = best_first(reduced.key_of(c.plane.start), reduced.key_of(c.plane.goal), neighbours, to_goal, heap,
                        search_state, NeverStop());
    benchmark::DoNotOptimize(reduced.expand(result.path, execution));
    bytes = graph.bytes() + graph.vertex_count() * state_bytes + at.size() * sizeof(std::uint8_t);
  }
  if (should_check(state)) check_length(c, result);
  report(state, at.size(), bytes);
  state.counters["settled"] = static_cast<double>(result.expanded) / static_cast<double>(at.size());
}

/// Items are the vertices that both sides settle.
void bm_bidirectional(benchmark::State& state) {
  const Case& c = case_of(state.range(0), state.range(1), false);
  const std::vector<Vec2>& at = c.plane.at;
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : c.graph.neighbours(v)) visit(w, distance(at[v], at[w]));
  };
  const auto to_goal = [&](VertexId v) { return distance(at[v], at[c.plane.goal]); };
  const auto to_start = [&](VertexId v) { return distance(at[v], at[c.plane.start]); };
  IndexedHeap<4> heaps[2];
  SearchState states[2];
  Execution execution;
  execution.threads = static_cast<unsigned>(state.range(2));
  SearchResult result;
  for (auto _ : state) {
    SearchSide forward(c.plane.start, at.size(), neighbours, to_goal, to_start, heaps[0], states[0]);
    SearchSide backward(c.plane.goal, at.size(), neighbours, to_start, to_goal, heaps[1], states[1]);
    benchmark::DoNotOptimize(result = bidirectional(forward, backward, execution));
  }
  if (should_check(state)) check_length(c, result);
  report_search(state, result, 2 * (state_bytes + sizeof(VertexId) + 1), at.size());
}

constexpr std::int64_t million = 1'000'000;

BENCHMARK(bm_best_first)
    ->ArgNames({"astar0_dijkstra1", "graph", "vertices", "random_ids"})
    ->ArgsProduct({{0, 1}, {maze, maze_with_loops}, {million}, {0, 1}})
    ->ArgsProduct({{0, 1}, {geometric}, {million / 4}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(bm_blind)
    ->ArgNames({"bfs2_dfs3", "graph", "vertices", "random_ids"})
    ->ArgsProduct({{2, 3}, {maze}, {million}, {0, 1}})
    ->ArgsProduct({{2, 3}, {geometric}, {million / 4}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(bm_reduced_astar)
    ->ArgNames({"graph", "vertices", "threads"})
    ->ArgsProduct({{maze, maze_with_loops}, {million}, {1, 2}})
    ->ArgsProduct({{maze_with_loops}, {4 * million}, {1, 2}})
    ->Args({geometric, million / 4, 2})
    ->Apply(over_threads);

BENCHMARK(bm_bidirectional)
    ->ArgNames({"graph", "vertices", "threads"})
    ->ArgsProduct({{maze, maze_with_loops}, {million}, {1, 2}})
    ->ArgsProduct({{maze_with_loops}, {4 * million}, {1, 2}})
    ->ArgsProduct({{geometric}, {million / 4}, {1, 2}})
    ->Apply(over_threads);

}  // namespace
}  // namespace warren::bench
