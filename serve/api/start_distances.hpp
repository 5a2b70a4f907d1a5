// SPDX-License-Identifier: BSD-3-Clause
// How far the milestones of a roadmap are from a start, along its free edges: what a layer of the service colours.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/execution.hpp"
#include "serve/tiles/step_tile.hpp"
#include "solve/roadmaps/roadmap_query.hpp"

namespace warren::serve {

/// Of a milestone that the start does not reach, beside the steps' own numbers.
inline constexpr std::uint8_t unreached_ink = step_inks.size();

struct StartDistances {
  std::vector<std::uint8_t> inks;  ///< one a milestone: the step of its distance, or unreached_ink
  Steps steps;
  std::uint64_t reached = 0;
  double farthest = 0.0;  ///< 0 where none is reached
};

/// Of points and discs in a roadmap whose edges are checked, by one search from the start, which is linked as a
/// question links it. start: two numbers. Throws UsageError where the body does not fit there or the roadmap is another
/// one, InputError, Stopped.
StartDistances start_distances(const RoadmapQuery& query, const std::vector<double>& start, const Execution& execution);

}  // namespace warren::serve
