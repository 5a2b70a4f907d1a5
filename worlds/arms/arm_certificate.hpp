// SPDX-License-Identifier: BSD-3-Clause
// Is an arm free all along a motion? Proved, for less than what samples cost: the motion is cut into eight pieces,
// whose middles are looked at side by side, in floats; most free motions need no more. What is open is cut again, at
// most four pieces into eight; where floats leave doubt, all is done again in doubles. After the study that tried it:
// free motions of a radian cost 1 to 2 us, others a third of that, kinematics 0.15 us.
//
// Why it is a proof, rounding included:
// (1) Let c be the centre of a ball that is fixed in a link, and all joints go evenly: c'' is the sum over pairs of
// joints of rate_k rate_j a_k x (a_j x (c - p_j)), k before j or j itself; no term is larger than the rates times how
// far c ever gets from the axis of j (ArmTables::reach); for a joint j that slides, times 1, and 0 where k does not
// turn. So |c''| <= A on the whole motion, one A a link.
// (2) On a piece of half the length h, c stays within A h^2 / 2 of its tangent in the middle.
// (3) An obstacle is what lies within some distance r' (a radius, the clearance) of a convex core. Let x be the core's
// point nearest to c in the middle of the piece, g = c - x, n = g / |g|. The core lies in n (y - x) <= 0. So c keeps
// |g| - |n v| h - A h^2 / 2 from it, with its velocity v there. A ball of radius r is free if that is more than r + r'.
// (4) Two balls: their difference in the frame of the last body that carries both. Only joints behind that one turn it;
// n v is the same in every frame, as n lies along the difference.
// (5) A link's hull is a ball around its balls; it moves with them. Obstacles and pairs that it is proved free of need
// no more. Obstacles whose upright box the hull's box, over all pieces, does not meet, are farther along an axis.
// (6) Links of other solids than balls are covered by balls. What these leave open, and obstacles that are hulls of
// points beyond their boxes, is asked of the convex bodies themselves (worlds/arms/convex_motion.hpp), lane by lane.
// (7) Middles and halves are sums of few powers of 2, hence exact: the pieces cover all of the motion.
// (8) Sines are wrong by largest_sine_error at most; the angle, by 2 to 3 roundings. From the base on, turn by turn,
// the frame's matrix gets wrong by these and 16 roundings, its origin by the parent's error times the offset; so
// ArmBuilder::take_slack adds them up. A frame or gap that is wrong is that of a point so far off; with twice that
// and 64 roundings of all sizes as `slack` the bounds hold for the true one, and wrong velocities cost way_slack.
// (9) Comparisons with NaN say no: not proved; what culls obstacles is no such comparison, but where the slack is below
// 1e30 all that it compares is a number. (10) A hit is a middle of a piece where balls inside of the solids meet
// by more than the slack, or convex bodies in doubles. It ends the search, whatever is looked at first; so verdicts
// don't depend on what was asked before, on threads, or on the instruction set, since all lanes round alike.
//
// tests/worlds/arms/arm_certificate_test.cpp attacks it; with a tenth of A the attack succeeds. Tried in the study:
// |v| h instead of |n v| h (2 to 10 times the cost), one A for all links (2 times), one obstacle after the other.
#pragma once

#include <span>

#include "core/run/execution.hpp"
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
  /// longer than its range (a continuous one's: more than a turn), are refused, as are angles beyond 1000 that are out
  /// of limits; other limits are the caller's business. Bounded: what takes some 20,000 looks is refused.
  /// 0.3 to 2 us for some ten links among some ten obstacles; equal on every machine and for any number of threads.
  MotionVerdict motion(std::span<const double> q, std::span<const double> way) const;
  /// A motion of no length: touching is not free.
  bool is_free(std::span<const double> q) const;

 private:
  detail::ArmSetup setup_;
};

namespace detail {

/// What motion() says, by the instruction set; of tests, with a bound of the acceleration that is so much of the true
/// one.
MotionVerdict judge_arm_motion(const ArmSetup& setup, std::span<const double> q, std::span<const double> way,
                               InstructionSet set, double bend_factor = 1.0);

}  // namespace detail
}  // namespace warren
