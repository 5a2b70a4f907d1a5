// SPDX-License-Identifier: BSD-3-Clause
#include "solve/steps/settled_ends.hpp"

#include <cmath>

#include "solve/steps/blocked_end.hpp"

namespace warren {
namespace {

double largest_coordinate_of(const Scene& scene, const Execution& execution) {
  double largest = 0.0;
  if (const Box box = room_of(scene, execution); !box.empty()) {
    for (const double c : {box.min.x, box.min.y, box.max.x, box.max.y}) largest = std::max(largest, std::abs(c));
  }
  for (const Sphere& s : scene.spheres) {
    largest = std::max({largest, std::abs(s.x) + s.radius, std::abs(s.y) + s.radius, std::abs(s.z) + s.radius});
  }
  for (const SolidBox& box : scene.boxes) {
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
  }
  return largest;
}

}  // namespace

double end_margin(const Scene& scene, const RobotSpec& robot, double clearance, double extent,
                  const Execution& execution) {
  const double round = end_margin(clearance + robot.radius, scene.map ? scene.map->cell : 0.0);
  if (robot.kind == RobotKind::point || robot.kind == RobotKind::disc) return round;
  constexpr double rounding = 4e-12;  // of coordinates
  return 2.0 * round + 2e-9 * extent + rounding * largest_coordinate_of(scene, execution);
}

}  // namespace warren
