// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<PolygonWorld>::Roadmap prm<PolygonWorld>;
template PlannersOf<PolygonWorld>::Roadmap lazy_prm<PolygonWorld>;
template PlannersOf<PolygonWorld>::Trees rrt<PolygonWorld>;
template PlannersOf<PolygonWorld>::Trees rrt_connect<PolygonWorld>;
template PlannersOf<PolygonWorld>::Better anytime<PolygonWorld>;
template PlannersOf<PolygonWorld>::Ask ask_roadmap<PolygonWorld>;
template PlannersOf<PolygonWorld>::Build build_roadmap<PolygonWorld>;

}  // namespace warren
