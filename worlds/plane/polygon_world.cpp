// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/polygon_world.hpp"

#include <algorithm>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren {
namespace {

/// The sides of polygons and bounds, as further walls.
std::vector<Segment> all_sides(const PolygonIndex& polygons, const Scene& scene, const Execution& execution) {
  const std::size_t count = polygons.polygons().corners.size();
  execution.reserve(count * sizeof(Segment));
  std::vector<Segment> sides = bounds_walls(scene);
  sides.reserve(sides.size() + count);
  for (std::size_t i = 0; i < count; ++i) sides.push_back(polygons.side(i));
  return sides;
}

}  // namespace

PolygonWorld::PolygonWorld(const Scene& scene, double clearance, const Execution& execution)
    : clearance_(checked_clearance(clearance)),
      planning_clearance_(clearance * (1 + 1e-9)),
      polygons_(plane_obstacles(scene, execution).polygons, execution),
      sides_(scene.walls, all_sides(polygons_, scene, execution), execution) {
  box_ = scene.bounds ? *scene.bounds : sides_.box();
  if (box_.empty()) {
    throw InputError("world", "has neither polygons, walls nor bounds: nothing confines the robot");
  }
}

double PolygonWorld::suggested_samples(const Execution& execution) const {
  constexpr double least = 500.0;
  constexpr double samples_a_side = 8.0;
  const double width = typical_width(sides_, box_, &polygons_, execution);
  const double asked = samples_for_width(width, sampled_area(), clearance_);
  return std::clamp(asked, least, least + samples_a_side * static_cast<double>(sides_.wall_count()));
}

}  // namespace warren
