// SPDX-License-Identifier: BSD-3-Clause
// Builds and opens the roadmaps of one body (sampled_solve.hpp says what a Body is), for questions that come later.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/error.hpp"
#include "planners/roadmap/build_roadmap.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/roadmaps/roadmap.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "solve/steps/roadmap_session.hpp"

namespace warren {

namespace detail {

inline void add_numbers(Vec2 p, RawVector<double>& numbers) { numbers.insert(numbers.end(), {p.x, p.y}); }
inline void add_numbers(const Se2& p, RawVector<double>& numbers) {
  numbers.insert(numbers.end(), {p.x, p.y, p.theta});
}
template <std::size_t N>
void add_numbers(const std::array<double, N>& q, RawVector<double>& numbers) {
  numbers.insert(numbers.end(), q.begin(), q.end());
}

template <class State>
State state_of(std::span<const double> numbers) {
  if constexpr (std::is_same_v<State, Vec2>) {
    return {numbers[0], numbers[1]};
  } else if constexpr (std::is_same_v<State, Se2>) {
    return {numbers[0], numbers[1], numbers[2]};
  } else {
    State state;
    std::copy_n(numbers.begin(), state.size(), state.begin());
    return state;
  }
}

template <class State>
constexpr unsigned state_width() {
  if constexpr (std::is_same_v<State, Vec2>) return 2;
  if constexpr (std::is_same_v<State, Se2>) return 3;
  return 6;
}

/// The options of the roadmap's planner, as a solve of this body resolves them.
template <class Body>
RoadmapOptions roadmap_options_of(const SolveRequest& request, const Body& body) {
  RoadmapOptions options = planner_options(request.options, request.scene, WallProblem{}).roadmap;
  options.sampler = body.choose_sampler(request.options, options);
  options.attach = body.attach(request.options);
  return options;
}

}  // namespace detail

/// SolveKind::build for a body.
template <class Body>
BuiltArrays build_sampled(const SolveRequest& request) {
  using World = typename Body::World;
  using State = typename World::State;
  const Execution& execution = request.execution;
  const Body body(request);
  const RoadmapOptions options = detail::roadmap_options_of(request, body);
  std::optional<World> world;
  BuiltArrays all;
  {
    const StageTimer timer(execution, "index", all.account.seconds.index);
    body.index(world, options.sampler);
  }
  const bool lazy = request.planner == PlannerKind::lazy_prm;
  BuiltRoadmap<State> built = build_roadmap(*world, options, lazy, execution);
  all.samples = built.samples;
  all.rule = built.rule;
  all.account.counters = built.counters;
  const double index_s = all.account.seconds.index;
  all.account.seconds = built.seconds;
  all.account.seconds.index = index_s;
  RoadmapArrays& arrays = all.arrays;
  arrays.dimension = detail::state_width<State>();
  arrays.directed = edge_directions<World>() == EdgeDirections::one;
  execution.reserve(built.states.size() * arrays.dimension * sizeof(double));
  arrays.states.reserve(built.states.size() * arrays.dimension);
  for (const State& state : built.states) detail::add_numbers(state, arrays.states);
  arrays.candidates = std::move(built.candidates);
  arrays.edge_states = std::move(built.edge_states);
  return all;
}

/// SolveKind::open for a body.
template <class Body>
std::unique_ptr<RoadmapSession> open_sampled(const SolveRequest& request, const RoadmapArrays& arrays,
                                             const ConnectionRule& rule) {
  using World = typename Body::World;
  using State = typename World::State;
  constexpr unsigned width = detail::state_width<State>();
  if (arrays.dimension != width || arrays.directed != (edge_directions<World>() == EdgeDirections::one)) {
    throw InputError("roadmap", "its states are none of the body that it says it is for");
  }
  const Body body(request);
  auto session = std::make_unique<SessionIn<World>>();
  body.index(session->world, detail::roadmap_options_of(request, body).sampler);
  const std::span<const double> numbers(arrays.states);
  RawVector<State> states;
  request.execution.reserve(arrays.states.size() * sizeof(double));
  states.reserve(numbers.size() / width);
  for (std::size_t i = 0; i < numbers.size(); i += width)
    states.push_back(detail::state_of<State>(numbers.subspan(i, width)));
  session->roadmap.emplace(*session->world, std::move(states), arrays.candidates, arrays.edge_states, rule,
                           request.planner == PlannerKind::lazy_prm, request.execution);
  return session;
}

}  // namespace warren
