// SPDX-License-Identifier: BSD-3-Clause
// What A* takes the way to the goal for, of points of the plane. Edges are as long as they are, so an estimate that may
// be longer than the straight line loses the shortest path: by the Manhattan distance it may come out sqrt(2) times as
// long, by the octile one 1.083 times. Such a search goes from the start alone and never looks at a settled vertex
// again, as those do that are programmed so.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "core/base/types.hpp"
#include "core/base/world.hpp"

namespace warren {

/// Of dx and dy: euclidean: the straight line. manhattan: dx + dy. octile: along axes and diagonals. chebyshev: the
/// larger. zero: nothing, which makes A* Dijkstra's search.
enum class HeuristicKind : std::uint8_t { euclidean, manhattan, octile, chebyshev, zero };
constexpr auto enum_names(HeuristicKind) {
  return std::array<std::string_view, 5>{"euclidean", "manhattan", "octile", "chebyshev", "zero"};
}

/// Is it never more than the straight line?
constexpr bool never_overestimates(HeuristicKind kind) {
  return kind != HeuristicKind::manhattan && kind != HeuristicKind::octile;
}

/// The estimate between two states; of bodies that have more than a place the world's metric, whatever the kind.
template <World W>
double estimated_way(const W& world, HeuristicKind kind, const typename W::State& a, const typename W::State& b) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    const double dx = std::abs(a.x - b.x);
    const double dy = std::abs(a.y - b.y);
    if (kind == HeuristicKind::manhattan) return dx + dy;
    if (kind == HeuristicKind::octile) return std::max(dx, dy) + (std::numbers::sqrt2 - 1.0) * std::min(dx, dy);
    if (kind == HeuristicKind::chebyshev) return std::max(dx, dy);
    if (kind == HeuristicKind::zero) return 0.0;
  }
  return world.distance(a, b);
}

}  // namespace warren
