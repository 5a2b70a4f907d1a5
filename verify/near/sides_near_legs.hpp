// SPDX-License-Identifier: BSD-3-Clause
// Which obstacles come into question for the legs of a path, for its verification: own code, nothing from spatial/ and
// nothing of what planners ask. The path is cut into boxes. Among walls and polygons one pass over all obstacles drops
// those that meet none, by a tree of these boxes, and what is left is filed in a tree of its own: O(obstacles log legs)
// once, then what lies near a leg. On a map there is nothing to file: the sides of blocked cells are read from the bits
// around a box, 64 columns at a time, so a map is never looked at but near the path.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {

/// A side of an obstacle.
struct NearSide {
  Segment segment;
  std::uint64_t number = 0;  ///< of Obstacles; on a map the blocked cell's, row by row, or `outside`
  static constexpr std::uint64_t outside = ~std::uint64_t{0};
};

/// Refers to the scene, which must outlive it. Any number of threads may gather.
class PathSurroundings : NotCopied {
 public:
  /// One pass over all obstacles; none with their index, which must outlive it. On a map its walls are not looked at.
  /// Throws Stopped.
  PathSurroundings(const Scene& scene, const ObstacleIndex* index, const Execution& execution);

  /// Of all walls and polygons, or of the map.
  const Box& box() const { return extent_.box; }
  double largest_coordinate() const { return extent_.largest_coordinate(); }
  const Obstacles& obstacles() const { return obstacles_; }

  /// To be called before gather(): with all boxes that it will be asked for, in any number of calls.
  void file(std::span<const Box> boxes, const Execution& execution);
  /// All sides whose boxes meet one of these, by number; on a map perhaps some others.
  void gather(std::span<const Box> boxes, std::vector<NearSide>& sides, const Execution& execution) const;
  std::string name(std::uint64_t number) const;

 private:
  const Scene& scene_;
  const std::optional<Obstacles> own_;  // without an index
  const Obstacles& obstacles_;
  const ObstacleIndex* index_;
  ObstacleExtent extent_;
  RawVector<std::size_t> near_;          // numbers of the obstacles that meet one of the filed boxes; without an index
  std::optional<BoxBlocks> near_sides_;  // of near_
};

// A path of poses cut into runs that are one motion each: straight on without a turn, or a turn on the spot. What a
// body sweeps on such a run is what it sweeps on the one leg from its first pose to its last, so a judge of paths over
// lattices, of millions of short legs, looks at each place once. Runs are found by doubling: O(poses).
//
// A car's path is read leg by leg: two poses say all about the leg between them.

/// Legs first .. last - 1 of a path; first == last where the path has a single pose.
struct PoseRun {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t legs() const { return last - first; }
  friend constexpr bool operator==(const PoseRun&, const PoseRun&) = default;
};

/// A motion from pose a, `way` and `turn` further: the reference point goes straight while the body turns evenly, or
/// the body turns about a point, as a car's does.
struct Leg {
  Se2 a;
  Vec2 way;
  double turn;
  bool is_arc = false;
  double blur = 0.0;       ///< how far points of the body may be off that motion
  std::size_t number = 0;  ///< what a violation calls it
};
/// The run as one leg, the shorter way round where it is a single one.
Leg leg_of(std::span<const Se2> path, const PoseRun& run);

/// The turn from a to b by which the body turns least; half turns may come out either way.
double shorter_turn(double a, double b);

/// The runs in their order, each of at most 1024 legs. The poses of a run that goes straight lie within `bend` of the
/// line between its ends; a run that turns goes one way, less than 3 radians. Throws Stopped.
std::vector<PoseRun> pose_runs(std::span<const Se2> path, double bend, const Execution& execution);

/// From one pose to the next with the steering wheel still, as a car takes it.
struct CarLeg {
  Se2 a;
  Vec2 chord;
  double turn = 0.0;
  double ahead = 0.0;   // the chord along the heading halfway; negative: backwards
  double aside = 0.0;   // and square to it: 0 but for rounding
  double length = 0.0;  // of the arc
  double radius = std::numeric_limits<double>::infinity();

  CarLeg(const Se2& from, const Se2& to, double turn_rad)
      : a(from), chord{to.x - from.x, to.y - from.y}, turn(turn_rad) {
    const double middle = from.theta + 0.5 * turn;
    const auto [sine, cosine] = portable::sin_and_cos(middle);
    ahead = chord.x * cosine + chord.y * sine;
    aside = chord.y * cosine - chord.x * sine;
    const double half_sine = portable::sin(0.5 * std::abs(turn));
    length = half_sine > 0.0 ? std::abs(ahead) * 0.5 * std::abs(turn) / half_sine : std::abs(ahead);
    if (half_sine > 0.0) radius = 0.5 * std::abs(ahead) / half_sine;
  }
  bool is_half_turn() const { return std::abs(turn) >= std::numbers::pi * (1.0 - 1e-12); }
};

/// The shorter way round. Half a turn could go either way: it is read as one ahead.
inline CarLeg car_leg_between(const Se2& a, const Se2& b) {
  const CarLeg leg(a, b, shorter_turn(a.theta, b.theta));
  if (!leg.is_half_turn() || leg.ahead >= 0.0) return leg;
  return {a, b, leg.turn - std::copysign(2.0 * std::numbers::pi, leg.turn)};
}

}  // namespace warren
