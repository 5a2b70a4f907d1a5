// SPDX-License-Identifier: BSD-3-Clause
// Where arrays and heaps cross: the size of graph from which on a search with an array as its queue is slower than the
// same search with a heap, from measured times at several sizes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "studies/compare/comparison.hpp"

namespace warren::studies {

/// Times of one way to search random graphs, against their size.
struct SweepCurve {
  std::string search;
  std::string queue;
  std::string library;
  std::vector<Vec2> points;  ///< vertices, seconds > 0; ascending vertices
};

/// A curve a search, queue and library, in the order of the contenders; each point is the geometric mean of the medians
/// over the graphs of that size. Only contenders on geometric graphs that were solved.
std::vector<SweepCurve> sweep_curves(const Comparison& comparison);

struct QueueCrossing {
  std::string search;
  std::string array;
  std::string heap;
  std::vector<Vec2> ratios;             ///< vertices, time with the array over time with the heap
  std::optional<double> not_slower_at;  ///< the largest size at which the array is no slower; none: slower everywhere
  std::optional<double> slower_from;    ///< the least size from which on it is always slower; none: not at the largest
  std::optional<double> crossing;       ///< between those two, by the line through log ratio against log size
  std::optional<double> fitted;         ///< the same by the line of least squares through all sizes, if it rises
};

/// Every array against every heap, search by search; our own library's. Sizes at which either is missing don't count.
std::vector<QueueCrossing> queue_crossings(const std::vector<SweepCurve>& curves);

}  // namespace warren::studies
