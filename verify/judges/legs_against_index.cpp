// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/legs_against_index.hpp"

#include <limits>
#include <utility>
#include <vector>

#include "parallel/chunks.hpp"

namespace warren {
namespace {

constexpr std::size_t leg_grain = 256;
constexpr std::size_t looks_a_poll = 4096;

Tally tally_of(const ObstacleIndex& index, const LegBoxes& legs, Range range, const VerifyOptions& options,
               const Execution& execution) {
  Comparison comparison(legs, options, std::numeric_limits<double>::infinity());
  std::size_t looks = 0;
  const auto polled = [&] {
    if (++looks % looks_a_poll == 0) execution.check();
  };
  std::size_t leg = range.first;
  const auto compare = [&](std::size_t number) {
    polled();
    comparison.with_leg(leg, index.obstacles().segment(number), number);
  };
  index.sides().for_some_near(box_of(legs.leg(leg)), compare);
  for (; leg < range.last; ++leg) {
    const auto skip = [&](const Box& box) {
      polled();
      return comparison.skips(leg, box);
    };
    index.sides().for_each(skip, compare);
  }
  return comparison.take();
}

}  // namespace

Tally compare_indexed(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
                      const Execution& execution) {
  std::vector<Tally> parts(chunk_count(legs.leg_count(), leg_grain));
  for_chunks(legs.leg_count(), leg_grain, execution,
             [&](Range r) { parts[r.first / leg_grain] = tally_of(index, legs, r, options, execution); });
  Tally all;
  all.box = index.box();
  for (Tally& part : parts) all.join(std::move(part));
  return all;
}

}  // namespace warren
