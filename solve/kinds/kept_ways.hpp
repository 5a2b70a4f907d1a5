// SPDX-License-Identifier: BSD-3-Clause
// What a solve over the priced cells of a map leaves for the next one of the same question: prices, weights of steps,
// the field of costs to the goals, and what legs cost that were tried. Where cells of the map change in between, what
// rests on them is lost and the rest stays. All of it is as if it were made anew, so that answers are the same bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/run/execution.hpp"
#include "planners/grid/price_field.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {

/// One thread. Its parts refer to each other, so it stays where it is.
class KeptWays {
 public:
  KeptWays() = default;
  KeptWays(const KeptWays&) = delete;
  KeptWays& operator=(const KeptWays&) = delete;

  /// The map as it is now, effective and without water; body and prices are as they were. Is anything priced? If not,
  /// nothing is kept. Throws as MapPrices does; after Stopped all is made anew.
  bool update(const OccupancyMap& map, const WallProblem& problem, const Execution& execution);
  void forget();

  const MapPrices& prices() const { return *prices_; }
  MapPrices::Scratch& scratch() { return scratch_; }
  /// Where the middle of the body may not be.
  const Bitmap& wide() const { return wide_; }
  StepWeights& weights() { return *weights_; }
  /// Kept where goals and places are as before. Throws Stopped.
  PriceField& field(std::span<const PriceField::Goal> goals, std::span<const Cell> towards, const Execution& execution);

  /// What was found of a leg; none: not asked yet. Kept while each solve asks for it.
  struct Leg {
    std::optional<double> cost;
    std::optional<bool> is_free;
    bool is_asked = false;  // since the last update
  };
  Leg& leg(Vec2 a, Vec2 b);

 private:
  struct HashOfLeg {
    std::size_t operator()(const Segment& leg) const;
  };
  bool is_same_frame(const OccupancyMap& map) const;
  void make(const OccupancyMap& map, const WallProblem& problem, const Execution& execution);
  void change(const OccupancyMap& map, const WallProblem& problem, const std::vector<Cell>& changed,
              const Execution& execution);
  void forget_legs(const std::vector<Cell>& changed, double reach);

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
