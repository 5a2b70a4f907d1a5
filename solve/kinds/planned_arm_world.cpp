// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<ArmWorld>::Roadmap prm<ArmWorld>;
template PlannersOf<ArmWorld>::Roadmap lazy_prm<ArmWorld>;
template PlannersOf<ArmWorld>::Trees rrt<ArmWorld>;
template PlannersOf<ArmWorld>::Trees rrt_connect<ArmWorld>;
template PlannersOf<ArmWorld>::Better anytime<ArmWorld>;
template PlannersOf<ArmWorld>::Ask ask_roadmap<ArmWorld>;
template PlannersOf<ArmWorld>::Build build_roadmap<ArmWorld>;

}  // namespace warren
