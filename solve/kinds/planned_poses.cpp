// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<Se2>::Roadmap prm<Se2>;
template PlannersOf<Se2>::Roadmap lazy_prm<Se2>;
template PlannersOf<Se2>::Trees rrt<Se2, false>;
template PlannersOf<Se2>::Trees rrt_connect<Se2, false>;
template PlannersOf<Se2>::Better anytime<Se2, false>;
template PlannersOf<Se2>::Ask ask_roadmap<AnyWorld<Se2>>;
template PlannersOf<Se2>::Build build_roadmap<Se2, false>;
template PlannersOf<Se2>::Shorter shortcut_path<AnyWorld<Se2>>;
template PlannersOf<Se2>::Improved improve_path<AnyWorld<Se2>>;

}  // namespace warren
