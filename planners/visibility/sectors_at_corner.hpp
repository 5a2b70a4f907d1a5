// SPDX-License-Identifier: BSD-3-Clause
// The contact rule at one point, exactly: the pieces that meet there cut the plane around it into sectors; a path that
// comes in by a sector must go on in the same one. A sector is free if it lies in no polygon and not outside of the
// bounds. A way that leaves along a piece lies on its left or on its right, in two different sectors (at the free end
// of a wall in the same one, which is how a path turns round it).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/geometry.hpp"
#include "planners/pieces/plane_pieces.hpp"

namespace warren {

/// Sides of a ray on which a path may run, as bits. Where the ray runs along no piece they are the same place.
using Lanes = std::uint8_t;
inline constexpr Lanes no_lane = 0;
inline constexpr Lanes left_lane = 1;
inline constexpr Lanes right_lane = 2;
inline constexpr Lanes both_lanes = left_lane | right_lane;

/// Order of the directions from `at`, anticlockwise from +x; directions are given by points that lie in them, not at
/// `at`. Exact.
class DirectionOrder {
 public:
  explicit DirectionOrder(Vec2 at) : at_(at) {}
  bool operator()(Vec2 p, Vec2 q) const {
    const bool p_low = is_low(p);
    const bool q_low = is_low(q);
    return p_low != q_low ? q_low : orient2d(at_, p, q) > 0;
  }
  bool same(Vec2 p, Vec2 q) const { return is_low(p) == is_low(q) && orient2d(at_, p, q) == 0; }
  bool is_low(Vec2 p) const { return p.y < at_.y || (p.y == at_.y && p.x < at_.x); }

 private:
  Vec2 at_;
};

/// The directions from `first` anticlockwise to `last`; the same direction twice: all round, from a piece to itself.
struct Sector {
  Vec2 first;
  Vec2 last;
  bool whole = false;  ///< no piece ends here: all directions, first and last mean nothing
};

/// Is the sector wider than half a turn? Only there do shortest paths bend.
inline bool is_reflex(Vec2 at, const Sector& s) {
  return !s.whole && (s.first == s.last || orient2d(at, s.first, s.last) < 0);
}

/// The lanes of the ray from `at` towards q that lie in the sector.
Lanes lanes_in_sector(Vec2 at, const Sector& sector, Vec2 q);

/// Does the line from `at` towards q, a direction in the closed sector, leave all that is not of the sector on one
/// side? The sector is reflex.
inline bool is_tangent(Vec2 at, const Sector& s, Vec2 q) {
  return orient2d(at, s.first, q) * orient2d(at, s.last, q) >= 0;
}

/// The free sectors around any point, anticlockwise from +x; none strictly inside of polygons and outside of the
/// bounds. O(pieces in the point's cell).
std::vector<Sector> free_sectors(const PlanePieces& pieces, Vec2 at);
/// A sector at an end of pieces, given by the other ends of the pieces that bound it.
struct SectorOfPoints {
  PointId first;
  PointId last;
};
/// The same around an end of pieces, of which there may be many. Throws Stopped.
std::vector<SectorOfPoints> free_sectors_at(const PlanePieces& pieces, PointId at, const Execution& execution);

}  // namespace warren
