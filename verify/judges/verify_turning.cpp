// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_turning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "verify/judges/body_on_leg.hpp"
#include "verify/judges/judged_input.hpp"
#include "verify/near/straight_runs.hpp"

namespace warren {
namespace {

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
// The whole body is judged (verify/judges/body_on_leg.hpp): at each pose neither lies in an obstacle nor an obstacle in
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

void check_car(const RobotSpec& car) {
  if (!(car.turning_radius > 0.0 && car.turning_radius <= largest_coordinate)) {
    throw InputError("robot: turning radius", "must be a number above 0", fmt::format("{}", car.turning_radius));
  }
  check_not_negative("robot: radius", car.radius);
  if (!car.outline.empty() && car.radius > 0.0) throw InputError("robot", "is a disc or a polygon, not both");
  check_outline(car.outline);
}

}  // namespace

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
  check_not_negative("tolerance", options.tolerance);
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
