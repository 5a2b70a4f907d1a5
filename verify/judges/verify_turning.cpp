// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_turning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/near/sides_near_legs.hpp"

namespace warren {
namespace {

// One leg of a body that moves in the plane against all sides of obstacles near it: the head of the header tells the
// method for bodies that turn while they go straight, what is said of cars below that of arcs. Both rest on this: a
// body that is apart from an obstacle where a leg begins, neither inside of the other, and whose outline does not meet
// the obstacle's on the leg, stays apart.

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The way of the reference point about the point that the body turns about.
Arc arc_of(const Leg& leg) {
  const Vec2 aside{-leg.way.y, leg.way.x};
  return {leg.a.position() + 0.5 * leg.way + (0.5 / portable::tan(0.5 * leg.turn)) * aside, leg.a.position(), leg.turn};
}

double distance_to(const std::vector<Vec2>& corners, const Segment& s) {
  if (outline_holds(corners, s.a, true)) return 0.0;  // exact signs, but the corners are rounded
  double least = infinity;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    least = std::min(least, exact::distance(exact::outline_side(corners, i), s));
  }
  return least;
}

/// Where the body does not turn, it sweeps the bodies at both ends and a parallelogram a side.
double distance_to_sweep(const std::vector<Vec2>& corners, Vec2 way, const Segment& s) {
  double least = distance_to(corners, s);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [a, b] = exact::outline_side(corners, i);
    const std::vector<Vec2> swept{a, b, b + way, a + way};
    least = std::min(least, distance_to(swept, s));
  }
  return least;
}

/// The corners go along arcs, and in the body's eyes the side's ends do, the other way round: apart at the start, they
/// come nearest where one of these is.
double distance_to_arcs(const std::vector<Vec2>& corners, const Arc& way, const Segment& s) {
  double least = distance_to(corners, s);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [a, b] = exact::outline_side(corners, i);
    least = std::min(least, distance(Arc{way.center, b, way.turn}, s));
    for (const Vec2 end : {s.a, s.b}) least = std::min(least, distance(Arc{way.center, end, -way.turn}, {a, b}));
  }
  return least;
}

/// What may be near a leg: sides of obstacles.
using Sides = std::vector<NearSide>;

/// One body among the obstacles of a scene. Refers to all that it is given. Any number of threads may check.
class BodyVerifier {
 public:
  /// outline: of a disc its middle alone, and then `clearance` includes its radius. poses_off: how far poses may stand
  /// off the box of the obstacles, where nothing else confines them.
  BodyVerifier(const Scene& scene, std::span<const Vec2> outline, double clearance, double poses_off,
               const Execution& execution, const ObstacleIndex* index)
      : index_(index),
        surroundings_(scene, index, execution),
        outline_(outline),
        clearance_(clearance),
        poses_off_(poses_off),
        execution_(execution),
        confines_(scene.bounds),
        map_(scene.map ? &*scene.map : nullptr) {
    for (const Vec2 p : outline_) radius_ = std::max(radius_, portable::hypot(p.x, p.y));
    bend_ = 1e-15 * surroundings_.largest_coordinate();
    rounding_ = 2e-14 * (surroundings_.largest_coordinate() + 2.0 * radius_ + clearance) + 4.0 * bend_;
    finest_ = std::max(1e-9 * radius_, 0.1 * rounding_);  // so no leg is halved more than some 50 times
    close_ = 1e-3 * radius_;
  }

  /// What all legs come to. settle(i) says of the i-th what needs no obstacle near it; where that is a violation, the
  /// leg is looked at no more: it may go anywhere. Of the others report_of(i, sides) says the rest, by all sides that
  /// may be near the leg or a part of it, once or several times: at first with the obstacles up to `reach` away, or
  /// what the body needs, then with ever more until the least distance is known.
  template <class Settle, class ReportOf>
  LegReport check_all(std::span<const Leg> legs, std::span<const Se2> path, double reach, const Settle& settle,
                      const ReportOf& report_of) {
    constexpr double widening = 8.0;
    constexpr std::size_t legs_a_chunk = 16;
    reach = std::max(1.01 * clearance_ + radius_, reach);
    execution_.reserve(legs.size());
    std::vector<std::uint8_t> settled(legs.size());
    const LegReport at_once = report_legs(legs.size(), legs_a_chunk, execution_.quiet(), [&](Range r) {
      LegReport part;
      for (std::size_t i = r.first; i < r.last; ++i) {
        const LegReport leg = settle(i);
        settled[i] = leg.violation ? 1 : 0;
        part.add(leg);
      }
      return part;
    });
    for (;; reach *= widening) {
      look_around(legs, settled, reach);
      LegReport whole = at_once;
      whole.add(report_legs(legs.size(), legs_a_chunk, execution_, [&](Range r) {
        Sides scratch;
        LegReport part;
        for (std::size_t i = r.first; i < r.last; ++i) {
          if (settled[i] != 0) continue;
          surroundings_.gather(boxes_of(legs[i]), scratch, execution_);
          part.add(report_of(i, scratch));
        }
        return part;
      }));
      if (whole.least <= reach || looks_everywhere(path)) return whole;
    }
  }

