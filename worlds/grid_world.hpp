// SPDX-License-Identifier: BSD-3-Clause
// A point or disc on an occupancy map: blocked cells are closed squares, what lies outside of the map is blocked.
// States are points of the world, not cells. Motions are decided by the squares near them, exactly but for a margin:
// planning keeps r (1 + 1e-9) cells, and a point 1e-9 of a cell, so that rounding can't fail the verification. The
// distance transform answers most queries at once.
#pragma once

#include <array>

#include "core/types.hpp"
#include "core/world.hpp"
#include "parallel/execution.hpp"
#include "spatial/distance_field.hpp"
#include "worlds/occupancy_map.hpp"

namespace warren {

/// Immutable after construction; one Query a thread. A motion costs the cells of the strip around it, 64 at a time.
class GridWorld {
 public:
  static constexpr std::size_t dimension = 2;
  using State = Vec2;
  struct Query {};

  /// radius: distance that states keep from blocked squares, world units, >= 0 and finite (InputError otherwise); 0:
  /// touching is blocked. Water is blocked. Copies the map.
  GridWorld(const OccupancyMap& map, double radius, const Execution& execution);

  Query make_query() const { return {}; }
  State at_unit(const std::array<double, 2>& u) const {
    return world_point(map_, {u[0] * map_.width(), u[1] * map_.height()});
  }
  bool is_free(const State& a, Query& query) const { return is_free_motion(a, a, query); }
  bool is_free_motion(const State& a, const State& b, Query& query) const;
  static double distance(const State& a, const State& b) { return warren::distance(a, b); }
  std::array<double, 2> embed(const State& a) const { return {a.x, a.y}; }
  State interpolate(const State& a, const State& b, double t) const {
    return t <= 0.0 ? a : t >= 1.0 ? b : a + t * (b - a);
  }

  /// Uniform samples that a first roadmap needs: one for each 64 cells, but no fewer than 500.
  double suggested_samples() const;
  const OccupancyMap& map() const { return map_; }

 private:
  bool row_is_free(const Segment& leg, std::int64_t row) const;

  OccupancyMap map_;
  double reach_;  // cells
  DistanceField field_;
};

static_assert(SteerableWorld<GridWorld>);

}  // namespace warren
