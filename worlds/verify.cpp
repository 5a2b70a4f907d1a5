// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "parallel/chunks.hpp"
#include "worlds/contact_walk.hpp"
#include "worlds/exact_segments.hpp"
#include "worlds/leg_boxes.hpp"
#include "worlds/obstacles.hpp"
#include "worlds/verify_comparison.hpp"
#include "worlds/verify_obstacles.hpp"

namespace warren {
namespace {

// Obstacle numbers past all real ones, in the order in which they are reported on one leg.
constexpr std::size_t box_number = std::numeric_limits<std::size_t>::max() - 2;
constexpr std::size_t goal_number = box_number + 1;

/// One verification in progress: the path's legs among the scene's obstacles.
class Verifier {
 public:
  Verifier(const Scene& scene, std::span<const Vec2> path, const VerifyOptions& options, const Execution& execution)
      : scene_(scene),
        path_(path),
        options_(options),
        execution_(execution),
        legs_(path, execution),
        obstacles_(scene) {}

  Verification run() {
    Tally tally = compare_obstacles(scene_, obstacles_, legs_, options_, execution_);
    check_contacts(tally);
    check_insides(tally);
    check_box(tally);
    check_goal(tally);
    Verification result;
    result.length = legs_.length();
    result.min_clearance = tally.least;
    result.first_violation = start_violation();
    if (!result.first_violation && tally.violation != no_violation) result.first_violation = describe(tally);
    result.verified = !result.first_violation;
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
    for (std::size_t ring = 0; ring < obstacles_.rings().size(); ++ring) {
      if (ring % 1024 == 0) execution_.check();
      if (obstacles_.rings()[ring].polygon == Ring::none) continue;
      if (!strictly_inside(obstacles_.rings()[ring], path_.front())) continue;
      tally.least = 0.0;
      tally.violation = std::min(tally.violation, LegContact{0, obstacles_.first_side(ring)});
      return;
    }
  }

  void check_box(Tally& tally) {
    box_ = frame(tally);
    if (box_.empty()) return;  // no obstacle, no bounds: nothing confines the path
    if (box_.contains(legs_.box().min) && box_.contains(legs_.box().max)) return;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      if (box_.contains(path_[i])) continue;
      tally.violation = std::min(tally.violation, LegContact{i == 0 ? 0 : i - 1, box_number});
      return;
    }
  }

  void check_goal(Tally& tally) const {
    if (!options_.goal || norm(path_.back() - *options_.goal) <= options_.start_tolerance) return;
    tally.violation = std::min(tally.violation, LegContact{leg_count() - 1, goal_number});
  }

  std::optional<Violation> start_violation() const {
    if (!options_.start || norm(path_.front() - *options_.start) <= options_.start_tolerance) return std::nullopt;
    return Violation{0, norm(path_.front() - *options_.start), place("start", *options_.start)};
  }

  static std::string place(std::string_view what, Vec2 p) { return fmt::format("{}: {} {}", what, p.x, p.y); }

  Violation describe(const Tally& tally) const {
    const auto [leg, number] = tally.violation;
    if (number == box_number) {
      return {leg, 0.0, fmt::format("box: {} {} {} {}", box_.min.x, box_.min.y, box_.max.x, box_.max.y)};
    }
    if (number == goal_number) return {leg, norm(path_.back() - *options_.goal), place("goal", *options_.goal)};
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
  std::span<const Vec2> path_;
  const VerifyOptions& options_;
  const Execution& execution_;
  const LegBoxes legs_;
  Obstacles obstacles_;
  Box box_;
};

/// The first point whose coordinates are not numbers or too large; the path's size, if there is none.
std::size_t first_misfit(std::span<const Vec2> path, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  Execution quiet = execution;
  quiet.progress = nullptr;
  std::vector<std::size_t> first(chunk_count(path.size(), grain), path.size());
  for_chunks(path.size(), grain, quiet, [&](Range r) {
    const auto fits = [](Vec2 p) { return std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate; };
    const auto part = path.subspan(r.first, r.size());
    const auto misfit = std::find_if_not(part.begin(), part.end(), fits);
    if (misfit != part.end()) first[r.first / grain] = r.first + static_cast<std::size_t>(misfit - part.begin());
  });
  return *std::min_element(first.begin(), first.end());
}

void check_input(std::span<const Vec2> path, const VerifyOptions& options, const Execution& execution) {
  constexpr std::size_t most_legs = 500'000'000;  // so that legs, and their runs in cells, can be numbered in 32 bits
  if (path.empty()) throw InputError("path", "has no points");
  if (path.size() > most_legs + 1) throw InputError("path", "more than 500 million legs can't be verified");
  if (const std::size_t i = first_misfit(path, execution); i < path.size()) {
    throw InputError(fmt::format("path point {}", i), "expected finite coordinates of at most 1e60");
  }
  if (!(options.clearance >= 0.0) || !(options.clearance <= largest_coordinate)) {
    throw InputError("clearance", "expected a finite number >= 0", fmt::format("{}", options.clearance));
  }
  if (!(options.start_tolerance >= 0.0)) {
    throw InputError("start_tolerance", "expected a number >= 0", fmt::format("{}", options.start_tolerance));
  }
}

}  // namespace

Verification verify_path(const Scene& scene, std::span<const Vec2> path, const VerifyOptions& options,
                         const Execution& execution) {
  check_input(path, options, execution);
  if (path.size() > 1) return Verifier(scene, path, options, execution).run();
  const Vec2 twice[] = {path.front(), path.front()};
  return Verifier(scene, twice, options, execution).run();
}

}  // namespace warren
