// SPDX-License-Identifier: BSD-3-Clause
// Solids of space, and an arm as plain data: joints in a tree, links with their solids, which links may not touch each
// other. What planners and judges of arms have in common; read from a URDF (scenes/arms/urdf_io.cpp) or made of a
// Denavit-Hartenberg table (worlds/arms/serial_chain.hpp).
//
// Where a joint's frame is: frame(joint) = frame(parent) * origin * motion(axis, value), with value = multiplier *
// q[variable] + offset; a revolute joint turns by `value` about its axis, a prismatic one slides by it along the axis.
// Fixed joints, and those that the group does not move, are part of the origins. Between two states every variable goes
// evenly; a continuous one the shorter way around.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.hpp"

namespace warren {

using Vec3 = Eigen::Vector3d;  ///< a point or vector of space; units of the world

/// What a Solid is.
enum class SolidKind : std::uint8_t { sphere, box, cylinder, capsule, hull };
constexpr auto enum_names(SolidKind) {
  return std::array<std::string_view, 5>{"sphere", "box", "cylinder", "capsule", "hull"};
}

/// A closed convex body anywhere in space: an obstacle of arms, or a part of an arm's link.
struct Solid {
  SolidKind kind = SolidKind::sphere;                      ///< which of the members below mean something
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of its own frame, whose z is a cylinder's axis
  /// sphere: x is the radius. box: half its sides. cylinder, capsule: x is the radius, z half the length of the axis (a
  /// capsule's without its caps). All >= 0. hull: unused.
  Vec3 half = Vec3::Zero();
  std::vector<Vec3> corners = {};                        ///< hull: at least one, in its own frame, each on the outside
  std::vector<std::array<std::uint32_t, 3>> faces = {};  ///< hull: triangles of corners, counter-clockwise from outside
  std::string name = {};                                 ///< in messages; may be empty
  /// The numbers of its line in a scene (scenes/arms/solid_text.cpp), so that it is written as it was read; whoever
  /// changes the members above clears them. Empty: none are known.
  std::vector<double> given = {};
};

/// Numbers that an arm's state may have: joints that move on their own.
inline constexpr std::size_t most_joints = 14;
/// Joint angles in radians, of joints that slide metres; those that an arm lacks are 0.
using JointState = std::array<double, most_joints>;

/// Joints that move, of one arm; those that mimic another one included.
inline constexpr std::size_t most_frames = 32;
/// Number of the frame that does not move, where a joint's or link's parent is asked for.
inline constexpr int base_frame = -1;

/// A number of an arm's state.
struct ArmVariable {
  std::string name;     ///< its joint's
  bool slides = false;  ///< metres, not radians
  bool continuous =
      false;           ///< an angle without end: low and high are -pi and pi, and mean nothing but where samples are
  double low = 0.0;    ///< finite
  double high = 0.0;   ///< >= low
  double speed = 0.0;  ///< largest, a second; 0: the file does not say
};

/// A joint that moves.
struct ArmJoint {
  std::string name;
  int parent = base_frame;  ///< number of the joint whose frame it stands in, below its own; or base_frame
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();  ///< of its frame in the parent's, while its value is 0
  Vec3 axis{0.0, 0.0, 1.0};                                  ///< of length 1, in its own frame
  bool slides = false;
  std::size_t variable = 0;
  double multiplier = 1.0;  ///< of a joint that mimics another one
  double offset = 0.0;
};

/// A part of the body that moves as one.
struct ArmLink {
  std::string name;
  int frame = base_frame;     ///< number of the joint whose frame it is fixed in, or base_frame
  std::vector<Solid> solids;  ///< at least one, in that frame
};

/// Two links, by number, the lower first.
using LinkPair = std::array<std::uint32_t, 2>;

struct ArmModel {
  std::string name;
  std::vector<ArmVariable> variables;  ///< 1 .. most_joints
  std::vector<ArmJoint> joints;        ///< at most most_frames, parents first
  std::vector<ArmLink> links;          ///< those with solids
  std::vector<LinkPair> pairs;         ///< of links that may not touch each other, in order, no pair twice
  int tool_frame = base_frame;         ///< number of the joint that the tool is fixed in
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();  ///< in that frame
  Vec3 base = Vec3::Zero();                                ///< where its root stands, from which its reach counts
  std::vector<std::string> assumed;  ///< what is taken for granted, a line each: pairs of links that always touch, …
  std::vector<std::string> told = {};  ///< what its reader has to say, a line each: hulls against their meshes, …
  std::vector<std::pair<std::string, double>> standing = {};  ///< joints that could move and stand still, and where
  std::vector<ArmJoint> idle_followers = {};  ///< that mimic a variable and carry nothing: without a frame
};

/// How far a variable goes from one state to the next: of a continuous one within half a turn to either side.
inline double variable_way(const ArmVariable& variable, double from, double to) {
  if (!variable.continuous) return to - from;
  return std::remainder(to - from, 2.0 * std::numbers::pi);
}

}  // namespace warren
