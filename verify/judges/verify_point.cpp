// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/contact.hpp"
#include "verify/judges/judged_input.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/judges/legs_against_obstacles.hpp"
#include "verify/judges/verify_map.hpp"
#include "verify/near/leg_boxes.hpp"
#include "verify/near/obstacle_index.hpp"
#include "verify/near/obstacle_sides.hpp"

namespace warren {
namespace {

/// One verification in progress: the path's legs among the scene's obstacles.
class Verifier {
 public:
  Verifier(const Scene& scene, const ObstacleIndex* index, std::span<const Vec2> path, const VerifyOptions& options,
           const Execution& execution)
      : scene_(scene),
        index_(index),
        path_(path),
        options_(options),
        execution_(execution),
        legs_(path, execution),
        own_obstacles_(index == nullptr ? std::optional<Obstacles>(scene) : std::nullopt),
        obstacles_(index == nullptr ? *own_obstacles_ : index->obstacles()) {}

  Verification run() {
    Tally tally = index_ == nullptr ? compare_obstacles(scene_, obstacles_, legs_, options_, execution_)
                                    : compare_indexed(*index_, legs_, options_, execution_);
    check_contacts(tally);
    check_insides(tally);
    box_ = frame(tally);
    check_box(box_, legs_, tally);
    LegReport legs{.least = tally.least};
    if (tally.violation != no_violation) legs.violation = describe(tally);
    Verification result = verdict_on(legs, wrong_start(path_, options_), wrong_goal(path_, options_));
    result.length = legs_.length();
    return result;
  }

 private:
  std::size_t leg_count() const { return legs_.leg_count(); }

  Box frame(const Tally& tally) const { return scene_.bounds ? *scene_.bounds : tally.box; }

  void check_contacts(Tally& tally) const {
    if (tally.contacts.empty()) return;
    std::sort(tally.contacts.begin(), tally.contacts.end());
    tally.contacts.erase(std::unique(tally.contacts.begin(), tally.contacts.end()), tally.contacts.end());
    const std::size_t leg_end = std::min(tally.violation.leg, leg_count());
    const auto forbidden =
        first_forbidden_contact(path_, leg_end, frame(tally), obstacles_, tally.contacts, execution_);
    if (forbidden) tally.violation = *forbidden;
  }

  /// Who starts outside a polygon and never passes its sides stays outside.
  void check_insides(Tally& tally) const {
    const std::optional<std::size_t> ring = ring_around(obstacles_, index_, path_.front(), execution_);
    if (!ring) return;
    tally.least = 0.0;
    tally.violation = std::min(tally.violation, LegContact{0, obstacles_.first_side(*ring)});
  }

  Violation describe(const Tally& tally) const {
    const auto [leg, number] = tally.violation;
    if (number == box_number) {
      const auto unsigned_zero = [](double x) { return x + 0.0; };  // which zero is the least, depends on the order
      return {leg, 0.0,
              fmt::format("box: {} {} {} {}", unsigned_zero(box_.min.x), unsigned_zero(box_.min.y),
                          unsigned_zero(box_.max.x), unsigned_zero(box_.max.y))};
    }
    const double d = tally.least == 0.0 && leg == 0 && is_inside(number)
                         ? 0.0
                         : exact::distance({path_[leg], path_[leg + 1]}, obstacles_.segment(number));
    return {leg, d, obstacles_.name(number)};
  }

  /// Is the number a polygon's, and does the path begin inside?
  bool is_inside(std::size_t number) const {
    if (number < obstacles_.wall_count()) return false;
    const Ring& ring = obstacles_.rings()[obstacles_.sides()[number - obstacles_.wall_count()].ring];
    return ring.polygon != Ring::none && strictly_inside(ring, path_.front());
  }

  const Scene& scene_;
  const ObstacleIndex* index_;
  std::span<const Vec2> path_;
  const VerifyOptions& options_;
  const Execution& execution_;
  const LegBoxes legs_;
  const std::optional<Obstacles> own_obstacles_;
  const Obstacles& obstacles_;
  Box box_;
};

/// The first point whose coordinates are not numbers or too large; the path's size, if there is none.
std::size_t first_misfit(std::span<const Vec2> path, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const auto fits = [](Vec2 p) { return std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate; };
  return first_that(path.size(), grain, execution.quiet(), [&](std::size_t i) { return !fits(path[i]); });
}

}  // namespace

void check_judged_path(std::span<const Vec2> path, const VerifyOptions& options, const Execution& execution) {
  constexpr std::size_t most_legs = 500'000'000;  // told at once; a path is 16 bytes a leg, and its boxes come on top
  if (path.empty()) throw InputError("path", "has no points");
  if (path.size() > most_legs + 1) throw InputError("path", "more than 500 million legs can't be verified");
  if (const std::size_t i = first_misfit(path, execution); i < path.size()) {
    throw InputError(fmt::format("path point {}", i), "expected finite coordinates of at most 1e60");
  }
  check_not_negative("radius", options.radius);
  check_not_negative("clearance", options.clearance);
  check_not_negative("tolerance", options.tolerance);
}

std::optional<Violation> wrong_start(std::span<const Vec2> path, const VerifyOptions& options) {
  if (!options.start || norm(path.front() - *options.start) <= options.tolerance) return std::nullopt;
  return elsewhere("start", std::array{options.start->x, options.start->y}, norm(path.front() - *options.start), 0);
}

std::optional<Violation> wrong_goal(std::span<const Vec2> path, const VerifyOptions& options) {
  if (!options.goal || norm(path.back() - *options.goal) <= options.tolerance) return std::nullopt;
  return elsewhere("goal", std::array{options.goal->x, options.goal->y}, norm(path.back() - *options.goal),
                   legs_of(path.size()) - 1);
}

Verification verify_path(const Scene& scene, std::span<const Vec2> path, const VerifyOptions& options,
                         const Execution& execution, const ObstacleIndex* index) {
  assert(index == nullptr || &index->scene() == &scene);
  check_judged_path(path, options, execution);
  check_plane_scene(scene, execution);
  if (scene.map) return verify_on_map(*scene.map, path, options, execution);
  const Vec2 twice[] = {path.front(), path.front()};
  const std::span<const Vec2> legs = path.size() > 1 ? path : std::span<const Vec2>(twice);
  Verification verdict = Verifier(scene, index, legs, options, execution).run();
  verdict.min_clearance -= options.radius;
  return verdict;
}

}  // namespace warren
