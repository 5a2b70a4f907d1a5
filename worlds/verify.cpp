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
#include "worlds/leg_index.hpp"
#include "worlds/obstacles.hpp"
#include "worlds/path_screen.hpp"

namespace warren {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t grain = std::size_t{1} << 15;
constexpr std::size_t sample_block = 512;  // walls in a row: as many as make one visit to memory worth it
constexpr std::size_t sample_stride = 32 * sample_block;

// Obstacle numbers past all real ones, in the order in which they are reported on one leg.
constexpr std::size_t box_number = std::numeric_limits<std::size_t>::max() - 2;
constexpr std::size_t goal_number = box_number + 1;
constexpr LegContact no_violation{std::numeric_limits<std::size_t>::max(), 0};

/// What a part of the obstacles says about the path.
struct Tally {
  double least = infinity;  ///< least distance met
  LegContact violation = no_violation;
  std::vector<LegContact> contacts;  ///< only where contact is allowed
  Box box;                           ///< of the obstacles

  void join(Tally&& other) {
    least = std::min(least, other.least);
    violation = std::min(violation, other.violation);
    contacts.insert(contacts.end(), other.contacts.begin(), other.contacts.end());
    box.include(other.box);
  }
};

/// Compares obstacles with the path's legs, one after the other, and keeps the tally. Distances at or above `at_most`
/// are of no interest.
class Comparison {
 public:
  Comparison(const LegIndex& legs, const VerifyOptions& options, double at_most)
      : legs_(legs), options_(options), at_most_(at_most) {
    narrow();
  }

  void with_near_legs(const Segment& obstacle, std::size_t number) {
    const Box box = box_of(obstacle);
    tally_.box.include(box);
    std::size_t seen_first = 1;  // neighbouring cells hold the same legs: these have just been compared
    std::size_t seen_last = 0;
    legs_.for_each_near(obstacle, [&](std::size_t first, std::size_t last) {
      if (seen_first > seen_last || first > seen_last + 1 || last + 1 < seen_first) {
        seen_first = first;
        seen_last = last;
        return compare(obstacle, box, number, first, last);
      }
      if (first < seen_first) {
        compare(obstacle, box, number, first, seen_first - 1);
        seen_first = first;
      }
      if (last > seen_last) {
        compare(obstacle, box, number, seen_last + 1, last);
        seen_last = last;
      }
    });
  }
  void with_all_legs(const Segment& obstacle, std::size_t number) {
    compare(obstacle, box_of(obstacle), number, 0, legs_.leg_count() - 1);
  }
  Tally take() { return std::move(tally_); }

 private:
  bool too_far(const Box& a, const Box& b) const {
    const double gap = exact::gap_sq(a, b);
    return gap >= near_sq_ && gap > 0.0;
  }

  /// Does the whole box lie farther from the obstacle's line than is of interest?
  bool beside(const Segment& obstacle, const Box& box) const {
    const Vec2 along = obstacle.b - obstacle.a;
    const Vec2 to = 0.5 * (box.min + box.max) - obstacle.a;
    const double spread = 0.5 * (std::abs(along.x) * box.height() + std::abs(along.y) * box.width());
    const double error = 1e-15 * (std::abs(along.x * to.y) + std::abs(along.y * to.x) + spread);
    const double room = std::abs(cross(along, to)) - spread - 8.0 * error;
    return room > 0.0 && room * room > near_sq_ * dot(along, along) * (1.0 + 1e-12);
  }

  void compare(const Segment& obstacle, const Box& box, std::size_t number, std::size_t first, std::size_t last) {
    legs_.for_each_in(
        first, last, [&](const Box& legs_box) { return too_far(legs_box, box) || beside(obstacle, legs_box); },
        [&](std::size_t leg) {
          const Segment s = legs_.leg(leg);
          if (!too_far(box_of(s), box)) compare(s, leg, obstacle, number);
        });
  }

