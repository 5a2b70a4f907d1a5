// SPDX-License-Identifier: BSD-3-Clause
// What a planner needs to know of a world: one robot among obstacles. The world is immutable and shared by all threads;
// a Query holds scratch and counters and belongs to one thread.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "core/base/rng.hpp"
#include "core/base/types.hpp"

namespace warren {

/// A coarse grid of places in the plane, a bit each, up to 64 columns and 64 rows: small enough to be looked at for
/// every problem. A row is a word, so that whole rows are moved and compared at once. No allocation. Place (column,
/// row) is at origin + step * (column, row). Bits beyond the columns are 0. What a set bit means is said by who made
/// the grid.
struct PlaceGrid {
  static constexpr std::size_t most = 64;  ///< columns, and rows

  Vec2 origin;
  double step = 1.0;  ///< > 0
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::array<std::uint64_t, most> bits{};

  Vec2 at(std::size_t column, std::size_t row) const {
    return origin + step * Vec2{static_cast<double>(column), static_cast<double>(row)};
  }
  bool test(std::size_t column, std::size_t row) const { return (bits[row] >> column & 1U) != 0; }

  /// A grid of set bits over the whole of a box, as fine as the number of columns and rows lets it be.
  static PlaceGrid over(const Box& box) {
    PlaceGrid grid;
    const double longest = std::max(box.width(), box.height());
    if (!(longest > 0.0)) return grid;
    grid.origin = box.min;
    grid.step = longest / static_cast<double>(most - 1) * (1.0 - 1e-12);  // rounding hardly leaves the box
    const auto count = [&grid](double extent) {
      return std::min(most, static_cast<std::size_t>(extent / grid.step * (1.0 + 1e-9)) + 1);
    };
    grid.columns = count(box.width());
    grid.rows = count(box.height());
    for (std::size_t row = 0; row < grid.rows; ++row) grid.bits[row] = ~std::uint64_t{0} >> (most - grid.columns);
    return grid;
  }
};

/// W::dimension      number of coordinates of a state
/// W::State          a configuration; copyable
/// w.at_unit(u)      the state at u in [0, 1)^dimension: samplers (uniform, Halton) are made of it
/// w.is_free(a, q)   may the robot stand at a, clearance included?
/// w.is_free_motion  may it move from a to b, clearance included, if both ends are free?
/// w.distance(a, b)  the metric that path length sums up; static where the world has no say in it
/// w.embed(a)        a point whose plain Euclidean distance is at most the metric: so one k-d tree serves every world
/// What a world may have beyond that: planners/graph/any_world.hpp.
template <class W>
concept World = std::copyable<typename W::State> &&
    requires(const W& w, typename W::Query& q, const typename W::State& a, const typename W::State& b,
             const std::array<double, W::dimension>& u) {
  { w.make_query() } -> std::same_as<typename W::Query>;
  { w.at_unit(u) } -> std::same_as<typename W::State>;
  { w.is_free(a, q) } -> std::same_as<bool>;
  { w.is_free_motion(a, b, q) } -> std::same_as<bool>;
  { w.distance(a, b) } -> std::same_as<double>;
  { w.embed(a)[0] } -> std::convertible_to<double>;
};

/// A world whose motions can be cut: what planners need that grow trees or shorten paths.
/// w.interpolate(a, b, t)  the state at the share t in [0, 1] of the motion from a to b; a and b themselves at the ends
template <class W>
concept SteerableWorld = World<W> && requires(const W& w, const typename W::State& a) {
  { w.interpolate(a, a, 0.5) } -> std::same_as<typename W::State>;
};

/// A state near a: a share t in [0, 1] of the way to b. No motion: poses of bodies that can't go sideways are moved all
/// the same, as the plane's own interpolate(a, b, t) does.
template <SteerableWorld W>
typename W::State state_between(const W& world, const typename W::State& a, const typename W::State& b, double t) {
  if constexpr (requires { interpolate(a, b, t); }) {
    return interpolate(a, b, t);
  } else {
    return world.interpolate(a, b, t);
  }
}

/// Motions and states that a world may check faster together than one by one.
template <class State>
struct Motion {
  State from;
  State to;
};
inline constexpr std::size_t bunch_size = 16;

/// A new state and the motion between it and one that is known to be free: is the state free, and the motion?
enum class Step : std::uint8_t { state_blocked, motion_blocked, free };

/// backward: the motion leads from the new state to the known one. A world may look at both at once
/// (world.is_free_step(), where the motion includes its ends and has no direction): then motion_blocked says either.
template <World W>
Step step_to(const W& world, const typename W::State& known, const typename W::State& fresh, bool backward,
             typename W::Query& query) {
  if constexpr (requires { world.step_to(known, fresh, backward, query); }) {
    return world.step_to(known, fresh, backward, query);
  } else if constexpr (requires { world.is_free_step(known, fresh, query); }) {
    return world.is_free_step(known, fresh, query) ? Step::free : Step::motion_blocked;
  } else {
    if (!world.is_free(fresh, query)) return Step::state_blocked;
    const bool free = backward ? world.is_free_motion(fresh, known, query) : world.is_free_motion(known, fresh, query);
    return free ? Step::free : Step::motion_blocked;
  }
}

/// Motions that this query saw refused: neither proved free nor blocked. 0 for worlds whose checks are exact.
template <class Query>
std::uint64_t refused_motions(const Query& query) {
  if constexpr (requires { query.refused; }) return query.refused;
  return 0;
}

/// The index-th uniform sample of a seed: a pure function.
template <class W>
typename W::State uniform_state(const W& world, std::uint64_t seed, std::uint64_t index) {
  std::array<double, W::dimension> u;
  for (std::size_t axis = 0; axis < W::dimension; ++axis) u[axis] = uniform(seed, index, axis);
  return world.at_unit(u);
}

}  // namespace warren
