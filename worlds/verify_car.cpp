// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/verify_car.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "parallel/chunks.hpp"
#include "worlds/arc_distance.hpp"
#include "worlds/exact_segments.hpp"
#include "worlds/obstacles.hpp"
#include "worlds/pose_runs.hpp"

namespace warren {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double small = 1e-9;  // what poses may be off by, in turning radii

/// From pose a with the steering wheel still.
struct CarLeg {
  Se2 a;
  Vec2 chord;
  double turn = 0.0;
  double ahead = 0.0;   // the chord along the heading halfway; negative: backwards
  double aside = 0.0;   // and square to it: 0 but for rounding
  double length = 0.0;  // of the arc
  double radius = infinity;

  CarLeg(const Se2& from, const Se2& to)
      : a(from), chord{to.x - from.x, to.y - from.y}, turn(shorter_turn(from.theta, to.theta)) {
    const double middle = from.theta + 0.5 * turn;
    ahead = chord.x * std::cos(middle) + chord.y * std::sin(middle);
    aside = chord.y * std::cos(middle) - chord.x * std::sin(middle);
    const double half_sine = std::sin(0.5 * std::abs(turn));
    length = half_sine > 0.0 ? std::abs(ahead) * 0.5 * std::abs(turn) / half_sine : std::abs(ahead);
    if (half_sine > 0.0) radius = 0.5 * std::abs(ahead) / half_sine;
  }
  /// Left of the car where its turn and its gear agree.
  Vec2 center() const {
    const double side = (ahead < 0.0) == (turn < 0.0) ? radius : -radius;
    return {a.x - side * std::sin(a.theta), a.y + side * std::cos(a.theta)};
  }
};

struct CarLegReport {
  double least = infinity;
  std::optional<Violation> violation;
};

class CarVerifier {
 public:
  CarVerifier(const Scene& scene, const VerifiedCar& car, double clearance, const Execution& execution)
      : obstacles_(scene), car_(car), clearance_(clearance), execution_(execution), confines_(scene.bounds) {
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      const Segment s = obstacles_.segment(i);
      segments_.push_back(s);
      if (i < obstacles_.wall_count() || is_polygon_side(i)) box_.include(box_of(s));
      for (const double c : {s.a.x, s.a.y, s.b.x, s.b.y}) largest_ = std::max(largest_, std::abs(c));
    }
    corners_ = car.outline.empty() ? std::vector<Vec2>{Vec2{}} : car.outline;
    for (const Vec2 p : corners_) size_ = std::max(size_, std::hypot(p.x, p.y));
    tolerance_ = small * car.turning_radius + 1e-14 * largest_;
  }

  CarLegReport check_pose(const Se2& pose, std::size_t number) const;
  /// Can the car drive it?
  std::optional<Violation> check_driving(const CarLeg& leg, std::size_t number) const;
  CarLegReport check_room(const CarLeg& leg, std::size_t number) const;
  double tolerance() const { return tolerance_; }

 private:
  bool is_polygon_side(std::size_t i) const {
    return obstacles_.rings()[obstacles_.sides()[i - obstacles_.wall_count()].ring].polygon != Ring::none;
  }
  std::vector<Vec2> placed_corners(const Se2& pose) const;
  Segment side(const std::vector<Vec2>& corners, std::size_t i) const {
    return {corners[i], corners[i + 1 == corners.size() ? 0 : i + 1]};
  }
  bool body_holds(const std::vector<Vec2>& corners, Vec2 p) const;
  bool goes_straight(const CarLeg& leg) const { return !(leg.radius < 1e6 * car_.turning_radius); }
  double straight_distance(const std::vector<Vec2>& corners, Vec2 way, const Segment& s) const;
  double turning_distance(const std::vector<Vec2>& corners, const CarLeg& leg, const Segment& s) const;
  bool leaves_box(const CarLeg& leg) const;

  Obstacles obstacles_;
  const VerifiedCar& car_;
  double clearance_;
  const Execution& execution_;
  std::optional<Box> confines_;
  std::vector<Segment> segments_;
  std::vector<Vec2> corners_;  // of the body; of a disc: its middle
  Box box_;                    // of walls and polygons
  double largest_ = 0.0;
  double size_ = 0.0;  // of the body
  double tolerance_ = 0.0;
};

std::vector<Vec2> CarVerifier::placed_corners(const Se2& pose) const {
  const double c = std::cos(pose.theta);
  const double s = std::sin(pose.theta);
  std::vector<Vec2> corners;
  for (const Vec2 p : corners_) corners.push_back({pose.x + (c * p.x - s * p.y), pose.y + (s * p.x + c * p.y)});
  return corners;
}

