// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/wall_set.hpp"

#include <algorithm>
#include <limits>

namespace warren {
namespace {

bool fits_float(double x) {
  return std::abs(x) <= std::numeric_limits<float>::max() && static_cast<double>(static_cast<float>(x)) == x;
}
bool fits_float(const Segment& s) {
  return fits_float(s.a.x) && fits_float(s.a.y) && fits_float(s.b.x) && fits_float(s.b.y);
}

template <class T>
RawVector<WallOf<T>> converted(std::span<const Segment> segments) {
  RawVector<WallOf<T>> walls(segments.size());
  std::transform(segments.begin(), segments.end(), walls.begin(), [](const Segment& s) {
    return WallOf<T>{static_cast<T>(s.a.x), static_cast<T>(s.a.y), static_cast<T>(s.b.x), static_cast<T>(s.b.y)};
  });
  return walls;
}

RawVector<PackedWall> packed(std::span<const Segment> segments) {
  RawVector<PackedWall> walls(segments.size());
  std::transform(segments.begin(), segments.end(), walls.begin(),
                 [](const Segment& s) { return PackedWall::of(s.a.x, s.a.y, s.b.x, s.b.y); });
  return walls;
}

}  // namespace

WallSet WallSet::narrowest(std::span<const Segment> segments) {
  const auto fits = [](const Segment& s) { return PackedWall::fits(s.a.x, s.a.y, s.b.x, s.b.y); };
  if (std::all_of(segments.begin(), segments.end(), fits)) return WallSet(packed(segments));
  const bool floats = std::all_of(segments.begin(), segments.end(), [](const Segment& s) { return fits_float(s); });
  return floats ? WallSet(converted<float>(segments)) : WallSet(converted<double>(segments));
}

}  // namespace warren
