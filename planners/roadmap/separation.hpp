// SPDX-License-Identifier: BSD-3-Clause
// Why start and goal are apart: the sizes of their components and the nearest gap between them. One query a milestone
// of the smaller component against an index over the larger: O(n).
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/state_index.hpp"

namespace warren {

/// Of two sets of points, neither of them empty; the order of the points does not matter.
template <int D>
Separation separation_between(std::vector<PointOf<D>> start, std::vector<PointOf<D>> goal, const Execution& execution) {
  Separation result{start.size(), goal.size(), 0.0};
  const bool start_is_smaller = start.size() <= goal.size();
  const auto& small = start_is_smaller ? start : goal;
  const KdTree<D> index(start_is_smaller ? goal : start, execution);  // a grid would search long where points are far
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
  return separation_between<embedding_dimension<W>>(points_of(start), points_of(goal), execution);
}

}  // namespace warren
