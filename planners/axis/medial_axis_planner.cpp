// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/medial_axis_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon_distance.hpp"
#include "core/plane/wall_set.hpp"
#include "parallel/components.hpp"
#include "planners/axis/axis_graph.hpp"
#include "planners/axis/retraction.hpp"
#include "planners/roadmap/separation.hpp"
#include "planners/roadmap/stopped_solution.hpp"
#include "planners/shorten/certain_clearance.hpp"

namespace warren {
namespace {

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
