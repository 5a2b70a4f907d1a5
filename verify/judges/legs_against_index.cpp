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
constexpr std::size_t legs_a_stretch = 64;
constexpr std::size_t legs_a_group = 8;
constexpr std::size_t most_around = 256;  // blocks near a stretch: more are a wide one, whose groups have fewer
constexpr std::size_t most_near = 32;     // blocks near a group: more are long legs, each of which has fewer

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
    compare_alone(leg);  // what is nearest to it keeps the searches of the others narrow
    for (std::size_t first = range.first; first < range.last; first += legs_a_stretch) {
      compare_stretch({first, std::min(first + legs_a_stretch, range.last)});
    }
    return comparison_.take();
  }

 private:
  Box box_around(Range legs) const;
  void compare_stretch(Range stretch);
  void compare_group(Range group);
  void find_around(const Box& legs);
  void find_near(const Box& legs);
  void compare_with_near(const BoxedSegment& leg);
  void compare_alone(const BoxedSegment& leg);
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
  std::vector<std::size_t> around_;  // blocks near a stretch
  std::vector<Block> near_;
  std::vector<BoxedSegment> sides_;  // of the blocks
  std::size_t looks_ = 0;
};

Box IndexedTally::box_around(Range legs) const {
  Box box;
  for (std::size_t leg = legs.first; leg < legs.last; ++leg) box.include(box_of(legs_.leg(leg)));
  return box;
}

/// The index is asked for the blocks near all legs of it; each group chooses among those.
void IndexedTally::compare_stretch(Range stretch) {
  find_around(box_around(stretch));
  for (std::size_t first = stretch.first; first < stretch.last; first += legs_a_group) {
    compare_group({first, std::min(first + legs_a_group, stretch.last)});
  }
}

void IndexedTally::find_around(const Box& legs) {
  around_.clear();
  const auto skip = [&](const Box& blocks) {
    poll();
    return around_.size() > most_around || comparison_.skips(legs, blocks);
  };
  index_.sides().for_each_block(skip, [&](std::size_t block) { around_.push_back(block); });
}

/// By the blocks near all legs of it; each leg by itself where they are many.
void IndexedTally::compare_group(Range group) {
  find_near(box_around(group));
  for (std::size_t number = group.first; number < group.last; ++number) {
    const BoxedSegment leg(legs_.leg(number), number);
    if (near_.size() > most_near) {
      compare_alone(leg);
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
  const auto add = [&](std::size_t block) {
    near_.push_back({block, sides_.size()});
    index_.sides().for_each_in(block, [&](std::size_t i) { sides_.push_back(side(i)); });
  };
  if (around_.size() > most_around) return index_.sides().for_each_block(skip, add);
  for (const std::size_t block : around_) {
    if (!skip(index_.sides().block_box(block))) add(block);
  }
}

void IndexedTally::compare_with_near(const BoxedSegment& leg) {
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (skips(leg, index_.sides().block_box(near_[i].number))) continue;
    const std::size_t last = i + 1 < near_.size() ? near_[i + 1].first : sides_.size();
    for (std::size_t k = near_[i].first; k < last; ++k) comparison_.with_leg(leg, sides_[k]);
  }
}

void IndexedTally::compare_alone(const BoxedSegment& leg) {
  index_.sides().for_each([&](const Box& blocks) { return skips(leg, blocks); },
                          [&](std::size_t i) { comparison_.with_leg(leg, side(i)); });
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
