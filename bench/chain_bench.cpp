// SPDX-License-Identifier: BSD-3-Clause
// The chain, link by link, on mazes of 41 x 41, 200 x 200 and 1000 x 1000 cells with uniform milestones, as prm and
// lazy-prm have them: chain/LINK/BY/maze:SIDE/threads:N. Items are milestones, queries, edges or vertices; nanoflann as
// packaged and Boost's d-ary heap stand beside ours. Heaps are checked here, what else is timed in tests/ and by the
// benches a hot file.
#pragma GCC diagnostic ignored "-Wnull-dereference"  // g++ 12 at -O3 sees one inside nanoflann's vector::resize

#include <benchmark/benchmark.h>

#if __has_include(<boost/graph/detail/d_ary_heap.hpp>)
#include <boost/graph/detail/d_ary_heap.hpp>
#include <boost/property_map/property_map.hpp>
#define WARREN_HAS_BOOST_HEAP
#endif

#include <functional>
#include <memory>
#include <string>
#include <type_traits>

#include "bench/plain_flann.hpp"
#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "core/search/search_queues.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren::bench {
namespace {

constexpr std::size_t nearest_k = 8;

/// A maze and what each link leaves to the next.
struct Chain {
  explicit Chain(std::uint32_t side)
      : scene(maze_scene({side, side, 1}, false, {})),
        maze(scene, 0.1, {}),
        world(maze),
        samples(usual_samples(world, options, {})),
        milestones(draw_milestones(world, options, samples, {})),
        rule(connection_rule_for(world, options, samples)),
        index(std::span<const Vec2>(milestones), {}, NeighbourIndex::kd_tree) {
    Counters counters;
    candidates = candidate_edges(world, states(), index, rule, {}, counters);
    free = connect_milestones(world, states(), index, rule, {}, counters);
    graph = assemble_graph(milestones.size(), free, {});
  }
  std::span<const Vec2> states() const { return milestones; }
  VertexId last() const { return static_cast<VertexId>(milestones.size() - 1); }

