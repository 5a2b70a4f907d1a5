// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/cell_planner.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "core/plane/geometry.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/components.hpp"
#include "planners/graph/no_path.hpp"
#include "planners/graph/queue_choice.hpp"
#include "planners/vertical_cells/polyanya.hpp"

namespace warren {
namespace {

/// The posts on one side of a string, from its last fixed point on: a chain that bends around them.
using RouteChain = std::deque<Vec2>;

/// A string from a point on through gates, each of which has one post: on its left or on its right. Between two calls
/// of tie() the posts come in the sweep's order or against it, so no chain turns by half a circle.
class Funnel {
 public:
  explicit Funnel(Vec2 from) : apex_(from), path_{from} {}

  void pass(Vec2 post, bool on_left) {
    if (post == apex_) return;
    RouteChain& own = on_left ? left_ : right_;
    const int inwards = on_left ? 1 : -1;  // the sign of a turn that keeps the own chain convex
    while (!own.empty()) {
      const Vec2 before = own.size() == 1 ? apex_ : own[own.size() - 2];
      if (orient2d(before, own.back(), post) * inwards > 0) break;
      own.pop_back();
    }
    if (own.empty()) move_apex(on_left ? right_ : left_, post, inwards);
    own.push_back(post);
  }

  /// Fixes the string to a point that it can't but pass.
  void tie(Vec2 at) {
    pass(at, true);
    path_.insert(path_.end(), left_.begin(), left_.end());
    if (!(path_.back() == at)) path_.push_back(at);
    left_.clear();
    right_.clear();
    apex_ = at;
  }

  Path<Vec2> take() { return std::move(path_); }

 private:
  /// Bends the string around the other side's posts that stand in the way to `to`.
  void move_apex(RouteChain& other, Vec2 to, int inwards) {
    while (!other.empty() && orient2d(apex_, other.front(), to) * inwards < 0) {
      apex_ = other.front();
      path_.push_back(apex_);
      other.pop_front();
    }
  }

  Vec2 apex_;
  RouteChain left_, right_;
  Path<Vec2> path_;
};

/// Through the middles of the doors, of which each two in a row belong to one cell; start and goal included.
Path<Vec2> path_through_middles(Vec2 start, Vec2 goal, std::span<const std::uint32_t> doors, const DoorPoints& points) {
  Path<Vec2> path{start};
  for (std::size_t i = 0; i < doors.size(); ++i) {
    if (i > 0) {
      if (const auto bend = points.bend(doors[i - 1], doors[i])) path.push_back(*bend);
    }
    path.push_back(points.middle(doors[i]));
  }
  path.push_back(goal);
  return path;
}

/// The shortest path through the doors; it bends at corners of the obstacles only. It is a string pulled taut through
/// the doors (funnel algorithm: Chazelle 1982; Lee, Preparata 1984). Of each door only its corner counts: the segment
/// at the other end begins and ends at corners that the route passes as well, or that lie behind its ends, and a string
/// that keeps to those keeps to the segment. So every decision is an exact orientation. Where the route turns back (two
/// doors below and above one corner in a row) the string is tied to that corner, and between such corners the route
/// runs from left to right or from right to left, which is all the funnel needs. O(doors).
Path<Vec2> shortest_path_through(const CellRoute& route, const CellDecomposition& cells) {
  const auto is_rightwards = [&](std::size_t i) { return cells.doors[route.doors[i]].left == route.cells[i]; };
  Funnel funnel(route.start);
  for (std::size_t i = 0; i < route.doors.size(); ++i) {
    const Door& door = cells.doors[route.doors[i]];
    const Vec2 corner = cells.corners[door.corner];
    const bool turns_back = i + 1 < route.doors.size() && is_rightwards(i) != is_rightwards(i + 1);
    if (turns_back) {  // the next door stands on the same corner
      funnel.tie(corner);
    } else {
      funnel.pass(corner, is_rightwards(i) != door.above);
    }
  }
  funnel.tie(route.goal);
  return funnel.take();
}

/// Why no path leads from start to goal: how many cells each can reach, and the gap between them.
/// parts: of the graph of the cells, with start and goal behind them in this order. Sizes count cells; the gap is the
/// least distance between the ends and the doors' middles of either side. O(cells).
Separation cell_separation(const CellDecomposition& cells, const Components& parts, Vec2 start, Vec2 goal,
                           const Execution& execution) {
  const auto start_vertex = static_cast<VertexId>(cells.cells.size());
  const VertexId goal_vertex = start_vertex + 1;
  const DoorPoints doors(cells, execution);
  const auto points_of = [&](VertexId vertex, Vec2 end) {
    std::vector<Vec2> points{end};
    for (std::uint32_t d = 0; d < cells.doors.size(); ++d) {
      const Door& door = cells.doors[d];
      if (!door.shut && parts.connected(door.left, vertex)) push_asked(points, doors.middle(d), execution);
    }
    return points;
  };
  Separation result = separation_between<2>(points_of(start_vertex, start), points_of(goal_vertex, goal), execution);
  result.start_size = parts.size_of(start_vertex) - 1;
  result.goal_size = parts.size_of(goal_vertex) - 1;
  return result;
}

/// One plan: the steps share the question and fill in the solution.
class CellPlanning {
 public:
  CellPlanning(Vec2 start, Vec2 goal, const CellOptions& options, const Execution& execution)
      : start_(start), goal_(goal), options_(options), execution_(execution) {}

