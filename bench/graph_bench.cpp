// SPDX-License-Identifier: BSD-3-Clause
// CSR assembly and components: serial oracle beside the parallel version, on the full lattice (2 edges a vertex), in
// tile order and with random numbers, and on a random geometric graph (13 edges a vertex).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <tuple>

#include "bench/plain_graph.hpp"
#include "bench/report.hpp"
#include "bench/test_graphs.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren::bench {
namespace {

enum GraphKind : int { tiled, shuffled_grid, random_places };

const PlaneGraph& graph_of(int kind, int side) {
  static PlaneGraph graph;
  static std::pair<int, int> built{-1, -1};
  if (built != std::pair{kind, side}) {
    graph = kind == random_places
                ? random_geometric(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 26.0, false)
                : lattice(static_cast<std::uint32_t>(side), false, 0.0, kind == shuffled_grid);
    built = {kind, side};
  }
  return graph;
}

void bm_from_edges(benchmark::State& state) {
  const PlaneGraph& graph = graph_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(plain_graph(graph.at.size(), graph.edges));
  report(state, graph.at.size(), plain_graph(graph.at.size(), graph.edges).bytes());
}

void bm_assemble(benchmark::State& state) {
  const PlaneGraph& graph = graph_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const auto parts = parts_of(graph);
  Execution execution;
  execution.threads = static_cast<unsigned>(state.range(2));
  const Graph built = assemble_graph(graph.at.size(), parts, execution);
  if (should_check(state)) {
    const Graph plain = plain_graph(graph.at.size(), graph.edges);
    for (VertexId v = 0; v < graph.at.size(); ++v)
      check(std::ranges::equal(plain.neighbours(v), built.neighbours(v)), "assemble_graph");
  }
  for (auto _ : state) benchmark::DoNotOptimize(assemble_graph(graph.at.size(), parts, execution));
  report(state, graph.at.size(), built.bytes());
}

void bm_components_serial(benchmark::State& state) {
  const PlaneGraph& graph = graph_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Graph rows = plain_graph(graph.at.size(), graph.edges);
  for (auto _ : state) benchmark::DoNotOptimize(plain_components(rows));
  report(state, graph.at.size(), graph.at.size() * sizeof(VertexId));
}

void bm_components(benchmark::State& state) {
  const PlaneGraph& graph = graph_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Graph rows = plain_graph(graph.at.size(), graph.edges);
  Execution execution;
  execution.threads = static_cast<unsigned>(state.range(2));
  if (should_check(state)) check(components(rows, execution).label == plain_components(rows).label, "components");
  for (auto _ : state) benchmark::DoNotOptimize(components(rows, execution));
  report(state, graph.at.size(), graph.at.size() * sizeof(VertexId));
}

/// The maze that was asked for last.
const PlaneGraph& maze_of(bool random_numbers, std::int64_t side, std::int64_t loops_per_cent) {
  static PlaneGraph graph;
  static std::tuple<bool, std::int64_t, std::int64_t> built{false, 0, 0};
  if (built != std::tuple{random_numbers, side, loops_per_cent}) {
    graph =
        lattice(static_cast<std::uint32_t>(side), true, static_cast<double>(loops_per_cent) / 100.0, random_numbers);
    built = {random_numbers, side, loops_per_cent};
  }
  return graph;
}

/// Peels vertex by vertex: what is left with another degree than 2, and what is kept, must be the keys.
void check_keys(const Graph& graph, const std::vector<VertexId>& keep, const ReducedGraphView& reduced) {
  std::vector<std::uint32_t> degree(graph.vertex_count());
  std::vector<VertexId> ends;
  std::vector<bool> is_kept(graph.vertex_count(), false);
  for (const VertexId v : keep) is_kept[v] = true;
  for (VertexId v = 0; v < degree.size(); ++v) {
    degree[v] = static_cast<std::uint32_t>(graph.neighbours(v).size());
    if (degree[v] <= 1 && !is_kept[v]) ends.push_back(v);
  }
  std::vector<bool> is_peeled(graph.vertex_count(), false);
  while (!ends.empty()) {
    const VertexId v = ends.back();
    ends.pop_back();
    is_peeled[v] = true;
    for (const VertexId w : graph.neighbours(v)) {
      if (!is_peeled[w] && --degree[w] == 1 && !is_kept[w]) ends.push_back(w);
    }
  }
  std::vector<bool> is_key(graph.vertex_count(), false);
  for (VertexId key = 0; key < reduced.graph().vertex_count(); ++key) is_key[reduced.vertex_of(key)] = true;
  for (VertexId v = 0; v < degree.size(); ++v) {
    check(is_key[v] == (!is_peeled[v] && (is_kept[v] || degree[v] != 2)), "reduce_graph: keys");
  }
}

/// Items are vertices; start and goal are opposite corners.
void bm_reduce(benchmark::State& state) {
  const PlaneGraph& maze = maze_of(state.range(0) == shuffled_grid, state.range(1), state.range(2));
  const Graph rows = plain_graph(maze.at.size(), maze.edges);
  Execution execution;
  execution.threads = static_cast<unsigned>(state.range(3));
  const std::vector<VertexId> keep{maze.start, maze.goal};
  const auto length = [&](VertexId v, VertexId w) { return distance(maze.at[v], maze.at[w]); };
  const auto reduced = reduce_graph(rows, keep, length, execution);
  if (should_check(state)) check_keys(rows, keep, reduced);
  const std::size_t keys = reduced.graph().vertex_count();
  for (auto _ : state) benchmark::DoNotOptimize(reduce_graph(rows, keep, length, execution).graph().vertex_count());
  report(state, maze.at.size(), rows.bytes() + reduced.graph().bytes() + keys * sizeof(VertexId));
  state.counters["keys/item"] = static_cast<double>(keys) / static_cast<double>(maze.at.size());
}

void serial_cases(benchmark::internal::Benchmark* b) {
  b->ArgNames({"kind", "side"})->Unit(benchmark::kMillisecond);
  for (const int kind : {tiled, shuffled_grid, random_places}) b->Args({kind, kind == random_places ? 500 : 1000});
  b->Args({tiled, 2000});
}
void parallel_cases(benchmark::internal::Benchmark* b) {
  b->ArgNames({"kind", "side", "threads"})->Apply(over_threads);
  for (const int threads : {1, 2}) {
    for (const int kind : {tiled, shuffled_grid, random_places})
      b->Args({kind, kind == random_places ? 500 : 1000, threads});
    b->Args({tiled, 2000, threads});
  }
}

BENCHMARK(bm_from_edges)->Apply(serial_cases);
BENCHMARK(bm_assemble)->Apply(parallel_cases);
BENCHMARK(bm_components_serial)->Apply(serial_cases);
BENCHMARK(bm_components)->Apply(parallel_cases);

BENCHMARK(bm_reduce)
    ->ArgNames({"kind", "side", "loops_%", "threads"})
    ->ArgsProduct({{tiled}, {1000, 2000}, {0, 10}, {1, 2}})
    ->Args({shuffled_grid, 1000, 10, 1})
    ->Apply(over_threads);

}  // namespace
}  // namespace warren::bench
