// SPDX-License-Identifier: BSD-3-Clause
// The planners of every world, compiled once: whoever includes this calls them as they stand in planners/ and compiles
// none of them again, which was half of the work of building the library. One planned_*_world.cpp a world has them.
#pragma once

#include <span>

#include "planners/anytime/anytime.hpp"
#include "planners/roadmap/ask_roadmap.hpp"
#include "planners/roadmap/build_roadmap.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/one_way_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/trees/rrt.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/plane/grid_world.hpp"
#include "worlds/plane/maze_world.hpp"
#include "worlds/plane/polygon_world.hpp"
#include "worlds/poses/car_world.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {

using DubinsWorld = CarWorld<DubinsCurve>;
using ReedsSheppWorld = CarWorld<ReedsSheppCurve>;

/// The planners' functions, so that a line names one of a world.
template <World W>
struct PlannersOf {
  using State = typename W::State;
  using Roadmap = Solution<State>(const W&, const State&, const State&, const RoadmapOptions&, const Execution&,
                                  PlannedRoadmap<State>*);
  using OneWay = Solution<State>(const W&, const State&, const State&, const RoadmapOptions&, bool, const Execution&,
                                 PlannedRoadmap<State>*);
  using Trees = Solution<State>(const W&, const State&, std::span<const State>, const RrtOptions&, const Execution&,
                                PlannedRoadmap<State>*);
  using Better = AnytimeSolution<State>(const W&, const State&, std::span<const State>, const AnytimeOptions&,
                                        const AnytimeBody<State>&, const Execution&);
  using Ask = Solution<State>(const AskedRoadmap<W>&, const State&, const State&, const RoadmapOptions&,
                              const Execution&, AskScratch&, PlannedRoadmap<State>*);
  using Build = BuiltRoadmap<State>(const W&, const RoadmapOptions&, bool, const Execution&,
                                    const KnownMotions<State>&);
};

extern template PlannersOf<MazeWorld>::Roadmap prm<MazeWorld>;
extern template PlannersOf<MazeWorld>::Roadmap lazy_prm<MazeWorld>;
extern template PlannersOf<MazeWorld>::Ask ask_roadmap<MazeWorld>;
extern template PlannersOf<MazeWorld>::Build build_roadmap<MazeWorld>;
extern template PlannersOf<PolygonWorld>::Roadmap prm<PolygonWorld>;
extern template PlannersOf<PolygonWorld>::Roadmap lazy_prm<PolygonWorld>;
extern template PlannersOf<PolygonWorld>::Trees rrt<PolygonWorld>;
extern template PlannersOf<PolygonWorld>::Trees rrt_connect<PolygonWorld>;
extern template PlannersOf<PolygonWorld>::Better anytime<PolygonWorld>;
extern template PlannersOf<PolygonWorld>::Ask ask_roadmap<PolygonWorld>;
extern template PlannersOf<PolygonWorld>::Build build_roadmap<PolygonWorld>;
extern template PlannersOf<GridWorld>::Roadmap prm<GridWorld>;
extern template PlannersOf<GridWorld>::Roadmap lazy_prm<GridWorld>;
extern template PlannersOf<GridWorld>::Trees rrt<GridWorld>;
extern template PlannersOf<GridWorld>::Trees rrt_connect<GridWorld>;
extern template PlannersOf<GridWorld>::Better anytime<GridWorld>;
extern template PlannersOf<GridWorld>::Ask ask_roadmap<GridWorld>;
extern template PlannersOf<GridWorld>::Build build_roadmap<GridWorld>;
extern template PlannersOf<Se2World>::Roadmap prm<Se2World>;
extern template PlannersOf<Se2World>::Roadmap lazy_prm<Se2World>;
extern template PlannersOf<Se2World>::Trees rrt<Se2World>;
extern template PlannersOf<Se2World>::Trees rrt_connect<Se2World>;
extern template PlannersOf<Se2World>::Better anytime<Se2World>;
extern template PlannersOf<Se2World>::Ask ask_roadmap<Se2World>;
extern template PlannersOf<Se2World>::Build build_roadmap<Se2World>;
extern template PlannersOf<ArmWorld>::Roadmap prm<ArmWorld>;
extern template PlannersOf<ArmWorld>::Roadmap lazy_prm<ArmWorld>;
extern template PlannersOf<ArmWorld>::Trees rrt<ArmWorld>;
extern template PlannersOf<ArmWorld>::Trees rrt_connect<ArmWorld>;
extern template PlannersOf<ArmWorld>::Better anytime<ArmWorld>;
extern template PlannersOf<ArmWorld>::Ask ask_roadmap<ArmWorld>;
extern template PlannersOf<ArmWorld>::Build build_roadmap<ArmWorld>;
extern template PlannersOf<DubinsWorld>::OneWay one_way_prm<DubinsWorld>;
extern template PlannersOf<DubinsWorld>::Trees rrt<DubinsWorld>;
extern template PlannersOf<DubinsWorld>::Trees rrt_connect<DubinsWorld>;
extern template PlannersOf<DubinsWorld>::Better anytime<DubinsWorld>;
extern template PlannersOf<DubinsWorld>::Ask ask_roadmap<DubinsWorld>;
extern template PlannersOf<DubinsWorld>::Build build_roadmap<DubinsWorld>;
extern template PlannersOf<ReedsSheppWorld>::OneWay one_way_prm<ReedsSheppWorld>;
extern template PlannersOf<ReedsSheppWorld>::Trees rrt<ReedsSheppWorld>;
extern template PlannersOf<ReedsSheppWorld>::Trees rrt_connect<ReedsSheppWorld>;
extern template PlannersOf<ReedsSheppWorld>::Better anytime<ReedsSheppWorld>;
extern template PlannersOf<ReedsSheppWorld>::Ask ask_roadmap<ReedsSheppWorld>;
extern template PlannersOf<ReedsSheppWorld>::Build build_roadmap<ReedsSheppWorld>;

}  // namespace warren
