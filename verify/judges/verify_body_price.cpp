// SPDX-License-Identifier: BSD-3-Clause
// What the path of a body that turns costs beside its length, recomputed: of polygons that turn as they go straight and
// of cars, whose legs are arcs. Nothing of worlds/ or planners/ is used.
//
// Nearness has no closed form here, but it has bounds. No point of the body goes farther on a piece of a leg than the
// piece is long and its turn times the body's extent; by so much at most the body's distance changes. So the distance
// in the piece's middle bounds the integral from both sides, in closed form. A piece is halved until both are as near
// as a thousandth of what it costs; half of what is left is the error. The distance is the least between corners of
// the one and sides of the other, since a body that is free crosses nothing; from piece to half only those pairs are
// kept that may be the least there. Areas are priced where the reference point is (verify/judges/judged_factors.hpp).
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/judged_factors.hpp"
#include "verify/judges/verify_price.hpp"
#include "verify/near/sides_near_legs.hpp"
#include "verify/near/straight_runs.hpp"

namespace warren {
namespace {

/// A leg by shares from 0 to 1.
struct BodyLeg {
  JudgedArc arc;
  bool is_straight;  // the turn is the body's, not the way's
  Vec2 chord;

  Se2 pose(double share) const {
    const Vec2 p = is_straight ? arc.from + share * chord : arc.at(share);
    return {p.x, p.y, arc.heading_rad + share * arc.turn_rad};
  }
  double length() const { return std::abs(arc.length); }
};

BodyLeg leg_of(const RobotSpec& robot, const Se2& a, const Se2& b) {
  const Vec2 chord{b.x - a.x, b.y - a.y};
  if (robot.kind != RobotKind::car) {
    const double length = portable::hypot(chord.x, chord.y);
    return {{a.position(), a.theta, shorter_turn(a.theta, b.theta), length}, true, chord};
  }
  const CarLeg leg = car_leg_between(a, b);
  return {{a.position(), a.theta, leg.turn, std::copysign(leg.length, leg.ahead)}, false, chord};
}

double square_to(Vec2 p, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const double length_sq = dot(along, along);
  const double share = length_sq > 0.0 ? std::clamp(dot(p - s.a, along) / length_sq, 0.0, 1.0) : 0.0;
  const Vec2 off = p - (s.a + share * along);
  return dot(off, off);
}

/// What nearness costs a body along its path.
class BodyNearness {
 public:
  BodyNearness(const Scene& scene, const RobotSpec& robot, const ClearancePrice& price, const Execution& execution)
      : obstacles_(scene),
        surroundings_(scene, obstacles_, nullptr, execution),
        execution_(execution),
        outline_(robot.outline.empty() ? std::vector<Vec2>{Vec2{}} : robot.outline),
        radius_(robot.radius),
        price_(price.price),
        reach_(price.reach.value_or(2.0 * robot.radius)) {
    if (!(reach_ > 0.0)) throw InputError("clearance_price", "says no reach, and the body has no width");
    for (const Vec2 p : outline_) extent_ = std::max(extent_, norm(p));
  }

  /// Boxes around all parts of all legs, in their order.
  void look_around(std::span<const BodyLeg> legs) {
    std::vector<Box> boxes;
    for (const BodyLeg& leg : legs) {
      execution_.check();
      for (double i = 0.0, parts = parts_of(leg); i < parts; ++i) boxes.push_back(box_of_part(leg, i, parts));
    }
    surroundings_.file(boxes, execution_);
  }

  void add(const BodyLeg& leg, PriceParts& parts) {
    if (!(leg.length() > 0.0)) return;
    low_ = high_ = 0.0;
    for (double i = 0.0, count = parts_of(leg); i < count; ++i) {
      execution_.check();
      sides_.clear();
      const Box box = box_of_part(leg, i, count);
      surroundings_.gather(std::span(&box, 1), sides_, execution_);
      pairs_.clear();
      for (std::uint32_t side = 0; side < sides_.size(); ++side) {
        for (std::uint32_t k = 0; k < outline_.size(); ++k) {
          pairs_.push_back({k, side, true});
          if (outline_.size() > 1) pairs_.push_back({k, side, false});
        }
      }
      piece(leg, i / count, (i + 1.0) / count, 0);
    }
    parts.clearance += 0.5 * (high_ + low_);
    parts.error += 0.5 * (high_ - low_);
  }

 private:
  /// A corner of the body and a side, or a side of the body and both ends of one.
  struct Pair {
    std::uint32_t of_body;
    std::uint32_t side;
    bool is_corner;
  };
  static constexpr double enough = 1e-3;

