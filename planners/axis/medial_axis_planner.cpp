// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/medial_axis_planner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/wall_set.hpp"
#include "core/search/search.hpp"
#include "core/search/union_find.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double margin = 1.0 + 1e-12;

/// Is high - low >= r? Exact: the rounding error of the difference decides where it rounds to r.
bool is_apart(double low, double high, double r) noexcept {
  const double difference = high - low;
  if (difference != r) return difference > r;
  const double taken = high - difference;
  const double error = (high - (difference + taken)) + (taken - low);
  return error >= 0.0;
}

bool boxes_are_apart(const Box& a, const Box& b, double r) noexcept {
  return is_apart(a.max.x, b.min.x, r) || is_apart(b.max.x, a.min.x, r) || is_apart(a.max.y, b.min.y, r) ||
         is_apart(b.max.y, a.min.y, r);
}

// How a point gets onto the axis: straight away from its nearest obstacle until another one is as near (the
// retraction). On the way the distance to the nearest obstacle grows, so the leg has the clearance of its first point.
// O(axis).

constexpr double tolerance = 1e-6;  // of the frame's size: how well a computed point must fit a curve
constexpr double noise = 1e-7;      // of that: p lies on the axis

/// A place on the axis.
struct AxisPlace {
  std::uint32_t edge;  ///< its number
  double parameter;    ///< on the edge's curve
  Vec2 at;
};

/// Away from the nearest site, from p on.
struct Retraction {
  std::uint32_t site;
  Vec2 from, direction;
  double room;  ///< distance of p to the site

  /// How far the ray goes until the other site is as near; infinite if never.
  double reach(const Segment& other) const {
    const Vec2 to_p = from - other.a;
    if (is_point(other)) {
      const double closing = dot(direction, to_p) - room;
      return closing < 0.0 ? 0.5 * (room * room - dot(to_p, to_p)) / closing : infinity;
    }
    const Vec2 along = (1.0 / distance(other.a, other.b)) * (other.b - other.a);
    const double height = cross(along, to_p);
    const double rise = cross(along, direction);
    const double speed = height < 0.0 || (height == 0.0 && rise < 0.0) ? -rise : rise;
    return speed < 1.0 ? (std::abs(height) - room) / (1.0 - speed) : infinity;
  }
};

std::optional<Retraction> retraction_of(const MedialAxis& axis, Vec2 p, const Execution& execution) {
  const std::vector<VoronoiSite>& sites = axis.sites;
  Retraction best{0, p, {}, infinity};
  for (std::uint32_t s = 0; s < sites.size(); ++s) {
    execution.poll(s);
    const double d = distance(p, sites[s].shape);
    // An end of a segment is a site of its own, and comes first where both are as near.
    if (d < best.room || (d == best.room && is_point(sites[s].shape))) {
      best.room = d;
      best.site = s;
    }
  }
  const Segment& site = sites[best.site].shape;
  const Vec2 away = p - nearest_point(p, site);
  if (!is_point(site)) {
    const Vec2 along = site.b - site.a;
    Vec2 normal{-along.y, along.x};
    const Vec2 inwards = 0.5 * (axis.frame.min + axis.frame.max) - p;  // for points on the frame
    if (dot(normal, best.room > 0.0 ? away : inwards) < 0.0) normal = -1.0 * normal;
    best.direction = (1.0 / norm(normal)) * normal;
  } else if (best.room > 0.0) {
    best.direction = (1.0 / norm(away)) * away;
  } else {
    return std::nullopt;
  }
  return best;
}

/// Where p, free and inside the frame, retracts to; none where rounding hides it, or where p touches an obstacle.
std::optional<AxisPlace> retract(const MedialAxis& axis, Vec2 p, const Execution& execution) {
  const std::optional<Retraction> ray = retraction_of(axis, p, execution);
  if (!ray) return std::nullopt;
  const double fit = tolerance * std::max(axis.frame.width(), axis.frame.height());
  std::optional<AxisPlace> found;
  double nearest = infinity;
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    execution.poll(i);
    const AxisEdge& edge = axis.edges[i];
    if (edge.site != ray->site && edge.other != ray->site) continue;
    const std::uint32_t other = edge.site == ray->site ? edge.other : edge.site;
    const double reach = std::max(0.0, ray->reach(axis.sites[other].shape));
    if (!(reach < nearest)) continue;
    const AxisCurve curve = axis.curve(edge);
    const Vec2 hit = p + reach * ray->direction;
    const double low = std::min(curve.first(), curve.last());
    const double high = std::max(curve.first(), curve.last());
    const double parameter = std::clamp(curve.parameter_beside(hit), low, high);
    if (distance(curve.at(parameter), hit) > fit) continue;
    nearest = reach;
    const Vec2 at = curve.at(parameter);
    found = AxisPlace{i, parameter, distance(at, p) <= noise * fit ? p : at};
  }
  return found;
}

