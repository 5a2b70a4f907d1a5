// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<DubinsWorld>::OneWay one_way_prm<DubinsWorld>;
template PlannersOf<DubinsWorld>::Trees rrt<DubinsWorld>;
template PlannersOf<DubinsWorld>::Trees rrt_connect<DubinsWorld>;
template PlannersOf<DubinsWorld>::Better anytime<DubinsWorld>;
template PlannersOf<DubinsWorld>::Ask ask_roadmap<DubinsWorld>;
template PlannersOf<DubinsWorld>::Build build_roadmap<DubinsWorld>;

}  // namespace warren
