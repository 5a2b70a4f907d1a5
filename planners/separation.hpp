// SPDX-License-Identifier: BSD-3-Clause
// Why start and goal are apart: the sizes of their components and the nearest gap between them. One query a milestone
// of the smaller component against an index over the larger: O(n).
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/graph.hpp"
#include "core/solution.hpp"
#include "core/world.hpp"
#include "parallel/chunks.hpp"
#include "planners/state_index.hpp"

namespace warren {

template <World W>
Separation separation_of(const W& world, std::span<const typename W::State> states, const Components& components,
                         VertexId start, VertexId goal, const Execution& execution) {
  const auto points_of = [&](VertexId v) {
    std::vector<PointOf<embedding_dimension<W>>> points;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (components.label[i] != components.label[v]) continue;
      points.push_back(embedded(world, states[i]));
    }
    return points;
  };
  auto small = points_of(start);
  auto large = points_of(goal);
  Separation result{small.size(), large.size(), 0.0};
  if (small.size() > large.size()) small.swap(large);
  const KdTree<embedding_dimension<W>> index(large, execution);  // a grid would search long where points are far
  constexpr std::size_t grain = 1024;
  std::vector<double> gaps(chunk_count(small.size(), grain), std::numeric_limits<double>::infinity());
  for_chunks(small.size(), grain, execution, [&](Range r) {
    std::vector<Neighbour> near;
    for (std::size_t i = r.first; i < r.last; ++i) {
      index.nearest(small[i], 1, no_vertex, near);
      gaps[r.first / grain] = std::min(gaps[r.first / grain], near.front().distance);
    }
  });
  result.nearest_gap = *std::min_element(gaps.begin(), gaps.end());
  return result;
}

}  // namespace warren