  void compare(const Segment& s, std::size_t leg, const Segment& obstacle, std::size_t number) {
    const double r = options_.clearance;
    const double d = exact::distance(s, obstacle);
    if (d < tally_.least) {
      tally_.least = d;
      narrow();
    }
    if (r > 0.0) {
      if (d <= r * (1.0 + 1e-12) || is_doubtful(d, s, obstacle)) {
        if (exact::closer_than(s, obstacle, r)) forbid(leg, number);
      }
    } else if (d == 0.0 && exact::touch(s, obstacle)) {
      touch(s, leg, obstacle, number);
    }
  }

  /// Is d within its own rounding of the clearance?
  bool is_doubtful(double d, const Segment& s, const Segment& obstacle) const {
    Box both = box_of(s);
    both.include(box_of(obstacle));
    return d <= options_.clearance + 1e-14 * std::max(both.width(), both.height());
  }

  void touch(const Segment& s, std::size_t leg, const Segment& obstacle, std::size_t number) {
    if (options_.contact == Contact::blocked || exact::cross_inside(s, obstacle)) return forbid(leg, number);
    const LegContact contact{leg, number};
    if (tally_.contacts.empty() || tally_.contacts.back() != contact) tally_.contacts.push_back(contact);
  }

  void forbid(std::size_t leg, std::size_t number) {
    tally_.violation = std::min(tally_.violation, LegContact{leg, number});
  }

  void narrow() {
    const double r = options_.clearance;
    const double least = std::min(at_most_, tally_.least);
    near_sq_ = std::max(least * least, r * r * (1.0 + 1e-12));
  }

  const LegIndex& legs_;
  const VerifyOptions& options_;
  double at_most_;
  double near_sq_ = infinity;  // legs at this distance (squared) and above are left out
  Tally tally_;
};

/// Runs `compare(comparison, i)` for i = 0 .. count - 1 in chunks of `size`, each with a comparison of its own.
template <class Compare>
Tally tally_of(std::size_t count, std::size_t size, const LegIndex& legs, const VerifyOptions& options, double at_most,
               const Execution& execution, const Compare& compare) {
  std::vector<Tally> parts(chunk_count(count, size));
  for_chunks(count, size, execution, [&](Range r) {
    Comparison comparison(legs, options, at_most);
    for (std::size_t i = r.first; i < r.last; ++i) compare(comparison, i);
    parts[r.first / size] = comparison.take();
  });
  Tally all;
  for (Tally& part : parts) all.join(std::move(part));
  return all;
}

/// One verification in progress: the path's legs among the scene's obstacles.
class Verifier {
 public:
  Verifier(const Scene& scene, std::span<const Vec2> path, const VerifyOptions& options, const Execution& execution)
      : scene_(scene), path_(path), options_(options), execution_(execution), obstacles_(scene) {}

  Verification run() {
    Tally tally = compare_all();
    check_contacts(tally);
    check_insides(tally);
    check_box(tally);
    check_goal(tally);
    Verification result;
    for (std::size_t i = 0; i < leg_count(); ++i) result.length += norm(path_[i + 1] - path_[i]);
    result.min_clearance = tally.least;
    result.first_violation = start_violation();
    if (!result.first_violation && tally.violation != no_violation) result.first_violation = describe(tally);
    result.verified = !result.first_violation;
    return result;
  }

 private:
  /// Half the extent of the middle one of some walls.
  double typical_wall() const {
    constexpr std::size_t most = 1023;
    const std::size_t step = std::max<std::size_t>(1, scene_.walls.size() / most);
    std::vector<double> halves;
    for (std::size_t i = 0; i < scene_.walls.size(); i += step) {
      const Box box = box_of(scene_.walls.segment(i));
      halves.push_back(0.5 * std::max(box.width(), box.height()));
    }
    if (halves.empty()) return 0.0;
    const auto middle = halves.begin() + static_cast<std::ptrdiff_t>(halves.size() / 2);
    std::nth_element(halves.begin(), middle, halves.end());
    return *middle;
  }