  void run(const PlaneObstacles& obstacles) {
    decompose_plane(obstacles);
    run();
  }
  void run(const CellRoadmap& roadmap) {
    cells_ = &roadmap.cells;
    points_ = &roadmap.points;
    for (const Vec2 end : {start_, goal_}) plan_.cells.places.push_back(locate(*cells_, roadmap.obstacles, end));
    run();
  }
  Solution<Vec2>& solution() { return solution_; }
  CellPlan& plan() { return plan_; }

 private:
  void run() {
    solution_.roadmap.milestones = cells_->cells.size();
    solution_.roadmap.edges = cells_->doors.size();
    if (ends_are_blocked() || share_a_cell()) return;
    connect_cells();
    if (!ends_are_joined()) return;
    find_route();
    lay_path();
  }
  const CellPlace& start_place() const { return plan_.cells.places[0]; }
  const CellPlace& goal_place() const { return plan_.cells.places[1]; }
  VertexId start_vertex() const { return static_cast<VertexId>(cells_->cells.size()); }
  VertexId goal_vertex() const { return start_vertex() + 1; }

  void decompose_plane(const PlaneObstacles& obstacles) {
    const StageTimer timer(execution_, "cells", solution_.seconds.graph, obstacles.polygons.corners.size());
    const std::array<Vec2, 2> ends{start_, goal_};
    plan_.cells = decompose(obstacles, ends, execution_, options_.overlaps);
    cells_ = &plan_.cells;
  }
  bool ends_are_blocked() {
    if (!start_place().blocked && !goal_place().blocked) return false;
    solution_.outcome = start_place().blocked ? Outcome::start_blocked : Outcome::goal_blocked;
    return true;
  }
  /// Both in one convex cell, or in one point: the straight way.
  bool share_a_cell() {
    const std::vector<VertexId>& s = start_place().cells;
    const auto shared = std::find_first_of(s.begin(), s.end(), goal_place().cells.begin(), goal_place().cells.end());
    if (shared == s.end() && !(start_ == goal_)) return false;
    plan_.route = {start_, goal_, {}, {}};
    if (shared != s.end()) plan_.route.cells.push_back(*shared);
    solution_.outcome = Outcome::solved;
    solution_.path = {start_, goal_};
    return true;
  }
  void connect_cells() {
    const StageTimer timer(execution_, "connect", solution_.seconds.connect, cells_->doors.size());
    std::vector<Edge> edges;
    edges.reserve(cells_->doors.size() + start_place().cells.size() + goal_place().cells.size());
    for (const Door& door : cells_->doors) {
      if (!door.shut) edges.push_back({door.left, door.right});
    }
    for (const VertexId cell : start_place().cells) edges.push_back({start_vertex(), cell});
    for (const VertexId cell : goal_place().cells) edges.push_back({goal_vertex(), cell});
    graph_ = assemble_graph(cells_->cells.size() + 2, edges, execution_);
  }
  bool ends_are_joined() {
    const StageTimer timer(execution_, "components", solution_.seconds.connect);
    const Components parts = components(graph_, execution_);
    solution_.roadmap.components = parts.count;
    if (parts.connected(start_vertex(), goal_vertex())) return true;
    solution_.outcome = Outcome::not_connected;
    solution_.separation = cell_separation(*cells_, parts, start_, goal_, execution_);
    return false;
  }
  void find_route() {
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    const bool over_cells = !has_queue(options_.search);
    const bool by_middles = options_.doors == DoorKind::midpoint;
    plan_.route = {start_, goal_, {}, {}};
    if (!over_cells && !by_middles && follow_taut_route()) return;
    if ((!over_cells || by_middles) && points_ == nullptr) points_ = &own_points_.emplace(*cells_, execution_);
    SearchState state;
    const SearchResult found =
        over_cells ? search_blindly(options_.search, graph_, start_vertex(), goal_vertex(), state, execution_)
                   : search_doors(state);
    solution_.counters.expanded = found.expanded;
    if (found.status == SearchStatus::stopped) execution_.check();
    over_cells ? follow_cells(found.path) : follow_doors(found.path);
  }
  /// Best first over the doors, start and goal behind them.
  SearchResult search_doors(SearchState& state) const {
    const auto count = static_cast<VertexId>(cells_->doors.size());
    const VertexId start = count;
    const VertexId goal = count + 1;
    std::vector<char> holds_goal(cells_->cells.size(), 0);
    for (const VertexId cell : goal_place().cells) holds_goal[cell] = 1;
    const auto neighbours = [&](VertexId v, const auto& visit) {
      if (v == start) {
        for (const VertexId cell : start_place().cells) {
          for_each_door(cell, [&](std::uint32_t d) { visit(d, distance(start_, points_->middle(d))); });
        }
        return;
      }
      const Door& door = cells_->doors[v];
      for (const std::uint32_t cell : {door.left, door.right}) {
        for_each_door(cell, [&](std::uint32_t d) {
          if (d != v) visit(d, points_->leg_length(v, d));
        });
        if (holds_goal[cell] != 0) visit(goal, distance(points_->middle(v), goal_));
      }
    };
    const bool informed = options_.search == SearchKind::astar;
    const auto estimate = [&](VertexId v) {
      if (!informed || v == goal) return 0.0;
      return distance(v == start ? start_ : points_->middle(v), goal_);
    };
    return search_best_first(options_.queue, count + 2, start, goal, neighbours, estimate, state, execution_);
  }
  /// cells: start's vertex, cells, goal's vertex.
  void follow_cells(std::span<const VertexId> cells) {
    CellRoute& route = plan_.route;
    route.cells.assign(cells.begin() + 1, cells.end() - 1);
    for (std::size_t i = 1; i < route.cells.size(); ++i) {
      route.doors.push_back(door_between(route.cells[i - 1], route.cells[i]));
    }
    middles_ = route.doors;
  }
  /// False where nothing is left although the cells are connected, since rounding has cut the last way off: then a way
  /// through the doors' middles does.
  bool follow_taut_route() {
    const bool informed = options_.search == SearchKind::astar;
    TautRoute found = shortest_taut_route(*cells_, plan_.cells.places, start_, goal_, informed, execution_);
    solution_.counters.expanded = found.expanded;
    plan_.route.cells = std::move(found.cells);
    plan_.route.doors = std::move(found.doors);
    return !plan_.route.cells.empty();
  }
  /// doors: start's vertex, doors, goal's vertex. A door that is reached but not passed (all legs lie in one cell) is
  /// left out, at the ends too.
  void follow_doors(std::span<const VertexId> doors) {
    CellRoute& route = plan_.route;
    middles_.assign(doors.begin() + 1, doors.end() - 1);
    const auto holds = [](const CellPlace& place, std::uint32_t cell) {
      return std::binary_search(place.cells.begin(), place.cells.end(), cell);
    };
    const std::size_t last = doors.size() - 2;
    for (std::size_t i = 1; i <= last; ++i) {
      const std::uint32_t door = doors[i];
      if (i == 1) {  // if start stands in the cell beyond as well, this door need not be passed
        const Door& d = cells_->doors[door];
        const std::uint32_t next = i < last                      ? cells_->shared_cell(door, doors[i + 1])
                                   : holds(goal_place(), d.left) ? d.left
                                                                 : d.right;
        const std::uint32_t other = cells_->beyond(door, next);
        route.cells.push_back(holds(start_place(), next) ? next : other);
        if (route.cells.back() == next) continue;
      }
      const std::uint32_t beyond = cells_->beyond(door, route.cells.back());
      if (i < last && cells_->shared_cell(door, doors[i + 1]) != beyond) continue;
      if (i == last && holds(goal_place(), route.cells.back())) continue;
      route.doors.push_back(door);
      route.cells.push_back(beyond);
    }
  }
  void lay_path() {
    const StageTimer timer(execution_, "path", solution_.seconds.search);
    Path<Vec2>& path = solution_.path;
    path = options_.doors == DoorKind::midpoint ? path_through_middles(start_, goal_, middles_, *points_)
                                                : shortest_path_through(plan_.route, *cells_);
    path.erase(std::unique(path.begin(), path.end()), path.end());
    if (path.size() == 1) path.push_back(path.front());
    solution_.outcome = Outcome::solved;
  }
  std::uint32_t door_between(std::uint32_t cell, std::uint32_t next) const {
    std::uint32_t found = no_number;
    for_each_door(cell, [&](std::uint32_t door) {
      if (cells_->beyond(door, cell) == next) found = door;
    });
    return found;
  }
  template <class Visit>
  void for_each_door(std::uint32_t cell, const Visit& visit) const {
    for (const std::uint32_t door : cells_->cells[cell].doors) {
      if (door != no_number && !cells_->doors[door].shut) visit(door);
    }
  }

