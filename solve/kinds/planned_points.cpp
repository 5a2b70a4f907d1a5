// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<Vec2>::Roadmap prm<Vec2>;
template PlannersOf<Vec2>::Roadmap lazy_prm<Vec2>;
template PlannersOf<Vec2>::Trees rrt<Vec2, false>;
template PlannersOf<Vec2>::Trees rrt_connect<Vec2, false>;
template PlannersOf<Vec2>::Better anytime<Vec2, false>;
template PlannersOf<Vec2>::Ask ask_roadmap<AnyWorld<Vec2>>;
template PlannersOf<Vec2>::Build build_roadmap<Vec2, false>;
template PlannersOf<Vec2>::Shorter shortcut_path<AnyWorld<Vec2>>;
template PlannersOf<Vec2>::Improved improve_path<AnyWorld<Vec2>>;

}  // namespace warren
