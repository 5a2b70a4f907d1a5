// SPDX-License-Identifier: BSD-3-Clause
// The picture of a comparison of searches: the graph that they searched, and the path of each with its length and the
// vertices that it settled.
#pragma once

#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/model/picture_options.hpp"
#include "scenes/scene/scene.hpp"
#include "studies/contests/search_contest.hpp"
#include "studies/searches/search_graph.hpp"

namespace warren::studies {

/// Writes FOLDER/searches.svg, in a folder that exists. Runs each search once more, within its budget; those that find
/// nothing have no path. Variants of one search that differ in nothing but their queues or library are one path in the
/// legend. Returns what is drawn otherwise than usual, a line each. Throws WriteError, Stopped.
std::vector<std::string> draw_searches(const Scene& scene, const SearchGraph& graph,
                                       const SearchContestOptions& options, const std::string& folder,
                                       const PictureOptions& look, const Execution& execution);

}  // namespace warren::studies
