// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<Se2, true>::OneWay one_way_prm<Se2, true>;
template PlannersOf<Se2, true>::Trees rrt<Se2, true>;
template PlannersOf<Se2, true>::Trees rrt_connect<Se2, true>;
template PlannersOf<Se2, true>::Better anytime<Se2, true>;
template PlannersOf<Se2, true>::Ask ask_roadmap<AnyWorld<Se2, true>>;
template PlannersOf<Se2, true>::Build build_roadmap<Se2, true>;
template PlannersOf<Se2, true>::Shorter shortcut_path<AnyWorld<Se2, true>>;
template PlannersOf<Se2, true>::Improved improve_path<AnyWorld<Se2, true>>;

}  // namespace warren
