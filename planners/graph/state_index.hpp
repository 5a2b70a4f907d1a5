// SPDX-License-Identifier: BSD-3-Clause
// Neighbours among the states of any world: an index over their embeddings, whose plain distance bounds the metric.
#pragma once

#include <concepts>
#include <span>

#include "core/base/raw_vector.hpp"
#include "core/base/world.hpp"
#include "parallel/chunks.hpp"
#include "spatial/points/neighbours.hpp"

namespace warren {

template <World W>
inline constexpr int embedding_dimension =
    std::tuple_size_v<decltype(std::declval<const W&>().embed(std::declval<const typename W::State&>()))>;

template <World W>
using StateIndex = Neighbours<embedding_dimension<W>>;

/// The embedding of a state, as the indices take points.
template <World W>
PointOf<embedding_dimension<W>> embedded(const W& world, const typename W::State& state) {
  const auto point = world.embed(state);
  if constexpr (embedding_dimension<W> == 2) {
    return {point[0], point[1]};
  } else {
    return point;
  }
}

template <World W>
StateIndex<W> index_of_states(const W& world, std::span<const typename W::State> states, const Execution& execution,
                              NeighbourIndex kind = NeighbourIndex::by_counts) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    return StateIndex<W>(states, execution, kind);
  } else {
    static_assert(embedding_dimension<W> != 2, "an index in the plane refers to its points, and these don't last");
    constexpr std::size_t grain = std::size_t{1} << 14;
    execution.reserve(states.size() * sizeof(PointOf<embedding_dimension<W>>));
    RawVector<PointOf<embedding_dimension<W>>> points(states.size());
    for_each_index(states.size(), grain, execution, [&](std::size_t i) { points[i] = embedded(world, states[i]); });
    return StateIndex<W>(points, execution, kind);
  }
}

}  // namespace warren
