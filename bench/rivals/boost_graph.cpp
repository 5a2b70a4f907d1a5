// SPDX-License-Identifier: BSD-3-Clause
// warren's A* and Dijkstra beside Boost.Graph's on the same graphs with the same numbering: a perfect maze, a maze with
// loops and a random geometric graph, vertices in spatial order or shuffled. Both sides keep edge lengths in arrays,
// start from arrays that are allocated already, and stop at the goal. The contestants take turns; the least CPU time of
// each counts. Every length is compared.
//   rival_boost_graph [VERTICES [REPEATS]]
#include <algorithm>
#include <boost/graph/astar_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/plain_graph.hpp"
#include "bench/rivals/stopwatch.hpp"
#include "bench/test_graphs.hpp"
#include "core/search/search.hpp"
#include "core/search/search_queues.hpp"

namespace warren::bench {
namespace {

struct Weight {
  double length;
};
using BoostGraph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Weight, boost::no_property,
                                                      std::uint32_t, std::uint32_t>;
using BoostVertex = boost::graph_traits<BoostGraph>::vertex_descriptor;

struct Found {};
struct StopAtGoal : boost::default_astar_visitor {
  BoostVertex goal;
  std::uint64_t* settled;
  StopAtGoal(BoostVertex goal_vertex, std::uint64_t* count) : goal(goal_vertex), settled(count) {}
  void examine_vertex(BoostVertex v, const BoostGraph&) const {
    ++*settled;
    if (v == goal) throw Found();
  }
};

struct Estimate : boost::astar_heuristic<BoostGraph, double> {
  const std::vector<Vec2>* at;  // nullptr: Dijkstra
  Vec2 goal;
  Estimate(const std::vector<Vec2>* positions, Vec2 target) : at(positions), goal(target) {}
  double operator()(BoostVertex v) const { return at == nullptr ? 0.0 : distance((*at)[v], goal); }
};

struct Answer {
  double length = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t settled = 0;
  double cpu_s = 0.0;
};

class BoostContestant {
 public:
  explicit BoostContestant(const PlaneGraph& plane) : plane_(plane), g_(plane.at.size()), f_(g_), color_(g_.size()) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
    std::vector<Weight> weights;
    for (const Edge& e : plane.edges) {
      for (const Edge& half : {e, Edge{e.to, e.from}}) {
        ends.emplace_back(half.from, half.to);
        weights.push_back({distance(plane.at[e.from], plane.at[e.to])});
      }
    }
    graph_ = BoostGraph(boost::edges_are_unsorted_multi_pass, ends.begin(), ends.end(), weights.begin(),
                        static_cast<std::uint32_t>(plane.at.size()));
    parent_.resize(plane.at.size());
  }
  Answer run(bool use_heuristic) {
    Answer answer;
    const Stopwatch watch;
    const auto index = get(boost::vertex_index, graph_);
    const auto map = [&](auto& values) { return boost::make_iterator_property_map(values.begin(), index); };
    try {
      boost::astar_search(graph_, plane_.start, Estimate(use_heuristic ? &plane_.at : nullptr, plane_.at[plane_.goal]),
                          boost::weight_map(get(&Weight::length, graph_))
                              .distance_map(map(g_))
                              .rank_map(map(f_))
                              .predecessor_map(map(parent_))
                              .color_map(map(color_))
                              .visitor(StopAtGoal(plane_.goal, &answer.settled)));
    } catch (const Found&) {
      answer.length = g_[plane_.goal];
    }
    answer.cpu_s = watch.read().cpu_s;
    return answer;
  }

