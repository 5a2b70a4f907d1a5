// SPDX-License-Identifier: BSD-3-Clause
// The queues of the search: the hold model (pop the least, push it back a little later) at a constant size, and A* on a
// maze with loops and on a random geometric graph. Items are pops, or vertices settled. All queues pop in the same
// order, which is checked by the path.
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "bench/test_graphs.hpp"
#include "core/search.hpp"
#include "core/search_queues.hpp"

namespace warren::bench {
namespace {

template <class Queue>
Queue make_queue() {
  return Queue();
}
template <>
BucketQueue make_queue<BucketQueue>() {
  return BucketQueue(0.25);
}

template <class Queue>
void bm_hold(benchmark::State& state) {
  const auto n = static_cast<VertexId>(state.range(0));
  auto queue = make_queue<Queue>();
  queue.resize(n);
  for (VertexId v = 0; v < n; ++v) queue.push(v, uniform(1, v, 0));
  std::uint64_t draws = 0;
  for (auto _ : state) {
    const QueueEntry top = queue.pop();
    queue.push(top.vertex, top.key + uniform(1, draws++, 1));
  }
  state.SetItemsProcessed(state.iterations());
}

const PlaneGraph& graph_of(bool is_geometric) {
  static const PlaneGraph graphs[] = {lattice(1000, true, 0.1, false), random_geometric(100'000, 20.0, false)};
  return graphs[is_geometric ? 1 : 0];
}

template <class Queue>
SearchResult astar(const PlaneGraph& plane, const Graph& graph, Queue& queue, SearchState& state) {
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : graph.neighbours(v)) visit(w, distance(plane.at[v], plane.at[w]));
  };
  const auto to_goal = [&](VertexId v) { return distance(plane.at[v], plane.at[plane.goal]); };
  state.clear();
  queue.clear();
  return best_first(plane.start, plane.goal, neighbours, to_goal, queue, state, NeverStop());
}

template <class Queue>
void bm_astar(benchmark::State& state) {
  const PlaneGraph& plane = graph_of(state.range(0) != 0);
  const Graph graph = Graph::from_edges(plane.at.size(), plane.edges);
  auto queue = make_queue<Queue>();
  IndexedHeap<2> plain;
  SearchState search_state;
  queue.resize(plane.at.size());
  plain.resize(plane.at.size());
  search_state.resize(plane.at.size());
  if (astar(plane, graph, plain, search_state).path != astar(plane, graph, queue, search_state).path) std::abort();
  SearchResult result;
  for (auto _ : state) benchmark::DoNotOptimize(result = astar(plane, graph, queue, search_state));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * result.expanded));
}

void sizes(benchmark::internal::Benchmark* b) { b->ArgName("entries")->Arg(64)->Arg(4096)->Arg(1 << 18); }
void small_sizes(benchmark::internal::Benchmark* b) { b->ArgName("entries")->Arg(64)->Arg(4096); }
void graphs(benchmark::internal::Benchmark* b) {
  b->ArgName("maze0_geometric1")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
}

BENCHMARK_TEMPLATE(bm_hold, IndexedHeap<2>)->Apply(sizes);
BENCHMARK_TEMPLATE(bm_hold, IndexedHeap<4>)->Apply(sizes);
BENCHMARK_TEMPLATE(bm_hold, IndexedHeap<8>)->Apply(sizes);
BENCHMARK_TEMPLATE(bm_hold, LazyHeap)->Apply(sizes);
BENCHMARK_TEMPLATE(bm_hold, BucketQueue)->Apply(sizes);
BENCHMARK_TEMPLATE(bm_hold, SortedArray)->Apply(small_sizes);
BENCHMARK_TEMPLATE(bm_hold, LinearScan)->Apply(small_sizes);
BENCHMARK_TEMPLATE(bm_astar, IndexedHeap<2>)->Apply(graphs);
BENCHMARK_TEMPLATE(bm_astar, IndexedHeap<4>)->Apply(graphs);
BENCHMARK_TEMPLATE(bm_astar, IndexedHeap<8>)->Apply(graphs);
BENCHMARK_TEMPLATE(bm_astar, LazyHeap)->Apply(graphs);
BENCHMARK_TEMPLATE(bm_astar, BucketQueue)->Apply(graphs);
BENCHMARK_TEMPLATE(bm_astar, SortedArray)->Apply(graphs);

}  // namespace
}  // namespace warren::bench
