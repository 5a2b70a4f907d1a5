// SPDX-License-Identifier: BSD-3-Clause
// Is the path of a body in the plane free? By looking at places a thousandth apart, everywhere and at everything: the
// body's whole area against walls, polygons with their holes, cells and bounds. It shares nothing with the program, not
// even a header. It refutes what it sees; that it sees nothing proves little, but no answer of the program may be
// refuted by it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/matrix/plain_plane.hpp"

namespace warren::test {

/// What a world's file says, as it is meant: cells of a map are regions, and the map's rim is `rim`.
struct PlaneObstacles {
  std::vector<PlaneLine> walls{};
  std::vector<Region> regions{};
  bool rounded = false;  ///< a map's cells, whose borders are where they are up to rounding: touching can't be told
  Ring rim{};  ///< convex, counter-clockwise: the body stays inside; empty: the reference point stays in the obstacles'
               ///< box
};

struct PlaneBody {
  double radius = 0.0;  ///< of a disc around the reference point; 0: a point
  Ring outline{};       ///< of a polygon; empty: a disc
  bool drives = false;  ///< a car: legs are straights and arcs
  bool reverses = false;
  bool turns_on_spot = false;
  double turning_radius = 0.0;
};

struct PlaneQuestion {
  std::array<double, 3> start{};
  std::array<double, 3> goal{};
  double clearance = 0.0;
  bool may_touch = false;  ///< a point that may slide along obstacles
};

/// What is wrong with the path; nothing where all of it is free. Poses have 2 numbers (points and discs) or 3.
std::optional<std::string> wrong_with_path(const PlaneObstacles& obstacles, const PlaneBody& body,
                                           const PlaneQuestion& question, const std::vector<std::vector<double>>& path);

}  // namespace warren::test
