// SPDX-License-Identifier: BSD-3-Clause
// A roadmap in the formats of the 9th DIMACS implementation challenge (shortest paths, 2006): arcs with whole weights
// (.gr) and whole coordinates (.co), vertices numbered from 1. Undirected edges are two arcs. Comment lines name the
// units (binary_unit.hpp). Of a state the plane's x and y are written, of an arm's all joints.
#pragma once

#include <string>

#include "roadmaps/exports/exported_edges.hpp"

namespace warren {

/// Both files are put in place when both are whole. Computes each length twice, first to find the longest. Throws
/// InputError (a length that is no number), and as OutputFile.
ExportAccount write_roadmap_dimacs(const ExportedRoadmapView& roadmap, const std::string& arc_path,
                                   const std::string& coordinate_path, const Execution& execution);

}  // namespace warren