/// A stretch of one of the axis' edges between two vertices of the graph.
struct AxisLink {
  VertexId from, to;
  std::uint32_t edge;
  double first, last;  ///< parameters on the edge's curve, at `from` and at `to`
  double length;
  double clearance;
};

constexpr std::size_t links_per_poll = 1 << 14;

/// What of a medial axis may be travelled with a clearance, as a graph between two places on it: the edges that are
/// wide enough, and the wide enough parts of the edges on which the two places lie. O(edges) to build, O(edges log
/// edges) to find the widest way. The axis' vertices, behind them the start and the goal. Refers to the axis and the
/// execution; what takes longer than a path throws Stopped.
class AxisGraph {
 public:
  /// Keeps what has at least this clearance and more than the axis' resolution.
  AxisGraph(const MedialAxis& axis, const AxisPlace& start, const AxisPlace& goal, double clearance,
            const Execution& execution)
      : axis_(axis), execution_(execution), ends_{start, goal} {
    const double least = std::max(clearance, axis.resolution);
    for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
      if (i % links_per_poll == 0) execution_.check();
      const AxisEdge& e = axis.edges[i];
      if (e.clearance < least) continue;
      const AxisCurve curve = axis.curve(e);
      push_asked(links_, {e.from, e.to, i, curve.first(), curve.last(), e.length, e.clearance}, execution_);
    }
    join(this->start(), least);
    join(this->goal(), least);
    if (start.edge == goal.edge) add(this->start(), this->goal(), start.edge, start.parameter, goal.parameter, least);
    index_links();
  }

  std::size_t vertex_count() const { return axis_.vertices.size() + 2; }
  VertexId start() const { return static_cast<VertexId>(axis_.vertices.size()); }
  VertexId goal() const { return start() + 1; }
  Vec2 place(VertexId v) const { return v < start() ? axis_.vertices[v] : ends_[v - start()].at; }
  const std::vector<AxisLink>& links() const { return links_; }
  Graph graph() const {
    std::vector<Edge> edges;
    execution_.reserve(links_.size() * sizeof(Edge));
    edges.reserve(links_.size());
    for (const AxisLink& l : links_) {
      execution_.poll(edges.size());
      if (l.from != l.to) edges.push_back({l.from, l.to});
    }
    return assemble_graph(vertex_count(), edges, execution_);
  }

  /// Leaves the links of the largest clearance with which start and goal, which are joined, still are.
  void narrow_to_widest() {
    execution_.reserve(links_.size() * sizeof(std::uint32_t) + vertex_count() * sizeof(VertexId));
    std::vector<std::uint32_t> order(links_.size());
    std::iota(order.begin(), order.end(), 0U);
    polled_sort(order.begin(), order.end(), execution_,
                [&](std::uint32_t i, std::uint32_t j) { return links_[i].clearance > links_[j].clearance; });
    std::vector<VertexId> parent(vertex_count());
    std::iota(parent.begin(), parent.end(), 0U);
    double widest = infinity;
    for (std::size_t n = 0; root_of(parent, start()) != root_of(parent, goal()); ++n) {
      if (n % links_per_poll == 0) execution_.check();
      const AxisLink& next = links_[order[n]];
      unite(parent, next.from, next.to);
      widest = next.clearance;
    }
    std::erase_if(links_, [&](const AxisLink& l) { return l.clearance < widest; });
    index_links();
  }
  /// Start to goal; lengths are the curves' for A* and Dijkstra, numbers of links else.
  SearchResult search(SearchKind search, QueueKind queue_kind) const {
    SearchState state;
    SearchResult found;
    if (!has_queue(search)) {
      found = search_blindly(search, graph(), start(), goal(), state, execution_);
    } else {
      const auto neighbours = [&](VertexId v, const auto& visit) {
        for (const std::uint32_t i : links_at_.of(v)) {
          const AxisLink& l = links_[i];
          visit(l.from == v ? l.to : l.from, l.length);
        }
      };
      const bool informed = search == SearchKind::astar;
      const auto estimate = [&](VertexId v) { return informed ? distance(place(v), place(goal())) : 0.0; };
      found = search_best_first(queue_kind, vertex_count(), start(), goal(), neighbours, estimate, state, execution_);
    }
    if (found.status == SearchStatus::stopped) execution_.check();
    return found;
  }
  /// The link between two vertices that follow each other in a path: the shortest one, where several do.
  const AxisLink& link_between(VertexId v, VertexId w) const {
    const AxisLink* best = nullptr;
    for (const std::uint32_t i : links_at_.of(v)) {
      const AxisLink& l = links_[i];
      if ((l.from == v ? l.to : l.from) != w) continue;
      if (best == nullptr || l.length < best->length) best = &l;
    }
    assert(best != nullptr);
    return *best;
  }
  /// Appends the polyline along a link from one of its vertices to the other, without its first point.
  void append_polyline(const AxisLink& l, VertexId from, VertexId to, std::vector<Vec2>& points) const {
    const auto [first, last] = l.from == from ? std::pair(l.first, l.last) : std::pair(l.last, l.first);
    axis_.curve(axis_.edges[l.edge]).part(first, last, place(from), place(to)).append_polyline(points);
  }

 private:
  void add(VertexId from, VertexId to, std::uint32_t edge, double first, double last, double clearance) {
    const AxisEdge& e = axis_.edges[edge];
    const AxisCurve part = axis_.curve(e).part(first, last, place(from), place(to));
    const double room = axis_.least_clearance(e, part);
    if (room >= clearance) push_asked(links_, {from, to, edge, first, last, part.length(), room}, execution_);
  }
  /// Links one of the ends with both vertices of its edge.
  void join(VertexId v, double clearance) {
    const AxisPlace& place = ends_[v - start()];
    const AxisEdge& e = axis_.edges[place.edge];
    const AxisCurve curve = axis_.curve(e);
    add(v, e.from, place.edge, place.parameter, curve.first(), clearance);
    add(v, e.to, place.edge, place.parameter, curve.last(), clearance);
  }
  void index_links() {
    execution_.reserve((vertex_count() + 2 * links_.size()) * sizeof(std::uint32_t));
    const auto each = [&](const auto& visit) {
      for (std::uint32_t i = 0; i < links_.size(); ++i) {
        if (i % links_per_poll == 0) execution_.check();
        visit(links_[i].from, i);
        visit(links_[i].to, i);
      }
    };
    links_at_ = items_by_key(vertex_count(), each, [&] { execution_.check(); });
  }

  const MedialAxis& axis_;
  const Execution& execution_;
  std::array<AxisPlace, 2> ends_;
  std::vector<AxisLink> links_;
  ItemsByKey links_at_;  // each vertex, by number
};

