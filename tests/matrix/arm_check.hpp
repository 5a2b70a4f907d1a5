// SPDX-License-Identifier: BSD-3-Clause
// Is the path of an arm free? By looking at postures so close that no point of the arm goes farther than a thousandth
// from one to the next: its links, capsules between the origins of its frames, against spheres and boxes. It shares
// nothing with the program, not even a header or a table.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace warren::test {

using SpacePoint = std::array<double, 3>;

struct SpaceObstacles {
  std::vector<std::array<double, 4>> spheres{};  ///< centre and radius
  std::vector<std::array<double, 6>> boxes{};    ///< two opposite corners, the lower one first
};

/// A row of a Denavit-Hartenberg table; radians.
struct ArmJoint {
  double d = 0.0;
  double a = 0.0;
  double alpha = 0.0;
  double low = 0.0;
  double high = 0.0;
  double offset = 0.0;
};

struct ArmBody {
  std::vector<ArmJoint> joints;
  bool modified = false;  ///< the table's convention
  double tool = 0.0;      ///< along the last z axis
  double radius = 0.0;
};

/// The Puma 560 with its classic limits.
ArmBody puma560_arm(double radius, double tool);

struct ArmQuestion {
  std::vector<double> start;  ///< six angles
  std::vector<double> goal;   ///< six angles, or the tool's place
  double clearance = 0.0;
};

/// What is wrong with the path; nothing where all of it is free.
std::optional<std::string> wrong_with_path(const SpaceObstacles& obstacles, const ArmBody& arm,
                                           const ArmQuestion& question, const std::vector<std::vector<double>>& path);

}  // namespace warren::test
