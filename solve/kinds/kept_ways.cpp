// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/kept_ways.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/whole.hpp"

namespace warren {
namespace {

constexpr std::size_t most_legs = 1 << 18;
constexpr std::size_t few_cells = 1024;  // changed cells, each of which is looked at for itself

/// Columns low.x to high.x of rows low.y to high.y.
struct CellRange {
  Cell low;
  Cell high;
  bool is_near(Cell c, std::uint32_t by) const {
    return c.x + by >= low.x && c.x <= high.x + by && c.y + by >= low.y && c.y <= high.y + by;
  }
  void include(Cell c) {
    low = {std::min(low.x, c.x), std::min(low.y, c.y)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y)};
  }
  /// Cells no farther than `by`, as far as the map may go.
  double count_around(std::uint32_t by) const {
    return (high.x - low.x + 1.0 + 2.0 * by) * (high.y - low.y + 1.0 + 2.0 * by);
  }
};

/// Ranges that hold all of the cells: of few cells far apart several, where less lies within `by` of these than of one
/// around all.
std::vector<CellRange> ranges_of(std::span<const Cell> cells, std::uint32_t by) {
  CellRange whole{cells.front(), cells.front()};
  for (const Cell c : cells) whole.include(c);
  if (cells.size() > few_cells) return {whole};
  std::vector<CellRange> ranges;
  for (const Cell c : cells) {
    const auto near = std::ranges::find_if(ranges, [&](const CellRange& r) { return r.is_near(c, by); });
    near != ranges.end() ? near->include(c) : ranges.push_back({c, c});
  }
  double count = 0.0;
  for (const CellRange& r : ranges) count += r.count_around(by);
  return count < whole.count_around(by) ? ranges : std::vector{whole};
}

}  // namespace

std::size_t KeptWays::HashOfLeg::operator()(const Segment& leg) const {
  std::uint64_t hash = 0;
  for (const double x : {leg.a.x, leg.a.y, leg.b.x, leg.b.y}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 29U;
  }
  return hash;
}

KeptWays::Leg& KeptWays::leg(Vec2 a, Vec2 b) {
  if (legs_.size() >= most_legs) legs_.clear();
  Leg& leg = legs_[{a, b}];
  leg.is_asked = true;
  return leg;
}

void KeptWays::forget() {
  field_.reset();
  weights_.reset();
  prices_.reset();
  legs_.clear();
}

bool KeptWays::is_same_frame(const OccupancyMap& map) const {
  return map.width() == map_.width() && map.height() == map_.height() && map.cell == map_.cell &&
         map.origin == map_.origin && map.yaw_rad == map_.yaw_rad && map.unknown.empty() == map_.unknown.empty();
}

bool KeptWays::update(const OccupancyMap& map, const WallProblem& problem, const Execution& execution) {
  try {
    if (!weights_ || !is_same_frame(map)) {
      make(map, problem, execution);
    } else {
      std::vector<Cell> changed;
      const auto poll = [&] { execution.check(); };
      for_each_differing(map.blocked, map_.blocked, poll, [&](Cell c) { changed.push_back(c); });
      for_each_differing(map.unknown, map_.unknown, poll, [&](Cell c) { changed.push_back(c); });
      for (auto known = legs_.begin(); known != legs_.end();) {
        known = std::exchange(known->second.is_asked, false) ? std::next(known) : legs_.erase(known);
      }
      if (!changed.empty()) change(map, problem, changed, execution);
    }
  } catch (...) {
    forget();
    throw;
  }
  if (!prices_->is_priced()) forget();
  return prices_.has_value();
}

void KeptWays::make(const OccupancyMap& map, const WallProblem& problem, const Execution& execution) {
  forget();
  map_ = map;
  prices_.emplace(map_, problem.robot.radius, problem.prices, execution);
  prices_->keep_near(problem.reach() / map_.cell, execution);
  scratch_ = {};
  wide_ = prices_->distances() != nullptr
              ? blocked_for_disc(map_.blocked, *prices_->distances(), problem.reach() / map_.cell, execution)
              : blocked_for_disc(map_.blocked, problem.reach() / map_.cell, execution);
  weights_.emplace(
      wide_, [this](Cell from, unsigned direction) { return prices_->step_up(from, direction, scratch_); }, execution);
}

