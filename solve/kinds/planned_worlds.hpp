// SPDX-License-Identifier: BSD-3-Clause
// The planners, compiled once a kind of state: whoever calls them through planned(), with the view of a world
// (planners/graph/any_world.hpp), compiles none of them again, which was half of the work of building the library.
// planned_*.cpp have them: for points, poses, poses whose ways lead one way, and arms.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>

#include "core/plane/se2.hpp"
#include "planners/anytime/anytime.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/roadmap/ask_roadmap.hpp"
#include "planners/roadmap/build_roadmap.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/one_way_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/shorten/shortcut.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Of a motion, as shortening wants it.
template <class State>
using MotionLength = std::function<double(const State&, const State&)>;

/// prm or lazy_prm, and where ways lead one way one_way_prm.
template <class State, bool one_way>
Solution<State> planned_on_roadmap(const AnyWorld<State, one_way>& world, const State& start, const State& goal,
                                   const RoadmapOptions& options, bool lazy, const Execution& execution,
                                   PlannedRoadmap<State>* keep) {
  if constexpr (one_way) {
    return one_way_prm(world, start, goal, options, lazy, execution, keep);
  } else {
    return (lazy ? lazy_prm<State> : prm<State>)(world, start, goal, options, execution, keep);
  }
}

/// The planners of a kind of state.
template <class State, bool one_way>
struct Planned {
  using Any = AnyWorld<State, one_way>;
  using Length = MotionLength<State>;
  decltype(planned_on_roadmap<State, one_way>)* on_roadmap = planned_on_roadmap<State, one_way>;
  decltype(warren::rrt<State, one_way>)* rrt = warren::rrt<State, one_way>;
  decltype(warren::rrt_connect<State, one_way>)* rrt_connect = warren::rrt_connect<State, one_way>;
  decltype(warren::anytime<State, one_way>)* anytime = warren::anytime<State, one_way>;
  decltype(ask_roadmap<Any>)* ask = ask_roadmap<Any>;
  decltype(build_roadmap<State, one_way>)* build = build_roadmap<State, one_way>;
  decltype(shortcut_path<Any, Length>)* shorter = shortcut_path<Any, Length>;
  decltype(improve_path<Any, Length>)* improved = improve_path<Any, Length>;
};
template <class State, bool one_way = false>
const Planned<State, one_way>& planned() {
  static const Planned<State, one_way> all;
  return all;
}
/// Those for the states of a world.
template <World W>
const auto& planned_in() {
  return planned<typename W::State, is_one_way<W>>();
}
extern template const Planned<Vec2, false>& planned<Vec2, false>();
extern template const Planned<Se2, false>& planned<Se2, false>();
extern template const Planned<Se2, true>& planned<Se2, true>();
extern template const Planned<JointState, false>& planned<JointState, false>();

}  // namespace warren
