// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/search_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "core/base/rng.hpp"
#include "core/search/search_queues.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/components.hpp"
#include "spatial/points/point_grid.hpp"
#include "spatial/points/tile_order.hpp"

namespace warren::studies {
namespace {

constexpr std::size_t vertices_per_poll = 1 << 12;

std::vector<Vec2> drawn_points(std::uint32_t size, std::uint64_t seed, const Execution& execution) {
  const double side = std::sqrt(static_cast<double>(size));
  std::vector<Vec2> drawn(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    if (i % vertices_per_poll == 0) execution.check();
    drawn[i] = {side * uniform(seed, i, 0), side * uniform(seed, i, 1)};
  }
  const RawVector<std::uint32_t> order = tile_order(drawn, execution);
  std::vector<Vec2> at(size);
  for (std::uint32_t i = 0; i < size; ++i) at[i] = drawn[order[i]];
  return at;
}

RawVector<Edge> edges_within(const std::vector<Vec2>& at, const SearchRadius& radius, const Execution& execution) {
  const PointGrid grid(at, execution);
  RawVector<Edge> edges;
  for (std::size_t v = 0; v < at.size(); v += vertices_per_poll) {
    execution.check();
    grid.for_each_later_pair({v, std::min(v + vertices_per_poll, at.size())}, radius, [&](VertexId i, VertexId j) {
      edges.push_back({i, j});
    });
  }
  return edges;
}

/// Label of the component with the most vertices; of equal ones the least.
VertexId largest_component(const Components& components) {
  std::vector<std::uint32_t> sizes(components.label.size(), 0);
  for (const VertexId label : components.label) ++sizes[label];
  VertexId largest = 0;
  for (VertexId v = 0; v < sizes.size(); ++v) {
    if (sizes[v] > sizes[largest]) largest = v;
  }
  return largest;
}

VertexId nearest_in(const std::vector<Vec2>& at, const Components& components, VertexId label, Vec2 place) {
  VertexId nearest = label;
  for (VertexId v = 0; v < at.size(); ++v) {
    if (components.label[v] == label && distance(at[v], place) < distance(at[nearest], place)) nearest = v;
  }
  return nearest;
}

/// A* (with the straight distance as heuristic) or Dijkstra. An array that is sorted at each push can take a second for
/// the expansions between two looks at the deadline, so there it is looked at more often.
template <class Queue, bool Informed>
GraphSearch best_first_on(const SearchGraph& from) {
  Queue empty;
  SearchState fresh;
  empty.resize(from.graph.vertex_count());
  fresh.resize(from.graph.vertex_count());
  return [&from, queue = std::move(empty), state = std::move(fresh)](const Execution& execution) mutable {
    constexpr std::uint64_t expansions_per_look = 64;
    [[maybe_unused]] std::uint64_t expansions = 0;
    const auto neighbours = [&](VertexId v, const auto& visit) {
      if constexpr (std::is_same_v<Queue, ResortedArray>) {
        if (++expansions % expansions_per_look == 0) execution.check();
      }
      const std::span<const VertexId> row = from.graph.neighbours(v);
      const std::span<const double> lengths = from.graph.lengths(v);
      for (std::size_t i = 0; i < row.size(); ++i) visit(row[i], lengths[i]);
    };
    const Vec2 goal = from.at[from.goal];
    const auto to_goal = [&](VertexId v) { return Informed ? distance(from.at[v], goal) : 0.0; };
    queue.clear();
    state.clear();
    try {
      return best_first(from.start, from.goal, neighbours, to_goal, queue, state,
                        [&] { return execution.should_stop(); });
    } catch (const Stopped&) {
      SearchResult stopped;
      stopped.status = SearchStatus::stopped;
      return stopped;
    }
  };
}

template <class Queue>
GraphSearch best_first_with(const SearchGraph& graph, SearchKind search) {
  return search == SearchKind::astar ? best_first_on<Queue, true>(graph) : best_first_on<Queue, false>(graph);
}

}  // namespace

SearchGraph geometric_graph(std::uint32_t size, double degree, std::uint64_t seed, const Execution& execution) {
  constexpr double bytes_a_vertex = 80.0;
  constexpr double bytes_an_end = 24.0;
  const double ends = std::min(degree, static_cast<double>(size));
  execution.reserve(static_cast<std::size_t>(size * (bytes_a_vertex + bytes_an_end * ends)));
  SearchGraph made;
  made.source = fmt::format("geometric:{}", size);
  made.kind = "geometric";
  made.options = {{"degree", fmt::format("{}", degree)}, {"seed", std::to_string(seed)}};
  made.at = drawn_points(size, seed, execution);
  const double radius = std::sqrt(degree / std::numbers::pi);
  const std::array<RawVector<Edge>, 1> edges{edges_within(made.at, radius, execution)};
  const auto length = [&](VertexId v, VertexId w) { return distance(made.at[v], made.at[w]); };
  made.graph = with_lengths(assemble_graph(size, edges, execution), execution, length);
  const Components parts = components(made.graph, execution);
  const VertexId largest = largest_component(parts);
  const double side = std::sqrt(static_cast<double>(size));
  made.start = nearest_in(made.at, parts, largest, {0.0, 0.0});
  made.goal = nearest_in(made.at, parts, largest, {side, side});
  return made;
}

GraphSearch graph_search(const SearchGraph& graph, const SearchVariant& variant) {
  if (variant.library == SearchLibrary::boost) return boost_search(graph, variant.search);
  if (!has_queue(variant.search)) {
    SearchState fresh;
    fresh.resize(graph.graph.vertex_count());
    const bool is_deep = variant.search == SearchKind::dfs;
    return [&graph, is_deep, state = std::move(fresh)](const Execution& execution) mutable {
      state.clear();
      const auto stop = [&] { return execution.should_stop(); };
      return is_deep ? depth_first(graph.graph, graph.start, graph.goal, state, stop)
                     : breadth_first(graph.graph, graph.start, graph.goal, state, stop);
    };
  }
  const QueuePolicy queue = variant.queue.value_or(QueuePolicy::heap);
  if (queue == QueuePolicy::lazy_heap) return best_first_with<LazyHeap>(graph, variant.search);
  if (queue == QueuePolicy::sorted_array) return best_first_with<SortedArray>(graph, variant.search);
  if (queue == QueuePolicy::resorted_array) return best_first_with<ResortedArray>(graph, variant.search);
  if (queue == QueuePolicy::linear_scan) return best_first_with<LinearScan>(graph, variant.search);
  return best_first_with<IndexedHeap<4>>(graph, variant.search);
}

double path_length(const SearchGraph& graph, std::span<const VertexId> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const std::span<const VertexId> row = graph.graph.neighbours(path[i - 1]);
    const auto place = static_cast<std::size_t>(std::find(row.begin(), row.end(), path[i]) - row.begin());
    length += graph.graph.lengths(path[i - 1])[place];
  }
  return length;
}

}  // namespace warren::studies
