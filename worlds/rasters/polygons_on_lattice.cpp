// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/polygons_on_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/whole.hpp"

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

Box box_around(std::span<const Vec2> points) {
  Box box;
  for (const Vec2 p : points) box.include(p);
  return box;
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

}  // namespace warren
