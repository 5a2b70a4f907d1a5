// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/prices/effective_map.hpp"

#include <utility>

#include "core/plane/se2.hpp"

namespace warren {
namespace {

/// Does the closed segment meet the open unit square at `low`? Three axes part what does not: x, y, and across it.
bool meets_square(const Segment& s, Vec2 low) {
  const Box box = box_of(s);
  const Vec2 high = low + Vec2{1.0, 1.0};
  if (!(box.max.x > low.x && box.min.x < high.x && box.max.y > low.y && box.min.y < high.y)) return false;
  if (s.a == s.b) return true;
  bool left = false;
  bool right = false;
  for (const Vec2 corner : {low, Vec2{high.x, low.y}, high, Vec2{low.x, high.y}}) {
    const int side = orient2d(s.a, s.b, corner);
    left |= side > 0;
    right |= side < 0;
  }
  return left && right;
}

/// Is the point, on no side, inside? Counts the sides above it.
bool holds(std::span<const Vec2> corners, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Segment side = polygon_side(corners, i);
    if ((side.a.x <= p.x) == (side.b.x <= p.x)) continue;
    if (side.a.x > side.b.x) std::swap(side.a, side.b);
    if (orient2d(side.a, side.b, p) < 0) inside = !inside;
  }
  return inside;
}

/// In the polygon, and not on the border.
bool is_inside(std::span<const Vec2> corners, Vec2 p) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (distance(p, polygon_side(corners, i)) <= AreaFactors::on_border) return false;
  }
  return holds(corners, p);
}

std::array<Vec2, 4> mask_square_in_world(const MaskCells& mask, std::uint32_t x, std::uint32_t y) {
  return {mask_corner(mask, x, y), mask_corner(mask, x + 1.0, y), mask_corner(mask, x + 1.0, y + 1.0),
          mask_corner(mask, x, y + 1.0)};
}

}  // namespace

bool restricts(const Prices& prices) {
  if (!prices.keep_out.empty() || prices.unknown) return true;
  return std::any_of(prices.masks.begin(), prices.masks.end(), [](const PriceMask& mask) {
    for (int value = 1; value <= 100; ++value)
      if (!mask_factor(mask, value)) return true;
    return false;
  });
}

bool is_dear(const PriceMask& mask) {
  for (int value = 1; value <= 100; ++value) {
    if (mask_factor(mask, value).value_or(1.0) > 1.0) return true;
  }
  return false;
}

std::optional<double> mask_factor(const PriceMask& mask, int value) {
  if (value <= 0) return 1.0;
  switch (mask.kind) {
    case MaskKind::areas:
      if (value >= 100) return std::nullopt;
      return 1.0 + (mask.factor.value_or(1.0) - 1.0) * value / 100.0;
    case MaskKind::keep_out:
      return value >= 100 ? mask.factor : std::optional(1.0);
    case MaskKind::speed: {
      const double limit = mask.base + mask.multiplier * value;  // per cent
      if (!(limit > 0.0)) return std::nullopt;
      return std::clamp(100.0 / limit, 1.0, largest_price);
    }
  }
  return 1.0;
}

Vec2 corner_in_cells(const OccupancyMap& map, Vec2 in_world) {
  constexpr double near = 1e-9;
  Vec2 p = map_point(map, in_world);
  for (double* x : {&p.x, &p.y}) {
    const double line = std::round(*x);
    if (std::abs(*x - line) <= near) *x = line + 0.0;
  }
  return p;
}

std::array<Vec2, 4> mask_square(const OccupancyMap& map, const MaskCells& mask, std::uint32_t x, std::uint32_t y) {
  std::array<Vec2, 4> corners = mask_square_in_world(mask, x, y);
  for (Vec2& p : corners) p = corner_in_cells(map, p);
  return corners;
}

void add_polygon_cells(Bitmap& cells, std::span<const Vec2> corners, const Execution& execution) {
  const Box box = box_around(corners);
  const auto whole = [](double x, std::uint32_t end) { return bounded_whole<std::uint32_t>(x, 0.0, end); };
  const std::uint32_t first_x = whole(std::floor(box.min.x), cells.width());
  const std::uint32_t last_x = whole(std::ceil(box.max.x), cells.width());
  const std::uint32_t last_y = whole(std::ceil(box.max.y), cells.height());
  for (std::uint32_t y = whole(std::floor(box.min.y), cells.height()); y < last_y; ++y) {
    execution.check();
    std::vector<std::size_t> sides;  // that come near the row
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Box side = box_of(polygon_side(corners, i));
      if (side.max.y > y && side.min.y < y + 1.0) sides.push_back(i);
    }
    for (std::uint32_t x = first_x; x < last_x; ++x) {
      const Vec2 low{static_cast<double>(x), static_cast<double>(y)};
      const bool is_met = std::any_of(sides.begin(), sides.end(),
                                      [&](std::size_t i) { return meets_square(polygon_side(corners, i), low); });
      if (is_met || holds(corners, low + Vec2{0.5, 0.5})) cells.set(x, y);
    }
  }
}

OccupancyMap effective_map(const OccupancyMap& map, const Prices& prices, const Execution& execution) {
  execution.reserve(2 * map.blocked.bytes() + map.unknown.bytes() + map.water.bytes());
  OccupancyMap effective = map;
  if (prices.unknown) effective.blocked.remove(map.unknown);
  Bitmap forbidden = cell_bitmap(map.width(), map.height(), execution);
  for (const KeepOut& area : prices.keep_out) {
    std::vector<Vec2> corners;
    for (const Vec2 p : area.corners) corners.push_back(corner_in_cells(map, p));
    add_polygon_cells(forbidden, corners, execution);
  }
  for_mask_cells(prices, execution, [&](const MaskCells& cells, std::uint32_t x, std::uint32_t y, const auto& factor) {
    if (!factor) add_polygon_cells(forbidden, mask_square(map, cells, x, y), execution);
  });
  effective.blocked.add(forbidden);
  effective.water.remove(forbidden);  // it is blocked all the same: but to paths that begin on it
  effective.free = map.blocked.size() - effective.blocked.count();
  return effective;
}

Scene restricted_scene(const Scene& scene, const Prices& prices, const Execution& execution) {
  Scene restricted = scene;
  if (restricted.map) {
    restricted.map = effective_map(*scene.map, prices, execution);
    return restricted;
  }
  for (const KeepOut& area : prices.keep_out) restricted.polygons.push_back({area.corners, area.line});
  for_mask_cells(prices, execution, [&](const MaskCells& cells, std::uint32_t x, std::uint32_t y, const auto& factor) {
    if (factor) return;
    const std::array<Vec2, 4> square = mask_square_in_world(cells, x, y);
    restricted.polygons.push_back({{square.begin(), square.end()}, 0});
  });
  return restricted;
}

Vec2 mask_corner(const MaskCells& mask, double column, double row) {
  const Vec2 p{mask.cell * column, mask.cell * row};
  return mask.origin + (mask.yaw_rad == 0.0 ? p : Rotation(mask.yaw_rad)(p));
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
