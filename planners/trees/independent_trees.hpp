// SPDX-License-Identifier: BSD-3-Clause
// Runs independent searches by growing trees side by side until one arrives, so that the answer does not depend on the
// machine: all of them take the same number of steps, batch after batch; after a batch the first in index order that
// has arrived answers. Batches grow from 32 to 1024 steps, so that easy problems waste little. Every search is a
// function of (problem, options, index); the threads are used across searches.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/planned_roadmap.hpp"
#include "planners/roadmap/sampler.hpp"
#include "planners/roadmap/stopped_solution.hpp"
#include "planners/trees/rrt_options.hpp"

namespace warren {

/// The seed of the index-th tree.
inline std::uint64_t tree_seed(std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t purpose = 0x7265657374726565U;
  return index == 0 ? seed : random_bits(seed, index, purpose);
}

/// A motion's length where none is given: a third of the way from the middle of the states to a corner of them, were
/// the coordinates square to each other, by the embedding (a car's own metric has loops in it).
template <World W>
double usual_step(const W& world) {
  std::array<double, W::dimension> u;
  u.fill(0.5);
  const auto middle = world.embed(world.at_unit(u));
  double sum = 0.0;
  for (std::size_t axis = 0; axis < W::dimension; ++axis) {
    u[axis] = std::nextafter(1.0, 0.0);
    const auto end = world.embed(world.at_unit(u));
    for (std::size_t i = 0; i < end.size(); ++i) sum += (end[i] - middle[i]) * (end[i] - middle[i]);
    u[axis] = 0.5;
  }
  return std::sqrt(sum) / 3.0;
}

/// s.advance(steps) takes so many steps, fewer where it arrives or gives up; s.arrived(), s.gave_up(),
/// s.counters() and s.finish(solution, keep, execution).
namespace detail {

/// Batches until one has arrived or all have given up: which one answers.
template <class Search>
std::optional<std::size_t> race(std::vector<Search>& searches, std::uint64_t& batches, const Execution& execution) {
  constexpr std::uint64_t first_batch = 32;
  constexpr std::uint64_t last_batch = 1024;
  for (std::uint64_t steps = first_batch;; steps = std::min(2 * steps, last_batch)) {
    ++batches;
    for_chunks(searches.size(), 1, execution, [&](Range r) { searches[r.first].advance(steps, execution); });
    const auto winner = std::find_if(searches.begin(), searches.end(), [](const Search& s) { return s.arrived(); });
    if (winner != searches.end()) return static_cast<std::size_t>(winner - searches.begin());
    if (std::all_of(searches.begin(), searches.end(), [](const Search& s) { return s.gave_up(); })) return std::nullopt;
  }
}

/// The goals that are free.
template <World W>
std::vector<typename W::State> free_states(const W& world, std::span<const typename W::State> states) {
  auto query = world.make_query();
  std::vector<typename W::State> free;
  for (const auto& state : states) {
    if (world.is_free(state, query)) free.push_back(state);
  }
  return free;
}

/// Search(world, start, goals, options, step, index) for each tree; the whole plan.
template <class Search, SteerableWorld W>
Solution<typename W::State> race_trees(const W& world, const typename W::State& start,
                                       std::span<const typename W::State> goals, const RrtOptions& options,
                                       const Execution& execution, PlannedRoadmap<typename W::State>* keep) {
  options.validate();
  Solution<typename W::State> solution;
  const auto free_goals = free_states(world, goals);
  if (free_states(world, std::span(&start, 1)).empty()) {
    solution.outcome = Outcome::start_blocked;
    return solution;
  }
  if (free_goals.empty()) {
    solution.outcome = Outcome::goal_blocked;
    return solution;
  }
  std::vector<Search> searches;
  try {
    execution.check();
    const StageTimer timer(execution, "search", solution.seconds.search);
    const double step = options.step ? *options.step : usual_step(world);
    for (std::uint32_t i = 0; i < options.trees; ++i) searches.emplace_back(world, start, free_goals, options, step, i);
    const auto winner = race(searches, solution.counters.rounds, execution);
    solution.outcome = winner ? Outcome::solved : Outcome::not_connected;
    searches[winner.value_or(0)].finish(solution, keep, execution);
  } catch (const Stopped& stopped) {
    mark_stopped(solution, stopped);
  }
  for (const Search& search : searches) solution.counters += search.counters();
  return solution;
}

}  // namespace detail

}  // namespace warren
