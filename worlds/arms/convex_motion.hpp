// SPDX-License-Identifier: BSD-3-Clause
// Do two convex bodies, each fixed in a frame that moves, stay apart for a while? A plane between them says so,
// whoever found it.
//
// A point r off the frame's origin is, at the parameter t, at `at + r + t (velocity + spin x r)` plus at most bend t^2
// /
// 2. For a direction n that is, but for the last, n.(at + t velocity) + (n + t n x spin).r: to first order the body is
// a linear image of itself, and what of it lies farthest along n a support in another direction. For any two points of
// the bodies their distance along n is affine in t; the least of these is concave: so what holds at both ends of the
// piece, holds in between. The best n is that of the point nearest to the origin in the hull of what the bodies'
// differences are at both ends; the method of Gilbert, Johnson and Keerthi walks there, each step with a bound below.
// Turning boxes so cost nothing beyond their bend; margins of spheres and capsules don't turn at all.
// Rounding: 1e-13 of all lengths that take part is taken off each bound; a support and its point are wrong by some 20
// units of 1e-16, and frames may be by 300. NaN proves nothing.
// Cost: a ball test (20 ns) settles what is far; else some 100 to 200 ns a step, 3 to 8 steps, never above 64.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "worlds/arms/convex_body.hpp"

namespace warren {

/// A rigid frame in motion, around the middle t = 0 of a piece.
struct MovingFrame {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of the frame, at the middle
  Vec3 at = Vec3::Zero();                              ///< its origin there
  Vec3 velocity = Vec3::Zero();                        ///< of its origin, a unit of t
  Vec3 spin = Vec3::Zero();                            ///< radians a unit of t
  double bend =
      0.0;  ///< no point of the body's core is accelerated by more, a unit of t squared, anywhere on the piece
};

/// proved: apart. meet: not apart. open: neither is proved.
enum class Apart : std::uint8_t { proved, open, meet };

/// Do a and b keep more than `room` >= 0 apart while |t| <= half? meet: at t = 0 they are nearer than that (overlap,
/// for room 0), beyond rounding. Allocates nothing; any number of threads may ask.
Apart keep_apart(const ConvexBody& a, const MovingFrame& at_a, const ConvexBody& b, const MovingFrame& at_b,
                 double half, double room);

/// A plane between two bodies.
struct PlaneBetween {
  double below;    ///< lower bound of their distance, rounding taken off; <= 0: they may meet
  Vec3 direction;  ///< of length 1, from a to b: along it they are so far apart
};

/// At t = 0. Within 1e-9 of the distance, where steps suffice; more than `enough` counts as any number above it.
PlaneBetween plane_between(const ConvexBody& a, const MovingFrame& at_a, const ConvexBody& b, const MovingFrame& at_b,
                           double enough);

}  // namespace warren
