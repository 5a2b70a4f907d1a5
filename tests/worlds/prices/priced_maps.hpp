// SPDX-License-Identifier: BSD-3-Clause
// Random maps with prices, and an oracle of what legs cost on them: brute force in the world, sample by sample.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
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

/// Every fourth as long as the map; some between middles, corners, along borders.
inline std::pair<Vec2, Vec2> random_leg(const OccupancyMap& map, std::uint64_t seed, std::uint64_t i) {
  const auto place = [&](std::uint64_t k) {
    const Vec2 p{map.width() * uniform(seed, i, k), map.height() * uniform(seed, i, k + 1)};
    return i % 3 == 0 ? Vec2{std::round(2.0 * p.x) / 2.0, std::round(2.0 * p.y) / 2.0} : p;
  };
  const Vec2 a = place(0);
  Vec2 b = i % 4 == 0 ? place(2) : a + 0.15 * (place(2) - a);
  if (i % 6 == 3) b = i % 12 == 3 ? Vec2{a.x, std::round(b.y)} : a + Vec2{2.0, 2.0};
  return {world_point(map, a), world_point(map, b)};
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
    const double up = std::max({0.0, y - p.y, p.y - y - 1.0});
    for (std::uint32_t x = 0; up < least && x < map.width(); ++x) {
      if (!map.blocked.test(x, y)) continue;
      const double dx = std::max({0.0, x - p.x, p.x - x - 1.0});
      const double dy = std::max({0.0, y - p.y, p.y - y - 1.0});
      least = std::min(least, std::sqrt(dx * dx + dy * dy));
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

/// Open areas: on a border the lesser factor counts.
inline double brute_factor(const OccupancyMap& map, Vec2 world, const Prices& prices) {
  const double near = 1e-9 * map.cell;
  std::vector<Vec2> around;
  for (const Vec2 by : {Vec2{-near, -near}, Vec2{near, -near}, Vec2{-near, near}, Vec2{near, near}}) {
    around.push_back(world + by);
  }
  const auto least = [&](const auto& of_place) {
    double factor = of_place(around[0]);
    for (const Vec2 p : around) factor = std::min(factor, of_place(p));
    return factor;
  };
  double factor = 1.0;
  for (const PricedArea& area : prices.areas) {
    factor = std::max(factor, least([&](Vec2 p) { return is_inside(area.corners, p) ? area.factor : 1.0; }));
  }
  if (prices.unknown) {
    factor = std::max(factor, least([&](Vec2 w) {
                        const Vec2 p = map_point(map, w);
                        const auto x = static_cast<std::int64_t>(std::floor(p.x));
                        const auto y = static_cast<std::int64_t>(std::floor(p.y));
                        return map.unknown.holds(x, y) ? *prices.unknown : 1.0;
                      }));
  }
  for (const PriceMask& mask : prices.masks) {
    factor = std::max(factor, least([&](Vec2 w) {
                        const MaskCells& cells = *mask.read;
                        const Vec2 d = w - cells.origin;
                        const double s = std::sin(cells.yaw_rad);
                        const double c = std::cos(cells.yaw_rad);
                        const double x = std::floor((c * d.x + s * d.y) / cells.cell);
                        const double y = std::floor((-s * d.x + c * d.y) / cells.cell);
                        if (x < 0 || y < 0 || x >= cells.width || y >= cells.height) return 1.0;
                        const int value =
                            cells.values[static_cast<std::size_t>(y) * cells.width + static_cast<std::size_t>(x)];
                        return value > 0 && value < 100 ? 1.0 + (*mask.factor - 1.0) * value / 100.0 : 1.0;
                      }));
  }
  return factor;
}

/// Where a leg passes into another factor: the places between which it is searched for, and some more.
inline std::vector<double> brute_cuts(const OccupancyMap& map, Vec2 a, Vec2 b, const Prices& prices) {
  std::vector<double> cuts{0.0, 1.0};
  const auto cross_line = [&](Vec2 p, Vec2 q) {  // the whole line
    const double from = cross(q - p, a - p);
    const double to = cross(q - p, b - p);
    if ((from < 0.0) != (to < 0.0)) cuts.push_back(from / (from - to));
  };
  for (const PricedArea& area : prices.areas) {
    for (std::size_t i = 0; i < area.corners.size(); ++i) {
      cross_line(area.corners[i], area.corners[(i + 1) % area.corners.size()]);
    }
  }
  for (std::uint32_t x = 0; x <= map.width(); ++x)
    cross_line(world_point(map, {1.0 * x, 0}), world_point(map, {1.0 * x, 1}));
  for (std::uint32_t y = 0; y <= map.height(); ++y)
    cross_line(world_point(map, {0, 1.0 * y}), world_point(map, {1, 1.0 * y}));
  for (const PriceMask& mask : prices.masks) {
    const Vec2 along{std::cos(mask.read->yaw_rad), std::sin(mask.read->yaw_rad)};
    const Vec2 up{-along.y, along.x};
    for (std::uint32_t i = 0; i <= std::max(mask.read->width, mask.read->height); ++i) {
      const Vec2 x = mask.read->origin + i * mask.read->cell * along;
      const Vec2 y = mask.read->origin + i * mask.read->cell * up;
      cross_line(x, x + up);
      cross_line(y, y + along);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

/// By Gauss's ten points, halved until both halves say the same: at kinks and jumps as deep as doubles go.
template <class Of>
double gauss(const Of& of, double from, double to) {
  static constexpr double places[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                      0.9739065285171717};
  static constexpr double weights[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806,
                                       0.0666713443086881};
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (int i = 0; i < 5; ++i) sum += weights[i] * (of(middle - half * places[i]) + of(middle + half * places[i]));
  return half * sum;
}
template <class Of>
double integral(const Of& of, double from, double to, double whole, int depth) {
  const double middle = 0.5 * (from + to);
  const double left = gauss(of, from, middle);
  const double right = gauss(of, middle, to);
  if (depth == 0 || std::abs(left + right - whole) < 1e-14) return left + right;
  return integral(of, from, middle, left, depth - 1) + integral(of, middle, to, right, depth - 1);
}
template <class Of>
double integral(const Of& of, double from, double to, int pieces) {
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double a = from + (to - from) * i / pieces;
    const double b = from + (to - from) * (i + 1) / pieces;
    sum += integral(of, a, b, gauss(of, a, b), 36);
  }
  return sum;
}

/// By quadrature, good to some 1e-12 of a cell. Only of masks of kind areas.
inline PriceParts brute_parts(const OccupancyMap& effective, Vec2 a, Vec2 b, const Prices& prices, double radius) {
  PriceParts parts;
  const double length = distance(a, b);
  const int pieces = static_cast<int>(std::ceil(1.0 + 150.0 * length / effective.cell));
  const auto at = [&](double t) { return a + (t * effective.cell / length) * (b - a); };
  const double cells = length / effective.cell;
  if (!(cells > 0.0)) return parts;
  if (prices.clearance) {
    const double reach = prices.clearance->reach.value_or(2.0 * radius);
    const auto near = [&](double t) {
      const double gap = effective.cell * distance_to_blocked(effective, map_point(effective, at(t))) - radius;
      return gap < reach ? prices.clearance->price * (1.0 - gap / reach) * (1.0 - gap / reach) : 0.0;
    };
    parts.clearance = effective.cell * integral(near, 0.0, cells, pieces);
  }
  const std::vector<double> cuts = brute_cuts(effective, a, b, prices);
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double middle = 0.5 * (cuts[i - 1] + cuts[i]);
    parts.areas += (cuts[i] - cuts[i - 1]) * length * (brute_factor(effective, a + middle * (b - a), prices) - 1.0);
  }
  return parts;
}

}  // namespace warren::priced_maps
