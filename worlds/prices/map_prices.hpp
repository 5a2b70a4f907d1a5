// SPDX-License-Identifier: BSD-3-Clause
// What straight legs cost among the cells of a map (scenes/scene/prices.hpp): exact but for rounding. A leg is walked
// cell by cell; where the distance transform says that nothing is near it goes on as far as it can. In one cell every
// blocked square lies to one side of the leg or beyond a corner, and of each row of squares only the nearest two count.
//
// Before it, a map with what a question forbids and opens: keep-out polygons, blocked cells of masks, unknown cells at
// a price. A cell is blocked where its open square meets an open polygon, or the open square of a mask's blocked cell:
// by exact orientations of the corners in cells. Corners within a billionth of a line between cells are on it.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "core/plane/geometry.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"
#include "spatial/maps/free_cells.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// Is there anything that changes which cells are blocked?
bool restricts(const Prices& prices);

/// The map as it is planned on, made of the map that it is given. Masks have been read. Throws Stopped.
OccupancyMap effective_map(OccupancyMap map, const Prices& prices, const Execution& execution);

/// The scene as it is planned in, which restricts(): on a map the map above; else keep-out polygons and the masks'
/// blocked cells are polygons more. Masks have been read. Throws Stopped.
Scene restricted_scene(const Scene& scene, const Prices& prices, const Execution& execution);

/// The factors of length that areas and masks give to places. The greatest of the open areas and cells around a place
/// counts; within a billionth of a border the lesser of both sides. Copies what it needs of the prices. Immutable.
class AreaFactors {
 public:
  struct Area {
    double factor;
    std::vector<Vec2> corners;
    Box box;
  };

  /// Places are the world's, or in the cells of a map. Areas and masks that cost nothing are left out.
  explicit AreaFactors(const Prices& prices, const OccupancyMap* map = nullptr);

  bool empty() const { return areas_.empty() && masks_.empty(); }
  const std::vector<Area>& areas() const { return areas_; }
  /// At a place.
  double factor(Vec2 p) const;
  /// The integral of factor_at(p) - 1 over a leg of that length in the direction u, which has length 1. factor_at: as
  /// factor(), or more where it changes at places that are cut already.
  template <class FactorAt>
  double over(Vec2 p, Vec2 u, double length, std::vector<double>& cuts, const FactorAt& factor_at) const;

 private:
  struct Mask {
    PriceMask mask;
    Vec2 origin;  // of its cell (0, 0)
    Vec2 right;   // a step of its columns, and of its rows
    Vec2 up;
  };

  std::vector<Area> areas_;
  std::vector<Mask> masks_;
};

// What nearness costs along a straight stretch: the integral of (1 - d / reach)^2 where d < reach, d being the distance
// to the nearest of several things. Each of them is, by arc length, a side (its distance is a straight line) or a
// corner (a hyperbola). The stretch is cut where any two are equally far, and where one is at the reach; in each
// interval the one that is least in its middle counts. That decides no ties: where two are equal they give the same
// integral.

/// The distance to one thing, where the stretch has gone `t` from its begin.
struct StretchDistance {
  bool is_side = true;    ///< which of the pairs below means something
  double at_begin = 0.0;  ///< side: distance at t = 0
  double slope = 0.0;     ///< side: what it grows by, -1 .. 1; the distance is never below 0 on the stretch
  double foot = 0.0;      ///< corner: t where it is nearest
  double apart_sq = 0.0;  ///< corner: its squared distance there

  /// The corner `c` as seen from a stretch that begins at `a` in the direction `u` of length 1.
  static StretchDistance corner(Vec2 c, Vec2 a, Vec2 u) {
    const double apart = cross(u, c - a);
    return {false, 0.0, 0.0, dot(u, c - a), apart * apart};
  }
  /// A side whose distance is so much at the begin and grows so.
  static StretchDistance side(double at_begin, double slope) { return {true, at_begin, slope, 0.0, 0.0}; }

  double operator()(double t) const {
    return is_side ? at_begin + slope * t : std::sqrt((t - foot) * (t - foot) + apart_sq);
  }
};

/// Sums such integrals; keeps its scratch, so one a thread.
class NearnessSum {
 public:
  /// Over the stretch from t = `from` to `to`; reach > 0. Of nothing: 0. Off by some 1e-15 * (1 + to - from).
  double integral(std::span<const StretchDistance> things, double from, double to, double reach);

 private:
  std::vector<StretchDistance> near_;
  std::vector<double> cuts_;
};

/// The reach D of a clearance price. Throws UsageError where neither it nor the body's width says one.
double clearance_reach(const ClearancePrice& price, double radius);

