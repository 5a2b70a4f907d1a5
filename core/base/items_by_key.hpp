// SPDX-License-Identifier: BSD-3-Clause
// Lists of items by key, as compressed rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/raw_vector.hpp"

namespace warren {

/// Lists of items that lie side by side, one list a key.
struct ItemsByKey {
  RawVector<std::uint32_t> first;  ///< where each key's list begins, and the end of the last
  RawVector<std::uint32_t> items;  ///< all lists, in the order of the keys
  /// The list of this key.
  std::span<const std::uint32_t> of(std::size_t key) const {
    return {items.data() + first[key], items.data() + first[key + 1]};
  }
};

/// each(visit) calls visit(key, item) for all items, fewer than 2^32, and is called twice: the same calls in the same
/// order, which each list keeps. poll() is called while the lists' room is made.
template <class Each, class Poll = NoPoll>
ItemsByKey items_by_key(std::size_t keys, const Each& each, const Poll& poll = {}) {
  ItemsByKey lists;
  RawVector<std::uint32_t>& first = lists.first;
  assign_polled(first, keys + 2, std::uint32_t{0}, poll);  // two places ahead: items move a list's begin to its end
  each([&](std::uint32_t key, std::uint32_t) { ++first[std::size_t{key} + 2]; });
  for (std::size_t key = 0; key < keys; ++key) first[key + 2] += first[key + 1];
  assign_polled(lists.items, first.back(), std::uint32_t{0}, poll);
  each([&](std::uint32_t key, std::uint32_t item) { lists.items[first[std::size_t{key} + 1]++] = item; });
  first.pop_back();
  return lists;
}

}  // namespace warren
