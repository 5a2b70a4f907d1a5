// SPDX-License-Identifier: BSD-3-Clause
// The shortest path of a disc, the plain way: all tangents between all circles around all corners, each compared with
// all obstacles, and Dijkstra over them. What is free is measured, by plain distances, at the few places where the
// distance of an arc from a segment can be least: nothing is known here of cones, sight and candidates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"

namespace warren::test {

class DiscOracle {
 public:
  /// What keeps `radius` less `doubt` is free.
  DiscOracle(const PlaneObstacles& obstacles, double radius, double doubt)
      : obstacles_(obstacles), radius_(radius), least_(radius - doubt) {
    std::vector<Vec2> corners = obstacles.polygons.corners;
    for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
      for_each_side(obstacles.polygons[p], [&](Vec2 a, Vec2 b) { segments_.push_back({a, b}); });
    }
    for (const Segment& wall : obstacles.walls) {
      segments_.push_back(wall);
      corners.insert(corners.end(), {wall.a, wall.b});
    }
    std::sort(corners.begin(), corners.end(), is_before);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    corners_ = corners;
    room_ = box_around(obstacles);
    if (obstacles.bounds) {
      const Box& b = *obstacles.bounds;
      const std::array<Vec2, 4> c{b.min, Vec2{b.max.x, b.min.y}, b.max, Vec2{b.min.x, b.max.y}};
      for (std::size_t i = 0; i < 4; ++i) segments_.push_back({c[i], c[(i + 1) % 4]});
    }
  }

  bool stands(Vec2 p) const {
    if (!in_room(p)) return false;
    for (std::size_t i = 0; i < obstacles_.polygons.size(); ++i) {
      if (contains(obstacles_.polygons[i], p)) return false;
    }
    return std::all_of(segments_.begin(), segments_.end(), [&](const Segment& s) { return keeps(p, s); });
  }

  /// Start and goal stand free.
  std::optional<double> length(Vec2 start, Vec2 goal) {
    nodes_.assign({{start, 0.0}, {goal, 0.0}});
    for (const Vec2 c : corners_) {
      nodes_.push_back({c, radius_});
      nodes_.push_back({c, -radius_});
    }
    ways_.clear();
    leaving_.assign(nodes_.size(), {});
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      for (std::size_t j = 0; j < nodes_.size(); ++j) add_way(i, j);
    }
    return search();
  }

 private:
  struct Node {
    Vec2 centre;
    double offset;  ///< to the left of the way
  };
  struct Way {
    std::size_t from, to;
    Vec2 along;
    double length;
    double cost = std::numeric_limits<double>::infinity();
    bool settled = false;
  };

  bool keeps(Vec2 p, const Segment& s) const { return distance(p, s) >= least_; }
  bool in_room(Vec2 p) const { return room_.empty() || room_.grown(radius_ - least_).contains(p); }
  Vec2 spoke(std::size_t node, Vec2 along) const { return -nodes_[node].offset * Vec2{-along.y, along.x}; }

  void add_way(std::size_t i, std::size_t j) {
    const Vec2 v = nodes_[j].centre - nodes_[i].centre;
    const double aside = nodes_[j].offset - nodes_[i].offset;
    const double rest = dot(v, v) - aside * aside;
    if (dot(v, v) == 0.0 || rest < -4.0 * radius_ * (radius_ - least_)) return;
    const double length = std::sqrt(std::max(rest, 0.0));
    const Vec2 along = (1.0 / dot(v, v)) * (length * v - aside * Vec2{-v.y, v.x});
    const Segment leg{nodes_[i].centre + spoke(i, along), nodes_[j].centre + spoke(j, along)};
    if (!in_room(leg.a) || !in_room(leg.b)) return;
    for (const Segment& s : segments_) {
      if (distance(leg, s) < least_) return;
    }
    leaving_[i].push_back(ways_.size());
    ways_.push_back({i, j, along, length});
  }

  /// The angle of the arc between two ways, if it is free.
  std::optional<double> arc(const Way& in, const Way& out) const {
    const Node& node = nodes_[in.to];
    const double way_round = node.offset > 0.0 ? 1.0 : -1.0;
    double angle = way_round * std::atan2(cross(in.along, out.along), dot(in.along, out.along));
    if (angle < -1e-9) angle += 2.0 * std::numbers::pi;
    const auto is_free = [&](Vec2 n, const Segment& s) {
      const Vec2 first = spoke(in.to, in.along);
      double turn = way_round * std::atan2(cross(first, n), dot(first, n));
      if (turn < 0.0) turn += 2.0 * std::numbers::pi;
      if (turn >= angle) return true;
      const Vec2 p = node.centre + radius_ / norm(n) * n;
      return in_room(p) && keeps(p, s);
    };
    for (const Segment& s : segments_) {
      const Vec2 a = s.a - node.centre;
      const Vec2 b = s.b - node.centre;
      const Vec2 across{s.a.y - s.b.y, s.b.x - s.a.x};
      for (const Vec2 n : {a, b, -1.0 * a, -1.0 * b, across, -1.0 * across}) {
        if (norm(n) > 0.0 && !is_free(n, s)) return std::nullopt;
      }
      for (const Vec2 n : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
        if (!is_free(n, s)) return std::nullopt;
      }
    }
    return std::max(angle, 0.0);
  }

  std::optional<double> search() {
    for (const std::size_t w : leaving_[0]) ways_[w].cost = ways_[w].length;
    for (;;) {
      Way* best = nullptr;
      for (Way& way : ways_) {
        if (!way.settled && std::isfinite(way.cost) && (best == nullptr || way.cost < best->cost)) best = &way;
      }
      if (best == nullptr) return std::nullopt;
      if (best->to == 1) return best->cost;
      best->settled = true;
      if (best->to == 0) continue;
      for (const std::size_t w : leaving_[best->to]) {
        Way& next = ways_[w];
        if (next.settled || best->cost + next.length >= next.cost) continue;
        const std::optional<double> angle = arc(*best, next);
        if (angle) next.cost = std::min(next.cost, best->cost + *angle * radius_ + next.length);
      }
    }
  }

  const PlaneObstacles& obstacles_;
  const double radius_;
  const double least_;
  Box room_;
  std::vector<Segment> segments_;
  std::vector<Vec2> corners_;
  std::vector<Node> nodes_;
  std::vector<Way> ways_;
  std::vector<std::vector<std::size_t>> leaving_;  // one a node: its ways
};

}  // namespace warren::test