  /// How far a point of the body goes on a share of the leg, at most.
  double travel(const BodyLeg& leg, double share) const {
    return share * (leg.length() + extent_ * std::abs(leg.arc.turn_rad)) * (1.0 + 1e-12);
  }
  double parts_of(const BodyLeg& leg) const {
    constexpr double most = 1e5;
    return std::clamp(std::ceil(travel(leg, 1.0) / (reach_ + radius_ + extent_)), 1.0, most);
  }
  Box box_of_part(const BodyLeg& leg, double number, double count) const {
    Box box;
    box.include(leg.pose((number + 0.5) / count).position());
    return box.grown(extent_ + radius_ + reach_ + travel(leg, 1.0 / count));
  }
  double distance_of(const Pair& pair) const {
    const Segment& side = sides_[pair.side].segment;
    if (pair.is_corner) return std::sqrt(square_to(corners_[pair.of_body], side));
    const Segment own = exact::outline_side(corners_, pair.of_body);
    return std::sqrt(std::min(square_to(side.a, own), square_to(side.b, own)));
  }
  /// The integral of (1 - u / reach)^2 from x on.
  double beyond(double x) const {
    if (x >= reach_) return 0.0;
    const double left = 1.0 - std::max(x, 0.0) / reach_;
    return reach_ / 3.0 * left * left * left + std::max(-x, 0.0);
  }

  /// The pairs that count are the last ones of pairs_; they are left as they are.
  void piece(const BodyLeg& leg, double from, double to, int depth) {
    constexpr std::uint64_t a_poll = 256;
    constexpr int deepest = 45;
    if (++polled_ % a_poll == 0) execution_.check();
    const Se2 pose = leg.pose(0.5 * (from + to));
    const auto [sine, cosine] = portable::sin_and_cos(pose.theta);
    corners_.clear();
    for (const Vec2 c : outline_) {
      corners_.push_back({pose.x + cosine * c.x - sine * c.y, pose.y + sine * c.x + cosine * c.y});
    }
    const std::size_t first = begin_;
    const std::size_t last = pairs_.size();
    distances_.resize(last);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < last; ++i) {
      distances_[i] = distance_of(pairs_[i]) - radius_;
      least = std::min(least, distances_[i]);
    }
    const double rounding =
        16.0 * std::numeric_limits<double>::epsilon() * (std::abs(pose.x) + std::abs(pose.y) + extent_ + reach_);
    const double way = travel(leg, 0.5 * (to - from)) + rounding;
    if (least - way >= reach_) return;
    // Over the piece the distance is within v t of the middle's: t of either half, v how fast the body is there.
    const double scale = price_ * leg.length() * (to - from) / way;
    const double high = scale * (beyond(least - way) - beyond(least));
    const double low = scale * (beyond(least) - beyond(least + way));
    const double cost = leg.length() * (to - from) + low;
    if (high - low <= enough * cost || depth >= deepest || way <= 4.0 * rounding) {
      low_ += low;
      high_ += high;
      return;
    }
    for (std::size_t i = first; i < last; ++i) {
      if (distances_[i] <= std::min(reach_ + way, least + 2.0 * way)) pairs_.push_back(pairs_[i]);
    }
    begin_ = last;
    piece(leg, from, 0.5 * (from + to), depth + 1);
    begin_ = last;
    piece(leg, 0.5 * (from + to), to, depth + 1);
    pairs_.resize(last);
    begin_ = first;
  }

  const Obstacles obstacles_;
  PathSurroundings surroundings_;
  const Execution& execution_;
  std::vector<Vec2> outline_;
  double radius_;
  double price_;
  double reach_;
  double extent_ = 0.0;
  double low_ = 0.0;  // of the leg
  double high_ = 0.0;
  std::uint64_t polled_ = 0;
  std::size_t begin_ = 0;  // of the pairs that count
  std::vector<Pair> pairs_;
  std::vector<double> distances_;
  std::vector<Vec2> corners_;
  std::vector<NearSide> sides_;
};

}  // namespace

PriceParts verify_body_price(const Scene& scene, std::span<const Se2> path, const RobotSpec& robot,
                             const Prices& prices, const Execution& execution) {
  PriceParts parts;
  execution.reserve(path.size() * sizeof(BodyLeg));
  std::vector<BodyLeg> legs;
  for (std::size_t i = 1; i < path.size(); ++i) legs.push_back(leg_of(robot, path[i - 1], path[i]));
  JudgedFactors factors(scene, prices, execution);
  for (const BodyLeg& leg : legs) {
    if (!factors.any() || !(leg.length() > 0.0)) continue;
    parts.areas +=
        leg.is_straight ? factors.over(Segment{leg.arc.from, leg.arc.from + leg.chord}) : factors.over(leg.arc);
  }
  if (!prices.clearance || !(prices.clearance->price > 0.0)) return parts;
  BodyNearness nearness(scene, robot, *prices.clearance, execution);
  nearness.look_around(legs);
  for (const BodyLeg& leg : legs) nearness.add(leg, parts);
  return parts;
}

}  // namespace warren
