// SPDX-License-Identifier: BSD-3-Clause
// A point or disc on an occupancy map: blocked cells are closed squares, what lies outside of the map is blocked.
// States are points of the world, not cells. Motions are decided by the squares near them, exactly but for a margin:
// planning keeps r (1 + 1e-9) cells, and a point 1e-9 of a cell, so that rounding can't fail the verification. The
// distance transform answers most queries at once.
#pragma once

#include <array>
#include <optional>

#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "spatial/maps/free_cells.hpp"
#include "worlds/plane/maze_world.hpp"
#include "worlds/rasters/corridor_points.hpp"

namespace warren {

/// Which milestones a roadmap of the world will ask for: corridor_state(), or milestone_cells(), cost memory. none: few
/// motions will be asked, so that the distance transform would cost more than it saves.
enum class MapMilestones : std::uint8_t { anywhere, corridors, cell_centres, none };

/// Immutable after construction; one Query a thread. A motion costs the cells of the strip around it, 64 at a time. Its
/// box is the map as if its origin were (0, 0) and it were not turned: what uniform samples are spread over.
class GridWorld : public PointWorld {
 public:
  struct Query {};

  /// radius: distance that states keep from blocked squares, world units, >= 0 and finite (InputError otherwise); 0:
  /// touching is blocked. Water is blocked. Copies the map. Cell centres need no distance transform for bodies up to a
  /// cell wide.
  GridWorld(const OccupancyMap& map, double radius, const Execution& execution,
            MapMilestones milestones = MapMilestones::anywhere);
  /// The same, and refers to distances that are there: to the map's blocked squares and to its outside.
  GridWorld(const OccupancyMap& map, double radius, const DistanceField& distances) : GridWorld(map, radius) {
    given_ = &distances;
  }

  Query make_query() const { return {}; }
  State at_unit(const std::array<double, 2>& u) const {
    return world_point(map_, {u[0] * map_.width(), u[1] * map_.height()});
  }
  bool is_free(const State& a, Query& query) const { return is_free_motion(a, a, query); }
  bool is_free_motion(const State& a, const State& b, Query& query) const;

  /// The index-th sample from the middles of the corridors, a pure function; the uniform one where there are no
  /// corridors wide enough, or none were asked for.
  State corridor_state(std::uint64_t seed, std::uint64_t index) const {
    return corridors_ && !corridors_->empty() ? corridors_->at(seed, index) : uniform_state(*this, seed, index);
  }

  /// Cells whose middles make a roadmap that joins what steps over common sides join; none unless they were asked for.
  const Bitmap& milestone_cells() const { return milestone_cells_; }
  State cell_state(std::uint32_t x, std::uint32_t y) const { return cell_centre(map_, {x, y}); }
  double milestone_reach() const { return cell_milestone_reach * map_.cell; }

  /// Uniform samples that a first roadmap needs: 4.5 for each free square as wide as its corridor, at least 500.
  /// O(cells).
  double suggested_samples(const Execution& execution) const;
  const OccupancyMap& map() const { return map_; }

 private:
  GridWorld(const OccupancyMap& map, double radius);
  bool row_is_free(const Segment& leg, std::int64_t row) const;
  /// Is all that is within half the leg of its middle free, by the middle's cell's distance from all squares?
  bool lies_in_the_open(const Segment& leg) const;

  const DistanceField* distances() const { return given_ != nullptr ? given_ : field_ ? &*field_ : nullptr; }

  OccupancyMap map_;
  double reach_;  // cells
  const DistanceField* given_ = nullptr;
  std::optional<DistanceField> field_;  // where none was given
  std::optional<CorridorPoints> corridors_;
  Bitmap milestone_cells_;
};

static_assert(SteerableWorld<GridWorld>);

}  // namespace warren
