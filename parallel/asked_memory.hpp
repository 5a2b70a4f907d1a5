// SPDX-License-Identifier: BSD-3-Clause
// Lists whose length nobody knows before they are made: memory is asked for before they grow.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/page_pool.hpp"
#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"

namespace warren {

/// Appends. Throws Stopped{memory} where the list would have to grow past the limit; looks at the deadline then, too.
template <class T>
void push_asked(RawVector<T>& list, const T& value, const Execution& execution) {
  if (list.size() == list.capacity()) {
    constexpr std::size_t fewest = 256;
    const std::size_t room = std::max(fewest, 2 * list.size());
    execution.reserve(room * sizeof(T));  // the old block is given back only when all has moved
    list.reserve(room);
  }
  list.push_back(value);
}

/// Appends. Throws Stopped where the vector is full and the larger block that it moves to would pass the limit; blocks
/// below 128 KiB are not worth a question, whoever makes many of them asks between them.
template <class T, class Allocator>
void push_asked(std::vector<T, Allocator>& to, std::type_identity_t<T> item, const Execution& execution) {
  constexpr std::size_t small = std::size_t{1} << 16;
  const std::size_t held = to.capacity() * sizeof(T);
  if (to.size() == to.capacity() && held >= small) execution.reserve(2 * held);
  to.push_back(std::move(item));
}

// Makes the system find the memory of a new block now, page after page on all threads, polled. Whoever scatters into
// cold memory meets all its pages in the first moments of the first chunk, and no poll comes in between: on a virtual
// machine that took 0.6 s for 130 MB. Where the memory is there already, little is done.

namespace detail {
inline void touch_pages(char* bytes, std::size_t count, std::size_t grain, const Execution& execution) {
  constexpr std::size_t page = 4096;
  for_chunks(count, grain, execution.quiet(), [&](Range r) {
    if (populate_pages(bytes + r.first, r.size())) return;
    volatile char* const unread = bytes;  // or the writes would be left out
    for (std::size_t i = r.first; i < r.last; i += page) unread[i] = 0;
  });
}
}  // namespace detail

/// May write a zero to each page of a block: its contents are not yet of value. Throws Stopped.
template <class T>
void touch_first(RawVector<T>& block, const Execution& execution) {
  static_assert(std::is_trivially_copyable_v<T>);
  constexpr std::size_t huge_page = std::size_t{1} << 21;
  detail::touch_pages(reinterpret_cast<char*>(block.data()), block.size() * sizeof(T), huge_page, execution);
}

/// Makes an empty vector's room for `count` elements, and touches it: filling it is then quick for one thread. Throws
/// Stopped, also where the memory limit doesn't allow for it.
template <class T>
void reserve_touched(RawVector<T>& empty, std::size_t count, const Execution& execution) {
  static_assert(std::is_trivially_copyable_v<T>);
  execution.reserve(count * sizeof(T));
  empty.reserve(count);
  constexpr std::size_t many_pages = std::size_t{1} << 17;
  detail::touch_pages(reinterpret_cast<char*>(empty.data()), count * sizeof(T), many_pages, execution);
}

/// One list of parts in their order. Throws Stopped.
template <class T>
RawVector<T> joined_parts(const std::vector<RawVector<T>>& parts, const Execution& execution) {
  std::vector<std::size_t> first(parts.size() + 1, 0);
  for (std::size_t i = 0; i < parts.size(); ++i) first[i + 1] = first[i] + parts[i].size();
  execution.reserve(first.back() * sizeof(T));
  RawVector<T> all(first.back());
  for_each_index(parts.size(), 1, execution, [&](std::size_t i) {
    std::copy(parts[i].begin(), parts[i].end(), all.begin() + static_cast<std::ptrdiff_t>(first[i]));
  });
  return all;
}

}  // namespace warren
