// SPDX-License-Identifier: BSD-3-Clause
// The planners, compiled once a kind of state: whoever includes this calls them as they stand in planners/, with the
// view of a world (planners/graph/any_world.hpp), and compiles none of them again, which was half of the work of
// building the library. planned_*.cpp have them: for points, poses, poses whose ways lead one way, and arms.
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

/// shortcut_path() and improve_path().
template <class State, bool one_way>
Path<State> shorter_path(const AnyWorld<State, one_way>& world, Path<State> path,
                         const MotionLength<std::type_identity_t<State>>& length, const ShortcutOptions& options,
                         const Execution& execution, Counters& counters) {
  return shortcut_path(world, std::move(path), length, options, execution, counters);
}
template <class State, bool one_way>
Path<State> improved_path(const AnyWorld<State, one_way>& world, Path<State> path,
                          const MotionLength<std::type_identity_t<State>>& length, const ImproveOptions& options,
                          const Execution& execution, Counters& counters) {
  return improve_path(world, std::move(path), length, options, execution, counters);
}

extern template decltype(prm<Vec2>) prm<Vec2>;
extern template decltype(lazy_prm<Vec2>) lazy_prm<Vec2>;
extern template decltype(rrt<Vec2, false>) rrt<Vec2, false>;
extern template decltype(rrt_connect<Vec2, false>) rrt_connect<Vec2, false>;
extern template decltype(anytime<Vec2, false>) anytime<Vec2, false>;
extern template decltype(ask_roadmap<AnyWorld<Vec2>>) ask_roadmap<AnyWorld<Vec2>>;
extern template decltype(build_roadmap<Vec2, false>) build_roadmap<Vec2, false>;
extern template decltype(shorter_path<Vec2, false>) shorter_path<Vec2, false>;
extern template decltype(improved_path<Vec2, false>) improved_path<Vec2, false>;
extern template decltype(prm<Se2>) prm<Se2>;
extern template decltype(lazy_prm<Se2>) lazy_prm<Se2>;
extern template decltype(rrt<Se2, false>) rrt<Se2, false>;
extern template decltype(rrt_connect<Se2, false>) rrt_connect<Se2, false>;
extern template decltype(anytime<Se2, false>) anytime<Se2, false>;
extern template decltype(ask_roadmap<AnyWorld<Se2>>) ask_roadmap<AnyWorld<Se2>>;
extern template decltype(build_roadmap<Se2, false>) build_roadmap<Se2, false>;
extern template decltype(shorter_path<Se2, false>) shorter_path<Se2, false>;
extern template decltype(improved_path<Se2, false>) improved_path<Se2, false>;
extern template decltype(one_way_prm<Se2, true>) one_way_prm<Se2, true>;
extern template decltype(rrt<Se2, true>) rrt<Se2, true>;
extern template decltype(rrt_connect<Se2, true>) rrt_connect<Se2, true>;
extern template decltype(anytime<Se2, true>) anytime<Se2, true>;
extern template decltype(ask_roadmap<AnyWorld<Se2, true>>) ask_roadmap<AnyWorld<Se2, true>>;
extern template decltype(build_roadmap<Se2, true>) build_roadmap<Se2, true>;
extern template decltype(shorter_path<Se2, true>) shorter_path<Se2, true>;
extern template decltype(improved_path<Se2, true>) improved_path<Se2, true>;
extern template decltype(prm<JointState>) prm<JointState>;
extern template decltype(lazy_prm<JointState>) lazy_prm<JointState>;
extern template decltype(rrt<JointState, false>) rrt<JointState, false>;
extern template decltype(rrt_connect<JointState, false>) rrt_connect<JointState, false>;
extern template decltype(anytime<JointState, false>) anytime<JointState, false>;
extern template decltype(ask_roadmap<AnyWorld<JointState>>) ask_roadmap<AnyWorld<JointState>>;
extern template decltype(build_roadmap<JointState, false>) build_roadmap<JointState, false>;
extern template decltype(shorter_path<JointState, false>) shorter_path<JointState, false>;
extern template decltype(improved_path<JointState, false>) improved_path<JointState, false>;

}  // namespace warren
