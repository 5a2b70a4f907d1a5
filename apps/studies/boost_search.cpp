// SPDX-License-Identifier: BSD-3-Clause
// Boost.Graph's searches on the same graph with the same numbering, the peer of `warren compare --peer boost`: its
// compressed rows, edge lengths in an array, maps allocated once. A visitor ends each search at the goal by throwing,
// as Boost's own example of A* does; its priority queue is Boost's indirect 4-ary heap.
#include "apps/studies/search_contest.hpp"

#include <algorithm>
#include <boost/graph/astar_search.hpp>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/depth_first_search.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>

namespace warren::studies {
namespace {

struct Weight {
  double length;
};
using BoostGraph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Weight, boost::no_property,
                                                      std::uint32_t, std::uint32_t>;
using BoostVertex = boost::graph_traits<BoostGraph>::vertex_descriptor;

BoostGraph boost_graph(const SearchGraph& from) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  std::vector<Weight> weights;
  ends.reserve(2 * from.graph.edge_count());
  weights.reserve(2 * from.graph.edge_count());
  for (VertexId v = 0; v < from.graph.vertex_count(); ++v) {
    const std::span<const VertexId> row = from.graph.neighbours(v);
    for (std::size_t i = 0; i < row.size(); ++i) {
      ends.emplace_back(v, row[i]);
      weights.push_back({from.graph.lengths(v)[i]});
    }
  }
  return {boost::edges_are_sorted, ends.begin(), ends.end(), weights.begin(),
          static_cast<std::uint32_t>(from.graph.vertex_count())};
}

struct Reached {};  // thrown at the goal
struct TimeIsUp {};

/// What ends a search: counts the vertices that are settled, looks at the clock like our own searches.
struct Watch {
  BoostVertex goal;
  const Execution* execution;
  std::uint64_t* settled;
  std::vector<BoostVertex>* parent;
  void settle(BoostVertex v) const {
    ++*settled;
    if (v == goal) throw Reached();
    if (*settled % expansions_per_poll == 0 && execution->should_stop()) throw TimeIsUp();
  }
};

/// Searches that take a map of predecessors don't tell tree_edge.
template <class Base>
struct Visitor : Base {
  explicit Visitor(Watch w) : watch(w) {}
  void examine_vertex(BoostVertex v, const BoostGraph&) const { watch.settle(v); }
  template <class BoostEdge>
  void tree_edge(const BoostEdge& e, const BoostGraph& graph) const {
    (*watch.parent)[target(e, graph)] = source(e, graph);
  }
  Watch watch;
};
struct DepthVisitor : Visitor<boost::default_dfs_visitor> {
  using Visitor::Visitor;
  void discover_vertex(BoostVertex v, const BoostGraph&) const { watch.settle(v); }
};

class BoostSearch {
 public:
  BoostSearch(const SearchGraph& from, SearchKind search)
      : from_(from),
        search_(search),
        graph_(boost_graph(from)),
        g_(from.graph.vertex_count()),
        f_(g_.size()),
        parent_(g_.size()),
        color_(g_.size()) {}

  SearchResult operator()(const Execution& execution) {
    SearchResult result;
    try {
      search({from_.goal, &execution, &result.expanded, &parent_});
    } catch (const Reached&) {
      result.status = SearchStatus::found;
      result.path = path();
      if (has_queue(search_)) result.length = g_[from_.goal];
    } catch (const TimeIsUp&) {
      result.status = SearchStatus::stopped;
    }
    return result;
  }

 private:
  template <class Values>
  auto map(Values& values) {
    return boost::make_iterator_property_map(values.begin(), get(boost::vertex_index, graph_));
  }

  void search(const Watch& watch) {
    const auto maps = boost::weight_map(get(&Weight::length, graph_))
                          .distance_map(map(g_))
                          .predecessor_map(map(parent_))
                          .color_map(map(color_));
    const auto to_goal = [&at = from_.at, goal = from_.at[from_.goal]](BoostVertex v) { return distance(at[v], goal); };
    switch (search_) {
      case SearchKind::bfs:
        return boost::breadth_first_search(graph_, from_.start,
                                           maps.visitor(Visitor<boost::default_bfs_visitor>(watch)));
      case SearchKind::dfs:
        std::fill(color_.begin(), color_.end(), boost::white_color);
        return boost::depth_first_visit(graph_, from_.start, DepthVisitor(watch), map(color_));
      case SearchKind::dijkstra:
        return boost::dijkstra_shortest_paths(graph_, from_.start,
                                              maps.visitor(Visitor<boost::default_dijkstra_visitor>(watch)));
      case SearchKind::astar:
        return boost::astar_search(graph_, from_.start, to_goal,
                                   maps.rank_map(map(f_)).visitor(Visitor<boost::default_astar_visitor>(watch)));
    }
  }

  RawVector<VertexId> path() const {
    RawVector<VertexId> path{from_.goal};
    while (path.back() != from_.start) path.push_back(parent_[path.back()]);
    std::reverse(path.begin(), path.end());
    return path;
  }

  const SearchGraph& from_;
  SearchKind search_;
  BoostGraph graph_;
  std::vector<double> g_;
  std::vector<double> f_;
  std::vector<BoostVertex> parent_;
  std::vector<boost::default_color_type> color_;
};

}  // namespace

GraphSearch boost_search(const SearchGraph& graph, SearchKind search) { return BoostSearch(graph, search); }

}  // namespace warren::studies
