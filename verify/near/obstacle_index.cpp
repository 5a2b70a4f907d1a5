// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/obstacle_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"

namespace warren {
namespace {

std::size_t numbered(std::size_t count) {
  if (count < std::numeric_limits<std::uint32_t>::max()) return count;
  throw InputError("world", "has 2^32 walls and sides or more: too many to be indexed for its judge");
}

Box box_of_ring(const Ring& ring) {
  Box box;
  for (const Vec2 p : ring.corners) box.include(p);
  return box;
}

Box box_of_all(const Obstacles& obstacles, const Execution& execution) {
  constexpr std::size_t walls_a_poll = std::size_t{1} << 16;
  Box box;
  for (std::size_t i = 0; i < obstacles.wall_count(); ++i) {
    if (i % walls_a_poll == 0) execution.check();
    box.include(box_of(obstacles.segment(i)));
  }
  for (const Ring& ring : obstacles.rings()) {
    if (ring.polygon != Ring::none) box.include(box_of_ring(ring));
  }
  return box;
}

}  // namespace

ObstacleIndex::ObstacleIndex(const Scene& scene, const Execution& execution)
    : scene_(scene),
      obstacles_(scene),
      sides_(
          numbered(obstacles_.size()), [&](std::size_t i) { return box_of(obstacles_.segment(i)); }, execution),
      rings_(
          obstacles_.rings().size(), [&](std::size_t i) { return box_of_ring(obstacles_.rings()[i]); }, execution),
      box_(box_of_all(obstacles_, execution)) {
  Box all = box_;
  if (scene.bounds) all.include(*scene.bounds);
  if (all.empty()) return;
  for (const double x : {all.min.x, all.min.y, all.max.x, all.max.y}) largest_ = std::max(largest_, std::abs(x));
}

}  // namespace warren