constexpr double planning_factor = 1.0 + 1e-9;  // the clearance that is asked for where rounding costs the exact one
constexpr std::size_t most_candidates = 64;

bool line_keeps_clearance(const WallIndex& walls, std::span<const Vec2> line, double r, const Execution& execution) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (i % 1024 == 0) execution.check();
    if (!certainly_keeps_clearance(walls, {line[i - 1], line[i]}, r)) return false;
  }
  return true;
}

/// One plan: the steps share the question and fill in the solution.
class AxisPlanning {
 public:
  AxisPlanning(Vec2 start, Vec2 goal, const MedialAxisOptions& options, const Execution& execution)
      : start_(start), goal_(goal), options_(options), execution_(execution) {
    if (options.clearance >= 0.0 && options.clearance <= largest_coordinate) return;
    throw InputError("clearance", "expected a finite number >= 0", std::to_string(options.clearance));
  }

  void run(const PlaneObstacles& obstacles) {
    if (obstacles.polygons.empty() && obstacles.walls.empty() && !obstacles.bounds) {
      solution_.outcome = Outcome::solved;
      solution_.path = {start_, goal_};
      plan_.axis_clearance = infinity;
      return;
    }
    {
      const StageTimer timer(execution_, "medial axis", solution_.seconds.graph);
      plan_.made.emplace(obstacles, execution_);
    }
    run(*plan_.made);
  }
  void run(const AxisRoadmap& roadmap) {
    roadmap_ = &roadmap;
    if (ends_are_blocked() || !join_ends()) return;
    // With exactly the clearance first: a gap that is just as wide as the disc is a way. Where rounding spoils that,
    // with a little more room.
    if (plan(options_.clearance) && !keeps_clearance()) {
      solution_.path.clear();
      if (plan(std::max(options_.clearance * planning_factor, axis().resolution)) && !keeps_clearance()) {
        solution_.outcome = Outcome::not_connected;
        solution_.path.clear();
      }
    }
  }
  Solution<Vec2>& solution() { return solution_; }
  MedialAxisPlan& kept() { return plan_; }

