// SPDX-License-Identifier: BSD-3-Clause
#include "studies/searches/graph_search.hpp"

#include <algorithm>
#include <type_traits>

#include "core/search/search_queues.hpp"

namespace warren::studies {
namespace {

/// A* (with the straight distance as heuristic) or Dijkstra. An array that is sorted at each push can take a second for
/// the expansions between two looks at the deadline, so there it is looked at more often.
template <class Queue, bool Informed>
class BestFirst : public GraphSearch {
 public:
  explicit BestFirst(const SearchGraph& graph) : graph_(graph) {
    queue_.resize(graph.graph.vertex_count());
    state_.resize(graph.graph.vertex_count());
  }

  SearchResult run(const Execution& execution) override {
    queue_.clear();
    state_.clear();
    try {
      return search(execution);
    } catch (const Stopped&) {
      SearchResult stopped;
      stopped.status = SearchStatus::stopped;
      return stopped;
    }
  }

 private:
  SearchResult search(const Execution& execution) {
    constexpr std::uint64_t expansions_per_look = 64;
    [[maybe_unused]] std::uint64_t expansions = 0;
    const Graph& graph = graph_.graph;
    const auto neighbours = [&](VertexId v, const auto& visit) {
      if constexpr (std::is_same_v<Queue, ResortedArray>) {
        if (++expansions % expansions_per_look == 0) execution.check();
      }
      const std::span<const VertexId> row = graph.neighbours(v);
      const std::span<const double> lengths = graph.lengths(v);
      for (std::size_t i = 0; i < row.size(); ++i) visit(row[i], lengths[i]);
    };
    const Vec2 goal = graph_.at[graph_.goal];
    const auto to_goal = [&](VertexId v) { return Informed ? distance(graph_.at[v], goal) : 0.0; };
    return best_first(graph_.start, graph_.goal, neighbours, to_goal, queue_, state_,
                      [&] { return execution.should_stop(); });
  }

  const SearchGraph& graph_;
  Queue queue_;
  SearchState state_;
};

class BreadthFirst : public GraphSearch {
 public:
  explicit BreadthFirst(const SearchGraph& graph) : graph_(graph) { state_.resize(graph.graph.vertex_count()); }
  SearchResult run(const Execution& execution) override {
    state_.clear();
    return breadth_first(graph_.graph, graph_.start, graph_.goal, state_, [&] { return execution.should_stop(); });
  }

 private:
  const SearchGraph& graph_;
  SearchState state_;
};

class DepthFirst : public GraphSearch {
 public:
  explicit DepthFirst(const SearchGraph& graph) : graph_(graph) { state_.resize(graph.graph.vertex_count()); }
  SearchResult run(const Execution& execution) override {
    state_.clear();
    return depth_first(graph_.graph, graph_.start, graph_.goal, state_, [&] { return execution.should_stop(); });
  }

 private:
  const SearchGraph& graph_;
  SearchState state_;
};

template <class Queue>
std::unique_ptr<GraphSearch> best_first_with(const SearchGraph& graph, SearchKind search) {
  if (search == SearchKind::astar) return std::make_unique<BestFirst<Queue, true>>(graph);
  return std::make_unique<BestFirst<Queue, false>>(graph);
}

std::unique_ptr<GraphSearch> best_first_search(const SearchGraph& graph, SearchKind search, QueuePolicy queue) {
  switch (queue) {
    case QueuePolicy::lazy_heap:
      return best_first_with<LazyHeap>(graph, search);
    case QueuePolicy::sorted_array:
      return best_first_with<SortedArray>(graph, search);
    case QueuePolicy::resorted_array:
      return best_first_with<ResortedArray>(graph, search);
    case QueuePolicy::linear_scan:
      return best_first_with<LinearScan>(graph, search);
    case QueuePolicy::heap:
      break;
  }
  return best_first_with<IndexedHeap<4>>(graph, search);
}

}  // namespace

std::unique_ptr<GraphSearch> graph_search(const SearchGraph& graph, const SearchVariant& variant) {
  if (variant.library == SearchLibrary::boost) return boost_search(graph, variant.search);
  switch (variant.search) {
    case SearchKind::bfs:
      return std::make_unique<BreadthFirst>(graph);
    case SearchKind::dfs:
      return std::make_unique<DepthFirst>(graph);
    default:
      return best_first_search(graph, variant.search, variant.queue.value_or(QueuePolicy::heap));
  }
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
