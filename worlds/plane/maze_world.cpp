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
#include "worlds/plane/open_sides.hpp"

namespace warren {
namespace {

static_assert(bunch_size <= WallIndex::most_motions);

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

std::uint32_t MazeWorld::free_states(std::span<const State> states, Query& query) const noexcept {
  std::uint32_t in_box = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    query.motions[i] = {states[i], states[i]};
    in_box |= std::uint32_t{box_.contains(states[i])} << i;
  }
  return in_box & index_.keep_clearance({query.motions.data(), states.size()}, planning_clearance_);
}

CellSides MazeWorld::cell_sides(std::size_t most_cells, const Execution& execution) const {
  return open_sides(index_, box_, clearance_, most_cells, execution);
}

double MazeWorld::suggested_samples(const Execution& execution) const {
  const auto is_outside = [](Vec2) { return true; };
  const double width = typical_width(index_, box_, is_outside, execution);
  return std::min(samples_for_width(width, sampled_area(), clearance_),
                  most_samples_for(box_, width, clearance_, index_.wall_count()));
}

}  // namespace warren
