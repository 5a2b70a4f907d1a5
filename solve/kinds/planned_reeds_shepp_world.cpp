// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<ReedsSheppWorld>::OneWay one_way_prm<ReedsSheppWorld>;
template PlannersOf<ReedsSheppWorld>::Trees rrt<ReedsSheppWorld>;
template PlannersOf<ReedsSheppWorld>::Trees rrt_connect<ReedsSheppWorld>;
template PlannersOf<ReedsSheppWorld>::Better anytime<ReedsSheppWorld>;
template PlannersOf<ReedsSheppWorld>::Ask ask_roadmap<ReedsSheppWorld>;
template PlannersOf<ReedsSheppWorld>::Build build_roadmap<ReedsSheppWorld>;

}  // namespace warren
