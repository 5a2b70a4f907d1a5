// SPDX-License-Identifier: BSD-3-Clause
// Lists whose length nobody knows before they are made: memory is asked for before they grow.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"

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

}  // namespace warren
