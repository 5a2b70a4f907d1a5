// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"
#include "verify/exact/exact_segments.hpp"
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

// Is this path free on a map? Each leg is compared with the closed square of every blocked cell near it, in cells; what
// lies outside of the map is blocked. Independent of what found it: nothing from spatial/ or planners/, orientations
// and distances by verify/exact/exact_segments, borders as the cells say and not as walls.
//
// All lengths are in cells until they are reported. A window of cells around a leg grows until it holds a blocked one
// or reaches as far as the least distance met so far, so a path far from everything is not compared with everything.

/// Is this cell closed to the robot?
struct Closed {
  const OccupancyMap& map;
  bool on_water;

  bool operator()(std::int64_t x, std::int64_t y) const {
    if (x < 0 || y < 0 || x >= map.width() || y >= map.height()) return true;
    return on_water ? !map.water.holds(x, y) : map.blocked.holds(x, y);
  }
  /// Of the map's cells.
  Box box() const { return {{}, {static_cast<double>(map.width()), static_cast<double>(map.height())}}; }
};

/// A leg in cells, and the distance that it has to keep.
struct JudgedLeg {
  Segment segment;
  double needed;

  /// From a cell's closed square: on the right side of what is needed, whatever the rounding of the distance.
  double distance_to_cell(Vec2 low) const {
    const Box square{low, low + Vec2{1.0, 1.0}};
    if (square.contains(segment.a) || square.contains(segment.b)) return 0.0;
    const std::array<Vec2, 4> corners = square.corners();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t side = 0; side < 4; ++side) {
      least = std::min(least, distance_to(exact::outline_side(corners, side)));
    }
    return least;
  }

 private:
  double distance_to(const Segment& side) const {
    const double d = exact::distance(segment, side);
    if (needed == 0.0 || !(std::abs(d - needed) <= 2.0 * exact::distance_error * needed)) return d;
    return exact::closer_than(segment, side, needed) ? std::min(d, std::nextafter(needed, 0.0)) : std::max(d, needed);
  }
};

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  double x = 0.0;  // of a cell, which may be anywhere outside
  double y = 0.0;
};

/// The nearest closed cell of those within `reach` of the piece; nothing beyond `reach` is promised.
Nearest nearest_within(const Closed& closed, const JudgedLeg& leg, const Segment& piece, double reach,
                       const Execution& execution) {
  constexpr std::uint64_t cells_a_poll = 1 << 16;
  const Box box = box_of(piece).grown(reach);
  const auto whole = [](double x, double most) { return bounded_whole<std::int64_t>(std::floor(x), -1.0, most); };
  const std::int64_t last_x = whole(box.max.x, closed.box().max.x);
  const std::int64_t last_y = whole(box.max.y, closed.box().max.y);
  std::uint64_t asked = 0;
  Nearest nearest;
  for (std::int64_t y = whole(box.min.y, closed.box().max.y); y <= last_y; ++y) {
    for (std::int64_t x = whole(box.min.x, closed.box().max.x); x <= last_x; ++x) {
      if (++asked % cells_a_poll == 0) execution.check();
      if (!closed(x, y)) continue;
      const Vec2 low{static_cast<double>(x), static_cast<double>(y)};
      const double distance = leg.distance_to_cell(low);
      if (distance < nearest.distance) nearest = {distance, low.x, low.y};
    }
  }
  return nearest;
}

