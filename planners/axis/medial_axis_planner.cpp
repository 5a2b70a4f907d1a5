// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/medial_axis_planner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon_distance.hpp"
#include "core/plane/wall_set.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "core/search/union_find.hpp"
#include "parallel/assemble_graph.hpp"
#include "parallel/components.hpp"
#include "parallel/polled_sort.hpp"
#include "planners/axis/retraction.hpp"
#include "planners/roadmap/queue_choice.hpp"
#include "planners/roadmap/separation.hpp"
#include "planners/roadmap/stopped_solution.hpp"
#include "planners/shorten/certain_clearance.hpp"

namespace warren {
namespace {

// What of a medial axis may be travelled with a clearance, as a graph between two places on it: the edges that are wide
// enough, and the wide enough parts of the edges on which the two places lie. O(edges) to build, O(edges log edges) to
// find the widest way.

/// A stretch of one of the axis' edges between two vertices of the graph.
struct AxisLink {
  VertexId from, to;
  std::uint32_t edge;
  double first, last;  ///< parameters on the edge's curve, at `from` and at `to`
  double length;
  double clearance;
};

/// The axis' vertices, behind them the start and the goal. Refers to the axis and the execution; what takes longer than
/// a path throws Stopped.
class AxisGraph {
 public:
  /// Keeps what has at least this clearance and more than the axis' resolution.
  AxisGraph(const MedialAxis& axis, const AxisPlace& start, const AxisPlace& goal, double clearance,
            const Execution& execution);

  std::size_t vertex_count() const { return axis_.vertices().size() + 2; }
  VertexId start() const { return static_cast<VertexId>(axis_.vertices().size()); }
  VertexId goal() const { return start() + 1; }
  Vec2 place(VertexId v) const { return v < start() ? axis_.vertices()[v] : ends_[v - start()].at; }
  const std::vector<AxisLink>& links() const { return links_; }
  Graph graph() const;

  /// The largest clearance with which start and goal are joined; negative where they aren't at all.
  double widest() const;
  /// Drops links with less clearance.
  void narrow_to(double clearance);
  /// Start to goal; lengths are the curves' for A* and Dijkstra, numbers of links else.
  SearchResult search(SearchKind search, QueueKind queue) const;
  /// The link between two vertices that follow each other in a path: the shortest one, where several do.
  const AxisLink& link_between(VertexId v, VertexId w) const;
  /// The polyline along a search's path, both ends included.
  std::vector<Vec2> polyline(std::span<const VertexId> path) const;

 private:
  void add(VertexId from, VertexId to, std::uint32_t edge, double first, double last, double clearance);
  void join(VertexId v, double clearance);
  void index_links();

  const MedialAxis& axis_;
  const Execution& execution_;
  std::array<AxisPlace, 2> ends_;
  std::vector<AxisLink> links_;
  std::vector<std::uint32_t> first_, at_;  // the links at vertex v are at_[first_[v]] .. at_[first_[v + 1] - 1]
};

constexpr std::size_t links_per_poll = 1 << 14;

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
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n % links_per_poll == 0) execution_.check();
    const std::uint32_t i = order[n];
    unite(parent, links_[i].from, links_[i].to);
    if (root_of(parent, start()) == root_of(parent, goal())) return links_[i].clearance;
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

constexpr double planning_factor = 1.0 + 1e-9;  // the clearance that is asked for where rounding costs the exact one
constexpr std::size_t most_candidates = 64;

WallSet true_obstacles(const MedialAxis& axis) {
  return WallSet::narrowest(std::span(axis.obstacles()).first(axis.true_obstacle_count()));
}

/// One plan: the steps share the question and fill in the solution.
class Planning {
 public:
  Planning(Vec2 start, Vec2 goal, const MedialAxisOptions& options, const Execution& execution)
      : start_(start), goal_(goal), options_(options), execution_(execution) {}

  void run(const PlaneObstacles& obstacles) {
    if (obstacles.polygons.empty() && obstacles.walls.empty() && !obstacles.bounds) return go_straight();
    build_axis(obstacles);
    run(obstacles.polygons);
  }
  void run(const AxisRoadmap& roadmap) {
    axis_ = &roadmap.axis;
    obstacles_ = &roadmap.index;
    run(roadmap.polygons);
  }
  Solution<Vec2>& solution() { return solution_; }
  MedialAxisPlan& kept() { return plan_; }