/// Any number of threads may ask while nobody changes it, each with its own Scratch.
class MapPrices {
 public:
  /// A blocked square as seen from a cell: a side where it is straight right, left, above or below, else a corner.
  struct Site {
    Vec2 at;
    double dx;  // -1, 0, 1: which way it lies
    double dy;
  };
  /// What a thread that asks holds, also of one MapPrices after the other: of the last it keeps what is near to some
  /// thousand cells.
  struct Scratch {
    static constexpr std::size_t kept_rows = 64;
    static constexpr std::size_t kept_columns = 128;
    struct Sites {
      std::size_t cell = std::numeric_limits<std::size_t>::max();
      std::vector<Site> sites;
    };
    NearnessSum sum;
    std::vector<StretchDistance> things;
    std::vector<double> cuts;
    std::vector<Sites> kept;
    std::uint64_t of = 0;  // whose; 0: nobody's
  };

  /// Refers to the map, which is the effective one (effective_map()): what is unknown and not blocked
  /// costs prices.unknown. radius: of the disc, world units, >= 0. Masks have been read. Throws UsageError as
  /// clearance_reach(), Stopped.
  MapPrices(const OccupancyMap& effective, double radius, const Prices& prices, const Execution& execution);

  /// From now on distances() tells nothing beyond so many cells, and beyond what prices feel: for renew().
  /// Throws Stopped.
  void keep_near(double cells, const Execution& execution);
  /// After changes of the map's cells from column low.x to high.x and row low.y to high.y: costs are those of one made
  /// anew. Only after keep_near(). Throws Stopped, and is of no use then.
  void renew(Cell low, Cell high, const Execution& execution);

  /// Distances to the map's blocked squares and its outside; nullptr where nearness costs nothing.
  const DistanceField* distances() const { return field_ ? &*field_ : nullptr; }
  /// Does any leg cost more than its length?
  bool is_priced() const { return reach_ > 0.0 || !touched_.empty(); }
  /// Of a straight leg of the middle that touches nothing blocked, world coordinates.
  PriceParts parts(Vec2 a, Vec2 b, Scratch& scratch) const;
  /// The leg's length and what it costs beyond.
  double cost(Vec2 a, Vec2 b, Scratch& scratch) const { return distance(a, b) + parts(a, b, scratch).sum(); }
  /// The leg from the middle of a free cell to that of its free neighbour; direction: of cell_steps
  /// (spatial/maps/free_cells.hpp). Whole units of 2^-20 cell, rounded up; there and back weigh the same.
  std::uint64_t step_up(Cell from, unsigned direction, Scratch& scratch) const;

 private:
  double nearness(Vec2 a, Vec2 b, Scratch& scratch) const;
  double nearness_in(Cell cell, Vec2 p, Vec2 u, double length, Scratch& scratch) const;
  std::span<const Site> sites(Cell cell, Scratch& scratch) const;
  double areas(Vec2 a, Vec2 b, Scratch& scratch) const;
  double areas_in(Vec2 p, Vec2 u, double length, Scratch& scratch) const;
  double half_step(Cell cell, unsigned direction, Scratch& scratch) const;
  bool is_near_area(Cell cell) const { return touched_.holds(cell.x, cell.y); }

  std::uint64_t number_ = fresh_number();
  const OccupancyMap& map_;
  double price_ = 0.0;         // of an integral over cells
  double reach_ = 0.0;         // of the middle, cells; 0: nearness costs nothing
  std::uint32_t open_sq_ = 0;  // cells whose distance is no less are beyond the reach
  std::optional<DistanceField> field_;
  AreaFactors areas_;  // in cells
  double unknown_ = 1.0;
  Bitmap touched_;  // cells in which some factor may be above 1; empty: in none
};

// What straight legs cost among walls, outlines of polygons and bounds: as among cells, with segments instead of
// squares. A leg is cut where the nearest place of a segment becomes an end of it.

/// Immutable; any number of threads may ask, each with its own Scratch.
class SidePrices {
 public:
  /// What a thread that asks holds.
  struct Scratch {
    NearnessSum sum;
    std::vector<Segment> near;
    std::vector<StretchDistance> things;
    std::vector<double> cuts;
  };

  /// Refers to the sides of what is blocked, keep-out polygons among them. radius: of the disc, >= 0.
  /// Throws UsageError as clearance_reach().
  SidePrices(const WallIndex& sides, double radius, const Prices& prices);

  /// Does any leg cost more than its length?
  bool is_priced() const { return reach_ > 0.0 || !areas_.empty(); }
  /// Of a straight leg of the middle that touches nothing blocked.
  PriceParts parts(Vec2 a, Vec2 b, Scratch& scratch) const;
  /// The leg's length and what it costs beyond.
  double cost(Vec2 a, Vec2 b, Scratch& scratch) const { return distance(a, b) + parts(a, b, scratch).sum(); }

 private:
  double nearness(Vec2 p, Vec2 u, double length, Scratch& scratch) const;

  const WallIndex& sides_;
  AreaFactors areas_;
  double price_ = 0.0;  // of an integral over the middle's distances
  double reach_ = 0.0;  // of the middle; 0: nearness costs nothing
};

}  // namespace warren
