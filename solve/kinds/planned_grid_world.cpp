// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<GridWorld>::Roadmap prm<GridWorld>;
template PlannersOf<GridWorld>::Roadmap lazy_prm<GridWorld>;
template PlannersOf<GridWorld>::Trees rrt<GridWorld>;
template PlannersOf<GridWorld>::Trees rrt_connect<GridWorld>;
template PlannersOf<GridWorld>::Better anytime<GridWorld>;
template PlannersOf<GridWorld>::Ask ask_roadmap<GridWorld>;
template PlannersOf<GridWorld>::Build build_roadmap<GridWorld>;

}  // namespace warren
