// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/maze_world.hpp"

#include <string>

#include "core/error.hpp"
#include "worlds/free_width.hpp"

namespace warren {
namespace {

double checked_clearance(double clearance) {
  if (!(clearance >= 0.0) || clearance > largest_coordinate) {
    throw InputError("clearance", "must be a number from 0 to 1e60", std::to_string(clearance));
  }
  return clearance;
}

}  // namespace

MazeWorld::MazeWorld(const Scene& scene, double clearance, const Execution& execution)
    : clearance_(checked_clearance(clearance)),
      planning_clearance_(clearance * (1 + 1e-9)),
      index_(scene.walls, bounds_walls(scene), execution) {
  box_ = scene.bounds ? *scene.bounds : index_.box();
  if (box_.empty()) throw InputError("world", "has neither walls nor bounds: nothing confines the robot");
}

bool MazeWorld::is_free(const State& a, Query&) const noexcept {
  return box_.contains(a) && index_.keeps_clearance(a, a, planning_clearance_);
}

double MazeWorld::suggested_samples() const {
  return samples_for_width(typical_width(index_, box_, [](Vec2) { return true; }), sampled_area(), clearance_);
}

}  // namespace warren
