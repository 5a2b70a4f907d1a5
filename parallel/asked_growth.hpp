// SPDX-License-Identifier: BSD-3-Clause
// Lists whose length nobody knows before they are made: --memory is asked before they grow.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/raw_vector.hpp"
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

}  // namespace warren
