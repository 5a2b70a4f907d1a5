// SPDX-License-Identifier: BSD-3-Clause
// What a planner answers where it has no path. Why start and goal are apart: the sizes of their components and the
// nearest gap between them, one query a milestone of the smaller component against an index over the larger, O(n). Or
// that it was stopped.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"

namespace warren {

/// Of two sets of points, neither of them empty; the order of the points does not matter.
template <int D>
Separation separation_between(std::vector<PointOf<D>> start, std::vector<PointOf<D>> goal, const Execution& execution) {
  Separation result{.start_size = start.size(), .goal_size = goal.size()};
  const bool start_is_smaller = start.size() <= goal.size();
  const auto& small = start_is_smaller ? start : goal;
  const auto& large = start_is_smaller ? goal : start;
  const KdTree<D> index(large, execution);  // a grid would search long where points are far
  constexpr std::size_t grain = 1024;
  struct Gap {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t small = 0;
    std::size_t large = 0;
  };
  const std::vector<Gap> gaps = parts_of_chunks(small.size(), grain, execution, [&](Range r) {
    std::vector<Neighbour> near;
    Gap least;
    for (std::size_t i = r.first; i < r.last; ++i) {
      index.nearest(small[i], 1, no_vertex, near);
      if (near.front().distance < least.distance) least = {near.front().distance, i, near.front().id};
    }
    return least;
  });
  const Gap least =
      *std::min_element(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.distance < b.distance; });
  result.nearest_gap = least.distance;
  const auto place = [](const PointOf<D>& point) {
    if constexpr (D == 2) {
      return std::array{point.x, point.y};
    } else {
      return std::array{point[0], point[1]};
    }
  };
  result.near_start = place(start_is_smaller ? small[least.small] : large[least.large]);
  result.near_goal = place(start_is_smaller ? large[least.large] : small[least.small]);
  return result;
}

/// Of what start and goal are joined with; point(v): where a vertex stands.
template <int D, class PointAt>
Separation separation_of_parts(const Components& parts, VertexId start, VertexId goal, const Execution& execution,
                               const PointAt& point) {
  const auto points_of = [&](VertexId end) {
    std::vector<PointOf<D>> points;
    for (VertexId v = 0; v < parts.label.size(); ++v) {
      if (parts.connected(v, end)) push_asked(points, point(v), execution);
    }
    return points;
  };
  return separation_between<D>(points_of(start), points_of(goal), execution);
}

template <World W>
Separation separation_of(const W& world, std::span<const typename W::State> states, const Components& components,
                         VertexId start, VertexId goal, const Execution& execution) {
  return separation_of_parts<embedding_dimension<W>>(components, start, goal, execution,
                                                     [&](VertexId v) { return embedded(world, states[v]); });
}

/// What a planner answers when it was stopped: why, and no path. Counts and times stay as they are.
template <class State>
void mark_stopped(Solution<State>& solution, const Stopped& stopped) {
  solution.outcome = Outcome::stopped;
  solution.stop_reason = stopped.reason;
  solution.path.clear();
}

/// Runs a plan; where it is stopped its solution says so.
template <class Plan, class... Ground>
auto run_plan(Plan& plan, const Ground&... ground) {
  try {
    plan.run(ground...);
  } catch (const Stopped& stopped) {
    mark_stopped(plan.solution(), stopped);
  }
  return std::move(plan.solution());
}

}  // namespace warren
