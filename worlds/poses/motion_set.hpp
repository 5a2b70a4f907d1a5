// SPDX-License-Identifier: BSD-3-Clause
// What a car may do on a lattice of cells and headings. The headings point along (1, 0), (2, 1), (1, 1), ... (32 of
// them: (3, 1) and (3, 2) too), so that motions end exactly on states: straights, and straight-arc-straight between two
// headings up to two apart. Two lines through states meet at some point; where it lies rho tan(turn / 2) or more from
// both ends, an arc of the turning radius joins them. If an end does, so do all ends farther along either heading: kept
// are the ends that no other leads to so, as many as the two headings' vectors span cells. Backwards the same is driven
// the other way round. A drive that turns on the spot turns to the next heading either way, and drives no arcs.
//
// Costs are whole numbers, so that no order of additions changes a search. relaxed_ratio() compares the motions with
// the knight_steps of spatial/maps/free_cells: wherever a motion leads, a chain of steps leads along cells whose
// middles are within `slack` of its way, no longer than the ratio times the motion. So what steps cost, divided by the
// ratio, bounds what motions cost.
//
// Its stamps are the cells of a map that a body may touch along each motion, once for all places: rows of bits, so that
// a motion is looked up among a map's free cells instead of computed. A cell is left out only where it is proved that
// its closed square keeps the body's clearance all along the motion (worlds/poses/certified_motion.hpp); what comes
// within a sixteenth of a cell of that may be in. So what the stamps call free is free, and nothing hides between two
// poses or inside of the outline. Motions of one quarter of the headings are computed, in parallel; the other quarters
// are these turned, which squares allow exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/run/execution.hpp"
#include "spatial/maps/free_cells.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {

struct MotionSetOptions {
  std::uint32_t headings = 16;  ///< 16 or 32
  double turning_radius = 1.0;  ///< in cells; > 0
  bool reverses = false;        ///< does it drive backwards?
  bool turns_on_spot = false;   ///< a differential drive
  double reverse_cost = 1.0;    ///< of a cell backwards; >= 1
  double turn_cost = 0.0;       ///< cells a radian, whatever the way; >= 0
};

/// One motion from a heading, wherever it begins.
struct LatticeMotion {
  std::int32_t dx = 0;      ///< cells
  std::int32_t dy = 0;      ///< the same
  std::uint32_t to = 0;     ///< heading at its end
  std::int8_t gear = 1;     ///< 1 forwards, -1 backwards, 0: turns on the spot
  std::uint64_t cost = 0;   ///< in units of cost_unit
  SteeringWord word = {};   ///< of the turning radius
  std::uint32_t shape = 0;  ///< which of shapes() it sweeps, after quarter_turns; backwards from its end
  std::uint32_t quarter_turns = 0;
};

/// A motion as it is at the first quarter of the headings, forwards.
struct MotionShape {
  std::uint32_t from = 0;  ///< heading
  std::uint32_t to = 0;
  std::int32_t dx = 0;
  std::int32_t dy = 0;
  SteeringWord word = {};
};

/// Immutable.
class MotionSet {
 public:
  static constexpr double cost_unit = 0x1p-20;  ///< cells
  static constexpr double slack = 0.75;         ///< cells
  /// Throws Stopped. Options out of range are the caller's bug.
  MotionSet(const MotionSetOptions& options, const Execution& execution);

  std::uint32_t headings() const { return as_whole<std::uint32_t>(motions_.size()); }
  double heading_rad(std::uint32_t k) const { return radians_[k]; }
  /// The heading nearest to an angle.
  std::uint32_t nearest_heading(double radians) const;
  std::span<const LatticeMotion> from(std::uint32_t heading) const { return motions_[heading]; }
  std::span<const MotionShape> shapes() const { return shapes_; }
  double turning_radius() const { return options_.turning_radius; }  ///< in cells
  /// At least 1: see above.
  double relaxed_ratio() const { return relaxed_ratio_; }
  /// What a curve costs, in units rounded to the nearest; its changes of gear are not in it.
  std::uint64_t cost_of(const SteeringWord& word) const;

 private:
  void add_shapes(std::uint32_t from, const Execution& execution);
  void add_turns(std::uint32_t from, std::uint32_t to);
  void add_motions(std::uint32_t shape);
  double ratio_of(const MotionShape& shape, const Execution& execution) const;

  MotionSetOptions options_;
  std::vector<std::array<std::int32_t, 2>> vectors_;
  std::vector<double> radians_;
  std::vector<MotionShape> shapes_;
  std::vector<std::vector<LatticeMotion>> motions_;  // by heading
  double relaxed_ratio_ = 1.0;
};

/// Immutable; any number of threads may ask. Keeps nothing of the motions.
class SweptStamps {
 public:
  /// outline: in cells, around the reference point, one point for a disc; reach: what is kept around it, in cells, a
  /// disc's radius too. Throws Stopped.
  SweptStamps(const MotionSet& motions, std::span<const Vec2> outline, double reach, const Execution& execution);

  /// Is the motion free of blocked cells, and within the map, where it begins in the middle of the cell?
  bool is_free(const FreeCells& map, Cell from, const LatticeMotion& motion) const;

 private:
  struct Row {
    std::int32_t x;
    std::int32_t y;
    std::uint64_t bits;  // bit i: cell x + i
  };
  struct Stamp {
    std::size_t first;  // of rows_
    std::size_t last;
    std::int32_t min_x, min_y, max_x, max_y;
  };

  std::vector<Stamp> stamps_;  // of each shape, its quarter turns after each other
  std::vector<Row> rows_;
};

}  // namespace warren
