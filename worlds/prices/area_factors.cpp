// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/prices/area_factors.hpp"

#include <span>
#include <utility>

#include "core/base/trigonometry.hpp"
#include "worlds/prices/effective_map.hpp"

namespace warren {
namespace {

bool is_inside(std::span<const Vec2> corners, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Segment side = polygon_side(corners, i);
    if (distance(p, side) <= AreaFactors::on_border) return false;
    if ((side.a.x <= p.x) == (side.b.x <= p.x)) continue;
    if (side.a.x > side.b.x) std::swap(side.a, side.b);
    if (orient2d(side.a, side.b, p) < 0) inside = !inside;
  }
  return inside;
}

}  // namespace

Vec2 mask_corner(const MaskCells& mask, double column, double row) {
  const Vec2 p{mask.cell * column, mask.cell * row};
  if (mask.yaw_rad == 0.0) return mask.origin + p;
  const auto [sine, cosine] = portable::sin_and_cos(mask.yaw_rad);
  return mask.origin + Vec2{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
}

double AreaFactors::factor(Vec2 p) const {
  double greatest = 1.0;
  for (const Area& area : areas_) {
    if (area.factor > greatest && area.box.contains(p) && is_inside(area.corners, p)) greatest = area.factor;
  }
  for (const Mask& mask : masks_) {
    const MaskCells& cells = *mask.mask.read;
    const Vec2 from = p - mask.origin;
    const double area = cross(mask.right, mask.up);
    const Vec2 in_mask{cross(from, mask.up) / area, cross(mask.right, from) / area};
    greatest = std::max(greatest, least_around(in_mask, [&](std::int64_t x, std::int64_t y) {
                          if (x < 0 || y < 0 || x >= cells.width || y >= cells.height) return 1.0;
                          const auto at = as_whole<std::size_t>(y * cells.width + x);
                          return mask_factor(mask.mask, cells.values[at]).value_or(1.0);
                        }));
  }
  return greatest;
}

void AreaFactors::cut(Vec2 p, Vec2 u, double length, std::vector<double>& cuts) const {
  cuts.assign(1, 0.0);
  const Box box = box_of({p, p + length * u});
  const auto add = [&](double t) {
    if (t > 0.0 && t < length) cuts.push_back(t);  // not NaN, where a side runs along
  };
  for (const Area& area : areas_) {
    if (!area.box.meets(box)) continue;
    for (std::size_t i = 0; i < area.corners.size(); ++i) {
      const Segment side = polygon_side(area.corners, i);
      if (box_of(side).meets(box)) add(cross(side.a - p, side.b - side.a) / cross(u, side.b - side.a));
    }
  }
  for (const Mask& mask : masks_) {
    const double area = cross(mask.right, mask.up);
    const auto lines = [&](double at, double slope, double most) {
      const double to = at + slope * length;
      const double last = std::min(std::max(at, to), most);
      for (double line = std::max(std::ceil(std::min(at, to)), 0.0); line <= last; ++line) add((line - at) / slope);
    };
    lines(cross(p - mask.origin, mask.up) / area, cross(u, mask.up) / area, mask.mask.read->width);
    lines(cross(mask.right, p - mask.origin) / area, cross(mask.right, u) / area, mask.mask.read->height);
  }
  cuts.push_back(length);
  std::sort(cuts.begin(), cuts.end());
}

}  // namespace warren
