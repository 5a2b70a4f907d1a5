// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template decltype(one_way_prm<Se2, true>) one_way_prm<Se2, true>;
template decltype(rrt<Se2, true>) rrt<Se2, true>;
template decltype(rrt_connect<Se2, true>) rrt_connect<Se2, true>;
template decltype(anytime<Se2, true>) anytime<Se2, true>;
template decltype(ask_roadmap<AnyWorld<Se2, true>>) ask_roadmap<AnyWorld<Se2, true>>;
template decltype(build_roadmap<Se2, true>) build_roadmap<Se2, true>;
template decltype(shorter_path<Se2, true>) shorter_path<Se2, true>;
template decltype(improved_path<Se2, true>) improved_path<Se2, true>;

}  // namespace warren
