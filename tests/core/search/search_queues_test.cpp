// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/search_queues.hpp"

#include <gtest/gtest.h>

#include <map>
#include <queue>
#include <set>

#include "core/base/rng.hpp"

namespace warren {
namespace {

bool same(const QueueEntry& a, const QueueEntry& b) { return a.key == b.key && a.vertex == b.vertex; }

template <class Heap>
class IndexedHeapOf : public testing::Test {};
using Heaps = testing::Types<IndexedHeap<2>, IndexedHeap<4>, IndexedHeap<8>>;
TYPED_TEST_SUITE(IndexedHeapOf, Heaps);

TYPED_TEST(IndexedHeapOf, EqualsAnOrderedSetUnderRandomPushesDecreasesAndPops) {
  constexpr std::size_t vertices = 200;
  TypeParam heap;
  heap.resize(vertices);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    heap.clear();
    std::set<QueueEntry> order;
    std::map<VertexId, double> key_of;
    for (int i = 0; i < 5000; ++i) {
      const auto v = static_cast<VertexId>(rng.below(vertices));
      ASSERT_EQ(heap.contains(v), key_of.contains(v));
      if (rng.below(3) != 0 || order.empty()) {
        const auto key = static_cast<double>(rng.below(50));  // many ties
        heap.push(v, key);
        const auto [at, is_new] = key_of.try_emplace(v, key);
        if (!is_new && key < at->second) {
          order.erase({at->second, v});
          at->second = key;
        }
        order.insert({at->second, v});
      } else {
        ASSERT_TRUE(same(heap.top(), *order.begin()));
        ASSERT_TRUE(same(heap.pop(), *order.begin()));
        key_of.erase(order.begin()->vertex);
        order.erase(order.begin());
      }
      ASSERT_EQ(heap.size(), order.size());
      ASSERT_EQ(heap.empty(), order.empty());
    }
  }
}

TYPED_TEST(IndexedHeapOf, GrowsForMoreVertices) {
  TypeParam heap;
  heap.resize(2);
  heap.push(1, 1.0);
  heap.pop();
  heap.resize(1000);
  EXPECT_FALSE(heap.contains(999));
  heap.push(999, 2.0);
  heap.push(1, 3.0);
  EXPECT_EQ(heap.pop().vertex, 999U);
}

/// Queues that keep duplicates, against the library's priority queue.
template <class Queue>
void expect_order_of_priority_queue(Queue queue, bool monotone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    std::priority_queue<QueueEntry, std::vector<QueueEntry>, decltype(later)> oracle(later);
    queue.resize(100);
    queue.clear();
    double least = 0.0;
    for (int i = 0; i < 3000; ++i) {
      if (rng.below(100) >= 45 && !oracle.empty()) {
        const QueueEntry popped = queue.pop();
        ASSERT_TRUE(same(popped, oracle.top()));
        least = monotone ? popped.key : 0.0;
        oracle.pop();
      } else {
        const auto v = static_cast<VertexId>(rng.below(100));
        const bool is_far = rng.below(50) == 0;
        const double key = least + static_cast<double>(rng.below(is_far ? 1U << 20 : 64)) / 16.0;
        queue.push(v, key);
        oracle.push({key, v});
      }
      ASSERT_EQ(queue.empty(), oracle.empty());
    }
  }
}

TEST(LazyHeap, PopsInTheOrderOfAPriorityQueue) { expect_order_of_priority_queue(LazyHeap(), false); }
TEST(SortedArray, PopsInTheOrderOfAPriorityQueue) { expect_order_of_priority_queue(SortedArray(), false); }
TEST(ResortedArray, PopsInTheOrderOfAPriorityQueue) { expect_order_of_priority_queue(ResortedArray(), false); }
TEST(LinearScan, PopsInTheOrderOfAPriorityQueue) { expect_order_of_priority_queue(LinearScan(), false); }
TEST(BucketQueue, PopsInTheOrderOfAPriorityQueueAtAnyWidth) {
  for (const double width : {1e-12, 0.01, 0.25, 1.0, 1e9}) {
    SCOPED_TRACE(width);
    expect_order_of_priority_queue(BucketQueue(width), true);
    expect_order_of_priority_queue(BucketQueue(width), false);
  }
}

TEST(BucketQueue, TakesKeysBeyondEveryBucketNumber) {
  BucketQueue queue(1e-9);
  queue.push(1, 1e60);
  queue.push(2, 1e59);
  queue.push(3, 0.0);
  EXPECT_EQ(queue.pop().vertex, 3U);
  EXPECT_EQ(queue.pop().vertex, 2U);
  EXPECT_EQ(queue.pop().vertex, 1U);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace warren
