// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/obstacle_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

Box box_of_all(const Obstacles& obstacles, const Execution& execution) {
  constexpr std::size_t walls_a_poll = std::size_t{1} << 16;
  Box box;
  for (std::size_t i = 0; i < obstacles.wall_count(); ++i) {
    if (i % walls_a_poll == 0) execution.check();
    box.include(box_of(obstacles.segment(i)));
  }
  for (const Ring& ring : obstacles.rings()) {
    if (ring.polygon != Ring::none) box.include(ring.box());
  }
  return box;
}

}  // namespace

ObstacleIndex::ObstacleIndex(const Scene& scene, const Execution& execution)
    : scene_(scene),
      obstacles_(scene),
      sides_(
          numbered(obstacles_.size()), [&](std::size_t i) { return box_of(obstacles_.segment(i)); }, execution),
      rings_(
          obstacles_.rings().size(), [&](std::size_t i) { return obstacles_.rings()[i].box(); }, execution),
      box_(box_of_all(obstacles_, execution)) {
  Box all = box_;
  if (scene.bounds) all.include(*scene.bounds);
  if (all.empty()) return;
  for (const double x : {all.min.x, all.min.y, all.max.x, all.max.y}) largest_ = std::max(largest_, std::abs(x));
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

/// Of those that hold the place, the one whose middle is nearest.
std::size_t BoxBlocks::nearest_part(std::size_t level, std::size_t first, std::size_t last, const Box& place) const {
  const auto distance = [&](std::size_t part) {
    const Box& box = levels_[level][part];
    const Vec2 off = (box.min - place.min) + (box.max - place.max);
    return std::pair(exact::gap_sq(box, place), dot(off, off));
  };
  std::size_t nearest = first;
  for (std::size_t part = first + 1; part < last; ++part) {
    if (distance(part) < distance(nearest)) nearest = part;
  }
  return nearest;
}

}  // namespace warren
