// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/obstacle_index.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/sort.hpp"
#include "verify/exact/exact_segments.hpp"

namespace warren {
namespace {

std::size_t numbered(std::size_t count) {
  if (count < std::numeric_limits<std::uint32_t>::max()) return count;
  throw InputError("world", "has 2^32 walls and sides or more: too many to be indexed for its judge");
}

/// Is the inside right of the sides? Asked at the leftmost corner, the lowest of these: there the ring is convex.
bool runs_clockwise(const std::vector<Vec2>& corners) {
  const auto corner = std::ranges::min_element(corners, {}, [](Vec2 p) { return std::pair(p.x, p.y); });
  const Vec2 next = corner + 1 == corners.end() ? corners.front() : *(corner + 1);
  const Vec2 last = corner == corners.begin() ? corners.back() : *(corner - 1);
  return exact::side_of(last, *corner, next) < 0;
}

bool is_skew(Vec2 way) {
  const double less = std::min(std::abs(way.x), std::abs(way.y));
  return less > 0.0 && less < 1e-6 * std::max(std::abs(way.x), std::abs(way.y));
}

}  // namespace

double ObstacleExtent::largest_coordinate() const {
  if (with_bounds.empty()) return 0.0;
  const auto [low, high] = with_bounds;
  return std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
}

ObstacleExtent extent_of(const Obstacles& obstacles, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const auto confines = [&](std::size_t i) {
    if (i < obstacles.wall_count()) return true;
    return obstacles.rings()[obstacles.sides()[i - obstacles.wall_count()].ring].polygon != Ring::none;
  };
  const auto extent_in = [&](Range r) {
    ObstacleExtent part;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const Box box = box_of(obstacles.segment(i));
      part.with_bounds.include(box);
      if (confines(i)) part.box.include(box);
    }
    return part;
  };
  ObstacleExtent all;
  for (const ObstacleExtent& part : parts_of_chunks(obstacles.size(), grain, execution, extent_in)) {
    all.box.include(part.box);
    all.with_bounds.include(part.with_bounds);
  }
  return all;
}

ObstacleIndex::ObstacleIndex(const Scene& scene, const Execution& execution)
    : scene_(scene),
      obstacles_(scene),
      sides_(
          numbered(obstacles_.size()), [&](std::size_t i) { return box_of(obstacles_.segment(i)); }, execution),
      rings_(
          obstacles_.rings().size(), [&](std::size_t i) { return obstacles_.rings()[i].box; }, execution),
      extent_(extent_of(obstacles_, execution.quiet())) {}

std::optional<std::size_t> ring_around(const Obstacles& obstacles, const ObstacleIndex* index, Vec2 p,
                                       const Execution& execution) {
  constexpr std::size_t rings_a_poll = 1024;
  std::optional<std::size_t> first;
  const auto ask = [&](std::size_t i) {
    const Ring& ring = obstacles.rings()[i];
    if ((first && *first < i) || ring.polygon == Ring::none || !ring.box.contains(p)) return;
    if (strictly_inside(ring, p)) first = i;
  };
  if (index != nullptr) {
    index->rings().for_each([&](const Box& box) { return !box.contains(p); }, ask);
    return first;
  }
  for (std::size_t i = 0; i < obstacles.rings().size() && !first; ++i) {
    if (i % rings_a_poll == 0) execution.check();
    ask(i);
  }
  return first;
}

void BoxLevels::build_on(RawVector<Box> blocks) {
  levels_.push_back(std::move(blocks));
  while (levels_.back().size() > 1) {
    const RawVector<Box>& parts = levels_.back();
    RawVector<Box> wholes((parts.size() + 7) / 8);
    for (std::size_t i = 0; i < parts.size(); ++i) wholes[i / 8].include(parts[i]);
    levels_.push_back(std::move(wholes));
  }
}

