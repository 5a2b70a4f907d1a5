// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template decltype(prm<Vec2>) prm<Vec2>;
template decltype(lazy_prm<Vec2>) lazy_prm<Vec2>;
template decltype(rrt<Vec2, false>) rrt<Vec2, false>;
template decltype(rrt_connect<Vec2, false>) rrt_connect<Vec2, false>;
template decltype(anytime<Vec2, false>) anytime<Vec2, false>;
template decltype(ask_roadmap<AnyWorld<Vec2>>) ask_roadmap<AnyWorld<Vec2>>;
template decltype(build_roadmap<Vec2, false>) build_roadmap<Vec2, false>;
template decltype(shorter_path<Vec2, false>) shorter_path<Vec2, false>;
template decltype(improved_path<Vec2, false>) improved_path<Vec2, false>;

}  // namespace warren
