// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/axis_graph.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "parallel/assemble_graph.hpp"
#include "parallel/polled_sort.hpp"
#include "planners/roadmap/queue_choice.hpp"

namespace warren {
namespace {
constexpr std::size_t links_per_poll = 1 << 14;
}  // namespace

AxisGraph::AxisGraph(const MedialAxis& axis, const AxisPlace& start, const AxisPlace& goal, double clearance,
                     const Execution& execution)
    : axis_(axis), execution_(execution), ends_{start, goal} {
  const double least = std::max(clearance, axis.resolution());
  for (std::uint32_t i = 0; i < axis.edges().size(); ++i) {
    if (i % links_per_poll == 0) execution_.check();
    const AxisEdge& e = axis.edges()[i];
    if (e.clearance < least) continue;
    const AxisCurve curve = axis.curve(e);
    links_.push_back({e.from, e.to, i, curve.first(), curve.last(), e.length, e.clearance});
  }
  join(this->start(), least);
  join(this->goal(), least);
  if (start.edge == goal.edge) add(this->start(), this->goal(), start.edge, start.parameter, goal.parameter, least);
  index_links();
}

void AxisGraph::add(VertexId from, VertexId to, std::uint32_t edge, double first, double last, double clearance) {
  const AxisEdge& e = axis_.edges()[edge];
  const AxisCurve part = axis_.curve(e).part(first, last).between(place(from), place(to));
  const double room = axis_.least_clearance(e, part);
  if (room >= clearance) links_.push_back({from, to, edge, first, last, part.length(), room});
}

/// Links one of the ends with both vertices of its edge.
void AxisGraph::join(VertexId v, double clearance) {
  const AxisPlace& place = ends_[v - start()];
  const AxisEdge& e = axis_.edges()[place.edge];
  const AxisCurve curve = axis_.curve(e);
  add(v, e.from, place.edge, place.parameter, curve.first(), clearance);
  add(v, e.to, place.edge, place.parameter, curve.last(), clearance);
}

void AxisGraph::index_links() {
  first_.assign(vertex_count() + 1, 0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (i % links_per_poll == 0) execution_.check();
    ++first_[links_[i].from + 1];
    ++first_[links_[i].to + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  at_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < links_.size(); ++i) {
    if (i % links_per_poll == 0) execution_.check();
    at_[next[links_[i].from]++] = i;
    at_[next[links_[i].to]++] = i;
  }
}

Graph AxisGraph::graph() const {
  std::vector<Edge> edges;
  edges.reserve(links_.size());
  for (const AxisLink& l : links_) {
    if (l.from != l.to) edges.push_back({l.from, l.to});
  }
  return assemble_graph(vertex_count(), edges, execution_);
}

double AxisGraph::widest() const {
  std::vector<std::uint32_t> order(links_.size());
  std::iota(order.begin(), order.end(), 0U);
  polled_sort(order.begin(), order.end(), execution_, [&](std::uint32_t i, std::uint32_t j) {
    return links_[i].clearance != links_[j].clearance ? links_[i].clearance > links_[j].clearance : i < j;
  });
  std::vector<VertexId> parent(vertex_count());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](VertexId v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n % links_per_poll == 0) execution_.check();
    const std::uint32_t i = order[n];
    parent[root(links_[i].from)] = root(links_[i].to);
    if (root(start()) == root(goal())) return links_[i].clearance;
  }
  return -1.0;
}

void AxisGraph::narrow_to(double clearance) {
  std::erase_if(links_, [&](const AxisLink& l) { return l.clearance < clearance; });
  index_links();
}

SearchResult AxisGraph::search(SearchKind search, QueueKind queue_kind) const {
  const auto should_stop = [&] { return execution_.should_stop(); };
  SearchState state;
  state.resize(vertex_count(), [&] { execution_.check(); });
  SearchResult found;
  if (search == SearchKind::bfs || search == SearchKind::dfs) {
    found = search == SearchKind::bfs ? breadth_first(graph(), start(), goal(), state, should_stop)
                                      : depth_first(graph(), start(), goal(), state, should_stop);
  } else {
    const auto neighbours = [&](VertexId v, const auto& visit) {
      for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
        const AxisLink& l = links_[at_[i]];
        visit(l.from == v ? l.to : l.from, l.length);
      }
    };
    const bool informed = search == SearchKind::astar;
    const auto estimate = [&](VertexId v) { return informed ? distance(place(v), place(goal())) : 0.0; };
    found = with_queue(queue_kind, vertex_count(), execution_, [&](auto& queue) {
      return best_first(start(), goal(), neighbours, estimate, queue, state, should_stop);
    });
  }
  if (found.status == SearchStatus::stopped) execution_.check();
  return found;
}

const AxisLink& AxisGraph::link_between(VertexId v, VertexId w) const {
  const AxisLink* best = nullptr;
  for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
    const AxisLink& l = links_[at_[i]];
    if ((l.from == v ? l.to : l.from) != w) continue;
    if (best == nullptr || l.length < best->length) best = &l;
  }
  assert(best != nullptr);
  return *best;
}

std::vector<Vec2> AxisGraph::polyline(std::span<const VertexId> path) const {
  std::vector<Vec2> points{place(path.front())};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const AxisLink& l = link_between(path[i - 1], path[i]);
    const bool forward = l.from == path[i - 1];
    const AxisCurve curve = axis_.curve(axis_.edges()[l.edge]);
    const AxisCurve part = curve.part(forward ? l.first : l.last, forward ? l.last : l.first);
    part.between(place(path[i - 1]), place(path[i])).append_polyline(points);
  }
  return points;
}

}  // namespace warren
