// SPDX-License-Identifier: BSD-3-Clause
// A path of poses cut into runs that are one motion each: straight on without a turn, or a turn on the spot. What a
// body sweeps on such a run is what it sweeps on the one leg from its first pose to its last, so a judge of paths over
// lattices, of millions of short legs, looks at each place once. Runs are found by doubling: O(poses).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"

namespace warren {

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
  double blur = 0.0;  ///< how far points of the body may be off that motion
};
/// The run as one leg, the shorter way round where it is a single one.
Leg leg_of(std::span<const Se2> path, const PoseRun& run);

/// The turn from a to b by which the body turns least; half turns may come out either way.
double shorter_turn(double a, double b);

/// Within tolerance of the place and, unless any heading will do, of the heading.
bool is_there(const Se2& pose, const Se2& wanted, bool any_heading, double tolerance);

/// The runs in their order, each of at most 1024 legs. The poses of a run that goes straight lie within `bend` of the
/// line between its ends; a run that turns goes one way, less than 3 radians. Throws Stopped.
std::vector<PoseRun> pose_runs(std::span<const Se2> path, double bend, const Execution& execution);

}  // namespace warren
