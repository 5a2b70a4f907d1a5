// SPDX-License-Identifier: BSD-3-Clause
// placeholder
#pragma once

#include "core/solution.hpp"
#include "core/world.hpp"
#include "parallel/execution.hpp"
#include "planners/roadmap.hpp"
#include "planners/roadmap_options.hpp"

namespace warren {

/// Probabilistic roadmap (Kavraki, Svestka, Latombe, Overmars 1996), every candidate edge checked. Never throws
/// Stopped: a deadline gives Outcome::stopped. `keep`, where given, receives the roadmap of the last round.
template <World W>
Solution<typename W::State> prm(const W& world, const typename W::State& start, const typename W::State& goal,
                                const RoadmapOptions& options, const Execution& execution,
                                Roadmap<typename W::State>* keep = nullptr);

}  // namespace warren
