// SPDX-License-Identifier: BSD-3-Clause
// Motions that cost more than their length, for searches that weigh that: of points and discs exactly, of bodies that
// turn as the mean over some poses of a motion. What a path costs the judge says.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "planners/shorten/taut_path.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {

/// The cost of free legs, the same both ways to the last bit; any number of threads may ask. Empty where nothing is
/// priced. Refers to the prices.
template <class LegPrices>
std::function<double(const Vec2&, const Vec2&)> motion_cost(const LegPrices& prices) {
  if (!prices.is_priced()) return {};
  return [&prices](const Vec2& a, const Vec2& b) {
    thread_local typename LegPrices::Scratch scratch;
    const bool is_forward = a.x < b.x || (a.x == b.x && a.y < b.y);
    return is_forward ? prices.cost(a, b, scratch) : prices.cost(b, a, scratch);
  };
}

/// What the poses of a body cost a unit of length more than that. Refers to the scene, as it is planned in. Any number
/// of threads may ask.
class PosePrices {
 public:
  /// kept: room that the body's world takes off its distances.
  PosePrices(const Scene& scene, const Prices& prices, double kept)
      : map_(scene.map ? &*scene.map : nullptr),
        areas_(prices),
        unknown_(map_ != nullptr && !map_->unknown.empty() ? prices.unknown_factor() : 1.0),
        kept_(kept) {
    if (prices.clearance && prices.clearance->price > 0.0) {
      price_ = prices.clearance->price;
      reach_ = *prices.clearance->reach;
      step_ = 0.25 * reach_;
    }
    if (unknown_ > 1.0) step_ = std::min(step_, map_->cell);
    for (const PriceMask& mask : prices.masks) step_ = std::min(step_, mask.read->cell);
    for (const AreaFactors::Area& area : areas_.areas())
      step_ = std::min(step_, 0.125 * (area.box.width() + area.box.height()));
  }
  bool is_priced() const { return price_ > 0.0 || !areas_.empty() || unknown_ > 1.0; }

  bool has_areas() const { return !areas_.empty() || unknown_ > 1.0; }

  double area_at(Vec2 p) const {
    const double factor = areas_.empty() ? 1.0 : areas_.factor(p);
    return (unknown_ > factor && is_unknown(p) ? unknown_ : factor) - 1.0;
  }
  /// World: what knows the body's clearance at a pose.
  template <class World, class Query>
  double nearness_at(const World& world, const Se2& pose, Query& query) const {
    if (!(price_ > 0.0)) return 0.0;
    const double far = (world.clearance(pose, reach_, query) + kept_) / reach_;
    const double near = std::clamp(1.0 - far, 0.0, 1.0);
    return price_ * near * near;
  }
  /// Of a motion of that length, from 0 to 1.
  template <class World, class Query, class PoseAt>
  double over(const World& world, double length, Query& query, const PoseAt& pose_at) const {
    constexpr double most = 64.0;
    double sum = 0.0;
    if (price_ > 0.0) {
      const double count = std::clamp(std::ceil(length / step_), 1.0, most);
      for (double i = 0.5; i < count; ++i) sum += nearness_at(world, pose_at(i / count), query) / count;
    }
    if (has_areas()) {  // a look at them is cheap, and they have borders
      for (double i = 0.5; i < most; ++i) sum += area_at(pose_at(i / most).position()) / most;
    }
    return sum * length;
  }

 private:
  bool is_unknown(Vec2 p) const {
    const Vec2 at = map_point(*map_, p);
    return map_->unknown.holds(bounded_whole<std::int64_t>(std::floor(at.x)),
                               bounded_whole<std::int64_t>(std::floor(at.y)));
  }

  const OccupancyMap* map_;
  AreaFactors areas_;
  double unknown_;
  double kept_;
  double price_ = 0.0;
  double reach_ = 0.0;
  double step_ = std::numeric_limits<double>::infinity();
};

/// The path pulled taut under the price; step: as PricedLegs has it.
template <class World, class Cost>
Path<Vec2> pulled_taut(const World& world, Path<Vec2> path, const Cost& cost, double step, const Execution& execution) {
  auto query = world.make_query();
  const auto is_free = [&](Vec2 a, Vec2 b) {
    return world.is_free(a, query) && world.is_free(b, query) && world.is_free_motion(a, b, query);
  };
  return priced_taut(std::move(path), {cost, is_free, step}, execution);
}

}  // namespace warren
