// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/maze_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace warren {
namespace {

double checked_clearance(double clearance) {
  if (!(clearance >= 0.0) || clearance > largest_coordinate) {
    throw InputError("clearance", "must be a number from 0 to 1e60", std::to_string(clearance));
  }
  return clearance;
}

/// How far one sees from the middle of a wall, square to it, before the next wall, to a percent; 0 where nothing is in
/// the way within the box.
double free_width(const WallIndex& index, const Box& box, const Segment& wall, double side) {
  const Vec2 along = wall.b - wall.a;
  const double length = norm(along);
  if (length == 0.0) return 0.0;
  const Vec2 middle = 0.5 * (wall.a + wall.b);
  const Vec2 normal = (side / length) * Vec2{-along.y, along.x};
  const double farthest = box.width() + box.height();
  const double step = 1e-3 * std::min(length, farthest);
  const auto blocked = [&](double t) { return index.blocks(middle + step * normal, middle + t * normal); };
  double far = 2.0 * step;
  while (far < farthest && !blocked(far)) far *= 2.0;
  if (far >= farthest) return 0.0;
  double near = 0.5 * far;
  while (far - near > 0.01 * far) {
    const double t = 0.5 * (near + far);
    (blocked(t) ? far : near) = t;
  }
  return far;
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
  constexpr double samples_a_square = 4.5;
  constexpr std::size_t probes = 64;
  std::vector<double> widths;
  for (const Segment& wall : index_.some_walls(probes)) {
    for (const double side : {-1.0, 1.0}) {
      const double width = free_width(index_, box_, wall, side);
      if (width > 0.0) widths.push_back(width);
    }
  }
  const double whole = std::sqrt(sampled_area());
  double corridor = whole;
  if (!widths.empty()) {
    const auto quartile = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 4);
    std::nth_element(widths.begin(), quartile, widths.end());
    corridor = std::min(corridor, *quartile);
  }
  const double width = std::max(corridor - 2.0 * clearance_, 0.1 * corridor);
  return samples_a_square * sampled_area() / (width * width);
}

}  // namespace warren