  /// How far poses may lie beside the line that is checked in their place.
  double bend() const { return bend_; }

  LegReport check(const Leg& leg, const Sides& sides) const {
    if (leg.turn == 0.0) return check_straight(leg, sides);
    return leg.is_arc ? check_arc(leg, sides) : check_turning(leg, sides);
  }
  /// Is the pose inside a polygon, outside the bounds, off the box or among a map's blocked cells? Boundaries are
  /// check()'s.
  LegReport check_pose(const Se2& pose, std::size_t number) const {
    const std::vector<Vec2> corners = corners_at({pose, {}, 0.0}, 0.0);
    const auto bad = [&](std::string what) {
      return LegReport{.least = 0.0, .met = 0.0, .violation = Violation{number, 0.0, std::move(what)}};
    };
    if (confines_) {
      for (const Vec2 p : corners) {
        if (!confines_->contains(p)) return bad(fmt::format("bounds: the corner {} {} is outside", p.x, p.y));
      }
    } else if (map_ != nullptr) {
      const std::optional<Cell> cell = cell_at(*map_, corners.front());
      if (!cell) return bad("map: the body is outside");
      if (map_->blocked.test(cell->x, cell->y)) return bad(fmt::format("cell {}, {}", cell->x, cell->y));
    } else if (!surroundings_.box().grown(poses_off_).contains({pose.x, pose.y})) {
      return bad(fmt::format("box: {} {} is outside the box of the obstacles", pose.x, pose.y));
    }
    const Obstacles& obstacles = surroundings_.obstacles();
    if (const auto ring = ring_around(obstacles, index_, corners.front(), execution_)) {
      return bad(fmt::format("polygon {}: holds {} {}", obstacles.rings()[*ring].polygon, corners.front().x,
                             corners.front().y));
    }
    return {};
  }

