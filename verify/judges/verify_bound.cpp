// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <vector>

#include "core/base/whole.hpp"
#include "scenes/scene/arm_model.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
namespace {

constexpr double bound_rounding = 1e-9;

/// The weight of a radian of a body that turns: how far it reaches.
double turn_weight(const RobotSpec& robot) {
  double farthest = 0.0;
  for (const Vec2 p : robot.outline) farthest = std::max(farthest, norm(p));
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
/// side of a wall that ends there others lead on than of those at the other. None is lost, as a way that goes on from
/// what is left out goes on, no longer, from one that is kept:
/// - A leg over a corner is two legs. So it comes along an obstacle all its way or nowhere.
/// - A leg doesn't go back to where the last came from, which ends there on the side where it began. Only about the tip
///   of a wall, where nothing else is, it may end on the other.
/// - Which side an arrival is on is told by the last leg through the open, or at a tip, where there is but one; ways
///   that set off along a wall from its tip, or from the start, may be on both. Where it is told, an arrival is covered
///   if a way leads from an earlier one through the corner and back along it: the two are on one side.
class ShorterWay {
 public:
  ShorterWay(const Scene& scene, Vec2 start, Vec2 goal, double limit, const Execution& execution)
      : scene_(scene), index_(scene, execution), limit_(limit), execution_(execution), places_{start, goal} {
    const Obstacles& obstacles = index_.obstacles();
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const Segment s = obstacles.segment(i);
      for (const Vec2 p : {s.a, s.b}) {
        if (p == start || p == goal) continue;
        if (distance(start, p) + distance(p, goal) < limit) places_.push_back(p);
      }
    }
    std::sort(places_.begin() + 2, places_.end(),
              [](Vec2 a, Vec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    places_.erase(std::unique(places_.begin() + 2, places_.end()), places_.end());
    arrived_.resize(places_.size());
    for (const Vec2 p : places_) tips_.push_back(is_tip(p));
  }

  /// Its places, where each two legs that follow each other are free; empty: there is none; nothing: too many legs were
  /// asked about.
  std::optional<std::vector<Vec2>> find() {
    settle({0.0, 0.0, none, 0, true, false});
    while (!open_.empty()) {
      if (asked_ > most_judged_legs) return std::nullopt;
      Leg leg = open_.top();
      open_.pop();
      if (!look_along(leg) || (leg.to != 1 && is_covered(leg))) continue;
      if (is_free_on(leg.before, std::array{places_[leg.to]})) {
        settle(leg);
        if (leg.to == 1) return way();
      }
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
    bool along;          ///< an obstacle; known when the leg comes first, and so is
    bool is_told;        ///< on which side
    bool operator<(const Leg& o) const { return std::tie(promise, to, before) > std::tie(o.promise, o.to, o.before); }
  };

  Vec2 place_before(const Leg& leg) const { return places_[leg.before == none ? 0 : arrivals_[leg.before].to]; }
  /// Back from the leg's end, as far as it tells on which side that is.
  std::vector<Vec2> tail(const Leg& last) const {
    std::vector<Vec2> path{places_[last.to]};
    for (const Leg* leg = &last; leg->before != none; leg = &arrivals_[leg->before]) {
      path.push_back(place_before(*leg));
      if (!leg->along || tips_[leg->to]) break;
    }
    return path;
  }
  /// Goes the way to an arrival on to these places?
  bool is_free_on(std::size_t arrival, std::span<const Vec2> onwards) {
    std::vector<Vec2> path = tail(arrivals_[arrival]);
    std::reverse(path.begin(), path.end());
    path.insert(path.end(), onwards.begin(), onwards.end());
    ++asked_;
    return is_free(path);
  }
  bool is_covered(const Leg& leg) {
    if (!leg.is_told) return false;
    const std::vector<Vec2> back = tail(leg);
    const std::vector<std::size_t>& earlier = arrived_[leg.to];
    return std::any_of(earlier.begin(), earlier.end(),
                       [&](std::size_t arrival) { return is_free_on(arrival, std::span(back).subspan(1)); });
  }
  /// Fills in what is known when a leg comes first. False: it leads over a corner, the start or the goal.
  bool look_along(Leg& leg) {
    const Segment s{place_before(leg), places_[leg.to]};
    const auto is_on = [&](Vec2 p) { return !(p == s.a) && !(p == s.b) && exact::contains(s, p); };
    const Box around = box_of(s);
    bool is_over = is_on(places_[0]) || is_on(places_[1]);
    leg.along = false;
    index_.sides().for_each([&](const Box& box) { return is_over || !box.meets(around); },
                            [&](std::size_t i) {
                              const Segment side = index_.obstacles().segment(i);
                              is_over = is_over || is_on(side.a) || is_on(side.b);
                              leg.along = leg.along || (exact::contains(side, s.a) && exact::contains(side, s.b));
                            });
    const Leg& before = arrivals_[leg.before];
    leg.is_told = !leg.along || tips_[leg.to] || (!tips_[before.to] && (!before.along || before.is_told));
    if (is_over) ++asked_;
    return !is_over;
  }
  /// Do all obstacles lead from here into one direction?
  bool is_tip(Vec2 at) const {
    std::optional<Vec2> first;
    bool is_one = true;
    index_.sides().for_each(
        [&](const Box& box) { return !box.contains(at); },
        [&](std::size_t i) {
          const Segment s = index_.obstacles().segment(i);
          if (!exact::contains(s, at)) return;
          for (const Vec2 p : {s.a, s.b}) {
            if (p == at) continue;
            if (!first) first = p;
            is_one = is_one && exact::side_of(at, *first, p) == 0 && !exact::contains({*first, p}, at);
          }
        });
    return is_one;
  }
  void settle(const Leg& leg) {
    execution_.reserve(places_.size() * sizeof(Leg));
    const std::size_t arrival = arrivals_.size();
    arrivals_.push_back(leg);
    arrived_[leg.to].push_back(arrival);
    for (std::size_t to = 1; to < places_.size(); ++to) {
      const bool is_back = leg.before != none && to == arrivals_[leg.before].to;
      if (to == leg.to || (is_back && !(leg.along && tips_[leg.to]))) continue;
      const double there = leg.way + distance(places_[leg.to], places_[to]);
      const double promise = there + distance(places_[to], places_[1]);
      if (promise < limit_) open_.push({promise, there, arrival, to, false, false});
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
  std::vector<bool> tips_;    // of the places
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
  for (std::size_t i = 1; i < way.size(); ++i) length += distance(way[i - 1], way[i]);
  return {BoundVerdict::refuted, fmt::format("the answer says {}, and a free way has {}", bound, length)};
}

/// More than what the few steps of each formula below are rounded by, as a share.
constexpr double rounding = 1e-12;

double outside_by(double x, double low, double high) { return std::max({low - x, x - high, 0.0}); }

class Proof {
 public:
  Proof(const OccupancyMap& map, const PotentialClaim& claim, const CellPotential& proof, const Execution& execution)
      : map_(map),
        claim_(claim),
        proof_(proof),
        execution_(execution),
        parts_(proof.width / map.width()),
        columns_(map.width()) {
    execution.reserve(sizeof(std::uint32_t) * map.blocked.count());
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      execution.check();
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (map.blocked.test(x, y)) columns_[x].push_back(y);
      }
    }
  }

  /// Of the first triangle that is too steep; empty: none is.
  std::string fault() const {
    for (std::uint32_t y = 0; y < proof_.height; ++y) {
      execution_.check();
      for (std::uint32_t x = 0; x < proof_.width; ++x) {
        if (map_.blocked.test(x / parts_, y / parts_)) continue;
        for (std::size_t i = 0; i < 4; ++i) {
          const double slope = slope_in(x, y, i);
          if (slope <= 1.0 - rounding) continue;
          execution_.check();  // a price may ask thousands of columns
          const double least = least_price(x, y, i);
          if (slope * (1.0 + rounding) <= least) continue;
          return fmt::format("the certificate rises by {} a unit in its cell {}, {}, where a path pays {}", slope, x, y,
                             least);
        }
      }
    }
    return {};
  }

  /// What the certificate says of a place: not more, or not less, whatever is rounded. NaN outside of the map.
  double value(Vec2 place, double side) const {
    const Vec2 p = static_cast<double>(parts_) * map_point(map_, place);
    if (!(p.x >= 0.0 && p.y >= 0.0 && p.x <= proof_.width && p.y <= proof_.height)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const auto x = bounded_whole<std::uint32_t>(p.x, 0.0, proof_.width - 1.0);
    const auto y = bounded_whole<std::uint32_t>(p.y, 0.0, proof_.height - 1.0);
    // The middle's share falls from 1 to 0 at the rim, the rest is the two corners'.
    const Vec2 from_middle{p.x - x - 0.5, p.y - y - 0.5};
    const double rim = 2.0 * std::max(std::abs(from_middle.x), std::abs(from_middle.y));
    const bool is_flat = std::abs(from_middle.x) < std::abs(from_middle.y);  // below or above the middle
    const double along = is_flat ? from_middle.x : from_middle.y;
    const std::size_t column = x + (!is_flat && from_middle.x > 0.0 ? 1 : 0);
    const std::size_t row = y + (is_flat && from_middle.y > 0.0 ? 1 : 0);
    const double low = proof_.values[proof_.corner(column, row)];
    const double high = proof_.values[proof_.corner(column + (is_flat ? 1 : 0), row + (is_flat ? 0 : 1))];
    const double middle = proof_.values[proof_.middle(x, y)];
    const double at = (1.0 - rim) * middle + (0.5 * rim - along) * low + (0.5 * rim + along) * high;
    // A place is rounded where the map is turned or far from the origin; the slope is at most that of all prices.
    const double misplaced = 1e-14 * (norm(place) + norm(map_.origin) + map_.cell);
    const double most = std::abs(middle) + std::abs(low) + std::abs(high);
    return at + side * (rounding * 1e-2 * most + misplaced * (1.0 + claim_.price));
  }

 private:
  /// By the legs of the right angle at the middle.
  double slope_in(std::uint32_t x, std::uint32_t y, std::size_t i) const {
    constexpr std::array<std::array<std::size_t, 2>, 5> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
    const double middle = proof_.values[proof_.middle(x, y)];
    const double a = proof_.values[proof_.corner(x + around[i][0], y + around[i][1])] - middle;
    const double b = proof_.values[proof_.corner(x + around[i + 1][0], y + around[i + 1][1])] - middle;
    return std::sqrt(2.0 * (a * a + b * b)) * parts_ / map_.cell;
  }

  /// Calls visit(low, high) for squares x .. x + 1 of rows low .. high: of each direction the nearest that is blocked,
  /// by bisection. What lies beyond the map is.
  template <class Visit>
  void nearest_blocked(std::int64_t x, std::uint32_t y, const Visit& visit) const {
    constexpr double endless = std::numeric_limits<double>::infinity();
    if (x < 0 || x >= std::int64_t{map_.width()}) return visit(-endless, endless);
    const std::vector<std::uint32_t>& rows = columns_[as_whole<std::size_t>(x)];
    const auto above = std::lower_bound(rows.begin(), rows.end(), y);
    const bool is_top = above == rows.end();
    visit(is_top ? map_.height() : *above, is_top ? endless : *above + 1.0);
    const bool is_lowest = above == rows.begin();
    visit(is_lowest ? -endless : *std::prev(above), is_lowest ? 0.0 : *std::prev(above) + 1.0);
  }

  /// Of length in the triangle; infinite where the middle can't be. The distance to a square is convex: nowhere in the
  /// triangle is it more than at one of the corners.
  double least_price(std::uint32_t x, std::uint32_t y, std::size_t i) const {
    const double keeps = claim_.keeps / map_.cell * (1.0 - 1e-9);
    const double radius = claim_.radius / map_.cell;
    const double reach = claim_.price > 0.0 ? claim_.reach / map_.cell : 0.0;
    constexpr std::array<Vec2, 5> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
    const Vec2 low{static_cast<double>(x), static_cast<double>(y)};
    const double part = 1.0 / parts_;
    const Vec2 at[] = {part * (low + Vec2{0.5, 0.5}), part * (low + corners[i]), part * (low + corners[i + 1])};
    const std::uint32_t row = y / parts_;
    const std::int64_t column = x / parts_;
    const auto around = bounded_whole<std::int64_t>(std::max(keeps, radius + reach) + 2.0, 1.0, 1e9);
    double nearest_sq = std::numeric_limits<double>::infinity();
    for (std::int64_t c = std::max<std::int64_t>(-1, column - around);
         c <= std::min<std::int64_t>(map_.width(), column + around); ++c) {
      const auto low_x = static_cast<double>(c);
      nearest_blocked(c, row, [&](double low_y, double high_y) {
        double farthest_sq = 0.0;
        for (const Vec2 p : at) {
          const double dx = c < 0                             ? p.x
                            : c == std::int64_t{map_.width()} ? low_x - p.x
                                                              : outside_by(p.x, low_x, low_x + 1.0);
          const double dy = outside_by(p.y, low_y, high_y);
          farthest_sq = std::max(farthest_sq, dx * dx + dy * dy);
        }
        nearest_sq = std::min(nearest_sq, farthest_sq);
      });
    }
    const double farthest = std::sqrt(nearest_sq);
    if (farthest < keeps) return std::numeric_limits<double>::infinity();
    const double share = reach > 0.0 ? 1.0 - (farthest - radius) / reach : 0.0;
    if (!(share > 0.0)) return 1.0;
    return 1.0 + claim_.price * std::min(share, 1.0) * std::min(share, 1.0) * (1.0 - rounding);
  }

  const OccupancyMap& map_;
  const PotentialClaim& claim_;
  const CellPotential& proof_;
  const Execution& execution_;
  std::uint32_t parts_;
  std::vector<std::vector<std::uint32_t>> columns_;  // the rows of each one's blocked cells, from below
};

}  // namespace

double straight_tour(Vec2 start, std::span<const Vec2> stops, std::optional<Vec2> end) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const std::size_t n = stops.size();
  const std::size_t all = (std::size_t{1} << n) - 1;
  std::vector<double> least((all + 1) * n, endless);  // over a set of stops, by the last of them
  for (std::size_t k = 0; k < n; ++k) least[(std::size_t{1} << k) * n + k] = distance(start, stops[k]);
  double shortest = endless;
  for (std::size_t set = 1; set <= all; ++set) {
    for (std::size_t last = 0; last < n; ++last) {
      const double way = least[set * n + last];
      if (set == all) shortest = std::min(shortest, way + (end ? distance(stops[last], *end) : 0.0));
      for (std::size_t next = 0; next < n; ++next) {
        if ((set >> next & 1U) != 0) continue;
        double& there = least[(set | std::size_t{1} << next) * n + next];
        there = std::min(there, way + distance(stops[last], stops[next]));
      }
    }
  }
  return shortest;
}

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
  JudgedBound judged;
  if (!is_place) stopped_by([&] { judged = judge_by_search(scene, asked, bound, execution); });
  return judged;
}

JudgedBound verify_potential(const OccupancyMap& map, const PotentialClaim& claim, const CellPotential& proof,
                             const Execution& execution) {
  const bool is_of_map = proof.width >= map.width() && proof.width % map.width() == 0 &&
                         proof.height % map.height() == 0 && proof.width / map.width() == proof.height / map.height() &&
                         proof.values.size() == proof.size();
  if (!is_of_map) {
    return {BoundVerdict::refuted,
            fmt::format("the certificate has {} x {} cells, which are no parts of the map's {} x {}", proof.width,
                        proof.height, map.width(), map.height())};
  }
  const Proof judged(map, claim, proof, execution);
  const double bound = judged.value(claim.start, -1.0) - judged.value(claim.goal, 1.0);
  if (!(claim.lower_bound <= std::max(bound, 0.0))) {
    return {BoundVerdict::refuted, fmt::format("the answer says {}, its certificate {}", claim.lower_bound, bound)};
  }
  const std::string fault = judged.fault();
  if (!fault.empty()) return {BoundVerdict::refuted, fault};
  return {BoundVerdict::checked, {}};
}

}  // namespace warren
