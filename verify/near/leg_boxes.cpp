// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/leg_boxes.hpp"

#include <cmath>

#include "parallel/chunks.hpp"

namespace warren {
namespace {

bool is_skew(Vec2 way) {
  const double less = std::min(std::abs(way.x), std::abs(way.y));
  return less > 0.0 && less < 1e-6 * std::max(std::abs(way.x), std::abs(way.y));
}

}  // namespace

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
  std::vector<double> lengths(chunk_count(blocks.size(), grain));
  std::vector<char> skews(lengths.size());
  for_chunks(blocks.size(), grain, execution, [&](Range r) {
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
    lengths[r.first / grain] = length;
    skews[r.first / grain] = skew ? 1 : 0;
  });
  for (const double length : lengths) length_ += length;
  has_skew_ = std::find(skews.begin(), skews.end(), 1) != skews.end();
  build_on(std::move(blocks));
}

}  // namespace warren
