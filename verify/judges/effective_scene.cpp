// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/effective_scene.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <span>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "verify/exact/exact_segments.hpp"

namespace warren {
namespace {

/// Corner (column, row) of a mask's cells, in the world.
Vec2 mask_place(const MaskCells& mask, std::uint32_t column, std::uint32_t row) {
  const double x = mask.cell * column;
  const double y = mask.cell * row;
  if (mask.yaw_rad == 0.0) return mask.origin + Vec2{x, y};
  const auto [sine, cosine] = portable::sin_and_cos(mask.yaw_rad);
  return mask.origin + Vec2{x * cosine - y * sine, x * sine + y * cosine};
}

/// Which values, from 0 to 100, block a cell of the mask.
std::bitset<101> blocked_values(const PriceMask& mask) {
  std::bitset<101> blocked;
  for (int value = 0; value <= 100; ++value) blocked[as_whole<std::size_t>(value)] = !judged_factor(mask, value);
  return blocked;
}

/// The blocked cells of a mask, row by row in runs: calls run(row, first column, end).
template <class Run>
void blocked_runs(const PriceMask& mask, const Execution& execution, const Run& run) {
  const MaskCells& cells = *mask.read;
  const std::bitset<101> blocked = blocked_values(mask);
  for (std::uint32_t y = 0; y < cells.height; ++y) {
    execution.check();
    const auto is_blocked = [&](std::uint32_t x) {
      const int value = cells.values[std::size_t{y} * cells.width + x];
      return value > 0 && blocked[as_whole<std::size_t>(std::min(value, 100))];
    };
    for (std::uint32_t x = 0; x < cells.width; ++x) {
      if (!is_blocked(x)) continue;
      const std::uint32_t first = x;
      while (x < cells.width && is_blocked(x)) ++x;
      run(y, first, x);
    }
  }
}

/// The cells of a map that a polygon closes.
class ClosedCells {
 public:
  ClosedCells(OccupancyMap& map, const Execution& execution) : map_(map), execution_(execution) {}

  void close(std::span<const Vec2> corners) {
    const double top = map_.height();
    Box box;
    for (const Vec2 p : corners) box.include(p);
    const auto first = bounded_whole<std::uint32_t>(std::floor(box.min.y), 0.0, top);
    const auto end = bounded_whole<std::uint32_t>(std::ceil(box.max.y), 0.0, top);
    for (std::uint32_t row = first; row < end; ++row) {
      execution_.check();
      close_row(corners, row);
    }
  }

 private:
  void set(std::uint32_t x, std::uint32_t y) {
    map_.blocked.set(x, y);
    if (!map_.water.empty()) map_.water.clear(x, y);
  }

  /// Of one row: the cells that a side passes through, and those whose middle is inside.
  void close_row(std::span<const Vec2> corners, std::uint32_t row) {
    const double low = row;
    const double width = map_.width();
    around_.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [a, b] = exact::outline_side(corners, i);
      if ((a.y <= low + 0.5) != (b.y <= low + 0.5)) around_.push_back(a.y < b.y ? Segment{a, b} : Segment{b, a});
      if (!(std::max(a.y, b.y) > low && std::min(a.y, b.y) < low + 1.0)) continue;
      const auto from = bounded_whole<std::uint32_t>(std::floor(std::min(a.x, b.x)), 0.0, width);
      const auto to = bounded_whole<std::uint32_t>(std::ceil(std::max(a.x, b.x)), 0.0, width);
      for (std::uint32_t x = from; x < to; ++x) {
        if (passes(a, b, x, low)) set(x, row);
      }
    }
    if (around_.empty()) return;
    Box box;
    for (const Segment& side : around_) box.include(box_of(side));
    const auto end = bounded_whole<std::uint32_t>(std::ceil(box.max.x), 0.0, width);
    for (auto x = bounded_whole<std::uint32_t>(std::floor(box.min.x), 0.0, width); x < end; ++x) {
      const auto left = std::count_if(around_.begin(), around_.end(), [&](const Segment& side) {
        return exact::side_of(side.a, side.b, {x + 0.5, low + 0.5}) < 0;  // upwards: its right is beyond it
      });
      if (left % 2 == 1) set(x, row);
    }
  }

