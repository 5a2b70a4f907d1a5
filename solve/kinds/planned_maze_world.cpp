// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template PlannersOf<MazeWorld>::Roadmap prm<MazeWorld>;
template PlannersOf<MazeWorld>::Roadmap lazy_prm<MazeWorld>;
template PlannersOf<MazeWorld>::Ask ask_roadmap<MazeWorld>;
template PlannersOf<MazeWorld>::Build build_roadmap<MazeWorld>;

}  // namespace warren