 private:
  const MedialAxis& axis() const { return roadmap_->axis; }
  bool ends_are_blocked() {
    const auto fits = [&, &polygons = roadmap_->polygons](Vec2 p) {
      if (!axis().frame.contains(p)) return false;
      for (std::size_t i = 0; i < polygons.size(); ++i) {
        execution_.poll(i);
        if (strictly_inside(polygons[i], p)) return false;
      }
      return is_clear({p, p});
    };
    const bool start_fits = fits(start_);
    if (start_fits && fits(goal_)) return false;
    solution_.outcome = start_fits ? Outcome::goal_blocked : Outcome::start_blocked;
    return true;
  }
  bool is_clear(const Segment& leg) const {
    double room = infinity;  // to the nearest true obstacle
    for (std::size_t i = 0; i < axis().true_obstacle_count; ++i) {
      execution_.poll(i);
      room = std::min(room, distance(leg, axis().obstacles[i]));
    }
    return room >= options_.clearance && room > 0.0;
  }
  bool join_ends() {
    const StageTimer timer(execution_, "join", solution_.seconds.connect);
    start_place_ = join(start_);
    goal_place_ = join(goal_);
    return start_place_ && goal_place_;
  }
  std::optional<AxisPlace> join(Vec2 p) const {
    const std::optional<AxisPlace> place = retract(axis(), p, execution_);
    if (place && is_clear({p, place->at})) return place;
    return nearest_clear(p);
  }
  /// Where rounding hides the retraction: the nearest vertex in sight.
  std::optional<AxisPlace> nearest_clear(Vec2 p) const {
    std::vector<std::pair<double, std::uint32_t>> near;
    const std::vector<AxisEdge>& edges = axis().edges;
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      execution_.poll(i);
      push_asked(near, {distance(p, axis().vertices[edges[i].from]), i}, execution_);
    }
    const std::size_t count = std::min(most_candidates, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    for (std::size_t i = 0; i < count; ++i) {
      execution_.check();
      const AxisEdge& edge = edges[near[i].second];
      const Vec2 at = axis().vertices[edge.from];
      if (is_clear({p, at})) return AxisPlace{near[i].second, axis().curve(edge).first(), at};
    }
    return std::nullopt;
  }
  /// Searches with this clearance; true if there is a path.
  bool plan(double clearance) {
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    AxisGraph graph(axis(), *start_place_, *goal_place_, clearance, execution_);
    solution_.outcome = Outcome::not_connected;
    if (!ends_are_joined(graph)) return false;
    if (options_.objective == AxisObjective::clearance) graph.narrow_to_widest();
    const SearchResult found = graph.search(options_.search, options_.queue);
    solution_.counters.expanded += found.expanded;
    if (found.status != SearchStatus::found) return false;
    plan_.axis_length = 0.0;
    plan_.axis_clearance = infinity;
    std::vector<Vec2> path{start_, graph.place(found.path.front())};
    for (std::size_t i = 1; i < found.path.size(); ++i) {
      if (i % 1024 == 0) execution_.reserve(2 * path.size() * sizeof(Vec2));
      const AxisLink& link = graph.link_between(found.path[i - 1], found.path[i]);
      plan_.axis_length += link.length;
      plan_.axis_clearance = std::min(plan_.axis_clearance, link.clearance);
      graph.append_polyline(link, found.path[i - 1], found.path[i], path);
    }
    path.push_back(goal_);
    path.erase(std::unique(path.begin(), path.end()), path.end());
    if (path.size() == 1) path.push_back(path.front());
    execution_.reserve(path.size() * sizeof(Vec2));
    solution_.path.assign(path.begin(), path.end());
    solution_.outcome = Outcome::solved;
    return true;
  }
  bool ends_are_joined(const AxisGraph& axis_graph) {
    const Graph graph = axis_graph.graph();
    const Components parts = components(graph, execution_);
    std::uint64_t lonely = 0;  // vertices that only narrow curves reach
    for (VertexId v = 0; v < axis_graph.start(); ++v) lonely += graph.degree(v) == 0 ? 1U : 0U;
    solution_.roadmap = {axis_graph.vertex_count() - lonely, axis_graph.links().size(), parts.count - lonely};
    if (parts.connected(axis_graph.start(), axis_graph.goal())) return true;
    solution_.separation = separation_of_parts<2>(parts, axis_graph.start(), axis_graph.goal(), execution_,
                                                  [&](VertexId v) { return axis_graph.place(v); });
    return false;
  }
  /// Does the polyline keep the clearance for sure, as an exact verification will ask?
  bool keeps_clearance() {
    const StageTimer timer(execution_, "check", solution_.seconds.connect);
    return line_keeps_clearance(roadmap_->index, solution_.path, options_.clearance, execution_);
  }

