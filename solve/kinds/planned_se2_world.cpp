// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<Se2World>::Roadmap prm<Se2World>;
template PlannersOf<Se2World>::Roadmap lazy_prm<Se2World>;
template PlannersOf<Se2World>::Trees rrt<Se2World>;
template PlannersOf<Se2World>::Trees rrt_connect<Se2World>;
template PlannersOf<Se2World>::Better anytime<Se2World>;
template PlannersOf<Se2World>::Ask ask_roadmap<Se2World>;
template PlannersOf<Se2World>::Build build_roadmap<Se2World>;

}  // namespace warren
