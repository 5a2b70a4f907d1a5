// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as two tables: vertices (id,x,y[,theta] or q1..qn,component) and edges (from,to,length,state), one line of
// names above each. Undirected edges stand once, from the smaller vertex.
#pragma once

#include <string>

#include "roadmaps/exports/exported_edges.hpp"

namespace warren {

/// Both files are put in place when both are whole. Throws InputError (a length that is no number), and as OutputFile.
ExportAccount write_roadmap_csv(const ExportedRoadmapView& roadmap, const std::string& vertex_path,
                                const std::string& edge_path, const Execution& execution);

}  // namespace warren