 private:
  void run(const PolygonSet& polygons) {
    if (ends_are_blocked(polygons) || !join_ends()) return;
    // With exactly the clearance first: a gap that is just as wide as the disc is a way. Where rounding spoils that,
    // with a little more room.
    if (plan(options_.clearance) && !keeps_clearance()) {
      solution_.path.clear();
      if (plan(std::max(options_.clearance * planning_factor, axis().resolution())) && !keeps_clearance()) {
        solution_.outcome = Outcome::not_connected;
        solution_.path.clear();
      }
    }
  }
  const MedialAxis& axis() const { return *axis_; }
  void go_straight();
  void build_axis(const PlaneObstacles& obstacles);
  bool ends_are_blocked(const PolygonSet& polygons);
  bool join_ends();
  std::optional<AxisPlace> join(Vec2 p) const;
  std::optional<AxisPlace> nearest_clear(Vec2 p) const;
  bool is_clear(const Segment& leg) const;
  bool plan(double clearance);
  bool ends_are_joined(const AxisGraph& graph);
  bool keeps_clearance();

  const Vec2 start_, goal_;
  const MedialAxisOptions& options_;
  const Execution& execution_;
  const MedialAxis* axis_ = nullptr;      // the plan's own, or a roadmap's
  const WallIndex* obstacles_ = nullptr;  // that the path is checked against
  std::optional<WallIndex> own_obstacles_;
  MedialAxisPlan plan_;
  AxisPlace start_place_{}, goal_place_{};
  Solution<Vec2> solution_;
};

void Planning::go_straight() {
  solution_.outcome = Outcome::solved;
  solution_.path = {start_, goal_};
  plan_.axis_clearance = std::numeric_limits<double>::infinity();
}

void Planning::build_axis(const PlaneObstacles& obstacles) {
  const StageTimer timer(execution_, "medial axis", solution_.seconds.graph);
  axis_ = &plan_.axis.emplace(obstacles, execution_);
}

bool Planning::ends_are_blocked(const PolygonSet& polygons) {
  const auto fits = [&](Vec2 p) {
    if (!axis().frame().contains(p)) return false;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      if (i % 4096 == 0) execution_.check();
      if (strictly_inside(polygons[i], p)) return false;
    }
    return is_clear({p, p});
  };
  if (!fits(start_)) {
    solution_.outcome = Outcome::start_blocked;
  } else if (!fits(goal_)) {
    solution_.outcome = Outcome::goal_blocked;
  } else {
    return false;
  }
  return true;
}

bool Planning::is_clear(const Segment& leg) const {
  const double room = clearance_of_leg(axis(), leg);
  return room >= options_.clearance && room > 0.0;
}

bool Planning::join_ends() {
  const StageTimer timer(execution_, "join", solution_.seconds.connect);
  const std::optional<AxisPlace> start = join(start_);
  const std::optional<AxisPlace> goal = join(goal_);
  solution_.outcome = Outcome::not_connected;
  if (!start || !goal) return false;
  start_place_ = *start;
  goal_place_ = *goal;
  return true;
}

std::optional<AxisPlace> Planning::join(Vec2 p) const {
  const std::optional<AxisPlace> place = retract(axis(), p);
  if (place && is_clear({p, place->at})) return place;
  return nearest_clear(p);
}