LegBoxes::LegBoxes(std::span<const Vec2> path, const Execution& execution) : path_(path) {
  constexpr std::size_t grain = legs_a_sum / 8;  // blocks: so that long paths fill all threads
  const std::size_t block_count = (leg_count() + 7) / 8;
  execution.reserve(block_count * sizeof(Box));
  RawVector<Box> blocks(block_count);
  const auto fill = [&](Range r) {
    double length = 0.0;
    bool skew = false;
    for (std::size_t block = r.first; block < r.last; ++block) {
      const std::size_t last = std::min(8 * block + 8, leg_count());
      Box box = box_of(leg(8 * block));
      for (std::size_t i = 8 * block; i < last; ++i) {
        const Vec2 to = path_[i + 1];
        box.include(to);
        length += norm(to - path_[i]);
        skew = skew || is_skew(to - path_[i]);
      }
      blocks[block] = box;
    }
    return std::pair(length, skew);
  };
  for (const auto& [length, skew] : parts_of_chunks(block_count, grain, execution, fill)) {
    length_ += length;
    has_skew_ = has_skew_ || skew;
  }
  build_on(std::move(blocks));
}

void BoxBlocks::put_in_order(RawVector<Middle>& middles, const Execution& execution) {
  const std::size_t count = middles.size();
  polled_sort(middles.begin(), middles.end(), execution,
              [](const Middle& a, const Middle& b) { return a.x != b.x ? a.x < b.x : a.number < b.number; });
  const std::size_t blocks = chunk_count(count, block_size);
  const auto stripes = bounded_whole<std::size_t>(std::ceil(std::sqrt(static_cast<double>(blocks))));
  order_.resize(count);
  for_chunks(count, chunk_count(blocks, stripes) * block_size, execution, [&](Range r) {
    const auto at = [&](std::size_t i) { return middles.begin() + as_whole<std::ptrdiff_t>(i); };
    polled_sort(at(r.first), at(r.last), execution,
                [](const Middle& a, const Middle& b) { return a.y != b.y ? a.y < b.y : a.number < b.number; });
    for (std::size_t i = r.first; i < r.last; ++i) order_[i] = middles[i].number;
  });
}

/// Downwards by the nearest parts; of those that hold the place, by the one whose middle is nearest.
std::size_t BoxBlocks::block_near(const Box& place) const {
  const auto distance = [&](const Box& box) {
    const Vec2 off = (box.min - place.min) + (box.max - place.max);
    return std::pair(exact::gap_sq(box, place), dot(off, off));
  };
  std::size_t block = 0;
  for (std::size_t level = levels_.size() - 1; level-- > 0;) {
    const std::span<const Box> all = levels_[level];
    const std::size_t first = block_size * block;
    const auto parts = all.subspan(first, std::min(block_size, all.size() - first));
    block = first + as_whole<std::size_t>(std::ranges::min_element(parts, {}, distance) - parts.begin());
  }
  return block;
}

Obstacles::Obstacles(const Scene& scene) : scene_(scene) {
  if (scene.bounds) {
    const Box& b = *scene.bounds;
    rings_.push_back({{b.min, {b.min.x, b.max.y}, b.max, {b.max.x, b.min.y}}, Ring::none});
  }
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    std::vector<Vec2> corners = scene.polygons[i].corners;
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.empty()) continue;
    if (runs_clockwise(corners)) std::reverse(corners.begin(), corners.end());
    rings_.push_back({std::move(corners), i});
  }
  for (std::size_t ring = 0; ring < rings_.size(); ++ring) {
    first_side_.push_back(sides_.size());
    for (const Vec2 p : rings_[ring].corners) rings_[ring].box.include(p);
    for (std::size_t side = 0; side < rings_[ring].corners.size(); ++side) sides_.push_back({ring, side});
  }
}

std::string Obstacles::name(std::size_t i) const {
  const auto [a, b] = segment(i);
  const std::string numbers = fmt::format("{} {} {} {}", a.x, a.y, b.x, b.y);
  if (i < wall_count()) return fmt::format("wall {}: {}", i, numbers);
  const std::size_t polygon = rings_[sides_[i - wall_count()].ring].polygon;
  return polygon == Ring::none ? fmt::format("bounds: {}", numbers) : fmt::format("polygon {}: {}", polygon, numbers);
}

bool outline_holds(std::span<const Vec2> corners, Vec2 p, bool on_outline) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [a, b] = exact::outline_side(corners, i);
    if (exact::contains({a, b}, p)) return on_outline;
    // Sides count where they cross the height of p going right of it; a half-open rule counts shared corners once.
    if ((a.y <= p.y) != (b.y <= p.y)) {
      const int side = exact::side_of(a, b, p);
      if (b.y > a.y ? side > 0 : side < 0) inside = !inside;
    }
  }
  return inside;
}

}  // namespace warren
