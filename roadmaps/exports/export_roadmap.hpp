// SPDX-License-Identifier: BSD-3-Clause
// A roadmap for other programs; the ending of the path says in which format, and the format's own head what it holds.
#pragma once

#include <string>
#include <vector>

#include "roadmaps/exports/exported_edges.hpp"

namespace warren {

/// The files that an export to this path writes: the path, and beside X.gr X.co, beside X.csv X.edges.csv. Throws
/// UsageError, which names the endings, for others than .geojson .graphml .gr .csv .npz .dot.
std::vector<std::string> files_of_export(const std::string& path);

/// Writes them: the same bytes for any number of threads. O(V + E); two files are put in place when both are whole.
/// `length` of an edge is called by several threads at once. Throws UsageError (as above, and what a format can't
/// hold), InputError (a length that is no finite number, zero or more), WriteError, Stopped.
ExportAccount export_roadmap(const std::string& path, const RoadmapParts& parts, const VertexDistance& length,
                             const ExportOptions& options, const Execution& execution);

}  // namespace warren
