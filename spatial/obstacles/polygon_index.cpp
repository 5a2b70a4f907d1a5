// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/polygon_index.hpp"

#include <algorithm>
#include <utility>

#include "core/base/whole.hpp"
#include "core/plane/geometry.hpp"

namespace warren {
/// What a ray from p to the right has met.
struct PolygonIndex::Crossings {
  Vec2 p;
  int turns = 0;  ///< sides that cross upwards less those that cross downwards: not 0 inside
  bool on_outline = false;
};

PolygonIndex::PolygonIndex(PolygonSet polygons, const Execution& execution) : polygons_(std::move(polygons)) {
  const std::size_t n = polygons_.corners.size();
  execution.reserve(n * (sizeof(std::uint32_t) + sizeof(Box) / 7) + polygons_.size() * sizeof(Box));
  next_.resize(n);
  constexpr std::size_t grain = std::size_t{1} << 12;
  std::vector<BoxOf<2>> boxes(polygons_.size());
  for_each_index(polygons_.size(), grain, execution, [&](std::size_t polygon) {
    const auto [first, last] = sides_of(polygon);
    Box box;
    for (std::size_t i = first; i < last; ++i) {
      next_[i] = as_whole<std::uint32_t>(i + 1 < last ? i + 1 : first);
      box.include(polygons_.corners[i]);
    }
    boxes[polygon] = {{box.min.x, box.min.y}, {box.max.x, box.max.y}};
  });
  tree_ = BoxTree<2>(boxes, execution);
  for (const Vec2 p : polygons_.corners) box_.include(p);
  for (std::size_t count = n; count > 1;) {
    std::vector<Box> blocks((count + (std::size_t{1} << fan_bits) - 1) >> fan_bits);
    for (std::size_t i = 0; i < count; ++i) {
      blocks[i >> fan_bits].include(levels_.empty() ? box_of(side(i)) : levels_.back()[i]);
    }
    count = blocks.size();
    levels_.push_back(std::move(blocks));
    execution.check();
  }
}

std::size_t PolygonIndex::level_of(Range run) noexcept {
  std::size_t level = 0;
  while (((run.last - 1) >> (fan_bits * level)) - (run.first >> (fan_bits * level)) >= 8) ++level;
  return level;
}

/// Half-open in y, so that a corner at the height of p counts once: a side crosses if one end lies above p's height
/// and the other at it or below.
void PolygonIndex::count(std::size_t level, std::size_t block, Range run, Crossings& crossings) const noexcept {
  const Vec2 p = crossings.p;
  const Box box = level == 0 ? box_of(side(block)) : levels_[level - 1][block];
  if (box.max.y < p.y || box.min.y > p.y || box.max.x < p.x) return;
  const std::size_t shift = fan_bits * level;
  const std::size_t first = std::max(run.first, block << shift);
  const std::size_t last = std::min(run.last, (block + 1) << shift);
  const double from = polygons_.corners[first].y;
  const double to = polygons_.corners[next_[last - 1]].y;
  if (box.min.x > p.x) {
    crossings.turns += (to > p.y ? 1 : 0) - (from > p.y ? 1 : 0);
  } else if (level == 0) {
    const Segment s = side(block);
    const int left = orient2d(s.a, s.b, p);
    if (left == 0 && box.contains(p)) crossings.on_outline = true;
    if (from <= p.y && to > p.y && left > 0) ++crossings.turns;
    if (from > p.y && to <= p.y && left < 0) --crossings.turns;
  } else {
    const std::size_t finer = shift - fan_bits;
    for (std::size_t part = first >> finer; part <= (last - 1) >> finer; ++part) count(level - 1, part, run, crossings);
  }
}

PolygonSide PolygonIndex::side_of(std::size_t polygon, Vec2 p) const noexcept {
  const Range run = sides_of(polygon);
  const std::size_t level = level_of(run);
  const std::size_t shift = fan_bits * level;
  Crossings crossings{p};
  for (std::size_t block = run.first >> shift; block <= (run.last - 1) >> shift; ++block) {
    count(level, block, run, crossings);
  }
  if (crossings.on_outline) return PolygonSide::on_outline;
  return crossings.turns != 0 ? PolygonSide::inside : PolygonSide::outside;
}

std::optional<std::uint32_t> PolygonIndex::polygon_around(Vec2 p) const noexcept {
  std::optional<std::uint32_t> found;
  for_each_polygon_near({p, p}, [&](std::uint32_t polygon) {
    if (side_of(polygon, p) == PolygonSide::inside) found = polygon;
    return !found;
  });
  return found;
}

}  // namespace warren