 private:
  struct Near {
    const NearSide* side;
    double distance;
  };
  /// Obstacles farther than `reach` from these legs, but for the settled ones, are left out from now on.
  void look_around(std::span<const Leg> legs, std::span<const std::uint8_t> settled, double reach) {
    reach_ = reach;
    if (map_ != nullptr) return;  // is read where it is asked
    constexpr std::size_t many = 1024;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      if (settled[i] != 0) continue;
      const std::vector<Box> more = boxes_of(legs[i]);
      if (i % many == 0 || more.size() >= many) execution_.reserve((many + more.size()) * sizeof(Box));  // and polls
      boxes.insert(boxes.end(), more.begin(), more.end());
    }
    surroundings_.file(boxes, execution_);
  }
  /// Does any reach that is larger find the same?
  bool looks_everywhere(std::span<const Se2> path) const {
    Box all = surroundings_.box();
    if (confines_) all.include(*confines_);
    for (const Se2& pose : path) all.include(pose.position());
    return reach_ >= all.width() + all.height();
  }
  /// Around the body and its reach on parts of the leg, which are about as long as the boxes are wide. Ends are in the
  /// box of the obstacles, and a turn is half of one at most: so the leg is hardly longer than that box.
  std::vector<Box> boxes_of(const Leg& leg) const {
    const double around = (radius_ + reach_) * (1.0 + 1e-9) + rounding_;
    constexpr double most_parts = 65536.0;
    const bool bends = leg.is_arc && leg.turn != 0.0;
    const Arc arc = bends ? arc_of(leg) : Arc{};
    const double radius = bends ? distance(arc.center, arc.from) : 0.0;
    const double length = bends ? radius * std::abs(leg.turn) : portable::hypot(leg.way.x, leg.way.y);
    const double parts = std::clamp(std::ceil(length / (4.0 * around)), 1.0, most_parts);
    const double bulge = radius * (1.0 - portable::cos(0.5 * leg.turn / parts)) * (1.0 + 1e-9);  // over a part's chord
    const double margin = around + bulge + leg.blur;
    const auto at = [&](double part) {
      return bends ? arc.at(leg.turn * part / parts) : leg.a.position() + (part / parts) * leg.way;
    };
    std::vector<Box> boxes;
    for (double part = 0.0; part < parts; ++part) boxes.push_back(box_of({at(part), at(part + 1.0)}).grown(margin));
    return boxes;
  }
  /// No halving: exact but for the rounding of corners.
  LegReport check_straight(const Leg& leg, const Sides& sides) const {
    const std::vector<Vec2> corners = corners_at(leg, 0.0);
    Box swept;
    for (const Vec2 p : corners) {
      swept.include(p);
      swept.include(p + leg.way);
    }
    LegReport report;
    execution_.check();
    for (const NearSide& side : sides) {
      if (std::sqrt(exact::gap_sq(swept, box_of(side.segment))) > report.met) continue;
      note(distance_to_sweep(corners, leg.way, side.segment), rounding_ + leg.blur, side, leg, report);
    }
    return report;
  }
  LegReport check_turning(const Leg& leg, const Sides& sides) const {
    std::vector<Near> all;
    all.reserve(sides.size());
    for (const NearSide& side : sides) all.push_back({&side, 0.0});
    LegReport report;
    check_piece(leg, 0.5, 0.5, all, report);
    return report;
  }
  /// No halving: exact but for rounding.
  LegReport check_arc(const Leg& leg, const Sides& sides) const {
    const std::vector<Vec2> corners = corners_at({leg.a, {}, 0.0}, 0.0);
    const Arc way = arc_of(leg);
    const double rounding = rounding_ + leg.blur + 1e-15 * distance(way.center, way.from);
    LegReport report;
    for (const NearSide& side : sides) {
      execution_.check();
      if (distance(way, side.segment) - radius_ > report.met) continue;
      note(distance_to_arcs(corners, way, side.segment), rounding, side, leg, report);
    }
    if (!report.violation && leaves_box(way)) {
      report.violation = Violation{leg.number, 0.0, "box: the way leaves the box of the obstacles"};
    }
    return report;
  }
  /// Notes a distance, which is known but for `rounding`, if it is the least.
  void note(double distance, double rounding, const NearSide& side, const Leg& leg, LegReport& report) const {
    if (distance >= report.met) return;
    report.met = distance;
    report.least = distance - rounding;
    if (report.least > clearance_ || (clearance_ > 0.0 && report.least >= clearance_)) return;
    report.violation = Violation{leg.number, distance, surroundings_.name(side.number)};
  }
  /// Between its ends, which are looked at as poses.
  bool leaves_box(const Arc& way) const {
    if (confines_ || map_ != nullptr) return false;
    const std::array<Vec2, 4> corners = surroundings_.box().grown(2.0 * poses_off_).corners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (distance(way, exact::outline_side(corners, i)) == 0.0) return true;
    }
    return false;
  }
  std::vector<Vec2> corners_at(const Leg& leg, double t) const {
    const double theta = leg.a.theta + t * leg.turn;
    const auto [s, c] = portable::sin_and_cos(theta);
    std::vector<Vec2> corners;
    corners.reserve(outline_.size());
    for (const Vec2 p : outline_) {
      corners.push_back({leg.a.x + t * leg.way.x + (c * p.x - s * p.y), leg.a.y + t * leg.way.y + (s * p.x + c * p.y)});
    }
    return corners;
  }
  /// The sides of `among` that may be the nearest to the body within `way` of the place t.
  std::vector<Near> nearest_at(const Leg& leg, double t, double way, const std::vector<Near>& among) const {
    const std::vector<Vec2> corners = corners_at(leg, t);
    Box body;
    for (const Vec2 p : corners) body.include(p);
    double least = infinity;
    const double spread = 2.0 * (way + rounding_);
    std::vector<Near> near;
    for (const Near& n : among) {
      const Segment& s = n.side->segment;
      if (std::sqrt(exact::gap_sq(body, box_of(s))) > least + spread) continue;
      const double distance = distance_to(corners, s);
      least = std::min(least, distance);
      near.push_back({n.side, distance});
    }
    std::erase_if(near, [&](const Near& n) { return n.distance > least + spread; });
    return near;
  }
  /// Checks the part of the leg that is `half` to both sides of `middle`.
  void check_piece(const Leg& leg, double middle, double half, const std::vector<Near>& among,
                   LegReport& report) const {
    constexpr std::size_t most_looks = 2'000'000;  // some seconds
    constexpr std::size_t enough_looks = 200'000;  // for the least distance; beyond, being apart is enough
    execution_.check();
    const bool weary = ++report.looks > most_looks;
    const double whole = portable::hypot(leg.way.x, leg.way.y) + radius_ * std::abs(leg.turn);
    const double way = half * whole * (1.0 + 1e-12);
    const std::vector<Near> near = nearest_at(leg, middle, way, among);
    if (near.empty() || report.violation) return;
    const Near nearest = *std::ranges::min_element(near, {}, &Near::distance);
    const double proved = nearest.distance - way - rounding_;
    report.met = std::min(report.met, nearest.distance);
    const bool settled = proved >= report.met - close_ || way < finest_ || report.looks > enough_looks;
    if (proved > clearance_ && settled) {
      report.least = std::min(report.least, proved);
      return;
    }
    if (nearest.distance <= rounding_ || nearest.distance + rounding_ < clearance_ || way < finest_ || weary) {
      report.least = std::min(report.least, nearest.distance);
      report.violation = Violation{leg.number, nearest.distance, surroundings_.name(nearest.side->number)};
      return;
    }
    check_piece(leg, middle - 0.5 * half, 0.5 * half, near, report);
    check_piece(leg, middle + 0.5 * half, 0.5 * half, near, report);
  }

  const ObstacleIndex* index_;  // nullptr: all obstacles are passed over
  PathSurroundings surroundings_;
  std::span<const Vec2> outline_;
  double clearance_;
  double poses_off_;
  const Execution& execution_;
  std::optional<Box> confines_;
  const OccupancyMap* map_;  // nullptr: the scene is none
  double reach_ = 0.0;       // obstacles farther away are left out
  double radius_ = 0.0;
  double bend_ = 0.0;
  double rounding_ = 0.0;  // bounds the error of every distance computed here, a bend included
  double finest_ = 0.0;    // pieces on which the body goes less are not halved
  double close_ = 0.0;     // how sharp the least clearance shall be
};

