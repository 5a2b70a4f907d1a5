// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/cell_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <queue>
#include <utility>

#include "core/plane/geometry.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"

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

/// Is it one of the cells that contain the place?
bool holds(const CellPlace& place, std::uint32_t cell) {
  return std::binary_search(place.cells.begin(), place.cells.end(), cell);
}

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

// The route through vertical cells whose taut path is the shortest of all: best first over what can be seen through the
// doors (Polyanya: Cui, Harabor, Grastien, IJCAI 2017, here on trapezoids and with exact decisions).
//
// A node stands in a door, sees it from a root (start, or a corner that the path bends at) between two rays through
// corners, and knows the length of the way to the root. Passing the next door narrows the rays by that door's corner,
// or bends at a corner that was just passed. As in shortest_path_through() the other ends of doors don't matter. Only
// the order of the search is rounded: the route is the best but for routes as short within rounding. A corner is a root
// again only if it is reached by no longer a way. Nodes are made as they are met and are no vertices of a graph, so the
// loop isn't core's best_first. Time: O(nodes log nodes), usually few nodes a cell.

constexpr std::uint64_t nodes_per_poll = 1024;
constexpr std::size_t bytes_a_node = 128;  // that are kept of it in small lists of bends and rays, more or less
constexpr double rounding = 1e-12;  // of lengths, relative: ways to a corner that differ by less are equally long

/// A ray that bounds what a root sees: through a corner, or the way on which the root was reached, going on.
struct Bound {
  enum class Kind : std::uint8_t { none, line, corner };
  Vec2 from, to;
  std::uint32_t door = no_number;  // whose corner `to` is
  Kind kind = Kind::none;
  bool fresh = false;  // by the door that the node stands in: the only place to bend at it

  bool any() const { return kind != Kind::none; }
};

struct Node {
  std::uint32_t cell;  // behind the door
  std::uint32_t door;  // no_number: start's cell
  std::uint32_t parent;
  std::uint32_t root_door;  // no_number: the root is the start
  bool rightwards;
  Vec2 root;
  double length;  // from the start to the root
  Bound left, right;
};

struct Waiting {
  double estimate;
  std::uint32_t node;
  bool at_goal;
  friend bool operator<(const Waiting& a, const Waiting& b) {  // the least estimate is the queue's top
    if (a.estimate != b.estimate) return a.estimate > b.estimate;
    return a.at_goal != b.at_goal ? b.at_goal : a.node > b.node;
  }
};

/// A bend at a corner, on the way out by a door, that was added: bends that see no more are not.
struct Bend {
  std::uint32_t door;
  double length;
  Vec2 from;
  bool on_left;
};

/// A ray that was all that was left of what a root sees behind a door: many routes along collinear corners come to it.
struct LastRay {
  std::uint32_t root_door;
  Vec2 from, to;
};

/// informed: A*, else Dijkstra's order. `ends`: where start and goal lie, in this order.
class TautSearch {
 public:
  TautSearch(const CellDecomposition& cells, std::span<const CellPlace> ends, Vec2 start, Vec2 goal, bool informed,
             const Execution& execution)
      : cells_(cells),
        ends_(ends),
        start_(start),
        goal_(goal),
        informed_(informed),
        execution_(execution),
        best_(asked_for(cells, execution), std::numeric_limits<double>::infinity()),
        bends_(cells.doors.size()),
        last_rays_(cells.doors.size()) {}

  /// Without cells and doors where none was found. Throws Stopped.
  CellRoute run() {
    for (const VertexId cell : ends_[0].cells) {
      for (const bool rightwards : {false, true}) {
        add({cell, no_number, no_number, no_number, rightwards, start_, 0.0, {}, {}});
      }
    }
    while (!queue_.empty()) {
      const Waiting next = queue_.top();
      queue_.pop();
      if (next.at_goal) return route_to(next.node);
      if (++expanded_ % nodes_per_poll == 0) execution_.reserve(nodes_per_poll * bytes_a_node);
      expand(next.node, next.estimate);
    }
    return {start_, goal_, {}, {}};
  }

