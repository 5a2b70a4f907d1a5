// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/maze_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace warren {
namespace {

std::vector<Segment> bounds_walls(const Scene& scene) {
  if (!scene.bounds) return {};
  const auto [low, high] = *scene.bounds;
  const Vec2 corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
  return {{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[3]}, {corners[3], corners[0]}};
}

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
  constexpr std::uint64_t probes = 255;
  constexpr double samples_a_square = 10.0;
  std::array<double, probes> clearances;
  for (std::uint64_t i = 0; i < probes; ++i) clearances[i] = index_.clearance(uniform_state(*this, 0, i));
  // Across a corridor of width w the clearance of random points is uniform in [0, w / 2]: its quarter is w / 8.
  std::nth_element(clearances.begin(), clearances.begin() + probes / 4, clearances.end());
  const double corridor = 8.0 * clearances[probes / 4];
  const double width = std::max(corridor - 2.0 * clearance_, 0.1 * corridor);
  return samples_a_square * sampled_area() / (width * width);
}

}  // namespace warren
