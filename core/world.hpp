// SPDX-License-Identifier: BSD-3-Clause
// What a planner needs to know of a world: one robot among obstacles. The world is immutable and shared by all threads;
// a Query holds scratch and counters and belongs to one thread.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "core/rng.hpp"

namespace warren {

/// W::dimension      number of coordinates of a state
/// W::State          a configuration; copyable
/// w.at_unit(u)      the state at u in [0, 1)^dimension: samplers (uniform, Halton) are made of it
/// w.is_free(a, q)   may the robot stand at a, clearance included?
/// w.is_free_motion  may it move from a to b, clearance included, if both ends are free?
/// W::distance       the metric that path length sums up
/// w.embed(a)        a point whose plain Euclidean distance is at most the metric: so one k-d tree serves every world
template <class W>
concept World = std::copyable<typename W::State> &&
    requires(const W& w, typename W::Query& q, const typename W::State& a, const typename W::State& b,
             const std::array<double, W::dimension>& u) {
  { w.make_query() } -> std::same_as<typename W::Query>;
  { w.at_unit(u) } -> std::same_as<typename W::State>;
  { w.is_free(a, q) } -> std::same_as<bool>;
  { w.is_free_motion(a, b, q) } -> std::same_as<bool>;
  { W::distance(a, b) } -> std::same_as<double>;
  { w.embed(a)[0] } -> std::convertible_to<double>;
};

/// The index-th uniform sample of a seed: a pure function.
template <class W>
typename W::State uniform_state(const W& world, std::uint64_t seed, std::uint64_t index) {
  std::array<double, W::dimension> u;
  for (std::size_t axis = 0; axis < W::dimension; ++axis) u[axis] = uniform(seed, index, axis);
  return world.at_unit(u);
}

}  // namespace warren
