// SPDX-License-Identifier: BSD-3-Clause
// What a solve over the priced cells of a map leaves for the next one of the same question: prices, weights of steps,
// the field of costs to the goals, and what legs cost that were tried. Where cells of the map change in between, what
// rests on them is lost and the rest stays. All of it is as if it were made anew, so that answers are the same bytes.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/whole.hpp"
#include "core/run/execution.hpp"
#include "planners/grid/price_field.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {

/// One thread. Its parts refer to each other, so it stays where it is.
class KeptWays : NotCopied {
 public:
  /// The map as it is now, effective and without water; body and prices are as they were. Is anything priced? If not,
  /// nothing is kept. Throws as MapPrices does; after Stopped all is made anew.
  bool update(const OccupancyMap& map, const WallProblem& problem, const Execution& execution) {
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
  void forget() {
    field_.reset();
    weights_.reset();
    prices_.reset();
    legs_.clear();
  }

  const MapPrices& prices() const { return *prices_; }
  MapPrices::Scratch& scratch() { return scratch_; }
  /// Where the middle of the body may not be.
  const Bitmap& wide() const { return wide_; }
  StepWeights& weights() { return *weights_; }
  /// Kept where goals and places are as before. Throws Stopped.
  PriceField& field(std::span<const PriceField::Goal> goals, std::span<const Cell> towards,
                    const Execution& execution) {
    if (field_ && field_->is_of(goals, towards)) {
      if (fresh_ == 0) fresh_ = field_->expanded();
      return *field_;
    }
    fresh_ = 0;
    return field_.emplace(*weights_, goals, towards, execution);
  }

  /// What was found of a leg; none: not asked yet. Kept while each solve asks for it.
  struct Leg {
    std::optional<double> cost;
    std::optional<bool> is_free;
    bool is_asked = false;  // since the last update
  };
  Leg& leg(Vec2 a, Vec2 b) {
    if (legs_.size() >= most_legs) legs_.clear();
    Leg& leg = legs_[{a, b}];
    leg.is_asked = true;
    return leg;
  }

 private:
  static constexpr std::size_t most_legs = 1 << 18;
  static constexpr std::size_t few_cells = 1024;  // changed cells, each of which is looked at for itself
  static Vec2 corner(Cell c) { return {1.0 * c.x, 1.0 * c.y}; }
  /// Boxes of the lower left corners of cells, that hold all of these: of few cells far apart several, where less lies
  /// within `by` of these than of one around all.
  static std::vector<Box> ranges_of(std::span<const Cell> cells, double by) {
    const auto count_around = [by](const Box& r) { return r.grown(by + 0.5).width() * r.grown(by + 0.5).height(); };
    Box whole;
    for (const Cell c : cells) whole.include(corner(c));
    if (cells.size() > few_cells) return {whole};
    std::vector<Box> ranges;
    for (const Cell c : cells) {
      const auto near = std::ranges::find_if(ranges, [&](const Box& r) { return r.grown(by).contains(corner(c)); });
      near != ranges.end() ? near->include(corner(c)) : ranges.push_back({corner(c), corner(c)});
    }
    double count = 0.0;
    for (const Box& r : ranges) count += count_around(r);
    return count < count_around(whole) ? ranges : std::vector{whole};
  }
  struct HashOfLeg {
    std::size_t operator()(const Segment& leg) const {
      std::uint64_t hash = 0;
      for (const double x : {leg.a.x, leg.a.y, leg.b.x, leg.b.y}) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
        hash ^= hash >> 29U;
      }
      return hash;
    }
  };
  bool is_same_frame(const OccupancyMap& map) const {
    return map.width() == map_.width() && map.height() == map_.height() && map.cell == map_.cell &&
           map.origin == map_.origin && map.yaw_rad == map_.yaw_rad && map.unknown.empty() == map_.unknown.empty();
  }
  void make(const OccupancyMap& map, const WallProblem& problem, const Execution& execution) {
    forget();
    map_ = map;
    prices_.emplace(map_, problem.robot.radius, problem.prices, execution);
    prices_->keep_near(problem.reach() / map_.cell, execution);
    scratch_ = {};
    wide_ = prices_->distances() != nullptr
                ? blocked_for_disc(map_.blocked, *prices_->distances(), problem.reach() / map_.cell, execution)
                : blocked_for_disc(map_.blocked, problem.reach() / map_.cell, execution);
    weights_.emplace(
        wide_, [this](Cell from, unsigned direction) { return prices_->step_up(from, direction, scratch_); },
        execution);
  }
  void change(const OccupancyMap& map, const WallProblem& problem, const std::vector<Cell>& changed,
              const Execution& execution) {
    map_ = map;
    Bitmap wide = wide_;
    const DistanceField* distances = prices_->distances();
    const double kept = distances != nullptr ? distances->kept_cells() : 0.0;
    const auto cell = [](Vec2 at) { return Cell{static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y)}; };
    const std::vector<Box> ranges = ranges_of(changed, std::floor(2.0 * kept));
    double reach = problem.reach() / map_.cell;
    for (const Box& r : ranges) prices_->renew(cell(r.min), cell(r.max), execution);
    if (distances != nullptr) {
      for (const Box& r : ranges) {
        renew_for_disc(wide, map_.blocked, *distances, reach, cell(r.min), cell(r.max), execution);
      }
    } else {
      wide = blocked_for_disc(map_.blocked, reach, execution);
    }
    const auto poll = [&] { execution.check(); };
    for_each_differing(wide, wide_, poll, [&](Cell c) { weights_->change(c, !wide.test(c.x, c.y)); });
    wide_ = std::move(wide);
    // What a step weighs rests on the squares within the reach of its two cells; which steps there are on the cells
    // around, of which a square closes those within the body's reach.
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
    forget_legs(changed, reach + 3.0, execution);
    constexpr std::uint64_t share = 3;
    if (field_ && !field_->repair(touched, fresh_ / share, execution)) field_.reset();
  }
  void forget_legs(const std::vector<Cell>& changed, double reach, const Execution& execution) {
    if (changed.size() > few_cells) return legs_.clear();
    const auto square = [](Cell c) { return Box{corner(c), {c.x + 1.0, c.y + 1.0}}; };
    Box all;
    for (const Cell c : changed) all.include(square(c));
    std::erase_if(legs_, [&, number = std::size_t{0}](const auto& known) mutable {
      execution.poll(number++);
      const Box box = box_of({map_point(map_, known.first.a), map_point(map_, known.first.b)});
      return all.grown(reach).meets(box) &&
             std::ranges::any_of(changed, [&](Cell c) { return square(c).grown(reach).meets(box); });
    });
  }

  OccupancyMap map_;
  std::optional<MapPrices> prices_;  // of map_
  MapPrices::Scratch scratch_;
  Bitmap wide_;
  std::optional<StepWeights> weights_;
  std::optional<PriceField> field_;
  std::uint64_t fresh_ = 0;                           // cells that the field expanded when it was new; 0: not known yet
  std::unordered_map<Segment, Leg, HashOfLeg> legs_;  // lookups only
};

}  // namespace warren
