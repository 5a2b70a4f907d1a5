// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>
#include <queue>
#include <tuple>
#include <vector>

#include "verify/judges/verify_point.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
namespace {

constexpr double bound_rounding = 1e-9;

double straight(Vec2 a, Vec2 b) { return std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y)); }

/// The weight of a radian of a body that turns: how far it reaches.
double turn_weight(const RobotSpec& robot) {
  double farthest = 0.0;
  for (const Vec2 p : robot.outline) farthest = std::max(farthest, straight({0.0, 0.0}, p));
  return farthest;
}

/// From one state to another in the body's metric as if nothing were there; of a car at least the straight line.
double free_distance(const RobotSpec& robot, std::span<const double> a, std::span<const double> b, bool in_metric) {
  const bool is_arm = robot.kind == RobotKind::puma560 || robot.kind == RobotKind::arm;
  double sum = 0.0;
  for (std::size_t i = 0; i < (is_arm ? a.size() : 2); ++i) sum += (b[i] - a[i]) * (b[i] - a[i]);
  if (robot.kind == RobotKind::polygon && in_metric && a.size() == 3 && b.size() == 3) {
    const double turn = turn_weight(robot) * std::remainder(b[2] - a[2], 2.0 * std::numbers::pi);
    sum += turn * turn;
  }
  return std::sqrt(sum);
}

/// Of the path, in what the answer calls cost.
double own_cost(const RobotSpec& robot, const ClaimedBound& claim) {
  if (robot.kind != RobotKind::polygon || !claim.cost) return claim.length;
  double sum = 0.0;
  const std::size_t width = claim.width;
  for (std::size_t i = width; i + width <= claim.states.size(); i += width) {
    sum += free_distance(robot, claim.states.subspan(i - width, width), claim.states.subspan(i, width), true);
  }
  return sum;
}

/// Looks for a way of a point that is shorter than `limit`.
class ShorterWay {
 public:
  ShorterWay(const Scene& scene, Vec2 start, Vec2 goal, double limit, const Execution& execution)
      : scene_(scene), index_(scene, execution), limit_(limit), execution_(execution), places_{start, goal} {
    const Obstacles& obstacles = index_.obstacles();
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const Segment s = obstacles.segment(i);
      for (const Vec2 p : {s.a, s.b}) {
        if (straight(start, p) + straight(p, goal) < limit) places_.push_back(p);
      }
    }
    std::sort(places_.begin() + 2, places_.end(),
              [](Vec2 a, Vec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    places_.erase(std::unique(places_.begin() + 2, places_.end()), places_.end());
  }

  /// Empty: there is none, whose legs are free one by one.
  std::vector<Vec2> find() {
    execution_.reserve(places_.size() * places_.size() * sizeof(Leg));
    parent_.assign(places_.size(), none);
    settle(0, 0, 0.0);
    while (!open_.empty()) {
      const Leg leg = open_.top();
      open_.pop();
      if (parent_[leg.to] != none || !is_free(places_[leg.from], places_[leg.to])) continue;
      settle(leg.to, leg.from, leg.way);
      if (leg.to == 1) return way();
    }
    return {};
  }

  /// As a whole.
  bool is_free(std::span<const Vec2> path) const {
    return verify_path(scene_, path, {.contact = Contact::allowed}, execution_, &index_).verified;
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  struct Leg {
    double promise;  ///< way, and straight on to the goal
    double way;      ///< with the leg
    std::size_t from, to;
    bool operator<(const Leg& o) const { return std::tie(promise, to, from) > std::tie(o.promise, o.to, o.from); }
  };

  bool is_free(Vec2 a, Vec2 b) const { return is_free(std::array{a, b}); }
  void settle(std::size_t v, std::size_t from, double way) {
    execution_.check();
    parent_[v] = from;
    for (std::size_t to = 1; to < places_.size(); ++to) {
      if (parent_[to] != none) continue;
      const double there = way + straight(places_[v], places_[to]);
      const double promise = there + straight(places_[to], places_[1]);
      if (promise < limit_) open_.push({promise, there, v, to});
    }
  }
  std::vector<Vec2> way() const {
    std::vector<Vec2> path{places_[1]};
    for (std::size_t v = 1; v != 0; v = parent_[v]) path.push_back(places_[parent_[v]]);
    std::reverse(path.begin(), path.end());
    return path;
  }

  const Scene& scene_;
  const ObstacleIndex index_;
  double limit_;
  const Execution& execution_;
  std::vector<Vec2> places_;  // start, goal, corners that may lie on a way
  std::vector<std::size_t> parent_;
  std::priority_queue<Leg> open_;
};

std::size_t judged_corners(const Scene& scene) {
  std::size_t corners = 2 * scene.walls.size();
  for (const ScenePolygon& polygon : scene.polygons) corners += polygon.corners.size();
  return corners;
}

/// Of points, and of discs, whose middle is one.
JudgedBound judge_by_search(const Scene& scene, const BoundQuestion& asked, double bound, const Execution& execution) {
  const bool is_plain = asked.robot.kind == RobotKind::point || asked.robot.kind == RobotKind::disc;
  if (!is_plain || scene.map || is_unmade(scene) || judged_corners(scene) > most_judged_corners) return {};
  const Vec2 start{asked.start[0], asked.start[1]};
  const Vec2 goal{asked.goal[0], asked.goal[1]};
  ShorterWay search(scene, start, goal, bound * (1.0 - bound_rounding), execution);
  const std::vector<Vec2> way = search.find();
  if (way.empty()) return {BoundVerdict::checked, {}};
  const bool is_point = asked.robot.kind == RobotKind::point || asked.robot.radius == 0.0;
  if (!is_point || asked.clearance > 0.0 || !search.is_free(way)) return {};
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += straight(way[i - 1], way[i]);
  return {BoundVerdict::refuted, fmt::format("the answer says {}, and a free way has {}", bound, length)};
}

}  // namespace

JudgedBound verify_bound(const Scene& scene, const BoundQuestion& asked, const ClaimedBound& claim,
                         const Execution& execution) {
  const double cost = own_cost(asked.robot, claim);
  if (claim.cost && std::abs(*claim.cost - cost) > bound_rounding * cost) {
    return {BoundVerdict::refuted,
            fmt::format("the answer says it bounds a cost of {}, its path has {}", *claim.cost, cost)};
  }
  const double bound = claim.lower_bound;
  if (bound > cost * (1.0 + bound_rounding)) {
    return {BoundVerdict::refuted, fmt::format("the answer says {}, its own path has {}", bound, cost)};
  }
  const bool is_place = asked.goal.size() < 2 || (asked.start.size() > 3 && asked.goal.size() == 3);
  const double plain = is_place ? 0.0 : free_distance(asked.robot, asked.start, asked.goal, claim.cost.has_value());
  if (bound <= plain * (1.0 + bound_rounding)) return {BoundVerdict::checked, {}};
  try {
    return is_place ? JudgedBound{} : judge_by_search(scene, asked, bound, execution);
  } catch (const Stopped&) {
    return {};
  } catch (const std::bad_alloc&) {
    return {};
  }
}

}  // namespace warren
