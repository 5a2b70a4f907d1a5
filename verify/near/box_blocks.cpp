// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/box_blocks.hpp"

#include <cmath>
#include <utility>

#include "parallel/polled_sort.hpp"
#include "verify/exact/exact_segments.hpp"

namespace warren {

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

void BoxBlocks::add_wholes() {
  while (levels_.back().size() > 1) {
    const RawVector<Box>& parts = levels_.back();
    RawVector<Box> wholes(chunk_count(parts.size(), block_size));
    for (std::size_t i = 0; i < parts.size(); ++i) wholes[i / block_size].include(parts[i]);
    levels_.push_back(std::move(wholes));
  }
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