  const Vec2 start_, goal_;
  const CellOptions& options_;
  const Execution& execution_;
  const CellDecomposition* cells_ = nullptr;  // the plan's own, or a roadmap's; the places are the plan's
  CellPlan plan_;
  std::vector<std::uint32_t> middles_;  // doors whose middles the searched path joins
  Graph graph_;
  const DoorPoints* points_ = nullptr;
  std::optional<DoorPoints> own_points_;
  Solution<Vec2> solution_;
};

}  // namespace

DoorPoints::DoorPoints(const CellDecomposition& cells, const Execution& execution) : cells_(cells) {
  execution.reserve(cells.doors.size() * sizeof(Vec2));
  middles_.resize(cells.doors.size());
  for_each_index<std::uint32_t>(cells.doors.size(), 16384, execution,
                                [&](std::uint32_t door) { middles_[door] = middle_of(door); });
}

Vec2 DoorPoints::middle_of(std::uint32_t door) const {
  const Door& d = cells_.doors[door];
  const Vec2 corner = cells_.corners[d.corner];
  const std::uint32_t far = cells_.far_segment(door);
  const bool on_right = far == CellDecomposition::floor_segment && corner.x == cells_.box.max.x;
  const bool on_left = far == CellDecomposition::ceiling_segment && corner.x == cells_.box.min.x;
  if (d.above ? on_left : on_right) return corner;  // between corner and box: what lies there on the box may be a wall
  const Vec2 middle{corner.x, 0.5 * corner.y + 0.5 * cells_.height(far, corner.x)};
  const bool fits = d.above ? middle.y > corner.y && cells_.side(far, middle) < 0
                            : middle.y < corner.y && cells_.side(far, middle) > 0;
  return fits ? middle : corner;
}

bool DoorPoints::strictly_inside(const VerticalCell& cell, Vec2 p) const {
  const double left = cell.left == no_number ? cells_.box.min.x : cells_.corners[cell.left].x;
  const double right = cell.right == no_number ? cells_.box.max.x : cells_.corners[cell.right].x;
  return left < p.x && p.x < right && cells_.side(cell.lower, p) > 0 && cells_.side(cell.upper, p) < 0;
}

std::optional<Vec2> DoorPoints::bend(std::uint32_t from, std::uint32_t to) const {
  const Door& d = cells_.doors[from];
  if (d.corner != cells_.doors[to].corner) return std::nullopt;
  const std::uint32_t cell = cells_.shared_cell(from, to);
  const Vec2 corner = cells_.corners[d.corner];
  double aside = 0.25 * std::abs(middles_[to].y - middles_[from].y);
  if (d.right != cell) aside = -aside;  // the doors are on the cell's right side
  for (int halved = 0; halved < 16; ++halved, aside *= 0.5) {
    const Vec2 p{corner.x + aside, corner.y};
    if (strictly_inside(cells_.cells[cell], p)) return p;
  }
  return std::nullopt;
}

double DoorPoints::leg_length(std::uint32_t from, std::uint32_t to) const {
  const Vec2 a = middles_[from];
  const Vec2 b = middles_[to];
  const std::optional<Vec2> by = bend(from, to);
  return by ? distance(a, *by) + distance(*by, b) : distance(a, b);
}

CellRoadmap::CellRoadmap(PlaneObstacles plane, const Execution& execution)
    : obstacles(std::move(plane)), cells(decompose(obstacles, {}, execution)), points(cells, execution) {}

Solution<Vec2> plan_through_cells(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, const CellOptions& options,
                                  const Execution& execution, CellPlan* keep) {
  CellPlanning planning(start, goal, options, execution);
  Solution<Vec2> solution = run_plan(planning, obstacles);
  if (keep != nullptr) *keep = std::move(planning.plan());
  return solution;
}

Solution<Vec2> plan_through_cells(const CellRoadmap& roadmap, Vec2 start, Vec2 goal, const CellOptions& options,
                                  const Execution& execution) {
  CellPlanning planning(start, goal, options, execution);
  return run_plan(planning, roadmap);
}

}  // namespace warren
