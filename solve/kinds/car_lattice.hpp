// SPDX-License-Identifier: BSD-3-Clause
// A car's world as planners/grid/motion_lattice.hpp searches it: on a map its cells, motions looked up by stamps
// (worlds/poses/motion_set.hpp); among walls and polygons cells of a given size around the start, motions certified
// one by one. Start and goal are any poses, joined to states around them by the car's own curves, which are certified
// against the obstacles. The estimate is the larger of two: a field of steps between cells where the disc around the
// reference point that the body holds fits, and, near a single goal, the length of the car's curve without obstacles.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "planners/grid/motion_lattice.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "spatial/maps/free_cells.hpp"
#include "worlds/poses/car_world.hpp"
#include "worlds/poses/motion_set.hpp"

namespace warren {

struct CarLatticeOptions {
  std::uint32_t headings = 16;         ///< 16 or 32
  std::optional<double> cell;          ///< distance of states, > 0; none: the usual one; a map has its own
  double clearance = 0.0;              ///< room around the body; >= 0
  DrivingPrice price;                  ///< of gears
  double turn_cost = 0.0;              ///< of a radian, in units of length; >= 0
  const PosePrices* prices = nullptr;  ///< of places; nullptr: all cost their length
};

/// Refers to body and execution. One search at a time.
class CarLattice {
 public:
  using ShortestWord = SteeringWord (*)(const Se2& a, const Se2& b, double turning_radius) noexcept;

  /// body: of this robot in this scene. goals: poses any of which will do, at least one. Throws UsageError where the
  /// world has more cells of that size than are searched, and Stopped.
  CarLattice(const CarBody& body, const Scene& scene, const RobotSpec& robot, ShortestWord shortest, const Se2& start,
             std::span<const Se2> goals, const CarLatticeOptions& options, const Execution& execution);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint32_t headings() const { return motions_.headings(); }
  std::span<const LatticeMotion> motions_from(std::uint32_t heading) const { return motions_.from(heading); }
  bool is_free(Cell from, const LatticeMotion& motion);
  /// What places make dear: nearness by the mean of both ends, areas by places a quarter of a cell apart.
  std::uint64_t extra(Cell from, std::uint32_t heading, const LatticeMotion& motion);
  std::uint64_t at_least(Cell cell, std::uint32_t heading);
  std::span<const LatticeStart> starts() const { return starts_; }
  bool is_free_start(std::size_t number);
  bool joins(Cell cell) const;
  /// So many states are expanded between two shots.
  std::uint64_t shot_pause(std::uint64_t at_least) const {
    return static_cast<std::uint64_t>(static_cast<double>(at_least) * MotionSet::cost_unit / motions_.turning_radius());
  }
  std::optional<LatticeShot> shot(Cell cell, std::uint32_t heading, std::int8_t gear, std::uint64_t most,
                                  std::uint64_t gear_change) {
    return shot_from(pose_of(cell, heading), gear, most, gear_change);
  }
  std::optional<LatticeShot> direct_shot(std::uint64_t most, std::uint64_t gear_change) {
    return shot_from(start_, 0, most, gear_change);
  }

  /// Of a unit of cost, in the world's.
  double unit() const { return cell_ * MotionSet::cost_unit; }
  std::uint64_t units_of(double length) const { return static_cast<std::uint64_t>(std::llround(length / unit())); }
  double cell() const { return cell_; }
  const MotionSet& motions() const { return motions_; }
  Se2 pose_of(Cell cell, std::uint32_t heading) const;
  /// Every leg is a straight or an arc of at most a quarter turn.
  Path<Se2> poses(const LatticePath& path) const;
  std::uint64_t refused() const { return query_.refused; }

 private:
  /// The middle of cell (0, 0) is (0, 0).
  Vec2 in_cells(const Se2& pose) const { return (1.0 / cell_) * Rotation(-yaw_rad_)(pose.position() - origin_); }
  SteeringCurve curve(const Se2& a, const Se2& b) const { return {a, b, shortest_(a, b, radius_), radius_}; }
  void lay_out(const Scene& scene, const Se2& start);
  void index_map(const OccupancyMap& map, const RobotSpec& robot, double clearance);
  void join_start(const Se2& start);
  void seed_field();
  std::optional<LatticeShot> shot_from(const Se2& pose, std::int8_t gear, std::uint64_t most,
                                       std::uint64_t gear_change);
  double dear_at(Cell cell, std::uint32_t heading);
  std::uint64_t extra(const SteeringCurve& way);
  std::uint64_t curve_cost(const SteeringWord& word, std::uint64_t gear_change, LatticeShot& shot) const;

  const CarBody& body_;
  const Execution& execution_;
  ShortestWord shortest_;
  double radius_;  // of turning
  Se2 start_;
  std::vector<Se2> goals_;
  std::vector<Vec2> goal_cells_;
  double cell_ = 1.0;
  Vec2 origin_;  // of the middle of cell (0, 0)
  double yaw_rad_ = 0.0;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  MotionSet motions_;
  CarBody::Query query_;
  const PosePrices* prices_;
  RawVector<float> dear_;              // what nearness costs at states, a unit of length; below 0: nobody has asked
  std::optional<FreeCells> free_;      // maps
  std::optional<SweptStamps> stamps_;  // maps
  std::optional<Bitmap> no_middle_;    // maps: where the disc does not fit
  std::optional<CarBody> disc_;        // among walls and polygons: the disc
  std::optional<CarBody::Query> disc_query_;
  std::optional<CellField> field_;
  double join_reach_ = 0.0;  // in cells
  std::vector<LatticeStart> starts_;
};

}  // namespace warren