  std::uint64_t expanded() const { return expanded_; }  ///< nodes

 private:
  static constexpr std::array<std::size_t, 2> left_doors{0, 1}, right_doors{2, 3};

  /// The number of doors. Asks for what is held of each.
  static std::size_t asked_for(const CellDecomposition& cells, const Execution& execution) {
    constexpr std::size_t bytes_a_door = sizeof(double) + sizeof(std::vector<Bend>) + sizeof(std::vector<LastRay>);
    execution.reserve(cells.doors.size() * bytes_a_door);
    return cells.doors.size();
  }
  Vec2 corner_of(std::uint32_t door) const { return cells_.corners[cells_.doors[door].corner]; }
  bool is_open(std::uint32_t door) const { return door != no_number && !cells_.doors[door].shut; }
  bool corner_is_left(std::uint32_t door, bool rightwards) const { return rightwards != cells_.doors[door].above; }
  bool outdated(const Node& node) const {
    return node.root_door != no_number && node.length > best_[node.root_door] * (1.0 + rounding);
  }

  void expand(std::uint32_t number, double estimate) {
    const Node node = nodes_[number];
    if (outdated(node)) return;
    floor_ = estimate;
    const VerticalCell& cell = cells_.cells[node.cell];
    if (holds(ends_[1], node.cell)) reach_goal(node, number);
    for (const std::size_t place : node.rightwards ? right_doors : left_doors) {
      if (is_open(cell.doors[place])) pass(node, number, cell.doors[place]);
    }
    if (node.door == no_number) return;
    for (const std::size_t place : node.rightwards ? left_doors : right_doors) {
      const std::uint32_t door = cell.doors[place];
      if (is_open(door) && door != node.door) turn_back(node, number, door);
    }
  }

  /// The node with its root moved to a corner that it has just passed.
  static Node bent(const Node& node, bool on_left) {
    const Bound& at = on_left ? node.left : node.right;
    const Bound on{node.root, at.to, no_number, Bound::Kind::line, false};
    Node child = node;
    child.root = at.to;
    child.root_door = at.door;
    child.length = node.length + distance(node.root, at.to);
    child.left = on_left ? Bound{} : on;
    child.right = on_left ? on : Bound{};
    return child;
  }
  static bool can_bend(const Bound& bound) { return bound.kind == Bound::Kind::corner && bound.fresh; }

  /// Straight on through the door, or bending at what the node has just passed.
  void pass(const Node& node, std::uint32_t number, std::uint32_t door) {
    const auto enter = [&](Node child) {
      child.left.fresh = child.right.fresh = false;
      if (!narrow(child, door) || is_known_ray(child, door)) return;
      child.cell = cells_.beyond(door, node.cell);
      child.door = door;
      child.parent = number;
      add(child);
    };
    enter(node);
    if (can_bend(node.left) && is_new_bend(node, true, door)) enter(bent(node, true));
    if (can_bend(node.right) && is_new_bend(node, false, door)) enter(bent(node, false));
  }

  /// Not if the same corner was reached as shortly, from where the way may bend at least as far.
  bool is_new_bend(const Node& node, bool on_left, std::uint32_t door) {
    const Bound& at = on_left ? node.left : node.right;
    const double length = node.length + distance(node.root, at.to);
    if (length > best_[at.door] * (1.0 + rounding)) return false;
    for (const Bend& b : bends_[at.door]) {
      if (b.door != door || b.on_left != on_left || b.length > length * (1.0 + rounding)) continue;
      if (orient2d(b.from, at.to, node.root) * (on_left ? 1 : -1) <= 0) return false;
    }
    push_asked(bends_[at.door], {door, length, node.root, on_left}, execution_);
    return true;
  }

