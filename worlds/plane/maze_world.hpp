// SPDX-License-Identifier: BSD-3-Clause
// A point or disc among wall segments: the world of mazes, and of any other set of walls. The reference point stays in
// the box of the walls (or strictly inside the bounds, which count as four walls); every point of a motion keeps the
// clearance. Planning widens the clearance by the factor 1 + 1e-9, so that rounding can't fail the verification.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// What worlds of points in a box have in common.
class PointWorld {
 public:
  static constexpr std::size_t dimension = 2;
  using State = Vec2;

  State at_unit(const std::array<double, 2>& u) const {
    return {box_.min.x + u[0] * box_.width(), box_.min.y + u[1] * box_.height()};
  }
  static double distance(const State& a, const State& b) { return warren::distance(a, b); }
  static State interpolate(const State& a, const State& b, double t) {
    return t <= 0.0 ? a : t >= 1.0 ? b : a + t * (b - a);
  }
  std::array<double, 2> embed(const State& a) const { return {a.x, a.y}; }
  const Box& box() const { return box_; }
  /// Area of the box that uniform samples are drawn from.
  double sampled_area() const { return box_.width() * box_.height(); }

 protected:
  Box box_;
};

class PolygonIndex;  // spatial/obstacles/polygon_index.hpp

// How wide the free ways between walls are, by looking from the middles of some walls to either side; and how many
// uniform samples ways of that width need. What `--samples auto` begins with: a guess that need not be right.

/// 4.5 samples for each square as wide as what the clearance leaves of `width`.
double samples_for_width(double width, double area, double clearance);

/// The lower quartile of the free widths on both sides of some walls, but for sides inside of polygons (nullptr: there
/// are none); the side of a square of the box's area where no other wall is seen. Throws Stopped: a look among crowded
/// walls takes long.
double typical_width(const WallIndex& index, const Box& box, const PolygonIndex* polygons, const Execution& execution);

/// Immutable after construction; one Query a thread.
class MazeWorld : public PointWorld {
 public:
  struct Query {
    std::array<Segment, bunch_size> motions;  ///< scratch
  };

  /// Indexes the scene's walls and bounds. clearance >= 0 and finite (InputError otherwise); with 0, touching a wall
  /// is blocked. Throws InputError for a scene without walls and bounds.
  MazeWorld(const Scene& scene, double clearance, const Execution& execution);

  Query make_query() const { return {}; }
  bool is_free(const State& a, Query&) const noexcept;
  bool is_free_motion(const State& a, const State& b, Query&) const noexcept {
    return index_.keeps_clearance(a, b, planning_clearance_);
  }
  std::uint32_t free_motions(std::span<const Motion<State>> motions, Query& query) const noexcept;
  std::uint32_t free_states(std::span<const State> states, Query& query) const noexcept;
  /// Which sides of unit cells the body can cross, asked wall by wall: a side is closed where both of its ends are
  /// nearer than the clearance to one wall, for then all of it is. Walls that do not run along the cells close nothing.
  /// O(walls + cells), a byte a cell; a long wall takes some tens of steps in each cell that it passes. Of the cells
  /// that meet the box. Nothing where they are more than most_cells, where the clearance is below a thousandth of a
  /// cell, or coordinates are beyond 10^9: then a point's cell may not be told for sure. Throws Stopped.
  CellSides cell_sides(std::size_t most_cells, const Execution& execution) const;

  /// Uniform samples that a first roadmap needs: 4.5 for each square as wide as the corridors are free. The corridors'
  /// width is the lower quartile of what rays from some walls' middles see on either side. A pure function of the
  /// walls.
  double suggested_samples(const Execution& execution) const;

  double planning_clearance() const { return planning_clearance_; }  ///< what motions keep: clearance (1 + 1e-9)
  const WallIndex& walls() const { return index_; }

 private:
  double clearance_;
  double planning_clearance_;
  WallIndex index_;
};

static_assert(SteerableWorld<MazeWorld>);

}  // namespace warren
