// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template decltype(prm<JointState>) prm<JointState>;
template decltype(lazy_prm<JointState>) lazy_prm<JointState>;
template decltype(rrt<JointState, false>) rrt<JointState, false>;
template decltype(rrt_connect<JointState, false>) rrt_connect<JointState, false>;
template decltype(anytime<JointState, false>) anytime<JointState, false>;
template decltype(ask_roadmap<AnyWorld<JointState>>) ask_roadmap<AnyWorld<JointState>>;
template decltype(build_roadmap<JointState, false>) build_roadmap<JointState, false>;
template decltype(shorter_path<JointState, false>) shorter_path<JointState, false>;
template decltype(improved_path<JointState, false>) improved_path<JointState, false>;

}  // namespace warren
