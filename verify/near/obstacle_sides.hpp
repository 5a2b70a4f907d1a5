// SPDX-License-Identifier: BSD-3-Clause
// All obstacles of a scene as one numbered list of segments: the walls as they are, then the sides of the bounds, then
// the sides of the polygons. A side remembers its neighbours in its ring, because at a corner the ring's blocked side
// counts. Polygons are turned so that their inside lies left of every side; the bounds the other way round, so that
// left of their sides is outside the world.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Corners without repetitions; left of every side is blocked.
struct Ring {
  std::vector<Vec2> corners;
  std::size_t polygon = 0;  ///< its number in the scene; `none`: the bounds
  Box box = {};             ///< of the corners
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
};

/// Refers to the scene's walls, which must outlive it.
class Obstacles {
 public:
  /// A side of a ring: from corner `side` to the one after it.
  struct Side {
    std::size_t ring;
    std::size_t side;
  };

  explicit Obstacles(const Scene& scene);

  std::size_t size() const { return scene_.walls.size() + sides_.size(); }
  std::size_t wall_count() const { return scene_.walls.size(); }
  const std::vector<Side>& sides() const { return sides_; }
  const std::vector<Ring>& rings() const { return rings_; }
  Segment side_segment(std::size_t i) const {
    const std::vector<Vec2>& corners = rings_[sides_[i].ring].corners;
    const std::size_t side = sides_[i].side;
    return {corners[side], corners[side + 1 == corners.size() ? 0 : side + 1]};
  }
  Segment segment(std::size_t i) const {
    return i < wall_count() ? scene_.walls.segment(i) : side_segment(i - wall_count());
  }
  /// The number of a ring's first side.
  std::size_t first_side(std::size_t ring) const { return wall_count() + first_side_[ring]; }
  /// e.g. "wall 17: 1.5 0.5 1.5 1.5"; numbers count from 0.
  std::string name(std::size_t i) const;

 private:
  const Scene& scene_;
  std::vector<Ring> rings_;
  std::vector<Side> sides_;
  std::vector<std::size_t> first_side_;
};

/// Is p inside of the outline? on_outline: what is said of a place on it. Exact; O(corners).
bool outline_holds(std::span<const Vec2> corners, Vec2 p, bool on_outline);
/// Is p in the open inside of the ring (the side left of it)?
inline bool strictly_inside(const Ring& ring, Vec2 p) { return outline_holds(ring.corners, p, false); }

}  // namespace warren
