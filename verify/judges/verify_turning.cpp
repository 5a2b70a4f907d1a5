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
// method for bodies that turn while they go straight, CarVerifier's that of arcs. Both rest on this: a body that is
// apart from an obstacle where a leg begins, neither inside of the other, and whose outline does not meet the
// obstacle's on the leg, stays apart.

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
  /// leg is looked at no more: it may go anywhere. Of the others report_of(i, sides) says the rest, with scratch for
  /// the sides, once or several times: at first with the obstacles up to `reach` away, then with ever more until the
  /// least distance is known.
  template <class Settle, class ReportOf>
  LegReport check_all(std::span<const Leg> legs, std::span<const Se2> path, double reach, const Settle& settle,
                      const ReportOf& report_of) {
    constexpr double widening = 8.0;
    constexpr std::size_t legs_a_chunk = 16;
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
          if (settled[i] == 0) part.add(report_of(i, scratch));
        }
        return part;
      }));
      if (whole.least <= reach || looks_everywhere(path)) return whole;
    }
  }
  double least_reach() const { return 1.01 * clearance_ + radius_; }

  /// How far poses may lie beside the line that is checked in their place.
  double bend() const { return bend_; }

  /// All sides that may be near the leg or a part of it.
  void gather(const Leg& leg, Sides& sides) const { surroundings_.gather(boxes_of(leg), sides, execution_); }
  /// `number` is what a violation calls the leg.
  LegReport check(const Leg& leg, const Sides& sides, std::size_t number) const {
    if (leg.turn == 0.0) return check_straight(leg, sides, number);
    return leg.is_arc ? check_arc(leg, sides, number) : check_turning(leg, sides, number);
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
    std::size_t side;  // of the leg's
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
    for (double part = 0.0; part < parts; ++part) {
      Box box;
      box.include(at(part));
      box.include(at(part + 1.0));
      boxes.push_back({box.min - Vec2{margin, margin}, box.max + Vec2{margin, margin}});
    }
    return boxes;
  }
  /// No halving: exact but for the rounding of corners.
  LegReport check_straight(const Leg& leg, const Sides& sides, std::size_t number) const {
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
      note(distance_to_sweep(corners, leg.way, side.segment), rounding_ + leg.blur, side, number, report);
    }
    return report;
  }
  LegReport check_turning(const Leg& leg, const Sides& sides, std::size_t number) const {
    std::vector<Near> all;
    all.reserve(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) all.push_back({i, 0.0});
    LegReport report;
    check_piece(leg, 0.5, 0.5, sides, all, number, report);
    return report;
  }
  /// No halving: exact but for rounding.
  LegReport check_arc(const Leg& leg, const Sides& sides, std::size_t number) const {
    const std::vector<Vec2> corners = corners_at({leg.a, {}, 0.0}, 0.0);
    const Arc way = arc_of(leg);
    const double rounding = rounding_ + leg.blur + 1e-15 * distance(way.center, way.from);
    LegReport report;
    for (const NearSide& side : sides) {
      execution_.check();
      if (distance(way, side.segment) - radius_ > report.met) continue;
      note(distance_to_arcs(corners, way, side.segment), rounding, side, number, report);
    }
    if (!report.violation && leaves_box(way)) {
      report.violation = Violation{number, 0.0, "box: the way leaves the box of the obstacles"};
    }
    return report;
  }
  /// Notes a distance, which is known but for `rounding`, if it is the least.
  void note(double distance, double rounding, const NearSide& side, std::size_t number, LegReport& report) const {
    if (distance >= report.met) return;
    report.met = distance;
    report.least = distance - rounding;
    if (report.least > clearance_ || (clearance_ > 0.0 && report.least >= clearance_)) return;
    report.violation = Violation{number, distance, surroundings_.name(side.number)};
  }
  /// Between its ends, which are looked at as poses.
  bool leaves_box(const Arc& way) const {
    if (confines_ || map_ != nullptr) return false;
    const auto [low, high] = surroundings_.box().grown(2.0 * poses_off_);
    const Segment sides[] = {
        {low, {high.x, low.y}}, {{high.x, low.y}, high}, {high, {low.x, high.y}}, {{low.x, high.y}, low}};
    return std::any_of(std::begin(sides), std::end(sides), [&](const Segment& s) { return distance(way, s) == 0.0; });
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
  std::vector<Near> nearest_at(const Leg& leg, double t, double way, const Sides& sides,
                               const std::vector<Near>& among) const {
    const std::vector<Vec2> corners = corners_at(leg, t);
    Box body;
    for (const Vec2 p : corners) body.include(p);
    double least = infinity;
    const double spread = 2.0 * (way + rounding_);
    std::vector<Near> near;
    for (const Near& n : among) {
      const Segment& s = sides[n.side].segment;
      if (std::sqrt(exact::gap_sq(body, box_of(s))) > least + spread) continue;
      const double distance = distance_to(corners, s);
      least = std::min(least, distance);
      near.push_back({n.side, distance});
    }
    std::erase_if(near, [&](const Near& n) { return n.distance > least + spread; });
    return near;
  }
  /// Checks the part of the leg that is `half` to both sides of `middle`.
  void check_piece(const Leg& leg, double middle, double half, const Sides& sides, const std::vector<Near>& among,
                   std::size_t number, LegReport& report) const {
    constexpr std::size_t most_looks = 2'000'000;  // some seconds
    constexpr std::size_t enough_looks = 200'000;  // for the least distance; beyond, being apart is enough
    execution_.check();
    const bool weary = ++report.looks > most_looks;
    const double whole = portable::hypot(leg.way.x, leg.way.y) + radius_ * std::abs(leg.turn);
    const double way = half * whole * (1.0 + 1e-12);
    const std::vector<Near> near = nearest_at(leg, middle, way, sides, among);
    if (near.empty() || report.violation) return;
    const auto less = [](const Near& a, const Near& b) { return a.distance < b.distance; };
    const Near nearest = *std::min_element(near.begin(), near.end(), less);
    const double proved = nearest.distance - way - rounding_;
    report.met = std::min(report.met, nearest.distance);
    const bool settled = proved >= report.met - close_ || way < finest_ || report.looks > enough_looks;
    if (proved > clearance_ && settled) {
      report.least = std::min(report.least, proved);
      return;
    }
    if (nearest.distance <= rounding_ || nearest.distance + rounding_ < clearance_ || way < finest_ || weary) {
      report.least = std::min(report.least, nearest.distance);
      report.violation = Violation{number, nearest.distance, surroundings_.name(sides[nearest.side].number)};
      return;
    }
    check_piece(leg, middle - 0.5 * half, 0.5 * half, sides, near, number, report);
    check_piece(leg, middle + 0.5 * half, 0.5 * half, sides, near, number, report);
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

constexpr double full_turn = 2.0 * std::numbers::pi;

/// A path, cut into runs that are checked as one leg each.
class PathCheck {
 public:
  PathCheck(BodyVerifier& body, std::span<const Se2> path, const Execution& execution) : body_(body), path_(path) {
    for (const PoseRun& run : pose_runs(path, body.bend(), execution)) add(run);
    execution.reserve(runs_.size() * sizeof(Leg));
    for (const PoseRun& run : runs_) legs_.push_back(leg_of(path, run));
  }

  LegReport check(double reach) {
    return body_.check_all(
        legs_, path_, reach, [&](std::size_t i) { return settle(runs_[i]); },
        [&](std::size_t i, Sides& sides) { return check_run(i, sides); });
  }

 private:
  /// A run to or from where the body may not be goes leg by leg: one before may be the first to blame.
  void add(const PoseRun& run) {
    if (run.legs() < 2 || !settle(run).violation) return runs_.push_back(run);
    for (std::size_t i = run.first; i < run.last; ++i) runs_.push_back({i, i + 1});
  }

  LegReport settle(const PoseRun& run) const {
    LegReport report = body_.check_pose(path_[run.first], run.first);
    report.add(body_.check_pose(path_[run.last], run.last - std::min<std::size_t>(run.legs(), 1)));
    return report;
  }

  /// A single leg of about half a turn is checked both ways round.
  LegReport check_run(std::size_t number, Sides& sides) const {
    const PoseRun& run = runs_[number];
    const Leg& leg = legs_[number];
    body_.gather(leg, sides);
    LegReport report = blamed(run, body_.check(leg, sides, run.first), sides);
    constexpr double nearly_half = 0.5 * full_turn * (1.0 - 1e-12);
    if (std::abs(leg.turn) >= nearly_half) {
      report.add(body_.check({leg.a, leg.way, leg.turn - std::copysign(full_turn, leg.turn)}, sides, run.first));
    }
    return report;
  }

  /// The report of a run, its violation that of the first leg that has one: by halving.
  LegReport blamed(PoseRun run, LegReport report, const Sides& sides) const {
    if (!report.violation || run.legs() < 2) return report;
    while (run.legs() > 1) {
      const std::size_t middle = run.first + run.legs() / 2;
      const PoseRun earlier{run.first, middle};
      const bool is_earlier = body_.check(leg_of(path_, earlier), sides, run.first).violation.has_value();
      run = is_earlier ? earlier : PoseRun{middle, run.last};
    }
    const LegReport found = body_.check(leg_of(path_, run), sides, run.first);
    if (found.violation) {
      report.violation = found.violation;
    } else {
      report.violation->leg = run.first;
    }
    return report;
  }

  BodyVerifier& body_;
  std::span<const Se2> path_;
  std::vector<PoseRun> runs_;
  std::vector<Leg> legs_;
};

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

class CarVerifier {
 public:
  CarVerifier(const Scene& scene, const RobotSpec& car, std::span<const Se2> path, const PoseVerifyOptions& options,
              const Execution& execution, const ObstacleIndex* index)
      : car_(car),
        path_(path),
        outline_(car.outline.empty() ? std::vector<Vec2>{Vec2{}} : car.outline),
        body_(scene, outline_, options.clearance + car.radius, small * car.turning_radius, execution, index) {
    for (const Vec2 p : outline_) size_ = std::max(size_, norm(p));
    execution.reserve(legs_of(path.size()) * (sizeof(CarLeg) + sizeof(Leg)));
    double largest = 0.0;
    for (std::size_t i = 0; i < legs_of(path.size()); ++i) {
      legs_.push_back(car_leg_between(path[i], path[std::min(i + 1, path.size() - 1)]));
      add_motion(i, motion_of(legs_.back()));
      if (reverses(car) && legs_.back().is_half_turn()) {  // either way may be meant: both must be free
        Leg other = motions_.back();
        other.turn -= std::copysign(2.0 * std::numbers::pi, other.turn);
        add_motion(i, other);
      }
      largest = std::max({largest, std::abs(path[i].x), std::abs(path[i].y)});
    }
    tolerance_ = small * car.turning_radius + 1e-14 * largest;
  }

  LegReport check() {
    const double reach = std::max(body_.least_reach(), 0.01 * car_.turning_radius);
    return body_.check_all(
        motions_, path_, reach, [&](std::size_t i) { return settle(i); },
        [&](std::size_t i, Sides& sides) {
          body_.gather(motions_[i], sides);
          return body_.check(motions_[i], sides, leg_of_motion_[i]);
        });
  }
  /// Length, turns and gears.
  void measure(Verification& result) const {
    int gear = 0;
    for (const CarLeg& leg : legs_) {
      result.length += leg.length;
      result.turn_rad += std::abs(leg.turn);
      if (leg.ahead < 0.0) result.reversed += leg.length;
      if (leg.length <= tolerance_) continue;
      const int now = leg.ahead < 0.0 ? -1 : 1;
      if (gear == -now) ++result.cusps;
      gear = now;
    }
  }

 private:
  static constexpr double small = 1e-9;  // what poses may be off by, in turning radii

  LegReport settle(std::size_t motion) const {
    const std::size_t i = leg_of_motion_[motion];
    LegReport report;
    report.violation = check_driving(legs_[i], i);
    if (report.violation) report.least = report.met = 0.0;  // where it goes nobody knows
    report.add(body_.check_pose(path_[i], i));
    report.add(body_.check_pose(path_[std::min(i + 1, path_.size() - 1)], i));
    return report;
  }
  /// Can the car drive it?
  std::optional<Violation> check_driving(const CarLeg& leg, std::size_t number) const {
    const auto bad = [&](std::string what) { return Violation{number, 0.0, std::move(what), ViolationKind::motion}; };
    if (std::abs(leg.aside) > tolerance_) {
      return bad(fmt::format("leg: slides sideways by {}; between two poses a car keeps its steering", leg.aside));
    }
    if (car_.steering != SteeringKind::differential &&
        leg.length + tolerance_ < car_.turning_radius * std::abs(leg.turn)) {
      return bad(fmt::format("turning radius: {} is below {}", leg.radius, car_.turning_radius));
    }
    if (!reverses(car_) && leg.ahead < -tolerance_) return bad(fmt::format("gear: goes backwards by {}", -leg.ahead));
    return std::nullopt;
  }
  void add_motion(std::size_t leg, const Leg& motion) {
    motions_.push_back(motion);
    leg_of_motion_.push_back(leg);
  }
  /// Arcs that hardly bend go as straight ones.
  Leg motion_of(const CarLeg& leg) const {
    const double aside = std::abs(leg.aside);
    if (leg.radius < 1e6 * car_.turning_radius) return {leg.a, leg.chord, leg.turn, true, aside};
    return {leg.a, leg.chord, 0.0, true, aside + std::abs(leg.turn) * (leg.length + size_)};
  }

  const RobotSpec& car_;
  std::span<const Se2> path_;
  std::vector<Vec2> outline_;  // of a disc: its middle
  BodyVerifier body_;
  std::vector<CarLeg> legs_;
  std::vector<Leg> motions_;
  std::vector<std::size_t> leg_of_motion_;
  double size_ = 0.0;  // of the body
  double tolerance_ = 0.0;
};

/// Throws InputError unless a body has no corner (a disc) or at least three.
void check_outline(std::span<const Vec2> outline) {
  if (!outline.empty() && outline.size() < 3) throw InputError("robot", "a polygon needs three corners or more");
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
  check_outline(car.outline);
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
    if (!wanted || is_there(end, *wanted, any_heading, options.tolerance)) return std::optional<Violation>();
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
  if (outline.empty()) throw InputError("robot", "a polygon needs three corners or more");
  check_outline(outline);
  check_judged_poses(scene, path, options, execution);
  BodyVerifier body(scene, outline, options.clearance, 0.0, execution, index);
  LegReport legs = PathCheck(body, path, execution).check(std::max(body.least_reach(), 1e-9));  // it may have no extent
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
  CarVerifier verifier(scene, car, path, options, execution, index);
  LegReport legs = verifier.check();
  legs.least = std::max(legs.least, 0.0) - car.radius;
  Verification result = verdict_on(legs, wrong_ends(path, options));
  verifier.measure(result);
  return result;
}

}  // namespace warren
