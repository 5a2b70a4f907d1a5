// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/judged_input.hpp"
#include "verify/judges/leg_reports.hpp"

namespace warren {
namespace {

/// Of contacts on legs before the first violation: may the path pass there?
void check_contacts(std::span<const Vec2> path, const Box& frame, const Obstacles& obstacles, Tally& tally,
                    const Execution& execution) {
  if (tally.contacts.empty()) return;
  std::sort(tally.contacts.begin(), tally.contacts.end());
  tally.contacts.erase(std::unique(tally.contacts.begin(), tally.contacts.end()), tally.contacts.end());
  const std::size_t leg_end = std::min(tally.violation.leg, legs_of(path.size()));
  const auto forbidden = first_forbidden_contact(path, leg_end, frame, obstacles, tally.contacts, execution);
  if (forbidden) tally.violation = *forbidden;
}

Violation describe(const Tally& tally, std::span<const Vec2> path, const Obstacles& obstacles, const Box& box) {
  const auto [leg, number] = tally.violation;
  if (number == box_number) {
    const auto unsigned_zero = [](double x) { return x + 0.0; };  // which zero is the least, depends on the order
    return {leg, 0.0,
            fmt::format("box: {} {} {} {}", unsigned_zero(box.min.x), unsigned_zero(box.min.y),
                        unsigned_zero(box.max.x), unsigned_zero(box.max.y))};
  }
  const auto is_inside = [&, number = number] {  // is the number a polygon's, and does the path begin inside?
    if (number < obstacles.wall_count()) return false;
    const Ring& ring = obstacles.rings()[obstacles.sides()[number - obstacles.wall_count()].ring];
    return ring.polygon != Ring::none && strictly_inside(ring, path.front());
  };
  const double d = tally.least == 0.0 && leg == 0 && is_inside()
                       ? 0.0
                       : exact::distance({path[leg], path[leg + 1]}, obstacles.segment(number));
  return {leg, d, obstacles.name(number)};
}

/// The path's legs, one at least, among the scene's obstacles.
Verification judged_legs(const Scene& scene, const ObstacleIndex* index, std::span<const Vec2> path,
                         const VerifyOptions& options, const Execution& execution) {
  const LegBoxes legs(path, execution);
  const auto own = index == nullptr ? std::optional<Obstacles>(scene) : std::nullopt;
  const Obstacles& obstacles = index == nullptr ? *own : index->obstacles();
  Tally tally = index == nullptr ? compare_obstacles(scene, obstacles, legs, options, execution)
                                 : compare_indexed(*index, legs, options, execution);
  const Box box = scene.bounds ? *scene.bounds : tally.box;
  check_contacts(path, box, obstacles, tally, execution);
  // Who starts outside a polygon and never passes its sides stays outside.
  if (const auto ring = ring_around(obstacles, index, path.front(), execution)) {
    tally.least = 0.0;
    tally.violation = std::min(tally.violation, LegContact{0, obstacles.first_side(*ring)});
  }
  check_box(box, legs, tally);
  LegReport report{.least = tally.least};
  if (tally.violation != no_violation) report.violation = describe(tally, path, obstacles, box);
  Verification result = verdict_on(report, wrong_ends(path, options, legs_of(path.size())));
  result.length = legs.length();
  return result;
}

}  // namespace

void check_judged_path(std::span<const Vec2> path, const VerifyOptions& options, const Execution& execution) {
  constexpr std::size_t most_legs = 500'000'000;  // told at once; a path is 16 bytes a leg, and its boxes come on top
  if (path.empty()) throw InputError("path", "has no points");
  if (path.size() > most_legs + 1) throw InputError("path", "more than 500 million legs can't be verified");
  constexpr std::size_t grain = std::size_t{1} << 14;
  const auto fits = [](Vec2 p) { return std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate; };
  const auto misfit = first_that(path.size(), grain, execution.quiet(), [&](std::size_t i) { return !fits(path[i]); });
  if (misfit < path.size()) {
    throw InputError(fmt::format("path point {}", misfit), "expected finite coordinates of at most 1e60");
  }
  check_not_negative("radius", options.radius);
  check_not_negative("clearance", options.clearance);
  check_not_negative("tolerance", options.tolerance);
}

WrongEnds wrong_ends(std::span<const Vec2> path, const VerifyOptions& options, std::size_t legs) {
  const auto wrong = [&](std::string_view which, const std::optional<Vec2>& wanted, Vec2 end, std::size_t leg) {
    if (!wanted || norm(end - *wanted) <= options.tolerance) return std::optional<Violation>();
    return std::optional(elsewhere(which, std::array{wanted->x, wanted->y}, norm(end - *wanted), leg));
  };
  return {wrong("start", options.start, path.front(), 0), wrong("goal", options.goal, path.back(), legs - 1)};
}

Verification verify_path(const Scene& scene, std::span<const Vec2> path, const VerifyOptions& options,
                         const Execution& execution, const ObstacleIndex* index) {
  assert(index == nullptr || &index->scene() == &scene);
  check_judged_path(path, options, execution);
  check_plane_scene(scene, execution);
  if (scene.map) return verify_on_map(*scene.map, path, options, execution);
  const Vec2 twice[] = {path.front(), path.front()};
  const std::span<const Vec2> legs = path.size() > 1 ? path : std::span<const Vec2>(twice);
  Verification verdict = judged_legs(scene, index, legs, options, execution);
  verdict.min_clearance -= options.radius;
  return verdict;
}

}  // namespace warren
