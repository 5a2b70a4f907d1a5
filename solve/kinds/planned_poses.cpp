// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template decltype(prm<Se2>) prm<Se2>;
template decltype(lazy_prm<Se2>) lazy_prm<Se2>;
template decltype(rrt<Se2, false>) rrt<Se2, false>;
template decltype(rrt_connect<Se2, false>) rrt_connect<Se2, false>;
template decltype(anytime<Se2, false>) anytime<Se2, false>;
template decltype(ask_roadmap<AnyWorld<Se2>>) ask_roadmap<AnyWorld<Se2>>;
template decltype(build_roadmap<Se2, false>) build_roadmap<Se2, false>;
template decltype(shorter_path<Se2, false>) shorter_path<Se2, false>;
template decltype(improved_path<Se2, false>) improved_path<Se2, false>;

}  // namespace warren
