// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/verify_se2.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "parallel/chunks.hpp"
#include "worlds/body_verifier.hpp"
#include "worlds/pose_runs.hpp"

namespace warren {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

void check_input(std::span<const Vec2> outline, std::span<const Se2> path, const Se2VerifyOptions& options) {
  if (outline.size() < 3) throw InputError("robot", "a polygon needs three corners or more");
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
  if (!(options.clearance >= 0.0 && options.clearance <= largest_coordinate)) {
    throw InputError("clearance", "must be a number from 0 to 1e60", fmt::format("{}", options.clearance));
  }
}

/// What a run of legs came to.
struct PathReport {
  double least = std::numeric_limits<double>::infinity();
  std::optional<Violation> first;  // in the order of legs

  void add(const LegReport& report) {
    least = std::min(least, report.least);
    if (report.violation && (!first || report.violation->leg < first->leg)) first = report.violation;
  }
  void add(const PathReport& later) {
    least = std::min(least, later.least);
    if (!first) first = later.first;
  }
};

/// A path, cut into runs that are checked as one leg each.
class PathCheck {
 public:
  PathCheck(BodyVerifier& body, std::span<const Se2> path, const Execution& execution)
      : body_(body), path_(path), execution_(execution), runs_(pose_runs(path, body.bend(), execution)) {
    execution.reserve(runs_.size() * sizeof(Leg));
    for (const PoseRun& run : runs_) legs_.push_back(leg_of(path, run));
  }

  /// All runs, with obstacles up to `reach` away.
  PathReport check(double reach) {
    constexpr std::size_t runs_a_chunk = 16;
    body_.look_around(legs_, reach);
    std::vector<PathReport> parts(chunk_count(runs_.size(), runs_a_chunk));
    for_chunks(runs_.size(), runs_a_chunk, execution_, [&](Range r) {
      Sides scratch;
      for (std::size_t i = r.first; i < r.last; ++i) check_run(i, scratch, parts[r.first / runs_a_chunk]);
    });
    PathReport whole;
    for (const PathReport& part : parts) whole.add(part);
    return whole;
  }

 private:
  /// A single leg of about half a turn is checked both ways round.
  void check_run(std::size_t number, Sides& sides, PathReport& report) const {
    const PoseRun& run = runs_[number];
    const Leg& leg = legs_[number];
    report.add(body_.check_pose(path_[run.first], run.first));
    report.add(body_.check_pose(path_[run.last], run.last - std::min<std::size_t>(run.legs(), 1)));
    body_.gather(leg, sides);
    report.add(blamed(run, body_.check(leg, sides, run.first), sides));
    constexpr double nearly_half = 0.5 * full_turn * (1.0 - 1e-12);
    if (std::abs(leg.turn) < nearly_half) return;
    report.add(body_.check({leg.a, leg.way, leg.turn - std::copysign(full_turn, leg.turn)}, sides, run.first));
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
  const Execution& execution_;
  std::vector<PoseRun> runs_;
  std::vector<Leg> legs_;
};

}  // namespace

Se2Verification verify_se2(const Scene& scene, std::span<const Vec2> outline, std::span<const Se2> path,
                           const Se2VerifyOptions& options, const Execution& execution) {
  check_input(outline, path, options);
  BodyVerifier body(scene, outline, options.clearance, execution);
  constexpr double widening = 8.0;
  double reach = std::max(body.least_reach(), 1e-9);  // a body may have no extent
  PathCheck path_check(body, path, execution);
  PathReport report = path_check.check(reach);
  while (report.least > reach && !body.looks_everywhere(path)) {  // nothing so near: how far is it?
    reach *= widening;
    report = path_check.check(reach);
  }

  Se2Verification result;
  result.min_clearance = std::max(report.least, 0.0);
  const auto note = [&](const Violation& v) {
    if (!result.first_violation || v.leg < result.first_violation->leg) result.first_violation = v;
  };
  if (options.start && !is_there(path.front(), *options.start, false, options.tolerance)) {
    note({0, 0.0, "start: the path begins elsewhere"});
  }
  if (report.first) note(*report.first);
  if (options.goal && !is_there(path.back(), *options.goal, options.any_heading, options.tolerance)) {
    if (!result.first_violation)
      note({std::max<std::size_t>(path.size(), 2) - 2, 0.0, "goal: the path ends elsewhere"});
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    result.length += std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
    result.turn_rad += std::abs(shorter_turn(path[i - 1].theta, path[i].theta));
  }
  result.verified = !result.first_violation;
  return result;
}

}  // namespace warren
