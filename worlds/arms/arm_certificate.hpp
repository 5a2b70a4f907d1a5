// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "parallel/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "spatial/points/disc_points.hpp"
#include "worlds/arms/arm_tables.hpp"
#include "worlds/poses/certified_motion.hpp"

namespace warren {

/// Immutable after construction; any number of threads may ask.
class ArmCertificate {
 public:
  /// What the arm is among: obstacles in the base's frame, each keeping `clearance` >= 0 from every link, as the
  /// model's pairs of links do from each other; below `resolution` (> 0, metres that a point of the arm may go in a
  /// piece) a motion that is neither proved free nor blocked is refused. Copies what it needs. Throws Stopped.
  ArmCertificate(const ArmModel& model, std::span<const Solid> obstacles, double clearance, double resolution,
                 const Execution& execution = {});

  /// Every variable goes evenly from q to q + way, both ends included. A joint that slides out of its limits, and a way
  /// longer than its range (a continuous one's: more than a turn), are refused; other limits are the caller's business.
  /// 0.3 to 2 us for some ten links among some ten obstacles; equal on every machine and for any number of threads.
  MotionVerdict motion(std::span<const double> q, std::span<const double> way) const;
  /// A motion of no length: touching is not free.
  bool is_free(std::span<const double> q) const;

 private:
  detail::ArmSetup setup_;
};

namespace detail {

/// For tests: by the instruction set, and with a bound of the acceleration that is so much of the true one.
MotionVerdict judge_arm_motion(const ArmSetup& setup, std::span<const double> q, std::span<const double> way,
                               InstructionSet set, double bend_factor = 1.0);

}  // namespace detail
}  // namespace warren
