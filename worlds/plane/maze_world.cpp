// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/maze_world.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "worlds/plane/corridor_width.hpp"

namespace warren {
namespace {

static_assert(bunch_size <= WallIndex::most_motions);

/// Calls test(x) for the set bits of the points in [low, high], and clears those for which it is false.
template <class Test>
void filter_points(double low, double high, std::span<std::uint64_t> bits, const Test& test) {
  const double last = static_cast<double>(bits.size() * 64);
  if (!(high >= 1.0) || !(low <= last)) return;
  const auto first_point = static_cast<std::size_t>(std::ceil(std::max(low, 1.0))) - 1;
  const auto last_point = static_cast<std::size_t>(std::floor(std::min(high, last)));  // one past
  for (std::size_t point = first_point; point < last_point; ++point) {
    const std::uint64_t rest = bits[point / 64] >> (point % 64);
    if (rest == 0) {
      point |= 63;
      continue;
    }
    point += static_cast<std::size_t>(std::countr_zero(rest));
    if (point >= last_point) return;
    if (!test(static_cast<double>(point + 1))) bits[point / 64] &= ~(std::uint64_t{1} << (point % 64));
  }
}

/// What part of the wall's extent in x lies in the band low_y <= y <= high_y, or a little more.
std::pair<double, double> extent_in_band(const Segment& wall, double low_y, double high_y) {
  const Box box = box_of(wall);
  if (box.height() <= 1.0 || box.width() <= 1.0) return {box.min.x, box.max.x};
  const double slope = (wall.b.x - wall.a.x) / (wall.b.y - wall.a.y);
  const double at_low = wall.a.x + slope * (low_y - wall.a.y);
  const double at_high = wall.a.x + slope * (high_y - wall.a.y);
  const double margin = 1e-9 * (1.0 + std::abs(wall.a.x) + std::abs(at_low) + std::abs(at_high));
  return {std::max(box.min.x, std::min(at_low, at_high) - margin),
          std::min(box.max.x, std::max(at_low, at_high) + margin)};
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

std::uint32_t MazeWorld::free_motions(std::span<const Motion<State>> motions, Query& query) const noexcept {
  std::transform(motions.begin(), motions.end(), query.motions.begin(), [](const Motion<State>& motion) {
    return Segment{motion.from, motion.to};
  });
  return index_.keep_clearance({query.motions.data(), motions.size()}, planning_clearance_);
}

void MazeWorld::keep_free(double y, std::span<std::uint64_t> bits) const noexcept {
  const double r = planning_clearance_;
  const double last = static_cast<double>(bits.size() * 64);
  filter_points(1.0, last, bits, [&](double x) { return box_.contains({x, y}); });
  index_.for_each_near(Box{{1.0, y}, {last, y}}.grown(r), [&](const Segment& wall) {
    const auto [low, high] = extent_in_band(wall, y - r, y + r);
    filter_points(low - r, high + r, bits, [&](double x) {
      const Segment point{{x, y}, {x, y}};
      return r > 0.0 ? segments_keep_distance(point, wall, r) : !segments_touch(point, wall);
    });
    return true;
  });
}

double MazeWorld::suggested_samples(const Execution& execution) const {
  const auto is_outside = [](Vec2) { return true; };
  const double width = typical_width(index_, box_, is_outside, execution);
  return std::min(samples_for_width(width, sampled_area(), clearance_),
                  most_samples_for(box_, width, clearance_, index_.wall_count()));
}

}  // namespace warren
