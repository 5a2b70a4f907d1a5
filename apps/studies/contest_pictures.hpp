// SPDX-License-Identifier: BSD-3-Clause
// The pictures of a comparison of planners: for each contender the run whose path is of median length, with its roadmap
// or tree, its path and the body along it; and the pages that a planner adds (the layers of some headings); and
// one figure of all these paths, in which none hides another.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/studies/planner_contest.hpp"
#include "apps/studies/search_contest.hpp"
#include "core/plane/polygon.hpp"
#include "pictures/model/picture_options.hpp"

namespace warren::studies {

/// Writes FOLDER/NAME.svg, NAME a contender's planner and options ("prm_samples_50"), and paths.svg. The folder must
/// exist. Solves each of the runs once more. A map's scene has its border walls. Returns what is drawn otherwise than
/// usual, a line each. Throws WriteError, Stopped.
std::vector<std::string> draw_contest(const Scene& scene, const PlannerContestOptions& options,
                                      const Comparison& comparison, const std::string& folder,
                                      const PictureOptions& look, const Execution& execution);

/// A text as part of a file's name: letters and digits as they are, and dashes; all else as one `between`, but at the
/// ends.
std::string file_name(std::string_view text, char between = '_');

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

// Paths that share parts, drawn so that none hides another: where several run along the same stretch they take turns in
// dashes, elsewhere each is a line.

/// For each path the chains that show it; all of them together cover every path. Stretches are shared in either
/// direction, wherever the paths' corners are; all lies on a raster of 2^-14 of the paths' extent, so what is nearer
/// than that is the same. dash > 0: about how long a dash is, world units. O(legs · log + dashes) where legs are short
/// or run along the axes; a long slanted one is held against the corners in its columns or rows. Throws Stopped.
std::vector<PolygonSet> lines_side_by_side(std::span<const std::vector<Vec2>> paths, double dash,
                                           const Execution& execution);

}  // namespace warren::studies
