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
    index_.sides().for_some_near(box_of(legs_.leg(range.first)), [&](std::size_t i) { compare(range.first, i); });
    for (std::size_t first = range.first; first < range.last; first += legs_a_group) {
      compare_group({first, std::min(first + legs_a_group, range.last)});
    }
    return comparison_.take();
  }

 private:
  void compare_group(Range group);
  void compare(std::size_t leg, std::size_t number) {
    poll();
    comparison_.with_leg(leg, index_.obstacles().segment(number), number);
  }
  void poll() {
    if (++looks_ % looks_a_poll == 0) execution_.check();
  }

  const ObstacleIndex& index_;
  const LegBoxes& legs_;
  const Execution& execution_;
  Comparison comparison_;
  std::vector<std::size_t> near_;  // blocks
  std::size_t looks_ = 0;
};

/// By the blocks near all legs of it; each leg by itself where they are many.
void IndexedTally::compare_group(Range group) {
  Box box;
  for (std::size_t leg = group.first; leg < group.last; ++leg) box.include(box_of(legs_.leg(leg)));
  near_.clear();
  const auto skip_group = [&](const Box& blocks) {
    poll();
    return near_.size() > most_near || comparison_.skips(box, blocks);
  };
  index_.sides().for_each_block(skip_group, [&](std::size_t block) { near_.push_back(block); });
  for (std::size_t leg = group.first; leg < group.last; ++leg) {
    const auto skip = [&](const Box& blocks) {
      poll();
      return comparison_.skips(leg, blocks);
    };
    const auto compare_one = [&](std::size_t number) { compare(leg, number); };
    if (near_.size() > most_near) {
      index_.sides().for_each(skip, compare_one);
      continue;
    }
    for (const std::size_t block : near_) {
      if (!skip(index_.sides().block_box(block))) index_.sides().for_each_in(block, compare_one);
    }
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
