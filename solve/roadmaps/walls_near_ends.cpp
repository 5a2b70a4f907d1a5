// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/walls_near_ends.hpp"

#include <array>
#include <memory>
#include <vector>

#include "core/base/error.hpp"

namespace warren {
namespace {

constexpr std::uint32_t most_passes = 32;

}  // namespace

const WallsNearEnds::Indexed* WallsNearEnds::index(const Execution& execution) const {
  return indexed_.get_after(most_passes, execution, [&] {
    auto indexed = std::make_unique<Indexed>();
    try {
      indexed->world.emplace(world_.whole(execution), reach_, execution);
    } catch (const Stopped& stopped) {
      if (stopped.reason != StopReason::memory) throw;
    }
    return indexed;
  });
}

/// The walls that motions of a few cells around a place can meet, and those that reach farthest: the box of all walls,
/// which the reference point stays in, is theirs too.
Scene WallsNearEnds::around(const Scene& scene, Vec2 p, const Execution& execution) const {
  constexpr std::size_t polled = std::size_t{1} << 20;
  const Box near = room_of_motions(p);
  std::vector<Segment> walls;
  Box all;
  std::array<Segment, 4> farthest{};
  scene.walls.visit([&](auto held) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (i % polled == 0) execution.check();
      const Segment s = held[i].segment();
      const Box box = box_of(s);
      if (near.meets(box)) walls.push_back(s);
      if (box.min.x < all.min.x) farthest[0] = s;
      if (box.min.y < all.min.y) farthest[1] = s;
      if (box.max.x > all.max.x) farthest[2] = s;
      if (box.max.y > all.max.y) farthest[3] = s;
      all.include(box);
    }
  });
  if (!all.empty()) walls.insert(walls.end(), farthest.begin(), farthest.end());
  Scene local;
  local.bounds = scene.bounds;
  local.walls = WallSet::narrowest(walls);
  return local;
}

}  // namespace warren
