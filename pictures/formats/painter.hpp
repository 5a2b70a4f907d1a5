// SPDX-License-Identifier: BSD-3-Clause
// A picture drawn on a surface, part by part from back to front.
#pragma once

#include <string>
#include <vector>

#include "core/run/execution.hpp"
#include "pictures/formats/surface.hpp"
#include "pictures/model/page.hpp"
#include "pictures/model/picture.hpp"

namespace warren {

/// Groups polygons, walls, edges, search_tree, milestones, path, start, goal and those of the layers, in the world;
/// frame, legend and title around it. Returns what was drawn otherwise than usual, a line each: the picture says it,
/// too, where it has a legend. Throws Stopped.
std::vector<std::string> paint(const Picture& picture, Parts parts, const Page& page, Surface& surface,
                               const Execution& execution);

}  // namespace warren