/// Long legs in pieces of a few cells, so that a leg across the map is not compared with its whole box. A leg with an
/// end outside of the map is settled at once: so the numbers of pieces and cells are bounded by the map's.
Nearest nearest_to(const Closed& closed, const JudgedLeg& leg, double enough, const Execution& execution) {
  constexpr double piece_cells = 16.0;
  const Vec2 a = leg.segment.a;
  const Vec2 b = leg.segment.b;
  for (const Vec2 end : {a, b}) {
    if (!closed.box().contains(end)) return {0.0, std::floor(end.x) + 0.0, std::floor(end.y) + 0.0};  // no -0
  }
  const double pieces = std::max(std::ceil(distance(a, b) / piece_cells), 1.0);
  const double rounding = pieces > 1.0 ? 1e-6 : 0.0;  // of a piece's ends
  Nearest nearest;
  nearest.distance = std::max(enough, leg.needed);  // what is farther matters neither to this leg nor to the least
  for (double p = 0.0; p < pieces; ++p) {
    execution.check();
    const auto at = [&](double i) { return i == pieces ? b : a + (i / pieces) * (b - a); };
    const Segment piece{at(p), at(p + 1.0)};
    for (double reach = 1.0;; reach *= 2.0) {
      const double window = std::min(reach, nearest.distance);
      const Nearest found = nearest_within(closed, leg, piece, window + rounding, execution);
      if (found.distance < nearest.distance) nearest = found;
      if (window >= nearest.distance || found.distance <= window) break;
    }
  }
  return nearest;
}

/// By how much the point's place in cells may be off, in cells: by nothing where neither difference nor quotient was
/// rounded, as on maps that are not turned, with their origin at 0 and cells of 1.
double rounding_at(const OccupancyMap& map, Vec2 p) {
  const auto is_exact = [&](double x, double origin) {
    const double from = x - origin;
    const double back = from - x;
    const double lost = (x - (from - back)) - (origin + back);
    return lost == 0.0 && std::fma(from / map.cell, map.cell, -from) == 0.0;
  };
  if (map.yaw_rad == 0.0 && is_exact(p.x, map.origin.x) && is_exact(p.y, map.origin.y)) return 0.0;
  return 4e-15 * (norm(p) + norm(map.origin)) / map.cell;
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
}

WrongEnds wrong_ends(std::span<const Vec2> path, const VerifyOptions& options, std::size_t legs) {
  const auto wrong = [&](std::string_view which, const std::optional<Vec2>& wanted, Vec2 end, std::size_t leg) {
    if (!wanted || norm(end - *wanted) == 0.0) return std::optional<Violation>();
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

Verification verify_on_map(const OccupancyMap& map, std::span<const Vec2> path, const VerifyOptions& options,
                           const Execution& execution) {
  check_judged_path(path, options, execution);
  if (options.contact == Contact::allowed) {
    throw InputError("contact", "can't be allowed on a map: a blocked cell is a closed square");
  }
  const auto first_cell = cell_at(map, path.front());
  const Closed closed{map, first_cell && map.water.holds(first_cell->x, first_cell->y)};
  const auto leg_at = [&](std::size_t i) { return Segment{path[i], path[std::min(i + 1, path.size() - 1)]}; };
  constexpr std::size_t legs_a_chunk = 256;
  LegReport legs = report_legs(legs_of(path.size()), legs_a_chunk, execution, [&](Range r) {
    LegReport report;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto [a, b] = leg_at(i);
      // Needed is less than what is asked for by what rounding may take, and no more.
      const double rounding = rounding_at(map, a) + rounding_at(map, b);
      const JudgedLeg leg{{map_point(map, a), map_point(map, b)}, std::max(options.reach() / map.cell - rounding, 0.0)};
      const Nearest nearest = nearest_to(closed, leg, report.least, execution);
      report.least = std::min(report.least, nearest.distance);
      const bool is_free = nearest.distance > 0.0 && nearest.distance >= leg.needed;
      if (is_free || report.violation) continue;
      report.violation = Violation{i, nearest.distance * map.cell, fmt::format("cell {}, {}", nearest.x, nearest.y)};
    }
    return report;
  });
  legs.least *= map.cell;
  Verification result = verdict_on(legs, wrong_ends(path, options, legs_of(path.size())));
  result.min_clearance -= options.radius;
  if (result.verified) result.min_clearance = std::max(result.min_clearance, 0.0);  // but for rounding
  for (std::size_t i = 0; i < legs_of(path.size()); ++i) result.length += distance(leg_at(i).a, leg_at(i).b);
  return result;
}

}  // namespace warren
