// SPDX-License-Identifier: BSD-3-Clause
// Do two convex bodies, each fixed in a frame that moves, stay apart for a while? A plane between them says so,
// whoever found it.
//
// A point r off the frame's origin is, at the parameter t, at `at + r + t (velocity + spin x r)` plus at most bend t^2
// / 2. For a direction n that is, but for the last, n.(at + t velocity) + (n + t n x spin).r: to first order the body
// is a linear image of itself, and what of it lies farthest along n a support in another direction. For any two points
// of the bodies their distance along n is affine in t; the least of these is concave: so what holds at both ends of the
// piece, holds in between. The best n is that of the point nearest to the origin in the hull of what the bodies'
// differences are at both ends; the method of Gilbert, Johnson and Keerthi walks there, each step with a bound below.
// Turning boxes so cost nothing beyond their bend; margins of spheres and capsules don't turn at all.
// Rounding: 1e-13 of all lengths that take part is taken off each bound; a support and its point are wrong by some 20
// units of 1e-16, and frames may be by 300. NaN proves nothing.
// Cost: a ball test (20 ns) settles what is far; else some 100 to 200 ns a step, 3 to 8 steps, never above 64.
//
// A ConvexBody is a Solid as separating planes need it: which of its points lies farthest in a direction. Spheres and
// capsules are a point or segment, the core, with a round margin; of the others the core is all.
// Cost: some ns; a hull's corners are held sixteen by sixteen, each with a ball around them, and sixteens whose ball
// ends before the best corner so far are passed over: 200 corners cost some 60 ns, 10,000 some 1,000.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenes/scene/scene.hpp"

namespace warren {

/// pose * point, the same bytes everywhere: Eigen takes these four numbers a time, in sums that arm64 fuses.
inline Vec3 placed_point(const Eigen::Isometry3d& pose, const Vec3& point) {
  return pose.linear() * point + pose.translation();
}

/// Immutable after construction; any number of threads may ask.
class ConvexBody {
 public:
  /// In the frame that the solid's pose is told in. Numbers are finite, lengths >= 0, a hull has a corner.
  explicit ConvexBody(const Solid& solid);

  /// A point of the core that lies farthest in a direction of any length, up to rounding (a few 1e-16 of its size).
  /// `near` says where a hull is looked at first, any number, and becomes what is best next for a direction much alike.
  Vec3 core_support(const Vec3& direction, std::size_t& near) const;
  /// The body is what is within this of the core; >= 0.
  double margin() const { return margin_; }
  /// Of a ball that holds the body.
  const Vec3& centre() const { return centre_; }
  /// Of that ball.
  double radius() const { return radius_; }
  /// What a support costs against that of a box, about: a hull of 1,000 corners is 2 more than one of few.
  std::size_t cost() const { return 1 + corners_.size() / 32; }

 private:
  static constexpr std::size_t lanes = 16;
  struct Corners {
    std::array<double, lanes> x;
    std::array<double, lanes> y;
    std::array<double, lanes> z;
    Vec3 centre;  // of a ball that holds them
    double radius = 0.0;
  };
  struct Farthest {
    double along;
    Vec3 corner;
  };
  void split_corners(std::vector<Vec3>& corners, std::size_t begin, std::size_t end);
  static void look(const Corners& corners, const Vec3& direction, Farthest& best);
  Vec3 hull_support(const Vec3& direction, std::size_t& near) const;

  Vec3 centre_ = Vec3::Zero();
  std::array<Vec3, 3> edges_;     // the core is the centre and up to so much of each to either side,
  std::size_t edge_count_ = 0;    // of so many,
  bool is_round_ = false;         // and, of a cylinder,
  std::array<Vec3, 2> rim_;       // the disc that these two span;
  std::vector<Corners> corners_;  // of a hull alone what is between these
  double margin_ = 0.0;
  double radius_ = 0.0;
};

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