  /// Between rays that lie on one line: has the root, or the one before it, been here by another route?
  bool is_known_ray(const Node& node, std::uint32_t door) {
    const Bound& l = node.left;
    const Bound& r = node.right;
    const auto on_line = [](Vec2 from, Vec2 to, const Bound& b) {
      return orient2d(from, to, b.from) == 0 && orient2d(from, to, b.to) == 0;
    };
    if (!l.any() || !r.any() || !on_line(l.from, l.to, r)) return false;
    const bool same_way = is_before(l.from, l.to) == is_before(r.from, r.to);
    if (same_way && (l.kind == Bound::Kind::line || r.kind == Bound::Kind::line)) return true;  // no bend: seen before
    for (const LastRay& known : last_rays_[door]) {
      if (known.root_door == node.root_door && on_line(known.from, known.to, l)) return true;
    }
    push_asked(last_rays_[door], {node.root_door, l.from, l.to}, execution_);
    return false;
  }

  /// Does the way on which the root was reached run against the node's, which turned back at the root? Then all that
  /// the node may see lies beside that way, and only what lies behind the root's own way back is hidden by it.
  static bool is_against(const Bound& bound, bool rightwards) {
    if (bound.kind != Bound::Kind::line) return false;
    return rightwards ? bound.to.x < bound.from.x : bound.to.x > bound.from.x;
  }

  /// Takes the door's corner as a ray where that leaves less. False: nothing is left.
  bool narrow(Node& node, std::uint32_t door) const {
    const Vec2 corner = corner_of(door);
    if (corner == node.root) return true;
    const bool on_left = corner_is_left(door, node.rightwards);
    Bound& own = on_left ? node.left : node.right;
    const Bound& other = on_left ? node.right : node.left;
    const int outwards = on_left ? 1 : -1;
    const bool own_is_against = is_against(own, node.rightwards);
    if (other.any() && !is_against(other, node.rightwards) && orient2d(other.from, other.to, corner) * outwards < 0) {
      return false;
    }
    if (own.any() && orient2d(own.from, own.to, corner) * outwards > 0) return !own_is_against;
    own = {node.root, corner, door, Bound::Kind::corner, true};
    return true;
  }

  /// Around the corner of the door that the node stands in, out by the other door at this corner.
  void turn_back(const Node& node, std::uint32_t number, std::uint32_t door) {
    const bool on_left = corner_is_left(node.door, node.rightwards);
    Node child = node;
    if (!(corner_of(node.door) == node.root)) {
      if (!can_bend(on_left ? node.left : node.right)) return;  // hidden: another node has its root on the way
      if (!is_new_bend(node, on_left, door)) return;
      child = bent(node, on_left);
    }
    child.left.fresh = child.right.fresh = false;
    child.rightwards = !node.rightwards;
    child.cell = cells_.beyond(door, node.cell);
    child.door = door;
    child.parent = number;
    add(child);
  }

  void reach_goal(const Node& node, std::uint32_t number) {
    // No two bounds hide the goal unless one runs against the node: then the other, if it is a corner, is bent at.
    const bool left_of_all = node.left.any() && orient2d(node.left.from, node.left.to, goal_) > 0;
    const bool right_of_all = node.right.any() && orient2d(node.right.from, node.right.to, goal_) < 0;
    double length = node.length;
    if (!left_of_all && !right_of_all) {
      length += distance(node.root, goal_);
    } else {
      const Bound& at = left_of_all && !is_against(node.left, node.rightwards) ? node.left : node.right;
      if (!can_bend(at)) return;
      length += distance(node.root, at.to) + distance(at.to, goal_);
    }
    queue_.push({std::max(length, floor_), number, true});
  }

  void add(const Node& node) {
    const std::optional<double> estimate = estimate_of(node);
    if (!estimate || outdated(node)) return;
    if (node.root_door != no_number) best_[node.root_door] = std::min(best_[node.root_door], node.length);
    queue_.push({std::max(*estimate, floor_), static_cast<std::uint32_t>(nodes_.size()), false});
    push_asked(nodes_, node, execution_);
  }

  /// Where the ray meets the vertical line at x; none where it runs straight up or down, or against the node's way.
  static std::optional<double> height_at(const Bound& bound, double x, bool rightwards) {
    const double width = bound.to.x - bound.from.x;
    const double reach = x - bound.from.x;
    if (!bound.any() || (rightwards ? width <= 0.0 : width >= 0.0)) return std::nullopt;
    return bound.from.y + reach * ((bound.to.y - bound.from.y) / width);
  }