/// Is p in the closed polygon?
bool CarVerifier::body_holds(const std::vector<Vec2>& corners, Vec2 p) const {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [a, b] = side(corners, i);
    if (exact::contains({a, b}, p)) return true;
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    const int at = exact::side_of(a, b, p);
    if (b.y > a.y ? at > 0 : at < 0) inside = !inside;
  }
  return inside;
}

double CarVerifier::straight_distance(const std::vector<Vec2>& corners, Vec2 way, const Segment& s) const {
  double least = infinity;
  for (const Vec2 p : corners) least = std::min(least, exact::distance({p, p + way}, s));
  for (std::size_t i = 0; corners.size() > 1 && i < corners.size(); ++i) {
    for (const Vec2 end : {s.a, s.b}) least = std::min(least, exact::distance({end, end - way}, side(corners, i)));
  }
  return least;
}

double CarVerifier::turning_distance(const std::vector<Vec2>& corners, const CarLeg& leg, const Segment& s) const {
  const Vec2 center = leg.center();
  double least = infinity;
  for (const Vec2 p : corners) least = std::min(least, distance(Arc{center, p, leg.turn}, s));
  for (std::size_t i = 0; corners.size() > 1 && i < corners.size(); ++i) {
    for (const Vec2 end : {s.a, s.b}) {
      least = std::min(least, distance(Arc{center, end, -leg.turn}, side(corners, i)));
    }
  }
  return least;
}

CarLegReport CarVerifier::check_room(const CarLeg& leg, std::size_t number) const {
  const std::vector<Vec2> corners = placed_corners(leg.a);
  const bool straight = goes_straight(leg);
  // What the leg is not known by, on top of the rounding of coordinates.
  const double blur = std::abs(leg.aside) + (straight ? std::abs(leg.turn) * (leg.length + size_) : 1e-15 * leg.radius);
  const double rounding = blur + 2e-14 * (largest_ + size_ + leg.length);
  const double asked = clearance_ + car_.radius;
  const double reach = size_ + leg.length;
  const Box around{{leg.a.x - reach, leg.a.y - reach}, {leg.a.x + reach, leg.a.y + reach}};
  CarLegReport report;
  double met = infinity;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    execution_.check();
    const Segment& s = segments_[i];
    if (std::sqrt(exact::gap_sq(around, box_of(s))) > met) continue;
    const bool held = corners.size() > 1 && body_holds(corners, s.a);
    const double found = held       ? 0.0
                         : straight ? straight_distance(corners, leg.chord, s)
                                    : turning_distance(corners, leg, s);
    if (found >= met) continue;
    met = found;
    const double proved = found - rounding;
    report.least = std::max(proved, 0.0) - car_.radius;
    if (proved > asked || (asked > 0.0 && proved >= asked)) continue;
    report.violation = Violation{number, found, obstacles_.name(i)};
  }
  return report;
}

/// Is the pose inside a polygon, outside the bounds or off the box? Boundaries are check_room()'s.
CarLegReport CarVerifier::check_pose(const Se2& pose, std::size_t number) const {
  const std::vector<Vec2> corners = placed_corners(pose);
  const auto bad = [&](std::string what) {
    return CarLegReport{-car_.radius, Violation{number, 0.0, std::move(what)}};
  };
  if (confines_) {
    for (const Vec2 p : corners) {
      if (!confines_->contains(p)) return bad(fmt::format("bounds: {} {} of the body is outside", p.x, p.y));
    }
  } else if (!box_.grown(tolerance_).contains({pose.x, pose.y})) {
    return bad(fmt::format("box: {} {} is outside the box of the obstacles", pose.x, pose.y));
  }
  for (const Ring& ring : obstacles_.rings()) {
    if (ring.polygon == Ring::none || !strictly_inside(ring, corners.front())) continue;
    return bad(fmt::format("polygon {}: holds {} {}", ring.polygon, corners.front().x, corners.front().y));
  }
  return {};
}

bool CarVerifier::leaves_box(const CarLeg& leg) const {
  if (confines_ || goes_straight(leg)) return false;  // ends are looked at as poses
  const Box room = box_.grown(2.0 * tolerance_);
  const Arc way{leg.center(), {leg.a.x, leg.a.y}, leg.turn};
  const Vec2 low = room.min;
  const Vec2 high = room.max;
  const Segment sides[] = {
      {low, {high.x, low.y}}, {{high.x, low.y}, high}, {high, {low.x, high.y}}, {{low.x, high.y}, low}};
  return std::any_of(std::begin(sides), std::end(sides), [&](const Segment& s) { return distance(way, s) == 0.0; });
}

