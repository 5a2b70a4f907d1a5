// SPDX-License-Identifier: BSD-3-Clause
// Motions of points and discs that cost more than their length, for roadmaps whose edges weigh that.
#pragma once

#include <functional>
#include <utility>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "planners/shorten/priced_taut.hpp"

namespace warren {

/// What a free motion costs; empty: its length.
using MotionCost = std::function<double(const Vec2&, const Vec2&)>;

/// The cost of legs, the same both ways to the last bit; any number of threads may ask. Empty where nothing is priced.
/// Refers to the prices.
template <class LegPrices>
MotionCost motion_cost(const LegPrices& prices) {
  if (!prices.is_priced()) return {};
  return [&prices](const Vec2& a, const Vec2& b) {
    thread_local typename LegPrices::Scratch scratch;
    const bool is_forward = a.x < b.x || (a.x == b.x && a.y < b.y);
    return is_forward ? prices.cost(a, b, scratch) : prices.cost(b, a, scratch);
  };
}

/// The path pulled taut under the price; step: as PricedLegs has it.
template <class World>
Path<Vec2> pulled_taut(const World& world, Path<Vec2> path, const MotionCost& cost, double step,
                       const Execution& execution) {
  auto query = world.make_query();
  const auto is_free = [&](Vec2 a, Vec2 b) {
    return world.is_free(a, query) && world.is_free(b, query) && world.is_free_motion(a, b, query);
  };
  return priced_taut(std::move(path), {cost, is_free, step}, execution);
}

}  // namespace warren
