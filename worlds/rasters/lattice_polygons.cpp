// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/lattice_polygons.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "core/plane/polygon.hpp"
#include "spatial/maps/free_cells.hpp"
#include "worlds/rasters/convex_pieces.hpp"

namespace warren {
namespace {

struct RowInterval {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();
  void include(double x) {
    from = std::min(from, x);
    to = std::max(to, x);
  }
  bool empty() const { return from > to; }
};

/// Adds where the segment meets the line at height y.
void include_segment(Vec2 a, Vec2 b, double y, RowInterval& interval) {
  if (a.y > b.y) std::swap(a, b);
  if (y < a.y || y > b.y) return;
  if (a.y == b.y) {
    interval.include(a.x);
    interval.include(b.x);
  } else {
    interval.include(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
}

void include_disc(Vec2 centre, double radius, double y, RowInterval& interval) {
  const double dy = y - centre.y;
  if (std::abs(dy) > radius) return;
  const double half = std::sqrt(radius * radius - dy * dy);
  interval.include(centre.x - half);
  interval.include(centre.x + half);
}

/// The line at height y within the convex polygon widened by radius: of discs around its corners and of its sides moved
/// outwards, which together have the same outline.
RowInterval slice(std::span<const Vec2> convex, double radius, double y) {
  RowInterval interval;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vec2 a = convex[i];
    const Vec2 b = convex[(i + 1) % convex.size()];
    include_segment(a, b, y, interval);
    if (radius == 0.0) continue;
    include_disc(a, radius, y, interval);
    const double length = distance(a, b);
    if (length == 0.0) continue;
    const Vec2 out = (radius / length) * Vec2{b.y - a.y, a.x - b.x};
    include_segment(a + out, b + out, y, interval);
  }
  return interval;
}

/// Calls add(y, from, to) for each longest run of borders between rows y - 1 and y.
template <class Add>
void for_borders_between_rows(const Bitmap& blocked, const Execution& execution, const Add& add) {
  const std::size_t words = blocked.empty() ? 0 : blocked.row(0).size();
  const auto solid = [&](std::int64_t y, std::size_t w) {
    if (y < 0 || y >= blocked.height()) return ~std::uint64_t{0};
    const std::uint64_t beyond =
        w + 1 == words && blocked.width() % 64 != 0 ? ~std::uint64_t{0} << blocked.width() % 64 : 0;
    return blocked.row(as_whole<std::uint32_t>(y))[w] | beyond;
  };
  for (std::int64_t y = 0; y <= blocked.height(); ++y) {
    if (y % 16 == 0) execution.check();
    std::int64_t first = -1;  // of the run that is open
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t differs = solid(y - 1, w) ^ solid(y, w);
      const auto base = as_whole<std::int64_t>(64 * w);
      std::int64_t x = 0;
      while (x < 64) {
        const auto next = as_whole<std::int64_t>(first < 0 ? std::countr_zero(differs) : std::countr_one(differs));
        if (x + next >= 64) break;
        x += next;
        differs >>= next;
        if (first < 0) {
          first = base + x;
        } else {
          add(y, first, base + x);
          first = -1;
        }
      }
    }
    if (first >= 0) add(y, first, std::int64_t{blocked.width()});
  }
}

}  // namespace

LatticeMarking::LatticeMarking(Vec2 origin, double cell, std::uint32_t width, std::uint32_t height)
    : origin_(origin), cell_(cell), marked_(width, height) {
  constexpr double share = 1e-9;
  rounding_ = share * (cell * std::max(width, height) + std::abs(origin.x) + std::abs(origin.y));
}

void LatticeMarking::mark_run(std::int64_t row, double from, double to) {
  if (row < 0 || row >= marked_.height()) return;
  const double first = std::max(0.0, std::ceil((from - rounding_ - origin_.x) / cell_));
  const double last = std::min<double>(marked_.width() - 1.0, std::floor((to + rounding_ - origin_.x) / cell_));
  if (first > last) return;
  marked_.set_run(as_whole<std::uint32_t>(row), bounded_whole<std::uint32_t>(first),
                  bounded_whole<std::uint32_t>(last) + 1);
}

void LatticeMarking::mark_near(std::span<const Vec2> convex, double radius) {
  const Box box = box_around(convex).grown(radius);
  const double first = std::max(0.0, std::ceil((box.min.y - rounding_ - origin_.y) / cell_));
  const double last = std::min<double>(marked_.height() - 1.0, std::floor((box.max.y + rounding_ - origin_.y) / cell_));
  for (double j = first; j <= last; ++j) {
    const auto row = bounded_whole<std::int64_t>(j);
    const RowInterval interval = slice(convex, radius, std::clamp(row_y(row), box.min.y, box.max.y));
    if (!interval.empty()) mark_run(row, interval.from, interval.to);
  }
}

void LatticeMarking::mark_outside(std::span<const Vec2> piece, double radius, const Box& bounds) {
  const Box body = box_around(piece).grown(radius);
  const double everything = std::numeric_limits<double>::infinity();
  const double left = bounds.min.x - body.min.x;
  const double right = bounds.max.x - body.max.x;
  for (std::int64_t j = 0; j < marked_.height(); ++j) {
    const double y = row_y(j);
    if (y + body.min.y <= bounds.min.y + rounding_ || y + body.max.y >= bounds.max.y - rounding_) {
      mark_run(j, -everything, everything);
    } else {
      mark_run(j, -everything, left);
      mark_run(j, right, everything);
    }
  }
}

void LatticeMarking::mark_inside(std::span<const Vec2> polygon, Vec2 offset, const Execution& execution) {
  constexpr std::size_t sides_per_poll = std::size_t{1} << 16;
  const Box box = box_around(polygon);
  const double rows = marked_.height();
  // A row more on either side: the heights of rows are rounded, and what lies on none is not marked anyway.
  const auto row_near = [&](double y) { return std::clamp((y - offset.y - origin_.y) / cell_, -2.0, rows + 2.0); };
  const auto first = std::max<std::int64_t>(0, bounded_whole<std::int64_t>(std::floor(row_near(box.min.y))) - 1);
  const auto end = std::min<std::int64_t>(marked_.height(), bounded_whole<std::int64_t>(row_near(box.max.y)) + 2);
  std::vector<double> crossings;
  std::size_t sides = 0;
  for (std::int64_t j = first; j < end; ++j) {
    const double y = row_y(j) + offset.y;
    crossings.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (++sides % sides_per_poll == 0) execution.check();
      const Vec2 a = polygon[i];
      const Vec2 b = polygon[(i + 1) % polygon.size()];
      if ((a.y <= y) == (b.y <= y)) continue;
      crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) - offset.x);
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t c = 1; c < crossings.size(); c += 2) mark_run(j, crossings[c - 1], crossings[c]);
  }
}