  std::size_t leg_count() const { return path_.size() - 1; }

  Tally compare_all() {
    const double half_wall = typical_wall();
    PathScreen screen(path_, 2.0 * half_wall, execution_);
    const double bound = least_of_some(screen);
    const double reach = std::max(bound, options_.clearance);
    if (!(reach <= 4.0 * screen.cell())) {
      legs_.emplace(path_, LegIndex::Plan{options_.clearance, obstacles_.size(), half_wall}, execution_);
      return compare_unscreened();
    }
    screen.set_reach(bound, options_.clearance);
    Screened screened = screened_obstacles(screen);
    Tally tally;
    if (!screened.doubtful.empty()) {
      legs_.emplace(path_, LegIndex::Plan{reach, screened.doubtful.size(), half_wall}, execution_);
      legs_->set_reach(reach, execution_);
      const auto compare = [&](Comparison& comparison, std::size_t i) {
        comparison.with_near_legs(obstacles_.segment(screened.doubtful[i]), screened.doubtful[i]);
      };
      tally = tally_of(screened.doubtful.size(), grain, *legs_, options_, reach, execution_, compare);
    }
    tally.box = screened.box;
    tally.least = std::min(tally.least, bound);
    return tally;
  }

  /// A distance from the path that some wall has: nothing beyond it matters for the least one.
  double least_of_some(const PathScreen& screen) const {
    constexpr std::size_t most_blocks = 256;
    constexpr std::size_t block = 64;  // walls in a row
    const std::size_t count = obstacles_.size();
    const std::size_t blocks = std::min(most_blocks, chunk_count(count, 8 * block));
    double least = infinity;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t first = count / blocks * b;
      for (std::size_t i = first; i < std::min(first + block, count); ++i) {
        least = std::min(least, screen.distance_of_some(obstacles_.segment(i)));
      }
    }
    return least;
  }

  /// What the screen says about obstacles.
  struct Screened {
    std::vector<std::size_t> doubtful;  ///< these may be near the path
    Box box;                            ///< of all

    void join(const Screened& other) {
      doubtful.insert(doubtful.end(), other.doubtful.begin(), other.doubtful.end());
      box.include(other.box);
    }
  };

  Screened screened_obstacles(const PathScreen& screen) const {
    Screened all = scene_.walls.visit([&](auto walls) {
      return screened(screen, walls.size(), 0, [walls](std::size_t i) { return box_of(walls[i].segment()); });
    });
    const Box walls_box = all.box;
    const auto side = [&](std::size_t i) { return box_of(obstacles_.side_segment(i)); };
    all.join(screened(screen, obstacles_.sides().size(), obstacles_.wall_count(), side));
    all.box = walls_box;
    for (const Ring& ring : obstacles_.rings()) include_corners(ring, all.box);
    return all;
  }

  /// Numbers count from `first_number`.
  template <class BoxAt>
  Screened screened(const PathScreen& screen, std::size_t count, std::size_t first_number, const BoxAt& box_at) const {
    std::vector<Screened> parts(chunk_count(count, grain));
    for_chunks(count, grain, execution_, [&](Range r) {
      Screened part;
      std::size_t budget = 65536 + 64 * r.size();  // words of cells: for many short obstacles and a few long ones
      for (std::size_t i = r.first; i < r.last; ++i) {
        const Box box = box_at(i);
        part.box.min = {std::min(part.box.min.x, box.min.x), std::min(part.box.min.y, box.min.y)};
        part.box.max = {std::max(part.box.max.x, box.max.x), std::max(part.box.max.y, box.max.y)};
        if (!screen.is_clear(box, budget)) part.doubtful.push_back(first_number + i);
      }
      parts[r.first / grain] = std::move(part);
    });
    Screened all;
    for (const Screened& part : parts) all.join(part);
    return all;
  }