/// Where rounding hides the retraction: the nearest vertex in sight.
std::optional<AxisPlace> Planning::nearest_clear(Vec2 p) const {
  std::vector<std::pair<double, std::uint32_t>> near;
  const std::vector<AxisEdge>& edges = axis().edges();
  for (std::uint32_t i = 0; i < edges.size(); ++i) near.push_back({distance(p, axis().vertices()[edges[i].from]), i});
  const std::size_t count = std::min(most_candidates, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  for (std::size_t i = 0; i < count; ++i) {
    execution_.check();
    const AxisEdge& edge = edges[near[i].second];
    const Vec2 at = axis().vertices()[edge.from];
    if (is_clear({p, at})) return AxisPlace{near[i].second, axis().curve(edge).first(), at};
  }
  return std::nullopt;
}

/// Searches with this clearance; true if there is a path.
bool Planning::plan(double clearance) {
  const StageTimer timer(execution_, "search", solution_.seconds.search);
  AxisGraph graph(axis(), start_place_, goal_place_, clearance, execution_);
  solution_.outcome = Outcome::not_connected;
  if (!ends_are_joined(graph)) return false;
  if (options_.objective == AxisObjective::clearance) graph.narrow_to(graph.widest());
  const SearchResult found = graph.search(options_.search, options_.queue);
  solution_.counters.expanded += found.expanded;
  if (found.status != SearchStatus::found) return false;
  plan_.axis_length = 0.0;
  plan_.axis_clearance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < found.path.size(); ++i) {
    const AxisLink& link = graph.link_between(found.path[i - 1], found.path[i]);
    plan_.axis_length += link.length;
    plan_.axis_clearance = std::min(plan_.axis_clearance, link.clearance);
  }
  Path<Vec2>& path = solution_.path;
  path.assign(1, start_);
  const std::vector<Vec2> line = graph.polyline(found.path);
  path.insert(path.end(), line.begin(), line.end());
  path.push_back(goal_);
  path.erase(std::unique(path.begin(), path.end()), path.end());
  if (path.size() == 1) path.push_back(path.front());
  solution_.outcome = Outcome::solved;
  return true;
}

bool Planning::ends_are_joined(const AxisGraph& axis_graph) {
  const Graph graph = axis_graph.graph();
  const Components parts = components(graph, execution_);
  std::uint64_t lonely = 0;  // vertices that only narrow curves reach
  for (VertexId v = 0; v < axis_graph.start(); ++v) lonely += graph.degree(v) == 0 ? 1U : 0U;
  solution_.roadmap = {axis_graph.vertex_count() - lonely, axis_graph.links().size(), parts.count - lonely};
  if (parts.connected(axis_graph.start(), axis_graph.goal())) return true;
  const auto points_of = [&](VertexId end) {
    std::vector<Vec2> points;
    for (VertexId v = 0; v < axis_graph.vertex_count(); ++v) {
      if (parts.connected(v, end)) points.push_back(axis_graph.place(v));
    }
    return points;
  };
  solution_.separation = separation_between<2>(points_of(axis_graph.start()), points_of(axis_graph.goal()), execution_);
  return false;
}

/// Does the polyline keep the clearance for sure, as an exact verification will ask?
bool Planning::keeps_clearance() {
  const StageTimer timer(execution_, "check", solution_.seconds.connect);
  if (obstacles_ == nullptr) obstacles_ = &own_obstacles_.emplace(true_obstacles(axis()), execution_);
  for (std::size_t i = 1; i < solution_.path.size(); ++i) {
    if (i % 1024 == 0) execution_.check();
    const Segment leg{solution_.path[i - 1], solution_.path[i]};
    if (!certainly_keeps_clearance(*obstacles_, leg, options_.clearance)) return false;
  }
  return true;
}

/// Ground: the obstacles, or a roadmap.
template <class Ground>
Solution<Vec2> plan_on(const Ground& ground, Vec2 start, Vec2 goal, const MedialAxisOptions& options,
                       const Execution& execution, MedialAxisPlan* keep) {
  if (!(options.clearance >= 0.0) || !(options.clearance <= largest_coordinate)) {
    throw InputError("clearance", "expected a finite number >= 0", std::to_string(options.clearance));
  }
  Planning planning(start, goal, options, execution);
  try {
    planning.run(ground);
  } catch (const Stopped& stopped) {
    mark_stopped(planning.solution(), stopped);
  }
  if (keep != nullptr) *keep = std::move(planning.kept());
  return std::move(planning.solution());
}

}  // namespace

AxisRoadmap::AxisRoadmap(const PlaneObstacles& obstacles, const Execution& execution)
    : polygons(obstacles.polygons), axis(obstacles, execution), index(true_obstacles(axis), execution) {}

Solution<Vec2> plan_on_medial_axis(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal,
                                   const MedialAxisOptions& options, const Execution& execution, MedialAxisPlan* keep) {
  return plan_on(obstacles, start, goal, options, execution, keep);
}

Solution<Vec2> plan_on_medial_axis(const AxisRoadmap& roadmap, Vec2 start, Vec2 goal, const MedialAxisOptions& options,
                                   const Execution& execution, MedialAxisPlan* keep) {
  return plan_on(roadmap, start, goal, options, execution, keep);
}

}  // namespace warren
