// SPDX-License-Identifier: BSD-3-Clause
// An arm as its judge sees it: bodies in frames, where the frames are and how they move, and the most that any point
// can. Built once a path, read by all threads.
//
// How far two convex solids are apart is measured between a plane that parts them and two of their points. Whatever
// finds the plane, what is said of it comes from supports alone, the farthest that a solid goes in a direction: were
// the search wrong, the bounds would be wide, never false.
//
// A solid is a core and a radius around it: a ball's core is a point, a capsule's a segment. From points and segments
// to boxes, cylinders and segments the way is written out; for all else Wolfe's algorithm looks for the point nearest
// to 0 in the difference of the cores (P. Wolfe, Finding the nearest point in a polytope, 1976): a corral of at most
// four differences of corners, whose plane is moved until no corner lies beyond it. Some supports of either solid, each
// one look at all corners of a hull.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"

namespace warren {

/// A rigid frame: its axes and its origin.
struct SolidFrame {
  std::array<Vec3, 3> axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  Vec3 at = Vec3::Zero();

  Vec3 turned(const Vec3& v) const { return v.x() * axes[0] + v.y() * axes[1] + v.z() * axes[2]; }
  Vec3 point(const Vec3& p) const { return at + turned(p); }
  Vec3 seen(const Vec3& v) const { return {axes[0].dot(v), axes[1].dot(v), axes[2].dot(v)}; }
  /// Of a frame that is given in this one.
  SolidFrame frame(const SolidFrame& inner) const {
    return {{turned(inner.axes[0]), turned(inner.axes[1]), turned(inner.axes[2])}, point(inner.at)};
  }
};

/// What a solid is made of, in its own frame, whose origin is its middle. A ball is a sphere with half = 0.
struct SolidCore {
  SolidKind kind = SolidKind::sphere;
  Vec3 half = Vec3::Zero();        ///< as Solid::half, without the radius of spheres and capsules
  double radius = 0.0;             ///< around the core
  double far = 0.0;                ///< no point of the core is farther from its middle
  std::vector<Vec3> corners = {};  ///< of hulls

  Vec3 support(const Vec3& direction) const;  ///< a point that goes farthest
};

/// The solid's core; its frame is moved to its middle.
SolidCore core_of(const Solid& solid, SolidFrame& frame);

/// A core where it is.
struct PlacedCore {
  const SolidCore& core;
  const SolidFrame& frame;

  /// How far the core goes in a direction of any length.
  double reach(const Vec3& direction) const {
    const Vec3 own = frame.seen(direction);
    return frame.at.dot(direction) + core.support(own).dot(own);
  }
};

/// Between cores: their radii are not taken off.
struct SolidGap {
  double least = 0.0;           ///< not less than 0
  double most = 0.0;            ///< the distance is between the two, but for rounding
  Vec3 towards = Vec3::Zero();  ///< of length 1, from the first to the second: square to the plane that says `least`
};

/// Measured until the bounds are no more than `close` apart, or `least` is `enough`, or more can't be told.
SolidGap gap_between(const PlacedCore& a, const PlacedCore& b, double close, double enough);

/// A solid of a link, a ball around all of a link, or an obstacle.
struct JudgedBody {
  SolidCore core;
  SolidFrame frame;            ///< in its joint's
  int joint = base_frame;      ///< that moves it, or base_frame
  std::size_t owner = 0;       ///< number of the link, or of the obstacle
  std::size_t first_part = 0;  ///< of the bodies that a ball is around
  std::size_t parts = 0;       ///< 0: a solid itself
};

/// A joint's frame at a moment of a leg, in the base, and how it moves: a point x of it by drift + spin.cross(x), times
/// what of the leg goes by.
struct JudgedFrame {
  SolidFrame frame;
  Vec3 spin = Vec3::Zero();
  Vec3 drift = Vec3::Zero();
};

/// Bounds for all points of a link's cores, on a leg, against the frame of a joint behind it.
struct Sway {
  double reach = 0.0;  ///< how far from that frame's origin; of the base's from where the root stands
  double speed = 0.0;  ///< their way a leg
  double bend = 0.0;   ///< the second derivative
};

class JudgedArm {
 public:
  /// Throws InputError for models that contradict arm_model.hpp. Refers to the model.
  JudgedArm(const ArmModel& model, const Execution& execution);

  /// All bodies: of each link its ball, at balls()[link], then its solids.
  const std::vector<JudgedBody>& bodies() const { return bodies_; }
  const std::vector<std::size_t>& balls() const { return balls_; }
  /// The last joint that moves both frames, or base_frame.
  int joint_behind(int a, int b) const;
  /// Base first, then the joints; the state is `from` + share * way.
  void frames_at(const JointState& from, const JointState& way, double share, std::vector<JudgedFrame>& frames) const;
  /// Those of link l against joint j's frame at [l * (joints + 1) + j + 1], where j is behind it. turns: how far each
  /// joint goes; values: the largest size of each one's value.
  std::vector<Sway> sways(std::span<const double> turns, std::span<const double> values) const;
  SolidFrame tool_at(const JointState& q) const;

 private:
  void add_link(std::size_t link);

  const ArmModel& model_;
  std::vector<JudgedBody> bodies_;
  std::vector<std::size_t> balls_;
  std::vector<double> reach_;  // of each link's cores from its frame's origin
};

/// A frame's numbers, if they are those of a rigid one; throws InputError, naming it.
SolidFrame rigid_frame(const Eigen::Isometry3d& pose, const std::string& name);
/// The same of a solid and its sizes.
SolidCore checked_core(const Solid& solid, SolidFrame& frame, const std::string& name);

}  // namespace warren
