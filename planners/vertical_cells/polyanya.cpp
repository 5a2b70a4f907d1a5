// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/polyanya.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>

#include "core/plane/geometry.hpp"

namespace warren {
namespace {

constexpr std::uint64_t nodes_per_poll = 1024;
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
        best_(cells.doors.size(), std::numeric_limits<double>::infinity()),
        bends_(cells.doors.size()),
        last_rays_(cells.doors.size()),
        holds_goal_(cells.cells.size(), 0) {
    for (const VertexId cell : ends[1].cells) holds_goal_[cell] = 1;
  }

  TautRoute run() {
    for (const VertexId cell : ends_[0].cells) {
      for (const bool rightwards : {false, true}) {
        add({cell, no_number, no_number, no_number, rightwards, start_, 0.0, {}, {}});
      }
    }
    while (!queue_.empty()) {
      const Waiting next = queue_.top();
      queue_.pop();
      if (next.at_goal) return route_to(next.node);
      if (++route_.expanded % nodes_per_poll == 0) execution_.check();
      expand(next.node, next.estimate);
    }
    return route_;
  }

 private:
  static constexpr std::array<std::size_t, 2> left_doors{0, 1}, right_doors{2, 3};

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
    if (holds_goal_[node.cell] != 0) reach_goal(node, number);
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
    bends_[at.door].push_back({door, length, node.root, on_left});
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
    last_rays_[door].push_back({node.root_door, l.from, l.to});
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
    nodes_.push_back(node);
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

  TautRoute route_to(std::uint32_t number) {
    for (std::uint32_t n = number; n != no_number; n = nodes_[n].parent) {
      route_.cells.push_back(nodes_[n].cell);
      if (nodes_[n].door != no_number) route_.doors.push_back(nodes_[n].door);
    }
    std::reverse(route_.cells.begin(), route_.cells.end());
    std::reverse(route_.doors.begin(), route_.doors.end());
    return std::move(route_);
  }

  const CellDecomposition& cells_;
  std::span<const CellPlace> ends_;
  const Vec2 start_, goal_;
  const bool informed_;
  const Execution& execution_;
  std::vector<double> best_;                     // of each door: the least length of a way to its corner, as a root
  std::vector<std::vector<Bend>> bends_;         // of each door: at its corner
  std::vector<std::vector<LastRay>> last_rays_;  // of each door: seen through it
  std::vector<char> holds_goal_;
  std::vector<Node> nodes_;
  std::priority_queue<Waiting> queue_;
  double floor_ = 0.0;  // the estimate of the node that is expanded: children are no nearer to the goal
  TautRoute route_;
};

}  // namespace

TautRoute shortest_taut_route(const CellDecomposition& cells, std::span<const CellPlace> ends, Vec2 start, Vec2 goal,
                              bool informed, const Execution& execution) {
  return TautSearch(cells, ends, start, goal, informed, execution).run();
}

}  // namespace warren