std::vector<Segment> border_walls(const OccupancyMap& map, const Execution& execution) {
  std::vector<Segment> walls;
  const auto point = [&](std::int64_t x, std::int64_t y) {
    return world_point(map, {static_cast<double>(x), static_cast<double>(y)});
  };
  for_borders_between_rows(map.blocked, execution, [&](std::int64_t y, std::int64_t from, std::int64_t to) {
    walls.push_back({point(from, y), point(to, y)});
  });
  for_borders_between_rows(transposed(map.blocked, execution), execution,
                           [&](std::int64_t x, std::int64_t from, std::int64_t to) {
                             walls.push_back({point(x, from), point(x, to)});
                           });
  return walls;
}

void add_map_walls(Scene& scene, const Execution& execution) {
  if (scene.map && scene.walls.size() == 0) scene.walls = WallSet::narrowest(border_walls(*scene.map, execution));
}

const Scene& with_map_walls(const Scene& scene, std::optional<Scene>& copy, const Execution& execution) {
  if (!scene.map || scene.walls.size() > 0) return scene;
  copy = scene;
  add_map_walls(*copy, execution);
  return *copy;
}

OccupancyMap map_of_scene(const Scene& scene, double cell, const Execution& execution) {
  if (!(cell > 0.0) || !std::isfinite(cell)) throw InputError("cell", "must be above 0", std::to_string(cell));
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  if (box.empty()) throw InputError("world", "has neither walls nor bounds: nothing to draw as cells");
  constexpr double rounding = 1e-9;
  const double width = std::max(1.0, std::ceil(box.width() / cell - rounding));
  const double height = std::max(1.0, std::ceil(box.height() / cell - rounding));
  constexpr double too_many = 4294967295.0;
  if (!(width < too_many && height < too_many)) throw InputError("cell", "is too small for this world");
  check_map_size("cell", bounded_whole<std::uint64_t>(width), bounded_whole<std::uint64_t>(height));
  execution.reserve(bounded_whole<std::size_t>(width * height / 8));
  OccupancyMap map;
  map.source = scene.source;
  map.cell = cell;
  map.origin = box.min;
  // A cell is the square around its middle, and the middles are the lattice.
  LatticeMarking marking(box.min + Vec2{cell / 2, cell / 2}, cell, bounded_whole<std::uint32_t>(width),
                         bounded_whole<std::uint32_t>(height));
  const double half = cell / 2;
  const ConvexPiece square{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  const auto mark = [&](const Segment& s) { marking.mark_near(touching_positions(square, s), 0.0); };
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    if (i % 64 == 0) execution.check();
    mark(scene.walls.segment(i));
  }
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.check();
    for_each_side(polygon.corners, [&](Vec2 a, Vec2 b) { mark({a, b}); });
    marking.mark_inside(polygon.corners, {0.0, 0.0}, execution);
  }
  map.blocked = marking.take();
  map.occupied = map.blocked.count();
  map.free = map.blocked.size() - map.occupied;
  return map;
}

}  // namespace warren
