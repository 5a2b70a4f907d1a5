// SPDX-License-Identifier: BSD-3-Clause
// Random maps with prices, and an oracle of what legs cost on them: brute force in the world, sample by sample.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/rng.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/prices.hpp"

namespace warren::priced_maps {

inline OccupancyMap random_map(std::uint64_t seed) {
  OccupancyMap map;
  const auto width = static_cast<std::uint32_t>(12 + random_bits(seed, 9, 0) % 30);
  const auto height = static_cast<std::uint32_t>(12 + random_bits(seed, 9, 1) % 20);
  map.blocked = Bitmap(width, height);
  map.unknown = Bitmap(width, height);
  const std::uint64_t blocked = width * height / (4 + random_bits(seed, 9, 2) % 60);
  for (std::uint64_t i = 0; i < blocked; ++i) {
    const auto x = static_cast<std::uint32_t>(random_bits(seed, 10, 2 * i) % width);
    const auto y = static_cast<std::uint32_t>(random_bits(seed, 10, 2 * i + 1) % height);
    map.blocked.set(x, y);
    if (i % 4 == 0) map.unknown.set(x, y);
  }
  if (seed % 2 == 1) {
    map.cell = 0.05;
    map.origin = {-3, 7};
    map.yaw_rad = 0.3;
  }
  return map;
}

inline Prices random_prices(const OccupancyMap& map, std::uint64_t seed) {
  Prices prices;
  if (seed % 5 != 4)
    prices.clearance = ClearancePrice{3.0 * uniform(seed, 20, 0), map.cell * (0.3 + 9.0 * uniform(seed, 20, 1))};
  if (seed % 4 == 1) prices.unknown = 1.0 + 4.0 * uniform(seed, 20, 2);
  const auto polygon = [&](std::uint64_t stream) {
    const Vec2 middle{map.width() * uniform(seed, stream, 0), map.height() * uniform(seed, stream, 1)};
    std::vector<Vec2> corners;
    for (int i = 0; i < 5; ++i) {
      const double angle = 1.2566370614359172 * i;
      const double radius = 1.0 + 4.0 * uniform(seed, stream, 2 + i);
      corners.push_back(world_point(map, middle + radius * Vec2{std::cos(angle), std::sin(angle)}));
    }
    return corners;
  };
  if (seed % 3 == 0) {
    for (std::uint64_t i = 0; i < 2; ++i)
      prices.areas.push_back({1.0 + 5.0 * uniform(seed, 21, i), polygon(30 + i), 0});
  }
  if (seed % 7 == 2) prices.keep_out.push_back({polygon(40), 0});
  if (seed % 6 == 4) {
    MaskCells cells{
        9, 7, {}, 1.7 * map.cell, world_point(map, {2.0, 3.0}), map.yaw_rad + 0.2 * static_cast<double>(seed % 3)};
    for (std::uint64_t i = 0; i < 63; ++i)
      cells.values.push_back(static_cast<std::int8_t>(random_bits(seed, 50, i) % 100));
    prices.masks.push_back({MaskKind::areas, "mask.yaml", 6.0, 100.0, -1.0, cells});
  }
  return prices;
}

inline double distance_to_blocked(const OccupancyMap& map, Vec2 p) {  // in cells
  double least = std::min({p.x, p.y, map.width() - p.x, map.height() - p.y});
  for (std::uint32_t y = 0; y < map.height(); ++y) {
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      if (!map.blocked.test(x, y)) continue;
      const double dx = std::max({0.0, x - p.x, p.x - x - 1.0});
      const double dy = std::max({0.0, y - p.y, p.y - y - 1.0});
      least = std::min(least, std::hypot(dx, dy));
    }
  }
  return least;
}

inline bool is_inside(const std::vector<Vec2>& corners, Vec2 p) {
  double turned = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i] - p;
    const Vec2 b = corners[(i + 1) % corners.size()] - p;
    turned += std::atan2(cross(a, b), dot(a, b));
  }
  return std::abs(turned) > 3.0;
}

inline double brute_factor(const OccupancyMap& map, Vec2 world, const Prices& prices) {
  double factor = 1.0;
  for (const PricedArea& area : prices.areas)
    if (is_inside(area.corners, world)) factor = std::max(factor, area.factor);
  const Vec2 p = map_point(map, world);
  if (prices.unknown &&
      map.unknown.holds(static_cast<std::int64_t>(std::floor(p.x)), static_cast<std::int64_t>(std::floor(p.y))))
    factor = std::max(factor, *prices.unknown);
  for (const PriceMask& mask : prices.masks) {
    const MaskCells& cells = *mask.read;
    const Vec2 d = world - cells.origin;
    const double s = std::sin(cells.yaw_rad);
    const double c = std::cos(cells.yaw_rad);
    const double x = std::floor((c * d.x + s * d.y) / cells.cell);
    const double y = std::floor((-s * d.x + c * d.y) / cells.cell);
    if (x < 0 || y < 0 || x >= cells.width || y >= cells.height) continue;
    const int value = cells.values[static_cast<std::size_t>(y) * cells.width + static_cast<std::size_t>(x)];
    if (value > 0 && value < 100) factor = std::max(factor, 1.0 + (*mask.factor - 1.0) * value / 100.0);
  }
  return factor;
}

/// By the middles of many small pieces. Only of masks of kind areas.
inline PriceParts brute_parts(const OccupancyMap& effective, Vec2 a, Vec2 b, const Prices& prices, double radius) {
  PriceParts parts;
  const double length = distance(a, b);
  const int pieces = static_cast<int>(std::ceil(400.0 * (1.0 + length / effective.cell)));
  for (int i = 0; i < pieces; ++i) {
    const Vec2 p = a + (i + 0.5) / pieces * (b - a);
    const double step = length / pieces;
    if (prices.clearance) {
      const double reach = prices.clearance->reach.value_or(2.0 * radius);
      const double gap = effective.cell * distance_to_blocked(effective, map_point(effective, p)) - radius;
      if (gap < reach) parts.clearance += step * prices.clearance->price * (1.0 - gap / reach) * (1.0 - gap / reach);
    }
    parts.areas += step * (brute_factor(effective, p, prices) - 1.0);
  }
  return parts;
}

}  // namespace warren::priced_maps