  /// Does a side meet the open square? Their boxes do, and corners lie on both sides of it.
  static bool passes(Vec2 a, Vec2 b, double x, double y) {
    if (!(std::max(a.x, b.x) > x && std::min(a.x, b.x) < x + 1.0)) return false;
    if (a == b) return true;
    int least = 1;
    int most = -1;
    for (const Vec2 corner : Box{{x, y}, {x + 1.0, y + 1.0}}.corners()) {
      const int side = exact::side_of(a, b, corner);
      least = std::min(least, side);
      most = std::max(most, side);
    }
    return least < 0 && most > 0;
  }

  OccupancyMap& map_;
  const Execution& execution_;
  std::vector<Segment> around_;  // sides that pass the middle of the row, upwards
};

void restrict_map(OccupancyMap& map, const Prices& prices, const Execution& execution) {
  if (prices.unknown) map.blocked.remove(map.unknown, [&] { execution.check(); });
  ClosedCells closed(map, execution);
  std::vector<Vec2> corners;
  for (const KeepOut& area : prices.keep_out) {
    corners.clear();
    for (const Vec2 p : area.corners) corners.push_back(judged_corner(map, p));
    closed.close(corners);
  }
  for (const PriceMask& mask : prices.masks) {
    blocked_runs(mask, execution, [&](std::uint32_t row, std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t x = first; x < end; ++x) {  // each its own square: lines between them are free
        corners.clear();
        for (const auto& [column, at] : {std::pair{x, row}, {x + 1, row}, {x + 1, row + 1}, {x, row + 1}}) {
          corners.push_back(judged_corner(map, mask_place(*mask.read, column, at)));
        }
        closed.close(corners);
      }
    });
  }
}

void restrict_plane(Scene& scene, const Prices& prices, const Execution& execution) {
  for (const KeepOut& area : prices.keep_out) scene.polygons.push_back({area.corners, area.line});
  for (const PriceMask& mask : prices.masks) {
    blocked_runs(mask, execution, [&](std::uint32_t row, std::uint32_t first, std::uint32_t end) {
      scene.polygons.push_back({{mask_place(*mask.read, first, row), mask_place(*mask.read, end, row),
                                 mask_place(*mask.read, end, row + 1), mask_place(*mask.read, first, row + 1)},
                                0});
    });
  }
}

}  // namespace

std::optional<double> judged_factor(const PriceMask& mask, int value) {
  if (value <= 0) return 1.0;
  if (mask.kind == MaskKind::speed) {
    const double per_cent = mask.base + mask.multiplier * value;
    if (!(per_cent > 0.0)) return std::nullopt;
    return std::min(std::max(100.0 / per_cent, 1.0), largest_price);
  }
  if (mask.kind == MaskKind::keep_out) return value < 100 ? std::optional(1.0) : mask.factor;
  if (value >= 100) return std::nullopt;
  return 1.0 + (mask.factor.value_or(1.0) - 1.0) * value / 100.0;
}

Vec2 judged_corner(const OccupancyMap& map, Vec2 in_world) {
  const Vec2 p = map_point(map, in_world);
  const auto on_line = [](double x) {
    const double line = std::floor(x + 0.5);
    return std::abs(x - line) <= 1e-9 ? line + 0.0 : x;
  };
  return {on_line(p.x), on_line(p.y)};
}

std::optional<Scene> effective_scene(const Scene& scene, const Prices& prices, const Execution& execution) {
  for (const PriceMask& mask : prices.masks) {
    if (!mask.read) throw InputError(mask.file, "this mask has not been read");
  }
  const bool opens = prices.unknown && scene.map && !scene.map->unknown.empty();
  const auto blocks = [](const PriceMask& mask) { return blocked_values(mask).any(); };
  if (!opens && prices.keep_out.empty() && std::none_of(prices.masks.begin(), prices.masks.end(), blocks)) {
    return std::nullopt;
  }
  if (scene.map) execution.reserve(scene.map->blocked.bytes() + scene.map->unknown.bytes() + scene.map->water.bytes());
  Scene effective = scene;
  if (effective.map) {
    restrict_map(*effective.map, prices, execution);
  } else {
    restrict_plane(effective, prices, execution);
  }
  return effective;
}

}  // namespace warren
