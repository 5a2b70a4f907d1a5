// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/grid_world.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "core/plane/geometry.hpp"

namespace warren {
namespace {

constexpr double margin = 1e-9;  // cells

double planning_reach(const OccupancyMap& map, double radius) {
  if (!(radius >= 0.0) || !std::isfinite(radius)) {
    throw InputError("radius", "must be a number from 0", std::to_string(radius));
  }
  return std::max(radius / map.cell * (1.0 + margin), margin);
}

/// Distance between a leg and the closed unit square at (x, y).
double distance_to_square(const Segment& leg, double x, double y) {
  const Box square{{x, y}, {x + 1.0, y + 1.0}};
  if (square.contains(leg.a) || square.contains(leg.b)) return 0.0;
  const Vec2 corners[] = {square.min, {square.max.x, y}, square.max, {x, square.max.y}};
  double least = distance(leg, {corners[3], corners[0]});
  for (int side = 0; side < 3; ++side) least = std::min(least, distance(leg, {corners[side], corners[side + 1]}));
  return least;
}

/// The part of a leg at heights low to high, as its range of x; empty (from > to) where there is none.
std::pair<double, double> range_between(const Segment& leg, double low, double high) {
  const Vec2 a = leg.a.y <= leg.b.y ? leg.a : leg.b;
  const Vec2 b = leg.a.y <= leg.b.y ? leg.b : leg.a;
  if (b.y < low || a.y > high) return {1.0, 0.0};
  const auto at = [&](double y) {
    if (y <= a.y) return a.x;
    if (y >= b.y) return b.x;
    return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
  };
  return std::minmax({at(low), at(high)});
}

}  // namespace

GridWorld::GridWorld(const OccupancyMap& map, double radius) : map_(map), reach_(planning_reach(map, radius)) {
  box_ = {{0.0, 0.0}, {map.cell * map.width(), map.cell * map.height()}};
}

GridWorld::GridWorld(const OccupancyMap& map, double radius, const Execution& execution, MapMilestones milestones)
    : GridWorld(map, radius) {
  const bool fits_every_cell = reach_ < 0.5;
  if (milestones == MapMilestones::cell_centres) {
    milestone_cells_ = fits_every_cell ? cell_milestones(map_.blocked, execution)
                                       : cell_milestones(blocked_for_disc(map_.blocked, reach_, execution), execution);
    if (fits_every_cell) return;
  }
  if (milestones == MapMilestones::none) return;
  field_.emplace(map_.blocked, CellDistance::squares, true, execution);
  if (milestones == MapMilestones::corridors) corridors_.emplace(map_, *field_, reach_, execution);
}

bool GridWorld::lies_in_the_open(const Segment& leg) const {
  const DistanceField* field = distances();
  if (field == nullptr) return false;
  const Vec2 middle = 0.5 * (leg.a + leg.b);
  const auto x = bounded_whole<std::uint32_t>(middle.x);
  const auto y = bounded_whole<std::uint32_t>(middle.y);
  const double room = field->distance(x, y) - warren::distance(middle, Vec2{x + 0.5, y + 0.5});
  return room > 0.5 * warren::distance(leg.a, leg.b) + reach_ + margin;
}

bool GridWorld::is_free_motion(const State& a, const State& b, Query&) const {
  const Segment leg{map_point(map_, a), map_point(map_, b)};
  const Box box = box_of(leg);
  if (!(box.min.x >= reach_ && box.min.y >= reach_ && box.max.x <= map_.width() - reach_ &&
        box.max.y <= map_.height() - reach_)) {
    return false;  // the outside is blocked, and it is nearest to an end
  }
  if (lies_in_the_open(leg)) return true;
  const auto first = bounded_whole<std::int64_t>(std::floor(box.min.y - reach_));
  const auto last = bounded_whole<std::int64_t>(std::floor(box.max.y + reach_));
  for (std::int64_t row = std::max<std::int64_t>(first, 0); row <= std::min<std::int64_t>(last, map_.height() - 1);
       ++row) {
    if (!row_is_free(leg, row)) return false;
  }
  return true;
}

bool GridWorld::row_is_free(const Segment& leg, std::int64_t row) const {
  const double low = static_cast<double>(row);
  const auto [from, to] = range_between(leg, low - reach_ - margin, low + 1.0 + reach_ + margin);
  if (from > to) return true;
  const auto first = bounded_whole<std::uint32_t>(from - reach_ - margin);
  const auto last = bounded_whole<std::uint32_t>(to + reach_ + margin, 0.0, map_.width() - 1.0);
  const auto words = map_.blocked.row(as_whole<std::uint32_t>(row));
  for (std::uint32_t w = first / 64; w <= last / 64; ++w) {
    std::uint64_t blocked = words[w];
    if (w == first / 64) blocked &= ~std::uint64_t{0} << first % 64;
    if (w == last / 64) blocked &= ~std::uint64_t{0} >> (63 - last % 64);
    for (; blocked != 0; blocked &= blocked - 1) {
      const double x = 64.0 * w + std::countr_zero(blocked);
      if (distance_to_square(leg, x, low) < reach_) return false;
    }
  }
  return true;
}

double GridWorld::suggested_samples(const Execution& execution) const {
  constexpr double samples_a_square = 4.5;  // as among walls: worlds/plane/maze_world.cpp
  constexpr double fewest = 500.0;
  const DistanceField* field = distances();
  if (field == nullptr) return static_cast<double>(map_.free);
  const double squares = 0.5 * CorridorCells(*field, reach_, execution).weight();
  if (corridors_) return std::max(fewest, samples_a_square * squares);  // which hardly ever fall on what is blocked
  const double free_share = static_cast<double>(map_.free) / static_cast<double>(map_.blocked.size());
  return std::max(fewest, free_share > 0.0 ? samples_a_square * squares / free_share : 0.0);
}

}  // namespace warren
