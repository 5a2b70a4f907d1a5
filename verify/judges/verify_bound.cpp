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

#include "scenes/scene/arm_model.hpp"
#include "verify/exact/exact_segments.hpp"
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

bool is_jointed(const RobotSpec& robot) {
  return robot.kind == RobotKind::puma560 || robot.kind == RobotKind::arm || robot.kind == RobotKind::urdf;
}

/// From one state to another in the body's metric as if nothing were there; of a car at least the straight line.
double free_distance(const RobotSpec& robot, std::span<const double> a, std::span<const double> b, bool in_metric) {
  double sum = 0.0;
  for (std::size_t i = 0; i < (is_jointed(robot) ? a.size() : 2); ++i) {
    const bool endless = robot.files && robot.files->read && robot.files->read->variables[i].continuous;
    const double way = endless ? std::remainder(b[i] - a[i], 2.0 * std::numbers::pi) : b[i] - a[i];
    sum += way * way;
  }
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

/// Looks for a way of a point that is shorter than `limit`. Arrivals at a corner are told apart, since of those at one
/// side of a wall that ends there others lead on than of those at the other: a later one is dropped where a way leads
/// from an earlier one to it through the corner, and so to all that it leads to. That is not said of one that comes
/// along an obstacle, on whichever side.
class ShorterWay {
 public:
  ShorterWay(const Scene& scene, Vec2 start, Vec2 goal, double limit, const Execution& execution)
      : scene_(scene), index_(scene, execution), limit_(limit), execution_(execution), places_{start, goal} {
    const Obstacles& obstacles = index_.obstacles();
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const Segment s = obstacles.segment(i);
      for (const Vec2 p : {s.a, s.b}) {
        if (p == start || p == goal) continue;
        if (straight(start, p) + straight(p, goal) < limit) places_.push_back(p);
      }
    }
    std::sort(places_.begin() + 2, places_.end(),
              [](Vec2 a, Vec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    places_.erase(std::unique(places_.begin() + 2, places_.end()), places_.end());
    arrived_.resize(places_.size());
  }

  /// Its places, where each two legs that follow each other are free; empty: there is none; nothing: too many legs were
  /// asked about.
  std::optional<std::vector<Vec2>> find() {
    settle({0.0, 0.0, none, 0, false});
    while (!open_.empty()) {
      Leg leg = open_.top();
      open_.pop();
      leg.along = comes_along(place_before(leg), places_[leg.to]);
      if (leg.to != 1 && is_covered(leg)) continue;
      if (goes_on(leg.before, places_[leg.to])) {
        settle(leg);
        if (leg.to == 1) return way();
      }
      if (asked_ > most_judged_legs) return std::nullopt;
    }
    return std::vector<Vec2>{};
  }

  /// As a whole.
  bool is_free(std::span<const Vec2> path) const {
    return verify_path(scene_, path, {.contact = Contact::allowed}, execution_, &index_).verified;
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  struct Leg {
    double promise;      ///< way, and straight on to the goal
    double way;          ///< with the leg
    std::size_t before;  ///< the arrival that it goes on from; none: the start
    std::size_t to;      ///< a place
    bool along;          ///< an obstacle; known when the leg comes first
    bool operator<(const Leg& o) const { return std::tie(promise, to, before) > std::tie(o.promise, o.to, o.before); }
  };

  Vec2 place_before(const Leg& leg) const { return places_[leg.before == none ? 0 : arrivals_[leg.before].to]; }
  /// Goes the way to an arrival on to a place? Of it the last leg tells, and those before it as far as legs come along
  /// obstacles, on whichever side.
  bool goes_on(std::size_t arrival, Vec2 to) {
    std::vector<Vec2> path{to, places_[arrivals_[arrival].to]};
    for (bool is_told = false; arrivals_[arrival].before != none && !is_told; arrival = arrivals_[arrival].before) {
      path.push_back(place_before(arrivals_[arrival]));
      is_told = !arrivals_[arrival].along;
    }
    std::reverse(path.begin(), path.end());
    ++asked_;
    return is_free(path);
  }
  /// Nothing is covered that comes along an obstacle.
  bool is_covered(const Leg& leg) {
    const std::vector<std::size_t>& earlier = arrived_[leg.to];
    return !leg.along && std::any_of(earlier.begin(), earlier.end(),
                                     [&](std::size_t arrival) { return goes_on(arrival, place_before(leg)); });
  }
  /// Does an obstacle lie on the last of the leg?
  bool comes_along(Vec2 came, Vec2 at) const {
    bool found = false;
    const auto lies_on_it = [&](Vec2 p) {
      return exact::side_of(came, at, p) == 0 && (p.x - at.x) * (came.x - at.x) + (p.y - at.y) * (came.y - at.y) > 0.0;
    };
    index_.sides().for_each([&](const Box& box) { return !box.contains(at); },
                            [&](std::size_t i) {
                              const Segment s = index_.obstacles().segment(i);
                              found = found || (exact::contains(s, at) && (lies_on_it(s.a) || lies_on_it(s.b)));
                            });
    return found;
  }
  void settle(const Leg& leg) {
    execution_.reserve(places_.size() * sizeof(Leg));
    const std::size_t arrival = arrivals_.size();
    arrivals_.push_back(leg);
    arrived_[leg.to].push_back(arrival);
    for (std::size_t to = 1; to < places_.size(); ++to) {
      if (to == leg.to) continue;
      const double there = leg.way + straight(places_[leg.to], places_[to]);
      const double promise = there + straight(places_[to], places_[1]);
      if (promise < limit_) open_.push({promise, there, arrival, to, false});
    }
  }
  std::vector<Vec2> way() const {
    std::vector<Vec2> path;
    for (std::size_t i = arrivals_.size() - 1; i != none; i = arrivals_[i].before) {
      path.push_back(places_[arrivals_[i].to]);
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  const Scene& scene_;
  const ObstacleIndex index_;
  double limit_;
  const Execution& execution_;
  std::vector<Vec2> places_;  // start, goal, corners that may lie on a way
  std::vector<Leg> arrivals_;
  std::vector<std::vector<std::size_t>> arrived_;  // at each place
  std::priority_queue<Leg> open_;
  std::size_t asked_ = 0;  // legs, how they go on
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
  const std::optional<std::vector<Vec2>> found = search.find();
  if (!found) return {};
  const std::vector<Vec2>& way = *found;
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
  const bool is_place = asked.goal.empty() || (is_jointed(asked.robot) && asked.goal.size() != asked.start.size());
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