/// The same the other way round: of half a turn either may be meant, and both must be free.
Leg turned_back(Leg leg) {
  leg.turn -= std::copysign(2.0 * std::numbers::pi, leg.turn);
  return leg;
}

/// The violation of a run that has one becomes that of the first leg that has one: by halving.
void blame_leg(const BodyVerifier& body, std::span<const Se2> path, PoseRun run, const Sides& sides,
               LegReport& report) {
  while (run.legs() > 1) {
    const std::size_t middle = run.first + run.legs() / 2;
    const PoseRun earlier{run.first, middle};
    const bool is_earlier = body.check(leg_of(path, earlier), sides).violation.has_value();
    run = is_earlier ? earlier : PoseRun{middle, run.last};
  }
  const LegReport found = body.check(leg_of(path, run), sides);
  if (found.violation) {
    report.violation = found.violation;
  } else {
    report.violation->leg = run.first;
  }
}

/// A path, cut into runs that are checked as one leg each.
LegReport check_runs(BodyVerifier& body, std::span<const Se2> path, const Execution& execution) {
  constexpr double least_reach = 1e-9;  // the body may have no extent
  const auto settle = [&](const PoseRun& run) {
    LegReport report = body.check_pose(path[run.first], run.first);
    report.add(body.check_pose(path[run.last], run.last - std::min<std::size_t>(run.legs(), 1)));
    return report;
  };
  std::vector<PoseRun> runs;
  for (const PoseRun& run : pose_runs(path, body.bend(), execution)) {
    if (run.legs() < 2 || !settle(run).violation) {
      runs.push_back(run);
      continue;
    }
    // To or from where the body may not be it goes leg by leg: one before may be the first to blame.
    for (std::size_t i = run.first; i < run.last; ++i) runs.push_back({i, i + 1});
  }
  execution.reserve(runs.size() * sizeof(Leg));
  std::vector<Leg> legs;
  for (const PoseRun& run : runs) legs.push_back(leg_of(path, run));
  const auto report_of = [&](std::size_t i, const Sides& sides) {
    const Leg& leg = legs[i];
    LegReport report = body.check(leg, sides);
    if (report.violation && runs[i].legs() > 1) blame_leg(body, path, runs[i], sides, report);
    constexpr double nearly_half = std::numbers::pi * (1.0 - 1e-12);
    if (std::abs(leg.turn) >= nearly_half) report.add(body.check(turned_back(leg), sides));
    return report;
  };
  return body.check_all(
      legs, path, least_reach, [&](std::size_t i) { return settle(runs[i]); }, report_of);
}