  /// The bounds are no obstacle in this sense.
  static void include_corners(const Ring& ring, Box& box) {
    if (ring.polygon == Ring::none) return;
    for (const Vec2 p : ring.corners) box.include(p);
  }

  Tally compare_unscreened() {
    LegIndex& legs = *legs_;
    const double widest = 4.0 * legs.cell();
    double bound = infinity;  // a distance that some wall has: nothing beyond it matters for the least one
    if (scene_.walls.size() > 8 * sample_stride) {
      legs.set_reach(widest, execution_);
      bound = sampled_least(widest);
    }
    const double reach = std::max(options_.clearance, std::min(bound, widest));
    legs.set_reach(reach, execution_);
    Tally tally = walls_against_path(reach);
    tally.join(sides_against_path(reach));
    tally.least = std::min(tally.least, bound);
    if (tally.least > reach) tally.least = least_of_far();
    return tally;
  }

  double sampled_least(double reach) const {
    return scene_.walls.visit([&](auto walls) {
      const std::size_t blocks = walls.size() / sample_stride;
      const auto compare = [&, walls](Comparison& comparison, std::size_t block) {
        const std::size_t first = block * sample_stride;
        for (std::size_t i = first; i < first + sample_block; ++i) comparison.with_near_legs(walls[i].segment(), i);
      };
      return tally_of(blocks, 64, *legs_, options_, reach, execution_, compare).least;
    });
  }

  Tally walls_against_path(double reach) const {
    return scene_.walls.visit([&](auto walls) {
      const auto compare = [walls](Comparison& comparison, std::size_t i) {
        comparison.with_near_legs(walls[i].segment(), i);
      };
      return tally_of(walls.size(), grain, *legs_, options_, reach, execution_, compare);
    });
  }

  Tally sides_against_path(double reach) const {
    const auto compare = [&](Comparison& comparison, std::size_t i) {
      comparison.with_near_legs(obstacles_.side_segment(i), obstacles_.wall_count() + i);
    };
    Tally tally = tally_of(obstacles_.sides().size(), grain, *legs_, options_, reach, execution_, compare);
    tally.box = {};  // the bounds are no obstacle in this sense
    for (const Ring& ring : obstacles_.rings()) include_corners(ring, tally.box);
    return tally;
  }

  /// For a path with nothing within reach: all legs against all obstacles, by the boxes of legs. A few of the obstacles
  /// go first, so that every chunk starts with a good bound.
  double least_of_far() const {
    const auto compare = [&](Comparison& comparison, std::size_t i) {
      comparison.with_all_legs(obstacles_.segment(i), i);
    };
    const std::size_t step = std::max<std::size_t>(1, obstacles_.size() / 512);
    const auto compare_some = [&](Comparison& comparison, std::size_t i) { compare(comparison, i * step); };
    const std::size_t some = obstacles_.size() / step;
    const double bound = tally_of(some, grain, *legs_, options_, infinity, execution_, compare_some).least;
    return std::min(bound, tally_of(obstacles_.size(), grain, *legs_, options_, bound, execution_, compare).least);
  }

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
  Obstacles obstacles_;
  std::optional<LegIndex> legs_;  ///< made only where the screen leaves something open
  Box box_;
};

void check_input(std::span<const Vec2> path, const VerifyOptions& options) {
  if (path.empty()) throw InputError("path", "has no points");
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool fits = std::abs(path[i].x) <= largest_coordinate && std::abs(path[i].y) <= largest_coordinate;
    if (!fits) throw InputError(fmt::format("path point {}", i), "expected finite coordinates of at most 1e60");
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
  check_input(path, options);
  if (path.size() > 1) return Verifier(scene, path, options, execution).run();
  const Vec2 twice[] = {path.front(), path.front()};
  return Verifier(scene, twice, options, execution).run();
}

}  // namespace warren
