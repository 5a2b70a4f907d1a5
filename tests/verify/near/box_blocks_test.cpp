// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/obstacle_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

std::vector<Box> random_boxes(std::uint64_t seed, std::size_t count) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const double size = std::pow(10.0, 4.0 * uniform(seed, i, 2) - 3.0);
    const Vec2 at{std::floor(20.0 * uniform(seed, i, 0)), 20.0 * uniform(seed, i, 1)};
    boxes.push_back({at, at + Vec2{size, i % 3 == 0 ? 0.0 : size}});
  }
  return boxes;
}

BoxBlocks blocks_of(const std::vector<Box>& boxes, const Execution& execution = {}) {
  return {boxes.size(), [&](std::size_t i) { return boxes[i]; }, execution};
}

std::vector<std::size_t> visited(const BoxBlocks& blocks, const Box& place) {
  std::vector<std::size_t> numbers;
  blocks.for_each([&](const Box& box) { return !box.meets(place); }, [&](std::size_t i) { numbers.push_back(i); });
  return numbers;
}

TEST(BoxBlocks, VisitEachBoxOnceWhereNothingIsLeftOut) {
  for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 63U, 64U, 65U, 513U, 20000U}) {
    SCOPED_TRACE(count);
    const std::vector<Box> boxes = random_boxes(count, count);
    std::vector<std::size_t> numbers = visited(blocks_of(boxes), {{-1e9, -1e9}, {1e9, 1e9}});
    std::sort(numbers.begin(), numbers.end());
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(numbers, all);
  }
}

TEST(BoxBlocks, MissNoBoxThatMeetsThePlaceAndLeaveMostOthersOut) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Box> boxes = random_boxes(seed, 3000);
    const BoxBlocks blocks = blocks_of(boxes);
    const Vec2 at{20.0 * uniform(seed, 0, 5), 20.0 * uniform(seed, 0, 6)};
    const Box place{at, at + Vec2{0.2, 0.2}};
    const std::vector<std::size_t> numbers = visited(blocks, place);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!boxes[i].meets(place)) continue;
      EXPECT_EQ(std::count(numbers.begin(), numbers.end(), i), 1) << i;
    }
    EXPECT_LT(numbers.size(), 1500U);
  }
}

TEST(BoxBlocks, SomeNearOnesAreNear) {
  std::vector<Box> boxes;
  for (int i = 0; i < 4096; ++i) {
    const Vec2 at{static_cast<double>(i % 64), static_cast<double>(i / 64)};
    boxes.push_back({at, at});
  }
  const BoxBlocks blocks = blocks_of(boxes);
  const Vec2 place{31.2, 47.9};
  double nearest = std::numeric_limits<double>::infinity();
  blocks.for_some_near({place, place}, [&](std::size_t i) { nearest = std::min(nearest, norm(boxes[i].min - place)); });
  EXPECT_LT(nearest, 4.0);
}

TEST(BoxBlocks, BlocksHoldWhatTheyAreLeftOutFor) {
  const std::vector<Box> boxes = random_boxes(4, 3001);
  const BoxBlocks blocks = blocks_of(boxes);
  const Box place{{3.0, 3.0}, {5.0, 6.0}};
  std::vector<std::size_t> numbers;
  blocks.for_each_block([&](const Box& box) { return !box.meets(place); },
                        [&](std::size_t block) {
                          EXPECT_TRUE(blocks.block_box(block).meets(place));
                          blocks.for_each_in(block, [&](std::size_t i) { numbers.push_back(i); });
                        });
  EXPECT_EQ(numbers, visited(blocks, place));
  EXPECT_LT(numbers.size(), boxes.size() / 2);
}

TEST(BoxBlocks, AreTheSameForAnyNumberOfThreads) {
  const std::vector<Box> boxes = random_boxes(3, 30000);
  const Box everywhere{{-1e9, -1e9}, {1e9, 1e9}};
  const std::vector<std::size_t> one = visited(blocks_of(boxes, {.threads = 1}), everywhere);
  EXPECT_EQ(visited(blocks_of(boxes, {.threads = 3}), everywhere), one);
}

}  // namespace
}  // namespace warren
