// SPDX-License-Identifier: BSD-3-Clause
// The pictures of a comparison of planners: for each contender the run whose path is of median length, with its roadmap
// or tree, its path and the body along it; and the pages that a planner adds (the layers of some headings); and
// one figure of all these paths.
#pragma once

#include <string>
#include <vector>

#include "apps/studies/comparison.hpp"
#include "apps/studies/planner_contest.hpp"
#include "apps/studies/search_contest.hpp"
#include "apps/studies/search_graph.hpp"
#include "core/run/execution.hpp"
#include "pictures/model/picture_options.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::studies {

/// Writes FOLDER/NAME.svg, NAME a contender's planner and options ("prm_samples_50"), and paths.svg. The folder must
/// exist. Solves each of the runs once more. A map's scene has its border walls. Returns what is drawn otherwise than
/// usual, a line each. Throws WriteError, Stopped.
std::vector<std::string> draw_contest(const Scene& scene, const PlannerContestOptions& options,
                                      const Comparison& comparison, const std::string& folder,
                                      const Execution& execution);

/// Makes the folder where there is none; throws WriteError where that fails or it can't be written in.
void make_folder(const std::string& folder);

// The picture of a comparison of searches: the graph that they searched, and the path of each with its length and the
// vertices that it settled.

/// Writes FOLDER/searches.svg, in a folder that exists. Runs each search once more, within its budget; those that find
/// nothing have no path. Variants of one search that differ in nothing but their queues or library are one path in the
/// legend. Returns what is drawn otherwise than usual, a line each. Throws WriteError, Stopped.
std::vector<std::string> draw_searches(const Scene& scene, const SearchGraph& graph,
                                       const SearchContestOptions& options, const std::string& folder,
                                       const PictureOptions& look, const Execution& execution);

}  // namespace warren::studies
