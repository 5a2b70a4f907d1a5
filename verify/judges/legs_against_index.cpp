// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/legs_against_index.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "parallel/chunks.hpp"

namespace warren {
namespace {

constexpr std::size_t leg_grain = 256;
constexpr std::size_t looks_a_poll = 4096;
constexpr std::size_t legs_a_group = 8;
constexpr std::size_t most_near = 32;  // blocks: more are long legs, each of which has fewer

class IndexedTally {
 public:
  IndexedTally(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
               const Execution& execution)
      : index_(index),
        legs_(legs),
        execution_(execution),
        comparison_(legs, options, std::numeric_limits<double>::infinity()) {}

  Tally of(Range range) {
    const BoxedSegment leg(legs_.leg(range.first), range.first);
    index_.sides().for_some_near(leg.box, [&](std::size_t i) { comparison_.with_leg(leg, side(i)); });
    for (std::size_t first = range.first; first < range.last; first += legs_a_group) {
      compare_group({first, std::min(first + legs_a_group, range.last)});
    }
    return comparison_.take();
  }

 private:
  void compare_group(Range group);
  void find_near(const Box& legs);
  void compare_with_near(const BoxedSegment& leg);
  BoxedSegment side(std::size_t number) const { return {index_.obstacles().segment(number), number}; }
  bool skips(const BoxedSegment& leg, const Box& blocks) {
    poll();
    return comparison_.skips(leg, blocks);
  }
  void poll() {
    if (++looks_ % looks_a_poll == 0) execution_.check();
  }

  /// Of boxes near a group, and where its sides begin among those.
  struct Block {
    std::size_t number;
    std::size_t first;
  };

  const ObstacleIndex& index_;
  const LegBoxes& legs_;
  const Execution& execution_;
  Comparison comparison_;
  std::vector<Block> near_;
  std::vector<BoxedSegment> sides_;  // of the blocks
  std::size_t looks_ = 0;
};

/// By the blocks near all legs of it; each leg by itself where they are many.
void IndexedTally::compare_group(Range group) {
  Box box;
  for (std::size_t leg = group.first; leg < group.last; ++leg) box.include(box_of(legs_.leg(leg)));
  find_near(box);
  for (std::size_t number = group.first; number < group.last; ++number) {
    const BoxedSegment leg(legs_.leg(number), number);
    if (near_.size() > most_near) {
      index_.sides().for_each([&](const Box& blocks) { return skips(leg, blocks); },
                              [&](std::size_t i) { comparison_.with_leg(leg, side(i)); });
    } else {
      compare_with_near(leg);
    }
  }
}

void IndexedTally::find_near(const Box& legs) {
  near_.clear();
  sides_.clear();
  const auto skip = [&](const Box& blocks) {
    poll();
    return near_.size() > most_near || comparison_.skips(legs, blocks);
  };
  index_.sides().for_each_block(skip, [&](std::size_t block) {
    near_.push_back({block, sides_.size()});
    index_.sides().for_each_in(block, [&](std::size_t i) { sides_.push_back(side(i)); });
  });
}

void IndexedTally::compare_with_near(const BoxedSegment& leg) {
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (skips(leg, index_.sides().block_box(near_[i].number))) continue;
    const std::size_t last = i + 1 < near_.size() ? near_[i + 1].first : sides_.size();
    for (std::size_t k = near_[i].first; k < last; ++k) comparison_.with_leg(leg, sides_[k]);
  }
}

}  // namespace

Tally compare_indexed(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
                      const Execution& execution) {
  std::vector<Tally> parts(chunk_count(legs.leg_count(), leg_grain));
  for_chunks(legs.leg_count(), leg_grain, execution,
             [&](Range r) { parts[r.first / leg_grain] = IndexedTally(index, legs, options, execution).of(r); });
  Tally all;
  all.box = index.box();
  for (Tally& part : parts) all.join(std::move(part));
  return all;
}

}  // namespace warren