void KeptWays::change(const OccupancyMap& map, const WallProblem& problem, const std::vector<Cell>& changed,
                      const Execution& execution) {
  map_ = map;
  Bitmap wide = wide_;
  const DistanceField* distances = prices_->distances();
  const double kept = distances != nullptr ? distances->kept_cells() : 0.0;
  const std::vector<CellRange> ranges = ranges_of(changed, bounded_whole<std::uint32_t>(2.0 * kept, 0.0, 1e9));
  for (const CellRange& r : ranges) prices_->renew(r.low, r.high, execution);
  if (distances != nullptr) {
    for (const CellRange& r : ranges) {
      renew_for_disc(wide, map_.blocked, *distances, problem.reach() / map_.cell, r.low, r.high, execution);
    }
  } else {
    wide = blocked_for_disc(map_.blocked, problem.reach() / map_.cell, execution);
  }
  const auto poll = [&] { execution.check(); };
  for_each_differing(wide, wide_, poll, [&](Cell c) { weights_->change(c, !wide.test(c.x, c.y)); });
  wide_ = std::move(wide);
  // What a step weighs rests on the squares within the reach of its two cells; which steps there are on the cells
  // around, of which a square closes those within the body's reach.
  double reach = problem.reach() / map_.cell;
  if (const auto& clearance = problem.prices.clearance) {
    reach = std::max(reach, (clearance_reach(*clearance, problem.robot.radius) + problem.robot.radius) / map_.cell);
  }
  const auto around = bounded_whole<std::uint32_t>(std::ceil(reach) + 3.0, 0.0, 1e9);
  Bitmap near(map_.width(), map_.height());
  for (const Cell c : changed) {
    const std::uint32_t last = std::min(c.x + around, map_.width() - 1) + 1;
    for (std::uint32_t y = c.y - std::min(c.y, around); y <= std::min(c.y + around, map_.height() - 1); ++y) {
      near.set_run(y, c.x - std::min(c.x, around), last);
    }
    execution.check();
  }
  std::vector<Cell> touched;
  for_each_differing(near, {}, poll, [&](Cell c) {
    touched.push_back(c);
    weights_->forget(c);
  });
  forget_legs(changed, reach + 3.0);
  constexpr std::uint64_t share = 3;
  if (field_ && !field_->repair(touched, fresh_ / share, execution)) field_.reset();
}

void KeptWays::forget_legs(const std::vector<Cell>& changed, double reach) {
  if (changed.size() > few_cells) return legs_.clear();
  const auto square = [](Cell c) {
    return Box{{static_cast<double>(c.x), static_cast<double>(c.y)}, {c.x + 1.0, c.y + 1.0}};
  };
  Box all;
  for (const Cell c : changed) all.include(square(c));
  const auto is_near = [&](const Box& leg, const Box& cells) {
    return cells.max.x + reach >= leg.min.x && cells.min.x - reach <= leg.max.x && cells.max.y + reach >= leg.min.y &&
           cells.min.y - reach <= leg.max.y;
  };
  std::erase_if(legs_, [&](const auto& known) {
    Box box;
    box.include(map_point(map_, known.first.a));
    box.include(map_point(map_, known.first.b));
    return is_near(box, all) && std::ranges::any_of(changed, [&](Cell c) { return is_near(box, square(c)); });
  });
}

PriceField& KeptWays::field(std::span<const PriceField::Goal> goals, std::span<const Cell> towards,
                            const Execution& execution) {
  if (field_ && field_->is_of(goals, towards)) {
    if (fresh_ == 0) fresh_ = field_->expanded();
    return *field_;
  }
  fresh_ = 0;
  return field_.emplace(*weights_, goals, towards, execution);
}

}  // namespace warren
