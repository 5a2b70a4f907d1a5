// SPDX-License-Identifier: BSD-3-Clause
// CSR assembly and components: serial oracle beside the parallel version, on the full lattice (2 edges a vertex), in
// tile order and with random numbers, and on a random geometric graph (13 edges a vertex).
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "bench/test_graphs.hpp"
#include "parallel/assemble_graph.hpp"
#include "parallel/components.hpp"
#include "parallel/reduce_graph.hpp"

namespace warren::bench {
namespace {

enum Kind : int { tiled, shuffled, geometric };

const PlaneGraph& graph_of(int kind, int side) {
  static PlaneGraph graph;
  static std::pair<int, int> built{-1, -1};
  if (built != std::pair{kind, side}) {
    graph = kind == geometric
                ? random_geometric(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 26.0, false)
                : lattice(static_cast<std::uint32_t>(side), false, 0.0, kind == shuffled);
    built = {kind, side};
  }
  return graph;
}

void count(benchmark::State& state, std::size_t vertices, std::size_t bytes) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * vertices));
  state.counters["bytes/item"] = static_cast<double>(bytes) / static_cast<double>(vertices);
}

void check(bool same) {
  if (!same) std::abort();
}

void bm_from_edges(benchmark::State& state) {
  const PlaneGraph& graph = graph_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(Graph::from_edges(graph.at.size(), graph.edges));
  count(state, graph.at.size(), Graph::from_edges(graph.at.size(), graph.edges).bytes());
}

void bm_assemble(benchmark::State& state) {
  const PlaneGraph& graph = graph_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const auto parts = parts_of(graph);
  Execution execution;
  execution.threads = static_cast<unsigned>(state.range(2));
  const Graph oracle = Graph::from_edges(graph.at.size(), graph.edges);
  const Graph built = assemble_graph(graph.at.size(), parts, execution);
  for (VertexId v = 0; v < graph.at.size(); ++v) check(std::ranges::equal(oracle.neighbours(v), built.neighbours(v)));
  for (auto _ : state) benchmark::DoNotOptimize(assemble_graph(graph.at.size(), parts, execution));
  count(state, graph.at.size(), built.bytes());
}

void bm_components_serial(benchmark::State& state) {
  const PlaneGraph& graph = graph_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Graph rows = Graph::from_edges(graph.at.size(), graph.edges);
  for (auto _ : state) benchmark::DoNotOptimize(components(rows));
  count(state, graph.at.size(), graph.at.size() * sizeof(VertexId));
}

void bm_components(benchmark::State& state) {
  const PlaneGraph& graph = graph_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Graph rows = Graph::from_edges(graph.at.size(), graph.edges);
  Execution execution;
  execution.threads = static_cast<unsigned>(state.range(2));
  check(components(rows, execution).label == components(rows).label);
  for (auto _ : state) benchmark::DoNotOptimize(components(rows, execution));
  count(state, graph.at.size(), graph.at.size() * sizeof(VertexId));
}

/// Items are vertices; start and goal are opposite corners.
void bm_reduce(benchmark::State& state) {
  const auto side = static_cast<std::uint32_t>(state.range(1));
  const PlaneGraph maze = lattice(side, true, static_cast<double>(state.range(2)) / 100.0, state.range(0) == shuffled);
  const Graph rows = Graph::from_edges(maze.at.size(), maze.edges);
  Execution execution;
  execution.threads = static_cast<unsigned>(state.range(3));
  const std::vector<VertexId> keep{maze.start, maze.goal};
  const auto length = [&](VertexId v, VertexId w) { return distance(maze.at[v], maze.at[w]); };
  std::size_t keys = 0;
  for (auto _ : state) keys = reduce_graph(rows, keep, length, execution).graph().vertex_count();
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * maze.at.size()));
  state.counters["keys/item"] = static_cast<double>(keys) / static_cast<double>(maze.at.size());
}

void serial_cases(benchmark::internal::Benchmark* b) {
  b->ArgNames({"kind", "side"})->Unit(benchmark::kMillisecond);
  for (const int kind : {tiled, shuffled, geometric}) b->Args({kind, kind == geometric ? 500 : 1000});
  b->Args({tiled, 3000});
}
void parallel_cases(benchmark::internal::Benchmark* b) {
  b->ArgNames({"kind", "side", "threads"})->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
  for (const int threads : {1, 2}) {
    for (const int kind : {tiled, shuffled, geometric}) b->Args({kind, kind == geometric ? 500 : 1000, threads});
    b->Args({tiled, 3000, threads});
  }
}

BENCHMARK(bm_from_edges)->Apply(serial_cases);
BENCHMARK(bm_assemble)->Apply(parallel_cases);
BENCHMARK(bm_components_serial)->Apply(serial_cases);
BENCHMARK(bm_components)->Apply(parallel_cases);

BENCHMARK(bm_reduce)
    ->ArgNames({"kind", "side", "loops_%", "threads"})
    ->ArgsProduct({{tiled}, {1000, 3000}, {0, 10}, {1, 2}})
    ->Args({shuffled, 1000, 10, 1})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace warren::bench
