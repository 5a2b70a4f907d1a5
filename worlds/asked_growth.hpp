// SPDX-License-Identifier: BSD-3-Clause
// Vectors whose length a file decides: they ask for memory before they move.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "parallel/execution.hpp"

namespace warren {

/// Appends. Throws Stopped where the vector is full and the larger block that it moves to would pass the limit; blocks
/// below 128 KiB are not worth a question, whoever makes many of them asks between them.
template <class T, class Allocator>
void push_asking(std::vector<T, Allocator>& to, std::type_identity_t<T> item, const Execution& execution) {
  constexpr std::size_t small = std::size_t{1} << 16;
  const std::size_t held = to.capacity() * sizeof(T);
  if (to.size() == to.capacity() && held >= small) execution.reserve(2 * held);
  to.push_back(std::move(item));
}

}  // namespace warren
