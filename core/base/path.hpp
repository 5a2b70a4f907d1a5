// SPDX-License-Identifier: BSD-3-Clause
// A path is the list of its states, start to goal.
#pragma once

#include <cstddef>
#include <ranges>

#include "core/base/raw_vector.hpp"

namespace warren {

/// A long one is made of pooled pages (core/base/page_pool.hpp): where one run follows another, the first touch of
/// fresh pages took more time than to find the states.
template <class State>
using Path = RawVector<State>;

/// Sum of the motions' lengths, in the path's order. States: a contiguous list of them.
template <std::ranges::contiguous_range States, class Distance>
double path_length(const States& path, Distance&& distance_between) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance_between(path[i - 1], path[i]);
  return length;
}

}  // namespace warren