// Is this path of a car drivable, and free? Independent of everything that found it: no steering curve is computed
// here, nothing from spatial/ is used. The path is a list of poses; between two of them the car keeps its steering
// wheel still, so two poses say all about a leg: its chord lies along the heading halfway, and length and turn give the
// radius, forwards or backwards. A leg whose poses contradict that, that turns tighter than the turning radius, or that
// goes backwards where the car can't, is refused.
//
// The whole body is judged (BodyVerifier): at each pose neither lies in an obstacle nor an obstacle in
// it, and nothing lies across it. On a leg the body turns about a point (or goes straight), so its corners follow arcs,
// and in its eyes the corners of the obstacles do: from there on the least distance is a minimum over arcs and sides in
// closed form (verify/exact/exact_segments.hpp). No halving, no sampling. O(obstacles) once, but for maps, then
// O(legs * sides near them * corners).

/// May it back up?
bool reverses(const RobotSpec& car) { return car.steering != SteeringKind::dubins; }

constexpr double poses_off = 1e-9;  // in turning radii

/// Can the car drive the leg?
std::optional<Violation> check_driving(const RobotSpec& car, const CarLeg& leg, std::size_t number, double tolerance) {
  const auto bad = [&](std::string what) { return Violation{number, 0.0, std::move(what), ViolationKind::motion}; };
  if (std::abs(leg.aside) > tolerance) {
    return bad(fmt::format("leg: slides sideways by {}; between two poses a car keeps its steering", leg.aside));
  }
  if (car.steering != SteeringKind::differential && leg.length + tolerance < car.turning_radius * std::abs(leg.turn)) {
    return bad(fmt::format("turning radius: {} is below {}", leg.radius, car.turning_radius));
  }
  if (!reverses(car) && leg.ahead < -tolerance) return bad(fmt::format("gear: goes backwards by {}", -leg.ahead));
  return std::nullopt;
}

/// Length, turns and gears.
void measure(std::span<const CarLeg> legs, double tolerance, Verification& result) {
  int gear = 0;
  for (const CarLeg& leg : legs) {
    result.length += leg.length;
    result.turn_rad += std::abs(leg.turn);
    if (leg.ahead < 0.0) result.reversed += leg.length;
    if (leg.length <= tolerance) continue;
    const int now = leg.ahead < 0.0 ? -1 : 1;
    if (gear == -now) ++result.cusps;
    gear = now;
  }
}

/// Throws InputError unless a polygon has three corners or more, within the limits.
void check_outline(std::span<const Vec2> outline) {
  if (outline.size() < 3) throw InputError("robot", "a polygon needs three corners or more");
  for (const Vec2 p : outline) {
    if (std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate) continue;
    throw InputError("robot", "must have corners of at most 1e60", fmt::format("{} {}", p.x, p.y));
  }
}

void check_car(const RobotSpec& car) {
  if (!(car.turning_radius > 0.0 && car.turning_radius <= largest_coordinate)) {
    throw InputError("robot: turning radius", "must be a number above 0", fmt::format("{}", car.turning_radius));
  }
  check_not_negative("robot: radius", car.radius);
  if (!car.outline.empty() && car.radius > 0.0) throw InputError("robot", "is a disc or a polygon, not both");
  if (!car.outline.empty()) check_outline(car.outline);
}

/// Throws InputError for paths, options and scenes that no judge of bodies with a heading takes: unless there is a
/// pose, and each has coordinates and a heading within the limits.
void check_judged_poses(const Scene& scene, std::span<const Se2> path, const PoseVerifyOptions& options,
                        const Execution& execution) {
  if (path.empty()) throw InputError("path", "has no poses");
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Se2& p = path[i];
    const bool fits = std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate;
    if (!fits) throw InputError(fmt::format("path: pose {}", i), "must have coordinates of at most 1e60");
    if (!(std::abs(p.theta) <= largest_heading)) {  // what lies between two headings is rounded with their size
      throw InputError(fmt::format("path: pose {}", i), "must have a heading of at most 1000 rad",
                       fmt::format("{}", p.theta));
    }
  }
  check_not_negative("clearance", options.clearance);
  check_plane_scene(scene, execution);
}