  /// Least length of a path by root and door to the goal (to the door: not informed); none: nothing is seen.
  std::optional<double> estimate_of(const Node& node) const {
    if (node.door == no_number) return informed_ ? distance(start_, goal_) : 0.0;
    const Segment line = cells_.door_line(node.door);
    const double x = line.a.x;
    double low = std::min(line.a.y, line.b.y);
    double high = std::max(line.a.y, line.b.y);
    double slack = std::abs(low) + std::abs(high);
    const Bound& upper = node.rightwards ? node.left : node.right;
    const Bound& lower = node.rightwards ? node.right : node.left;
    if (const auto top = height_at(upper, x, node.rightwards)) {
      high = std::min(high, *top);
      slack += std::abs(upper.from.y) + std::abs(*top);
    }
    if (const auto bottom = height_at(lower, x, node.rightwards)) {
      low = std::max(low, *bottom);
      slack += std::abs(lower.from.y) + std::abs(*bottom);
    }
    if (low > high + rounding * slack) return std::nullopt;
    high = std::max(low, high);
    if (!informed_) return node.length + distance(node.root, Vec2{x, std::clamp(node.root.y, low, high)});
    const bool behind = (goal_.x < x) == (node.root.x < x) && goal_.x != x && node.root.x != x;
    const double mirrored_x = behind ? 2.0 * x - goal_.x : goal_.x;
    const double width = mirrored_x - node.root.x;
    const double y = width == 0.0 ? node.root.y : node.root.y + (x - node.root.x) / width * (goal_.y - node.root.y);
    const Vec2 by{x, std::clamp(y, low, high)};
    return node.length + distance(node.root, by) + distance(by, goal_);
  }

  CellRoute route_to(std::uint32_t number) const {
    CellRoute route{start_, goal_, {}, {}};
    for (std::uint32_t n = number; n != no_number; n = nodes_[n].parent) {
      route.cells.push_back(nodes_[n].cell);
      if (nodes_[n].door != no_number) route.doors.push_back(nodes_[n].door);
    }
    std::reverse(route.cells.begin(), route.cells.end());
    std::reverse(route.doors.begin(), route.doors.end());
    return route;
  }

  const CellDecomposition& cells_;
  std::span<const CellPlace> ends_;
  const Vec2 start_, goal_;
  const bool informed_;
  const Execution& execution_;
  std::vector<double> best_;                     // of each door: the least length of a way to its corner, as a root
  std::vector<std::vector<Bend>> bends_;         // of each door: at its corner
  std::vector<std::vector<LastRay>> last_rays_;  // of each door: seen through it
  std::vector<Node> nodes_;
  std::priority_queue<Waiting> queue_;
  double floor_ = 0.0;  // the estimate of the node that is expanded: children are no nearer to the goal
  std::uint64_t expanded_ = 0;
};

/// One plan: the steps share the question and fill in the solution.
class CellPlanning {
 public:
  CellPlanning(Vec2 start, Vec2 goal, const CellOptions& options, const Execution& execution)
      : start_(start), goal_(goal), options_(options), execution_(execution) {}

  void run(const PlaneObstacles& obstacles) {
    {
      const StageTimer timer(execution_, "cells", solution_.seconds.graph, obstacles.polygons.corners.size());
      plan_.cells = decompose(obstacles, std::array{start_, goal_}, execution_, options_.overlaps);
    }
    cells_ = &plan_.cells;
    run();
  }
  void run(const CellRoadmap& roadmap) {
    cells_ = &roadmap.cells;
    points_ = &roadmap.points;
    for (const Vec2 end : {start_, goal_}) {
      plan_.cells.places.push_back(locate(*cells_, roadmap.obstacles, end, execution_));
    }
    run();
  }
  Solution<Vec2>& solution() { return solution_; }
  CellPlan& plan() { return plan_; }

