// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<JointState>::Roadmap prm<JointState>;
template PlannersOf<JointState>::Roadmap lazy_prm<JointState>;
template PlannersOf<JointState>::Trees rrt<JointState, false>;
template PlannersOf<JointState>::Trees rrt_connect<JointState, false>;
template PlannersOf<JointState>::Better anytime<JointState, false>;
template PlannersOf<JointState>::Ask ask_roadmap<AnyWorld<JointState>>;
template PlannersOf<JointState>::Build build_roadmap<JointState, false>;
template PlannersOf<JointState>::Shorter shortcut_path<AnyWorld<JointState>>;
template PlannersOf<JointState>::Improved improve_path<AnyWorld<JointState>>;

}  // namespace warren