WrongEnds wrong_ends(std::span<const Se2> path, const PoseVerifyOptions& options) {
  const auto wrong = [&](std::string_view which, const std::optional<Se2>& wanted, const Se2& end, bool any_heading,
                         std::size_t leg) {
    if (!wanted) return std::optional<Violation>();
    const bool is_turned = !(std::abs(shorter_turn(end.theta, wanted->theta)) <= options.tolerance);
    const bool is_off = portable::hypot(end.x - wanted->x, end.y - wanted->y) > options.tolerance;
    if (!is_off && (any_heading || !is_turned)) return std::optional<Violation>();
    const std::array numbers{wanted->x, wanted->y, wanted->theta};
    const double off = distance(end.position(), wanted->position());
    return std::optional(elsewhere(which, std::span(numbers).first(any_heading ? 2 : 3), off, leg));
  };
  return {wrong("start", options.start, path.front(), false, 0),
          wrong("goal", options.goal, path.back(), options.any_heading, legs_of(path.size()) - 1)};
}

}  // namespace

Verification verify_se2(const Scene& scene, std::span<const Vec2> outline, std::span<const Se2> path,
                        const PoseVerifyOptions& options, const Execution& execution, const ObstacleIndex* index) {
  check_outline(outline);
  check_judged_poses(scene, path, options, execution);
  BodyVerifier body(scene, outline, options.clearance, 0.0, execution, index);
  LegReport legs = check_runs(body, path, execution);
  legs.least = std::max(legs.least, 0.0);
  Verification result = verdict_on(legs, wrong_ends(path, options));
  for (std::size_t i = 1; i < path.size(); ++i) {
    result.length += portable::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
    result.turn_rad += std::abs(shorter_turn(path[i - 1].theta, path[i].theta));
  }
  return result;
}

Verification verify_car(const Scene& scene, const RobotSpec& car, std::span<const Se2> path,
                        const PoseVerifyOptions& options, const Execution& execution, const ObstacleIndex* index) {
  check_car(car);
  check_judged_poses(scene, path, options, execution);
  const std::vector<Vec2> outline = car.outline.empty() ? std::vector<Vec2>{Vec2{}} : car.outline;
  BodyVerifier body(scene, outline, options.clearance + car.radius, poses_off * car.turning_radius, execution, index);
  double size = 0.0;
  for (const Vec2 p : outline) size = std::max(size, norm(p));
  execution.reserve(legs_of(path.size()) * (sizeof(CarLeg) + sizeof(Leg)));
  std::vector<CarLeg> legs;
  std::vector<Leg> motions;
  double largest = 0.0;
  for (std::size_t i = 0; i < legs_of(path.size()); ++i) {
    const CarLeg& leg = legs.emplace_back(car_leg_between(path[i], path[std::min(i + 1, path.size() - 1)]));
    const bool bends = leg.radius < 1e6 * car.turning_radius;  // arcs that hardly do go as straight ones
    const double blur = std::abs(leg.aside) + (bends ? 0.0 : std::abs(leg.turn) * (leg.length + size));
    motions.push_back({leg.a, leg.chord, bends ? leg.turn : 0.0, true, blur, i});
    if (reverses(car) && leg.is_half_turn()) motions.push_back(turned_back(motions.back()));
    largest = std::max({largest, std::abs(path[i].x), std::abs(path[i].y)});
  }
  const double tolerance = poses_off * car.turning_radius + 1e-14 * largest;
  const auto settle = [&](std::size_t motion) {
    const std::size_t i = motions[motion].number;
    LegReport report;
    report.violation = check_driving(car, legs[i], i, tolerance);
    if (report.violation) report.least = report.met = 0.0;  // where it goes nobody knows
    report.add(body.check_pose(path[i], i));
    report.add(body.check_pose(path[std::min(i + 1, path.size() - 1)], i));
    return report;
  };
  LegReport report = body.check_all(motions, path, 0.01 * car.turning_radius, settle,
                                    [&](std::size_t i, const Sides& sides) { return body.check(motions[i], sides); });
  report.least = std::max(report.least, 0.0) - car.radius;
  Verification result = verdict_on(report, wrong_ends(path, options));
  measure(legs, tolerance, result);
  return result;
}

}  // namespace warren
