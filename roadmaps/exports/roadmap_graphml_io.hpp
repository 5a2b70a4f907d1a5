// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as GraphML: nodes with x, y, theta or q1..qn and component, edges with length and, where they are
// unchecked, state ("free" is its default). http://graphml.graphdrawing.org
#pragma once

#include <string>

#include "roadmaps/exports/exported_edges.hpp"

namespace warren {

/// Throws InputError (a length that is no number), and as OutputFile.
ExportAccount write_roadmap_graphml(const ExportedRoadmapView& roadmap, const std::string& path,
                                    const Execution& execution);

}  // namespace warren
