// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/box_tree.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/base/rng.hpp"

namespace warren {
namespace {

template <int D>
std::vector<BoxOf<D>> random_boxes(std::uint64_t seed, std::size_t count) {
  std::vector<BoxOf<D>> boxes(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < D; ++axis) {
      boxes[i].low[axis] = uniform(seed, i, 2 * axis);
      boxes[i].high[axis] = boxes[i].low[axis] + 0.1 * uniform(seed, i, 2 * axis + 1);
    }
    if (seed % 4 == 0) boxes[i] = boxes[i / 7];  // many that are equal
  }
  return boxes;
}

template <int D>
double gap(const BoxOf<D>& a, const BoxOf<D>& b) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    double d = 0.0;
    if (a.low[axis] > b.high[axis]) d = a.low[axis] - b.high[axis];
    if (b.low[axis] > a.high[axis]) d = b.low[axis] - a.high[axis];
    sum += d * d;
  }
  return std::sqrt(sum);
}

template <int D>
void expect_as_brute_force(std::uint64_t seed) {
  SCOPED_TRACE(seed);
  const std::vector<BoxOf<D>> boxes = random_boxes<D>(seed, 1 + 37 * seed);
  const BoxTree<D> tree(boxes);
  const std::set<std::uint32_t> all(tree.order().begin(), tree.order().end());
  ASSERT_EQ(all.size(), boxes.size());
  for (const BoxOf<D>& from : random_boxes<D>(seed + 1000, 50)) {
    double nearest = std::numeric_limits<double>::infinity();
    tree.search(from, nearest, [&](std::uint32_t place) {
      nearest = std::min(nearest, gap(boxes[tree.order()[place]], from));
      return nearest;
    });
    double least = std::numeric_limits<double>::infinity();
    std::set<std::uint32_t> near;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      least = std::min(least, gap(boxes[i], from));
      if (gap(boxes[i], from) <= 0.2) near.insert(i);
    }
    EXPECT_EQ(nearest, least);
    std::set<std::uint32_t> visited;
    tree.search(from, 0.2, [&](std::uint32_t place) {
      EXPECT_TRUE(visited.insert(tree.order()[place]).second) << "twice";
      return 0.2;
    });
    EXPECT_EQ(visited, near);
  }
}

TEST(BoxTree, FindsTheNearestAndAllWithinADistanceAsBruteForceDoes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    expect_as_brute_force<2>(seed);
    expect_as_brute_force<3>(seed);
  }
}

TEST(BoxTree, EndsWhenToldTo) {
  const std::vector<BoxOf<2>> boxes = random_boxes<2>(1, 100);
  int visits = 0;
  BoxTree<2>(boxes).search({{0, 0}, {1, 1}}, 1.0, [&](std::uint32_t) {
    ++visits;
    return -1.0;
  });
  EXPECT_EQ(visits, 1);
}

TEST(BoxTree, OfManyIsNotBuiltToItsEndWhenASignalCame) {
  const SignalFlag signal{15};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  EXPECT_THROW(BoxTree<2>(random_boxes<2>(1, 5000), {.deadline = &deadline}), Stopped);
}

TEST(BoxTree, OfNothingFindsNothing) {
  BoxTree<3>(std::vector<BoxOf<3>>{}).search({{0, 0, 0}, {1, 1, 1}}, 1.0, [&](std::uint32_t) {
    ADD_FAILURE();
    return 0.0;
  });
}

}  // namespace
}  // namespace warren
