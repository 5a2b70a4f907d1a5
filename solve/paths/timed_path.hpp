// SPDX-License-Identifier: BSD-3-Clause
// When a body is where on its path: as fast as its limits let it go along the exact curve. Each leg is a trapezoid of
// speed, from what the leg before leaves to what those behind it allow; the body stops at corners, where its direction
// jumps, and where a car changes gear. Two passes over the legs.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "parallel/execution.hpp"
#include "solve/paths/path_legs.hpp"

namespace warren {

/// Numbers > 0; infinite: no limit, so that the body starts and stops at once.
struct TravelLimits {
  double speed = std::numeric_limits<double>::infinity();         ///< of every point of a body that turns, of a car's
                                                                  ///< reference point; length a second
  double acceleration = std::numeric_limits<double>::infinity();  ///< along the path
  double lateral_acceleration = std::numeric_limits<double>::infinity();  ///< of a car's reference point on arcs
  std::vector<double> joint_speed = {};         ///< arms alone, instead of speed: of all joints or of each; rad/s
  std::vector<double> joint_acceleration = {};  ///< rad/s^2; empty: no limit
};

/// A moment of a timed path.
struct PathMoment {
  std::size_t leg = 0;
  double share = 0.0;  ///< of the leg
  double speed = 0.0;  ///< in the leg's units of length a second; negative: backwards
};

/// Refers to the legs.
class TimedPath {
 public:
  /// limits: some speed is finite. Throws Stopped.
  TimedPath(const PathLegs& legs, const TravelLimits& limits, const Execution& execution);

  double duration_s() const { return times_.back(); }
  /// When the body leaves state i, in s.
  double time_s(std::size_t i) const { return times_[i]; }
  /// 0 <= t <= duration_s().
  PathMoment at(double t) const;
  /// At a share of a leg.
  PathMoment at_share(std::size_t leg, double share, double& time_s) const;

 private:
  /// The trapezoid of one leg.
  struct Ramp {
    double from, top, to;  // speeds
    double up_s, level_s, down_s;
    double rate;  // acceleration
    double duration_s() const { return up_s + level_s + down_s; }
  };
  Ramp ramp(std::size_t leg) const;
  struct LegLimits {
    double speed, acceleration;
  };
  LegLimits limits_of(std::size_t leg) const;

  const PathLegs* legs_;
  TravelLimits limits_;
  std::vector<double> speeds_;  // through each state
  std::vector<double> times_;
};

}  // namespace warren
