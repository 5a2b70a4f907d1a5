// SPDX-License-Identifier: BSD-3-Clause
// The queues of the search: the hold model (pop the least, push it back a little later) at a constant size, and A* on a
// maze with loops and on a random geometric graph. Items are pops, or vertices settled; bytes are those of an entry.
// All queues pop in the same order, which is checked against the unordered array, and by the path.
#include <benchmark/benchmark.h>

#include "bench/plain_graph.hpp"
#include "bench/report.hpp"
#include "bench/test_graphs.hpp"
#include "core/search/search.hpp"
#include "core/search/search_queues.hpp"

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

/// Bytes an entry: key and vertex, and its place where the queue can find it again.
template <class Queue>
constexpr std::size_t entry_bytes = sizeof(QueueEntry);
template <unsigned Arity>
constexpr std::size_t entry_bytes<IndexedHeap<Arity>> = sizeof(QueueEntry) + sizeof(VertexId);

/// A queue of constant size; each step pops the least entry and pushes it back a little later.
template <class Queue>
class Hold {
 public:
  explicit Hold(VertexId n) : queue_(make_queue<Queue>()) {
    queue_.resize(n);
    for (VertexId v = 0; v < n; ++v) queue_.push(v, uniform(1, v, 0));
  }
  VertexId step() {
    const QueueEntry top = queue_.pop();
    queue_.push(top.vertex, top.key + uniform(1, draws_++, 1));
    return top.vertex;
  }

 private:
  Queue queue_;
  std::uint64_t draws_ = 0;
};

template <class Queue>
void check_order(VertexId n) {
  constexpr int steps = 500;
  Hold<Queue> hold(n);
  Hold<LinearScan> plain(n);
  for (int i = 0; i < steps; ++i) check(hold.step() == plain.step(), "order of a queue");
}

template <class Queue>
void bm_hold(benchmark::State& state) {
  const auto n = static_cast<VertexId>(state.range(0));
  if (should_check(state)) check_order<Queue>(n);
  Hold<Queue> hold(n);
  for (auto _ : state) benchmark::DoNotOptimize(hold.step());
  report(state, 1, entry_bytes<Queue>);
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
  const Graph graph = plain_graph(plane.at.size(), plane.edges);
  auto queue = make_queue<Queue>();
  IndexedHeap<2> plain;
  SearchState search_state;
  queue.resize(plane.at.size());
  plain.resize(plane.at.size());
  search_state.resize(plane.at.size());
  if (should_check(state))
    check(astar(plane, graph, plain, search_state).path == astar(plane, graph, queue, search_state).path,
          "path of a queue");
  SearchResult result;
  for (auto _ : state) benchmark::DoNotOptimize(result = astar(plane, graph, queue, search_state));
  report(state, result.expanded, result.expanded * entry_bytes<Queue>);
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
