// SPDX-License-Identifier: BSD-3-Clause
// The planners, compiled once a kind of state: whoever includes this calls them as they stand in planners/, with the
// view of a world (planners/graph/any_world.hpp), and compiles none of them again, which was half of the work of
// building the library. planned_*.cpp have them: for points, poses, poses whose ways lead one way, and arms.
#pragma once

#include <functional>
#include <span>
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
#include "planners/trees/rrt.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Of a motion, as shortening wants it.
template <class State>
using MotionLength = std::function<double(const State&, const State&)>;

/// shortcut_path() in any world.
template <World W>
Path<typename W::State> shorter_path(const W& world, Path<typename W::State> path,
                                     const MotionLength<typename W::State>& length, const ShortcutOptions& options,
                                     const Execution& execution, Counters& counters) {
  const AnyWorldOf<W>& any = WorldView(world);
  return shortcut_path(any, std::move(path), length, options, execution, counters);
}

/// improve_path() likewise.
template <World W>
Path<typename W::State> improved_path(const W& world, Path<typename W::State> path,
                                      const MotionLength<typename W::State>& length, const ImproveOptions& options,
                                      const Execution& execution, Counters& counters) {
  const AnyWorldOf<W>& any = WorldView(world);
  return improve_path(any, std::move(path), length, options, execution, counters);
}

/// The planners' functions, so that a line names one of a kind of state.
template <class State, bool one_way = false>
struct PlannersOf {
  using Any = AnyWorld<State, one_way>;
  using Roadmap = Solution<State>(const Any&, const State&, const State&, const RoadmapOptions&, const Execution&,
                                  PlannedRoadmap<State>*);
  using OneWay = Solution<State>(const Any&, const State&, const State&, const RoadmapOptions&, bool, const Execution&,
                                 PlannedRoadmap<State>*);
  using Trees = Solution<State>(const Any&, const State&, std::span<const State>, const RrtOptions&, const Execution&,
                                PlannedRoadmap<State>*);
  using Better = AnytimeSolution<State>(const Any&, const State&, std::span<const State>, const AnytimeOptions&,
                                        const AnytimeBody<State>&, const Execution&);
  using Ask = Solution<State>(const AskedRoadmap<Any>&, const State&, const State&, const RoadmapOptions&,
                              const Execution&, AskScratch&, PlannedRoadmap<State>*);
  using Build = BuiltRoadmap<State>(const Any&, const RoadmapOptions&, bool, const Execution&,
                                    const KnownMotions<State>&);
  using Shorter = Path<State>(const Any&, Path<State>, const MotionLength<State>&, const ShortcutOptions&,
                              const Execution&, Counters&);
  using Improved = Path<State>(const Any&, Path<State>, const MotionLength<State>&, const ImproveOptions&,
                               const Execution&, Counters&);
};

extern template PlannersOf<Vec2>::Roadmap prm<Vec2>;
extern template PlannersOf<Vec2>::Roadmap lazy_prm<Vec2>;
extern template PlannersOf<Vec2>::Trees rrt<Vec2, false>;
extern template PlannersOf<Vec2>::Trees rrt_connect<Vec2, false>;
extern template PlannersOf<Vec2>::Better anytime<Vec2, false>;
extern template PlannersOf<Vec2>::Ask ask_roadmap<AnyWorld<Vec2>>;
extern template PlannersOf<Vec2>::Build build_roadmap<Vec2, false>;
extern template PlannersOf<Vec2>::Shorter shortcut_path<AnyWorld<Vec2>>;
extern template PlannersOf<Vec2>::Improved improve_path<AnyWorld<Vec2>>;
extern template PlannersOf<Se2>::Roadmap prm<Se2>;
extern template PlannersOf<Se2>::Roadmap lazy_prm<Se2>;
extern template PlannersOf<Se2>::Trees rrt<Se2, false>;
extern template PlannersOf<Se2>::Trees rrt_connect<Se2, false>;
extern template PlannersOf<Se2>::Better anytime<Se2, false>;
extern template PlannersOf<Se2>::Ask ask_roadmap<AnyWorld<Se2>>;
extern template PlannersOf<Se2>::Build build_roadmap<Se2, false>;
extern template PlannersOf<Se2>::Shorter shortcut_path<AnyWorld<Se2>>;
extern template PlannersOf<Se2>::Improved improve_path<AnyWorld<Se2>>;
extern template PlannersOf<Se2, true>::OneWay one_way_prm<Se2, true>;
extern template PlannersOf<Se2, true>::Trees rrt<Se2, true>;
extern template PlannersOf<Se2, true>::Trees rrt_connect<Se2, true>;
extern template PlannersOf<Se2, true>::Better anytime<Se2, true>;
extern template PlannersOf<Se2, true>::Ask ask_roadmap<AnyWorld<Se2, true>>;
extern template PlannersOf<Se2, true>::Build build_roadmap<Se2, true>;
extern template PlannersOf<Se2, true>::Shorter shortcut_path<AnyWorld<Se2, true>>;
extern template PlannersOf<Se2, true>::Improved improve_path<AnyWorld<Se2, true>>;
extern template PlannersOf<JointState>::Roadmap prm<JointState>;
extern template PlannersOf<JointState>::Roadmap lazy_prm<JointState>;
extern template PlannersOf<JointState>::Trees rrt<JointState, false>;
extern template PlannersOf<JointState>::Trees rrt_connect<JointState, false>;
extern template PlannersOf<JointState>::Better anytime<JointState, false>;
extern template PlannersOf<JointState>::Ask ask_roadmap<AnyWorld<JointState>>;
extern template PlannersOf<JointState>::Build build_roadmap<JointState, false>;
extern template PlannersOf<JointState>::Shorter shortcut_path<AnyWorld<JointState>>;
extern template PlannersOf<JointState>::Improved improve_path<AnyWorld<JointState>>;

}  // namespace warren
