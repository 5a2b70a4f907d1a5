// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/wall_set.hpp"

#include <algorithm>
#include <utility>

namespace warren {
namespace {

bool fits_float(const Segment& s) {
  return exact_as_float(s.a.x) && exact_as_float(s.a.y) && exact_as_float(s.b.x) && exact_as_float(s.b.y);
}

template <class Wall>
WallSet held_as(std::span<const Segment> segments) {
  RawVector<Wall> walls(segments.size());
  std::transform(segments.begin(), segments.end(), walls.begin(),
                 [](const Segment& s) { return Wall::of(s.a.x, s.a.y, s.b.x, s.b.y); });
  return WallSet(std::move(walls));
}

}  // namespace

WallSet WallSet::narrowest(std::span<const Segment> segments) {
  const auto fits = [](const Segment& s) { return PackedWall::fits(s.a.x, s.a.y, s.b.x, s.b.y); };
  if (std::all_of(segments.begin(), segments.end(), fits)) return held_as<PackedWall>(segments);
  const bool floats = std::all_of(segments.begin(), segments.end(), [](const Segment& s) { return fits_float(s); });
  return floats ? held_as<FloatWall>(segments) : held_as<DoubleWall>(segments);
}

}  // namespace warren