 private:
  const PlaneGraph& plane_;
  BoostGraph graph_;
  std::vector<double> g_;
  std::vector<double> f_;
  std::vector<BoostVertex> parent_;
  std::vector<boost::default_color_type> color_;
};

class WarrenContestant {
 public:
  explicit WarrenContestant(const PlaneGraph& plane) : plane_(plane) {
    const Graph rows = plain_graph(plane.at.size(), plane.edges);
    RawVector<EdgeEnd> offsets(1, 0);
    RawVector<VertexId> targets;
    RawVector<double> lengths;
    for (VertexId v = 0; v < rows.vertex_count(); ++v) {
      for (const VertexId w : rows.neighbours(v)) {
        targets.push_back(w);
        lengths.push_back(distance(plane.at[v], plane.at[w]));
      }
      offsets.push_back(static_cast<EdgeEnd>(targets.size()));
    }
    graph_ = Graph(std::move(offsets), std::move(targets), std::move(lengths));
    heap_.resize(plane.at.size());
    state_.resize(plane.at.size());
  }
  Answer run(bool use_heuristic) {
    const Stopwatch watch;
    heap_.clear();
    state_.clear();
    const auto neighbours = [&](VertexId v, const auto& visit) {
      const auto row = graph_.neighbours(v);
      const auto lengths = graph_.lengths(v);
      for (std::size_t i = 0; i < row.size(); ++i) visit(row[i], lengths[i]);
    };
    const Vec2 goal = plane_.at[plane_.goal];
    const auto to_goal = [&](VertexId v) { return use_heuristic ? distance(plane_.at[v], goal) : 0.0; };
    const SearchResult result = best_first(plane_.start, plane_.goal, neighbours, to_goal, heap_, state_, NeverStop());
    return {result.length, result.expanded, watch.read().cpu_s};
  }

 private:
  const PlaneGraph& plane_;
  Graph graph_;
  IndexedHeap<4> heap_;
  SearchState state_;
};

void compare(const std::string& name, const PlaneGraph& plane, int repeats) {
  BoostContestant boost_side(plane);
  WarrenContestant warren_side(plane);
  for (const bool use_heuristic : {true, false}) {
    Answer best[2];
    for (int i = 0; i < repeats; ++i) {
      const Answer now[2] = {warren_side.run(use_heuristic), boost_side.run(use_heuristic)};
      if (!(std::abs(now[0].length - now[1].length) <= 1e-9 * now[0].length))
        throw std::runtime_error(name + ": lengths differ");
      for (int k = 0; k < 2; ++k) {
        if (i == 0 || now[k].cpu_s < best[k].cpu_s) best[k] = now[k];
      }
    }
    const auto per_settled = [](const Answer& a) { return 1e9 * a.cpu_s / static_cast<double>(a.settled); };
    std::printf("%-26s %-8s %12.3f %10llu %8.1f %10llu %8.1f %7.2f\n", name.c_str(), use_heuristic ? "A*" : "Dijkstra",
                best[0].length, static_cast<unsigned long long>(best[0].settled), per_settled(best[0]),
                static_cast<unsigned long long>(best[1].settled), per_settled(best[1]), best[1].cpu_s / best[0].cpu_s);
  }
}

}  // namespace
}  // namespace warren::bench

int main(int argc, char** argv) {
  using namespace warren::bench;
  const std::size_t vertices = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 5;
  if (vertices < 100 || vertices > 100'000'000 || repeats < 1) {
    std::fprintf(stderr, "usage: rival_boost_graph [VERTICES [REPEATS]], 100 to 10^8 vertices\n");
    return 2;
  }
  const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(vertices)));
  std::printf("%-26s %-8s %12s %10s %8s %10s %8s %7s\n", "graph", "search", "length", "settled", "ns", "Boost's", "ns",
              "ratio");
  for (const bool shuffled : {false, true}) {
    const std::string order = shuffled ? ", random ids" : "";
    compare("maze" + order, lattice(side, true, 0.0, shuffled), repeats);
    compare("maze with loops" + order, lattice(side, true, 0.1, shuffled), repeats);
    compare("geometric" + order, random_geometric(vertices / 4, 20.0, shuffled), repeats);
  }
  return 0;
}