  Scene scene;
  MazeWorld maze;
  WorldView<MazeWorld> world;
  RoadmapOptions options{.sampler = SamplerKind::uniform};
  std::uint64_t samples;
  RawVector<Vec2> milestones;
  ConnectionRule rule;
  StateIndex<AnyWorld<Vec2>> index;
  EdgeParts candidates;
  EdgeParts free;
  Graph graph;
};

/// The one asked for last.
const Chain& chain_of(std::uint32_t side) {
  static std::unique_ptr<Chain> kept;
  static std::uint32_t kept_side = 0;
  if (kept_side != side) {
    kept.reset();
    kept = std::make_unique<Chain>(side);
    kept_side = side;
  }
  return *kept;
}

template <class Index>
std::unique_ptr<Index> index_of(const Chain& chain) {
  if constexpr (std::is_same_v<Index, PlainFlann>) {
    return std::make_unique<Index>(chain.states());
  } else {
    return std::make_unique<Index>(chain.states(), Execution{.threads = 1});
  }
}

void count_items(benchmark::State& state, std::size_t items) {
  state.SetItemsProcessed(static_cast<std::int64_t>(items));
  state.counters["s/item"] =
      benchmark::Counter(static_cast<double>(items), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
std::size_t iterations(const benchmark::State& state) { return static_cast<std::size_t>(state.iterations()); }

template <class Index>
void index_built(benchmark::State& state, std::uint32_t side) {
  const Chain& chain = chain_of(side);
  for (auto _ : state) benchmark::DoNotOptimize(index_of<Index>(chain).get());
  count_items(state, iterations(state) * chain.milestones.size());
}

/// One query an iteration, in the order of the milestones.
template <class Index, class Ask>
void asked(benchmark::State& state, std::uint32_t side, const Ask& ask) {
  const Chain& chain = chain_of(side);
  const auto index = index_of<Index>(chain);
  std::vector<Neighbour> near;
  VertexId i = 0;
  for (auto _ : state) {
    ask(*index, chain, i, near);
    benchmark::DoNotOptimize(near.data());
    i = i == chain.last() ? 0 : i + 1;
  }
  count_items(state, iterations(state));
}
template <class Index>
void k_nearest(benchmark::State& state, std::uint32_t side) {
  asked<Index>(state, side, [](const Index& index, const Chain& chain, VertexId i, std::vector<Neighbour>& near) {
    index.nearest(chain.milestones[i], nearest_k, i, near);
  });
}
template <class Index>
void radius(benchmark::State& state, std::uint32_t side) {
  asked<Index>(state, side, [](const Index& index, const Chain& chain, VertexId i, std::vector<Neighbour>& near) {
    index.within(chain.milestones[i], SearchRadius(chain.rule.radius), i, near);
  });
}

void edge_checks(benchmark::State& state, std::uint32_t side, unsigned threads) {
  const Chain& chain = chain_of(side);
  for (auto _ : state) {
    for_chunks(chain.candidates.size(), 1, {.threads = threads}, [&](Range r) {
      auto query = chain.world.make_query();
      detail::Bunch<Vec2> bunch;
      const auto flush = [&] {
        benchmark::DoNotOptimize(chain.world.free_motions(bunch.motions(), query));
        bunch.clear();
      };
      for (const Edge& e : chain.candidates[r.first]) {
        bunch.add(e, chain.milestones[e.from], chain.milestones[e.to]);
        if (bunch.full()) flush();
      }
      if (!bunch.edges().empty()) flush();
    });
  }
  std::uint64_t candidates = 0;
  for (const RawVector<Edge>& part : chain.candidates) candidates += part.size();
  count_items(state, iterations(state) * candidates);
}

double distance_in(const Chain& chain, VertexId v, VertexId w) {
  return distance(chain.milestones[v], chain.milestones[w]);
}

/// A search that checks the edges which it needs: items are these.
void lazy_validation(benchmark::State& state, std::uint32_t side) {
  const Chain& chain = chain_of(side);
  const Execution alone{.threads = 1};
  const Graph none;
  const auto estimate = [&](VertexId v, VertexId w) { return distance_in(chain, v, w); };
  std::uint64_t checked = 0;
  for (auto _ : state) {
    LazyGraph<AnyWorld<Vec2>> graph(chain.world, chain.states(), chain.index, chain.rule, none, {}, alone);
    SearchState search;
    const ImplicitSearch how{VertexDistance(estimate), true, QueueKind::heap, chain.milestones.size(), alone};
    benchmark::DoNotOptimize(search_implicit(AnyNeighbours(graph), 0, chain.last(), how, search).expanded);
    checked += graph.counters().edges_checked;
  }
  count_items(state, checked);
}

void csr_rows(benchmark::State& state, std::uint32_t side, unsigned threads) {
  const Chain& chain = chain_of(side);
  for (auto _ : state) {
    benchmark::DoNotOptimize(assemble_graph(chain.milestones.size(), chain.free, {.threads = threads}).edge_count());
  }
  count_items(state, iterations(state) * chain.graph.edge_count());
}

void astar(benchmark::State& state, std::uint32_t side, unsigned threads) {
  const Chain& chain = chain_of(side);
  const Execution execution{.threads = threads};
  const auto length = [&](VertexId v, VertexId w) { return distance_in(chain, v, w); };
  const RoadmapSearch how{.start = 0,
                          .goal = chain.last(),
                          .length = VertexDistance(length),
                          .estimate = VertexDistance(length),
                          .search = SearchKind::astar,
                          .queue = QueueKind::heap,
                          .execution = execution,
                          .tree = nullptr,
                          .estimate_fits = true};
  std::uint64_t expanded = 0;
  for (auto _ : state) expanded += search_roadmap(chain.graph, how).expanded;
  count_items(state, expanded);
}

/// As many vertices as the maze has milestones: all pushed, all decreased once, all popped. Items are these steps.
template <class Push, class Decrease, class Pop>
void heap_steps(benchmark::State& state, std::uint32_t side, const Push& push, const Decrease& decrease,
                const Pop& pop) {
  const auto n = static_cast<VertexId>(chain_of(side).milestones.size());
  std::vector<double> first(n);
  std::vector<double> second(n);
  for (VertexId v = 0; v < n; ++v) {
    first[v] = 1.0 + uniform(1, v, 0);
    second[v] = uniform(1, v, 1);
  }
  const auto fill = [&] {
    for (VertexId v = 0; v < n; ++v) push(v, first[v]);
    for (VertexId v = 0; v < n; ++v) decrease(v, second[v]);
  };
  fill();
  double last = 0.0;
  for (VertexId i = 0; i < n; ++i) {
    const double key = second[pop()];
    check(last <= key, "order of a heap");
    last = key;
  }
  for (auto _ : state) {
    fill();
    for (VertexId i = 0; i < n; ++i) benchmark::DoNotOptimize(pop());
  }
  count_items(state, iterations(state) * 3 * n);
}
void heap_of_ours(benchmark::State& state, std::uint32_t side) {
  IndexedHeap<4> heap;
  heap.resize(chain_of(side).milestones.size());
  const auto push = [&](VertexId v, double key) { heap.push(v, key); };
  heap_steps(state, side, push, push, [&] { return heap.pop().vertex; });
}
#ifdef WARREN_HAS_BOOST_HEAP
void heap_of_boost(benchmark::State& state, std::uint32_t side) {
  const std::size_t n = chain_of(side).milestones.size();
  std::vector<double> keys(n);
  std::vector<std::size_t> places(n, static_cast<std::size_t>(-1));
  boost::d_ary_heap_indirect<VertexId, 4, std::size_t*, double*, std::less<double>> heap(keys.data(), places.data());
  const auto push = [&](VertexId v, double key) { keys[v] = key, heap.push(v); };
  const auto decrease = [&](VertexId v, double key) { keys[v] = key, heap.update(v); };
  heap_steps(state, side, push, decrease, [&] {
    const VertexId top = heap.top();
    heap.pop();
    return top;
  });
}
#endif

const bool are_registered = [] {
  for (const std::uint32_t side : {41U, 200U, 1000U}) {
    const std::string maze = "/maze:" + std::to_string(side);
    const auto add = [&](const std::string& name, const auto& run) {
      benchmark::RegisterBenchmark(("chain/" + name + maze).c_str(), [=](benchmark::State& s) {
        run(s, side);
      })->UseRealTime();
    };
    add("index_built/kd_tree", index_built<KdTree<2>>);
    add("index_built/grid", index_built<PointGrid>);
    add("index_built/nanoflann", index_built<PlainFlann>);
    add("k_nearest/kd_tree", k_nearest<KdTree<2>>);
    add("k_nearest/grid", k_nearest<PointGrid>);
    add("k_nearest/nanoflann", k_nearest<PlainFlann>);
    add("radius/kd_tree", radius<KdTree<2>>);
    add("radius/grid", radius<PointGrid>);
    add("radius/nanoflann", radius<PlainFlann>);
    add("lazy_validation/kd_tree", lazy_validation);
    add("heap_push_decrease_pop/ours", heap_of_ours);
#ifdef WARREN_HAS_BOOST_HEAP
    add("heap_push_decrease_pop/boost", heap_of_boost);
#endif
    for (const unsigned threads : {1U, 2U}) {
      const auto add_threads = [&](const std::string& name, const auto& run) {
        benchmark::RegisterBenchmark(("chain/" + name + maze + "/threads:" + std::to_string(threads)).c_str(),
                                     [=](benchmark::State& s) { run(s, side, threads); })
            ->UseRealTime();
      };
      add_threads("edge_checks", edge_checks);
      add_threads("csr_rows", csr_rows);
      add_threads("astar", astar);
    }
  }
  return true;
}();

}  // namespace
}  // namespace warren::bench
