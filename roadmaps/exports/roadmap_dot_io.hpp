// SPDX-License-Identifier: BSD-3-Clause
// A roadmap for Graphviz: `neato -n roadmap.dot -Tsvg`. Vertices stand where they are (pos, with ! so that neato leaves
// them there), edges have their length (len), unchecked ones are dashed. Headings and joints are attributes by their
// names; an arm's vertices have no pos.
#pragma once

#include <string>

#include "roadmaps/exports/exported_edges.hpp"

namespace warren {

/// Throws InputError (a length that is no number), and as OutputFile.
ExportAccount write_roadmap_dot(const ExportedRoadmapView& roadmap, const std::string& path,
                                const Execution& execution);

}  // namespace warren
