// SPDX-License-Identifier: BSD-3-Clause
// Stable counting sort by an integer key, in parallel, deterministic: the order of n items whose keys are below `keys`,
// and where each key begins. Few keys: one histogram a chunk, prefix sums over (key, chunk), scatter. Many keys: the
// same over at most 512 buckets of neighbouring keys, then each bucket is counted and scattered by one thread inside
// its cache; that replaces one cache miss an item by two passes over streams. Chunk borders depend on n alone and the
// sort is stable, so the result is a function of the keys.
// 2048 buckets took 10 ns an item at 10^6 items where 512 take 4, and were no faster at 7 10^7.
// Cost O(n + keys); 8 bytes an item of scratch where there are more than 512 keys.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/base/items_by_key.hpp"
#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"

namespace warren {

namespace detail {

inline constexpr std::size_t sort_buckets = 512;

/// Chunks of at least 16384 items, at most 64 of them: so that the histograms stay small beside the items.
constexpr std::size_t sort_grain(std::size_t n) { return std::max<std::size_t>(std::size_t{1} << 14, (n + 63) / 64); }

/// Turns histograms [chunk][bucket] into the first place of each (bucket, chunk); returns where each bucket begins.
inline std::vector<std::uint32_t> places_of_buckets(std::vector<std::uint32_t>& counts, std::size_t chunks,
                                                    std::size_t buckets) {
  std::vector<std::uint32_t> begin(buckets + 1);
  std::uint32_t place = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    begin[bucket] = place;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      place += std::exchange(counts[chunk * buckets + bucket], place);
    }
  }
  begin[buckets] = place;
  return begin;
}

/// Stable scatter of put(i) for i in 0 .. n - 1 to the bucket bucket_of(i); returns where each bucket begins.
template <class BucketOf, class Put>
std::vector<std::uint32_t> scatter_to_buckets(std::size_t n, std::size_t buckets, const Execution& execution,
                                              const BucketOf& bucket_of, const Put& put) {
  const std::size_t grain = sort_grain(n);
  const std::size_t chunks = chunk_count(n, grain);
  std::vector<std::uint32_t> counts(chunks * buckets, 0);
  for_chunks(n, grain, execution, [&](Range range) {
    std::uint32_t* const count = counts.data() + range.first / grain * buckets;
    for (std::size_t i = range.first; i < range.last; ++i) ++count[bucket_of(i)];
  });
  std::vector<std::uint32_t> begin = places_of_buckets(counts, chunks, buckets);
  for_chunks(n, grain, execution, [&](Range range) {
    std::uint32_t* const place = counts.data() + range.first / grain * buckets;
    for (std::size_t i = range.first; i < range.last; ++i) put(place[bucket_of(i)]++, i);
  });
  return begin;
}

/// Sorts the (key, item) pairs of the keys first_key .. last_key - 1, which lie at places begin .. end - 1.
inline void sort_bucket(const RawVector<std::uint64_t>& pairs, Range places, Range keys,
                        std::vector<std::uint32_t>& scratch, ItemsByKey& order) {
  scratch.assign(keys.size(), 0);
  for (std::size_t i = places.first; i < places.last; ++i) ++scratch[(pairs[i] >> 32) - keys.first];
  auto place = static_cast<std::uint32_t>(places.first);
  for (std::size_t key = keys.first; key < keys.last; ++key) {
    order.first[key] = place;
    place += std::exchange(scratch[key - keys.first], place);
  }
  for (std::size_t i = places.first; i < places.last; ++i) {
    order.items[scratch[(pairs[i] >> 32) - keys.first]++] = static_cast<std::uint32_t>(pairs[i]);
  }
}

}  // namespace detail

/// Sorts items 0 .. n - 1 by key_of(i) < keys; key_of is called twice for each item, from several threads, and must
/// give the same both times. The items of each key ascend. n and keys below 2^32, keys >= 1. Throws Stopped at the
/// deadline.
template <class KeyOf>
ItemsByKey counting_sort(std::size_t n, std::size_t keys, const Execution& execution, const KeyOf& key_of) {
  assert(keys >= 1 && n < (std::uint64_t{1} << 32) && keys < (std::uint64_t{1} << 32));
  const Execution quiet = execution.quiet();
  unsigned shift = 0;
  while (((keys - 1) >> shift) >= detail::sort_buckets) ++shift;
  const std::size_t buckets = ((keys - 1) >> shift) + 1;
  quiet.reserve((n + keys) * sizeof(std::uint32_t) + (shift == 0 ? 0 : n * sizeof(std::uint64_t)));
  ItemsByKey order;
  order.first.resize(keys + 1);
  order.items.resize(n);
  touch_first(order.items, quiet);
  order.first[keys] = static_cast<std::uint32_t>(n);
  if (shift == 0) {
    const auto begin = detail::scatter_to_buckets(n, buckets, quiet, key_of, [&](std::size_t place, std::size_t i) {
      order.items[place] = static_cast<std::uint32_t>(i);
    });
    std::copy(begin.begin(), begin.end(), order.first.begin());
    return order;
  }
  RawVector<std::uint64_t> pairs(n);
  touch_first(pairs, quiet);
  const auto begin = detail::scatter_to_buckets(
      n, buckets, quiet, [&](std::size_t i) { return std::size_t{key_of(i)} >> shift; },
      [&](std::size_t place, std::size_t i) { pairs[place] = std::uint64_t{key_of(i)} << 32 | i; });
  for_chunks(buckets, 8, quiet, [&](Range range) {
    std::vector<std::uint32_t> scratch;
    for (std::size_t b = range.first; b < range.last; ++b) {
      const Range some_keys{b << shift, std::min(keys, (b + 1) << shift)};
      detail::sort_bucket(pairs, {begin[b], begin[b + 1]}, some_keys, scratch, order);
    }
  });
  return order;
}

/// std::sort that looks at the deadline between comparisons: sorting ten million edges takes a second. The look is at a
/// counter in all comparisons but one of 2^12, for exact ones can take microseconds. Sorts first .. last by less.
/// Throws Stopped: the elements are then in some order, and one of them may have been moved from.
template <class Iterator, class Less = std::less<>>
void polled_sort(Iterator first, Iterator last, const Execution& execution, const Less& less = {}) {
  constexpr std::uint32_t comparisons_per_poll = 1U << 12;
  std::uint32_t comparisons = 0;
  std::sort(first, last, [&](const auto& a, const auto& b) {
    if (++comparisons % comparisons_per_poll == 0) execution.check();
    return less(a, b);
  });
}

/// Exclusive prefix sums in parallel: two passes over the data, chunk sums between them. Integers only, so the result
/// does not depend on the chunks. Replaces values[i] by the sum of values[0 .. i - 1] and returns the total. O(n), 2
/// reads and 1 write an element.
template <class Vector>
std::uint64_t exclusive_scan(Vector& values, const Execution& execution) {
  using Value = typename Vector::value_type;
  constexpr std::size_t grain = std::size_t{1} << 16;
  std::vector<std::uint64_t> sums = parts_of_chunks(values.size(), grain, execution, [&](Range r) {
    std::uint64_t sum = 0;
    for (std::size_t i = r.first; i < r.last; ++i) sum += values[i];
    return sum;
  });
  std::uint64_t total = 0;
  for (std::uint64_t& sum : sums) total += std::exchange(sum, total);
  for_chunks(values.size(), grain, execution, [&](Range r) {
    std::uint64_t sum = sums[r.first / grain];
    for (std::size_t i = r.first; i < r.last; ++i) sum += std::exchange(values[i], static_cast<Value>(sum));
  });
  return total;
}

}  // namespace warren