  const Vec2 start_, goal_;
  const MedialAxisOptions& options_;
  const Execution& execution_;
  const AxisRoadmap* roadmap_ = nullptr;  // that is asked, or the plan's own
  MedialAxisPlan plan_;
  std::optional<AxisPlace> start_place_, goal_place_;
  Solution<Vec2> solution_;
};

/// Ground: the obstacles, or a roadmap.
template <class Ground>
Solution<Vec2> plan_on(const Ground& ground, Vec2 start, Vec2 goal, const MedialAxisOptions& options,
                       const Execution& execution, MedialAxisPlan* keep) {
  AxisPlanning planning(start, goal, options, execution);
  Solution<Vec2> solution = run_plan(planning, ground);
  if (keep != nullptr) *keep = std::move(planning.kept());
  return solution;
}

}  // namespace

bool certainly_keeps_clearance(const WallIndex& walls, const Segment& leg, double r) noexcept {
  if (r == 0.0) return !walls.blocks(leg.a, leg.b);
  if (walls.keeps_clearance(leg.a, leg.b, r * margin)) return true;
  const Box box = box_of(leg);
  bool keeps = true;
  walls.for_each_near(box.grown(r * margin), [&](const Segment& wall) {
    keeps = boxes_are_apart(box, box_of(wall), r) || segments_keep_distance(leg, wall, r * margin);
    return keeps;
  });
  return keeps;
}

AxisRoadmap::AxisRoadmap(const PlaneObstacles& obstacles, const Execution& execution)
    : polygons(obstacles.polygons),
      axis(obstacles, execution),
      index(WallSet::narrowest(std::span(axis.obstacles).first(axis.true_obstacle_count)), execution) {}

Solution<Vec2> plan_on_medial_axis(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal,
                                   const MedialAxisOptions& options, const Execution& execution, MedialAxisPlan* keep) {
  return plan_on(obstacles, start, goal, options, execution, keep);
}

Solution<Vec2> plan_on_medial_axis(const AxisRoadmap& roadmap, Vec2 start, Vec2 goal, const MedialAxisOptions& options,
                                   const Execution& execution, MedialAxisPlan* keep) {
  return plan_on(roadmap, start, goal, options, execution, keep);
}

StraightLines axis_lines(const AxisRoadmap& roadmap, double clearance, const Execution& execution) {
  const MedialAxis& axis = roadmap.axis;
  const double least = std::max(clearance, axis.resolution);
  StraightLines lines;
  execution.reserve(axis.vertices.size() * sizeof(VertexId));
  std::vector<VertexId> point_of(axis.vertices.size(), no_vertex);  // made where a line first comes by
  const auto point = [&](Vec2 at) {
    push_asked(lines.points, at, execution);
    return static_cast<VertexId>(lines.points.size() - 1);
  };
  const auto vertex = [&](VertexId v) {
    if (point_of[v] == no_vertex) point_of[v] = point(axis.vertices[v]);
    return point_of[v];
  };
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < axis.edges.size(); ++i) {
    if (i % 256 == 0) execution.check();
    const AxisEdge& edge = axis.edges[i];
    if (edge.clearance < least) continue;
    corners.assign(1, axis.vertices[edge.from]);
    axis.curve(edge).append_polyline(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (!line_keeps_clearance(roadmap.index, corners, clearance, execution)) continue;
    VertexId before = vertex(edge.from);
    for (std::size_t c = 1; c < corners.size(); ++c) {
      const VertexId next = c + 1 == corners.size() ? vertex(edge.to) : point(corners[c]);
      if (before != next) push_asked(lines.edges, {std::min(before, next), std::max(before, next)}, execution);
      before = next;
    }
  }
  polled_sort(lines.edges.begin(), lines.edges.end(), execution);
  lines.edges.erase(std::unique(lines.edges.begin(), lines.edges.end()), lines.edges.end());
  return lines;
}

}  // namespace warren
