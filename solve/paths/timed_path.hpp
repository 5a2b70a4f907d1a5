// SPDX-License-Identifier: BSD-3-Clause
// When a body is where on its path: as fast as its limits let it go along the exact curve. Each leg is a trapezoid of
// speed, from what the leg before leaves to what those behind it allow; the body stops at corners, where its direction
// jumps, and where a car changes gear. Two passes over the legs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/run/execution.hpp"
#include "solve/answer/answer.hpp"

namespace warren {
// An answer's path as the curve that it is, leg by leg: straight ways of points and discs, ways of bodies that turn
// evenly while their reference point goes straight, arcs and straights of cars, even turns of an arm's joints.

enum class LegShape : std::uint8_t { straight, turning, driven, joints };

struct PathState {
  std::array<double, most_joints> numbers{};
  std::size_t width = 2;  ///< 2: x, y; 3: x, y, theta; of arms, the joints

  std::span<const double> used() const { return {numbers.data(), width}; }
};

/// Refers to the answer, which has a path. A path of one state has no leg; asked for leg 0, it stays there. Immutable.
class PathLegs {
 public:
  explicit PathLegs(const Answer& answer);

  LegShape shape() const { return shape_; }
  std::size_t width() const { return answer_->state_width(); }
  std::size_t leg_count() const { return state_count_ - 1; }
  /// In units of length: of a body that turns so much that no point of it goes farther; of an arm, the farthest way of
  /// a joint in rad or, where it slides, m. Leg i leads from state i to state i + 1.
  double length(std::size_t i) const;
  /// Of the turning circle; infinite where the leg is straight, and for all but cars.
  double radius(std::size_t i) const;
  /// -1 where a car drives backwards, else 1.
  int gear(std::size_t i) const;
  /// May leg j follow leg i without a stop: is there no corner and no change of gear? Both have a length.
  bool goes_on(std::size_t i, std::size_t j) const;
  /// How much joint k turns, in rad, or slides, in m, its sign with it; arms alone.
  double joint_turn(std::size_t i, std::size_t k) const;
  /// By how much, in rad, joint k stands farther at the end of leg i than its state's number says: 0, or a full turn or
  /// several, of a joint without end that goes the shorter way around.
  double whole_turns(std::size_t i, std::size_t k) const;
  /// The state at a share of leg i, 0 to 1.
  PathState at(std::size_t i, double share) const;

 private:
  /// Number k of a state; behind the last one, of the last.
  double number(std::size_t state, std::size_t k) const;
  Se2 pose(std::size_t state) const { return {number(state, 0), number(state, 1), number(state, 2)}; }
  /// Towards where a state moves, each number in units of length.
  std::array<double, most_joints> direction(std::size_t leg) const;

  const Answer* answer_;
  LegShape shape_;
  std::size_t state_count_;
  double reach_ = 0.0;  // of a turning body's farthest point from the reference point
};

/// As the only joint speed: as the arm's file has them.
inline constexpr double speed_of_file = 0.0;

/// Numbers > 0; infinite: no limit, so that the body starts and stops at once.
struct TravelLimits {
  double speed = std::numeric_limits<double>::infinity();         ///< of every point of a body that turns, of a car's
                                                                  ///< reference point; length a second
  double acceleration = std::numeric_limits<double>::infinity();  ///< along the path
  double lateral_acceleration = std::numeric_limits<double>::infinity();  ///< of a car's reference point on arcs
  std::vector<double> joint_speed = {};         ///< arms alone, instead of speed: of all joints or of each; rad/s
  std::vector<double> joint_acceleration = {};  ///< rad/s^2; empty: no limit
};

struct PathMoment {
  std::size_t leg = 0;
  double share = 0.0;  ///< of the leg
  double speed = 0.0;  ///< in the leg's units of length a second; negative: backwards
  double time_s = 0.0;
};

/// Refers to the legs.
class TimedPath {
 public:
  /// limits: some speed is finite. Throws Stopped.
  TimedPath(const PathLegs& legs, const TravelLimits& limits, const Execution& execution);

  double duration_s() const { return times_.back(); }
  /// 0 <= t <= duration_s().
  PathMoment at(double t) const;
  PathMoment at_share(std::size_t leg, double share) const;

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