std::optional<Violation> CarVerifier::check_driving(const CarLeg& leg, std::size_t number) const {
  const auto bad = [&](std::string what) { return Violation{number, 0.0, std::move(what)}; };
  if (std::abs(leg.aside) > tolerance_) {
    return bad(fmt::format("leg: slides sideways by {}; between two poses a car keeps its steering", leg.aside));
  }
  if (leg.length + tolerance_ < car_.turning_radius * std::abs(leg.turn)) {
    return bad(fmt::format("turning radius: {} is below {}", leg.radius, car_.turning_radius));
  }
  if (!car_.reverses && leg.ahead < -tolerance_) return bad(fmt::format("gear: goes backwards by {}", -leg.ahead));
  if (leaves_box(leg)) return bad("box: the way leaves the box of the obstacles");
  return std::nullopt;
}

void check_input(const VerifiedCar& car, std::span<const Se2> path, const CarVerifyOptions& options) {
  const auto fits = [](double value) { return std::abs(value) <= largest_coordinate; };
  if (!(car.turning_radius > 0.0 && fits(car.turning_radius))) {
    throw InputError("robot: turning radius", "must be a number above 0", fmt::format("{}", car.turning_radius));
  }
  if (!car.outline.empty() && car.outline.size() < 3) {
    throw InputError("robot", "a polygon needs three corners or more");
  }
  if (path.empty()) throw InputError("path", "has no poses");
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (fits(path[i].x) && fits(path[i].y) && std::abs(path[i].theta) <= largest_heading) continue;
    throw InputError(fmt::format("path: pose {}", i),
                     "must have coordinates of at most 1e60, a heading of at most 1000");
  }
  if (!(options.clearance >= 0.0 && fits(options.clearance))) {
    throw InputError("clearance", "must be a number from 0 to 1e60", fmt::format("{}", options.clearance));
  }
}

/// The worst of what is said about leg i.
CarLegReport leg_report(const CarVerifier& car, std::span<const Se2> path, std::size_t i) {
  const Se2& b = path[std::min(i + 1, path.size() - 1)];
  const CarLeg leg(path[i], b);
  CarLegReport report = car.check_room(leg, i);
  for (const Se2& pose : {path[i], b}) {
    const CarLegReport at_pose = car.check_pose(pose, i);
    report.least = std::min(report.least, at_pose.least);
    if (!report.violation) report.violation = at_pose.violation;
  }
  if (const auto violation = car.check_driving(leg, i)) report.violation = violation;
  return report;
}

/// Length, turns and gears.
void measure(std::span<const Se2> path, double nothing, CarVerification& result) {
  int gear = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const CarLeg leg(path[i - 1], path[i]);
    result.length += leg.length;
    result.turn_rad += std::abs(leg.turn);
    if (leg.ahead < 0.0) result.reversed += leg.length;
    if (leg.length <= nothing) continue;
    const int now = leg.ahead < 0.0 ? -1 : 1;
    if (gear == -now) ++result.cusps;
    gear = now;
  }
}

}  // namespace

CarVerification verify_car(const Scene& scene, const VerifiedCar& car, std::span<const Se2> path,
                           const CarVerifyOptions& options, const Execution& execution) {
  check_input(car, path, options);
  const CarVerifier verifier(scene, car, options.clearance, execution);
  const std::size_t legs = std::max<std::size_t>(path.size() - 1, 1);
  std::vector<CarLegReport> reports(legs);
  for_chunks(legs, 1, execution, [&](Range r) { reports[r.first] = leg_report(verifier, path, r.first); });

  CarVerification result;
  if (options.start && !is_there(path.front(), *options.start, false, options.tolerance)) {
    result.first_violation = Violation{0, 0.0, "start: the path begins elsewhere"};
  }
  for (const CarLegReport& report : reports) {
    result.min_clearance = std::min(result.min_clearance, report.least);
    if (report.violation && !result.first_violation) result.first_violation = report.violation;
  }
  if (options.goal && !is_there(path.back(), *options.goal, options.any_heading, options.tolerance) &&
      !result.first_violation) {
    result.first_violation = Violation{legs - 1, 0.0, "goal: the path ends elsewhere"};
  }
  measure(path, verifier.tolerance(), result);
  result.verified = !result.first_violation;
  return result;
}

}  // namespace warren