 private:
  void run() {
    solution_.roadmap.milestones = cells_->cells.size();
    solution_.roadmap.edges = cells_->doors.size();
    if (start_place().blocked || goal_place().blocked) {
      solution_.outcome = start_place().blocked ? Outcome::start_blocked : Outcome::goal_blocked;
      return;
    }
    if (share_a_cell()) return;
    connect_cells();
    if (!ends_are_joined()) return;
    find_route();
    lay_path();
  }
  const CellPlace& start_place() const { return plan_.cells.places[0]; }
  const CellPlace& goal_place() const { return plan_.cells.places[1]; }
  VertexId start_vertex() const { return static_cast<VertexId>(cells_->cells.size()); }
  VertexId goal_vertex() const { return start_vertex() + 1; }

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
    const std::size_t most = cells_->doors.size() + start_place().cells.size() + goal_place().cells.size();
    execution_.reserve(most * sizeof(Edge));
    edges.reserve(most);
    for (const Door& door : cells_->doors) {
      execution_.poll(edges.size());
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
    // The gap between the ends and the doors' middles of either side; sizes count cells.
    const DoorPoints doors(*cells_, execution_);
    const auto points_of = [&](VertexId vertex, Vec2 end) {
      std::vector<Vec2> points{end};
      for (std::uint32_t d = 0; d < cells_->doors.size(); ++d) {
        execution_.poll(d);
        const Door& door = cells_->doors[d];
        if (!door.shut && parts.connected(door.left, vertex)) push_asked(points, doors.middle(d), execution_);
      }
      return points;
    };
    Separation gap =
        separation_between<2>(points_of(start_vertex(), start_), points_of(goal_vertex(), goal_), execution_);
    gap.start_size = parts.size_of(start_vertex()) - 1;
    gap.goal_size = parts.size_of(goal_vertex()) - 1;
    solution_.separation = gap;
    return false;
  }
  void find_route() {
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    const bool over_cells = !has_queue(options_.search);
    const bool by_middles = options_.doors == DoorKind::midpoint;
    plan_.route = {start_, goal_, {}, {}};
    if (!over_cells && !by_middles) {
      const bool informed = options_.search == SearchKind::astar;
      TautSearch search(*cells_, plan_.cells.places, start_, goal_, informed, execution_);
      plan_.route = search.run();
      solution_.counters.expanded = search.expanded();
      if (!plan_.route.cells.empty()) return;  // else rounding has cut the last way off: one through the middles does
    }
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
        if (holds(goal_place(), cell)) visit(goal, distance(points_->middle(v), goal_));
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
  /// doors: start's vertex, doors, goal's vertex. A door that is reached but not passed (all legs lie in one cell) is
  /// left out, at the ends too.
  void follow_doors(std::span<const VertexId> doors) {
    CellRoute& route = plan_.route;
    middles_.assign(doors.begin() + 1, doors.end() - 1);
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

std::optional<Vec2> DoorPoints::bend(std::uint32_t from, std::uint32_t to) const {
  const Door& d = cells_.doors[from];
  if (d.corner != cells_.doors[to].corner) return std::nullopt;
  const std::uint32_t number = cells_.shared_cell(from, to);
  const VerticalCell& cell = cells_.cells[number];
  const double left = cell.left == no_number ? cells_.box.min.x : cells_.corners[cell.left].x;
  const double right = cell.right == no_number ? cells_.box.max.x : cells_.corners[cell.right].x;
  const Vec2 corner = cells_.corners[d.corner];
  double aside = 0.25 * std::abs(middles_[to].y - middles_[from].y);
  if (d.right != number) aside = -aside;  // the doors are on the cell's right side
  for (int halved = 0; halved < 16; ++halved, aside *= 0.5) {
    const Vec2 p{corner.x + aside, corner.y};
    if (left < p.x && p.x < right && cells_.side(cell.lower, p) > 0 && cells_.side(cell.upper, p) < 0) return p;
  }
  return std::nullopt;
}

double DoorPoints::leg_length(std::uint32_t from, std::uint32_t to) const {
  const std::optional<Vec2> by = bend(from, to);
  return by ? distance(middle(from), *by) + distance(*by, middle(to)) : distance(middle(from), middle(to));
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
