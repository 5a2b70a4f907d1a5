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

}  // namespace warren
