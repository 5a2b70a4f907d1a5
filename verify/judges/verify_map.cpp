// SPDX-License-Identifier: BSD-3-Clause
// All lengths are in cells until they are reported. A window of cells around a leg grows until it holds a blocked one
// or reaches as far as the least distance met so far, so a path far from everything is not compared with everything.
#include "verify/judges/verify_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/judged_input.hpp"
#include "verify/judges/leg_reports.hpp"

namespace warren {
namespace {

/// Is this cell closed to the robot?
class Closed {
 public:
  Closed(const OccupancyMap& map, bool on_water) : map_(map), on_water_(on_water) {}
  bool operator()(std::int64_t x, std::int64_t y) const {
    if (x < 0 || y < 0 || x >= map_.width() || y >= map_.height()) return true;
    return on_water_ ? !map_.water.holds(x, y) : map_.blocked.holds(x, y);
  }

 private:
  const OccupancyMap& map_;
  bool on_water_;
};

/// Distance between a leg and a cell's closed square.
double distance_to_square(const Segment& leg, std::int64_t x, std::int64_t y) {
  const Vec2 low{static_cast<double>(x), static_cast<double>(y)};
  const Box square{low, low + Vec2{1.0, 1.0}};
  if (square.contains(leg.a) || square.contains(leg.b)) return 0.0;
  const Vec2 corners[] = {low, {square.max.x, low.y}, square.max, {low.x, square.max.y}};
  double least = std::numeric_limits<double>::infinity();
  for (int side = 0; side < 4; ++side) {
    least = std::min(least, exact::distance(leg, {corners[side], corners[(side + 1) % 4]}));
  }
  return least;
}

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// The nearest closed cell of those within `reach` of the leg; nothing beyond `reach` is promised.
Nearest nearest_within(const Closed& closed, const Segment& leg, double reach) {
  const Box box = box_of(leg).grown(reach);
  Nearest nearest;
  const auto whole = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
  for (std::int64_t y = whole(box.min.y); y <= whole(box.max.y); ++y) {
    for (std::int64_t x = whole(box.min.x); x <= whole(box.max.x); ++x) {
      if (!closed(x, y)) continue;
      const double distance = distance_to_square(leg, x, y);
      if (distance < nearest.distance) nearest = {distance, x, y};
    }
  }
  return nearest;
}

/// Long legs in pieces of a few cells, so that a leg across the map is not compared with its whole box.
Nearest nearest_to(const Closed& closed, const Segment& leg, double enough, const Execution& execution) {
  constexpr double piece_cells = 16.0;
  const double length = distance(leg.a, leg.b);
  const auto pieces = static_cast<std::int64_t>(std::ceil(length / piece_cells)) + (length == 0.0 ? 1 : 0);
  Nearest nearest;
  nearest.distance = enough;
  for (std::int64_t p = 0; p < pieces; ++p) {
    execution.check();
    const auto at = [&](std::int64_t i) {
      const double t = static_cast<double>(i) / static_cast<double>(pieces);
      return i == pieces ? leg.b : leg.a + t * (leg.b - leg.a);
    };
    const Segment piece{at(p), at(p + 1)};
    for (double reach = 1.0;; reach *= 2.0) {
      const double window = std::min(reach, nearest.distance);
      const Nearest found = nearest_within(closed, piece, window);
      if (found.distance < nearest.distance) nearest = found;
      if (window >= nearest.distance || found.distance <= window) break;
    }
  }
  return nearest;
}

void check(std::span<const Vec2> path, const VerifyOptions& options) {
  if (path.empty()) throw InputError("path", "has no points");
  for (const Vec2 p : path) {
    if (!(std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate)) {
      throw InputError("path", "has a point that is not finite");
    }
  }
  check_not_negative("radius", options.radius);
  check_not_negative("clearance", options.clearance);
  check_not_negative("tolerance", options.tolerance);
  if (options.contact == Contact::allowed) {
    throw InputError("contact", "can't be allowed on a map: a blocked cell is a closed square");
  }
}

}  // namespace

Verification verify_on_map(const OccupancyMap& map, std::span<const Vec2> path, const VerifyOptions& options,
                           const Execution& execution) {
  check(path, options);
  const auto first_cell = cell_at(map, path.front());
  const Closed closed(map, first_cell && !map.water.empty() && map.water.test(first_cell->x, first_cell->y));
  constexpr double rounding = 1e-9;  // of coordinates turned into cells
  const double needed = options.reach() / map.cell * (1.0 - rounding);
  const auto leg_at = [&](std::size_t i) { return Segment{path[i], path[std::min(i + 1, path.size() - 1)]}; };
  constexpr std::size_t legs_a_chunk = 256;
  LegReport legs = report_legs(legs_of(path.size()), legs_a_chunk, execution, [&](Range r) {
    LegReport report;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto [a, b] = leg_at(i);
      const Nearest nearest = nearest_to(closed, {map_point(map, a), map_point(map, b)}, report.least, execution);
      report.least = std::min(report.least, nearest.distance);
      const bool is_free = nearest.distance > 0.0 && nearest.distance >= needed;
      if (is_free || report.violation) continue;
      report.violation = Violation{i, nearest.distance * map.cell, fmt::format("cell {}, {}", nearest.x, nearest.y)};
    }
    return report;
  });
  legs.least *= map.cell;
  Verification result = verdict_on(legs, wrong_start(path, options), wrong_goal(path, options));
  result.min_clearance -= options.radius;
  for (std::size_t i = 0; i < legs_of(path.size()); ++i) result.length += distance(leg_at(i).a, leg_at(i).b);
  return result;
}

}  // namespace warren
