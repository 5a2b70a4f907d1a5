// SPDX-License-Identifier: BSD-3-Clause
// A roadmap for other programs; the ending of the path says in which format, and the format's own head what it holds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/run/execution.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "solve/kept/roadmap.hpp"

namespace warren {

/// What is written.
struct ExportOptions {
  bool with_unchecked = false;  ///< edges that nobody has asked about, too; else free ones alone
  std::string frame = "map";    ///< of the coordinates, for .geojson: a frame that Nav2 knows
};

/// What was written and what was not. An edge that leads both ways is one.
struct ExportAccount {
  std::uint64_t vertices = 0;            ///< all of them
  std::uint64_t edges = 0;               ///< those that are written
  std::uint64_t unchecked_left_out = 0;  ///< edges that nobody has asked about
  std::uint64_t blocked_left_out = 0;    ///< edges that are not free
  friend bool operator==(const ExportAccount&, const ExportAccount&) = default;
};

/// The files that an export to this path writes: the path, and beside X.gr X.co, beside X.csv X.edges.csv. Throws
/// UsageError, which names the endings, for others than .geojson .graphml .gr .csv .npz .dot.
std::vector<std::string> files_of_export(const std::string& path);

/// Writes them: the same bytes for any number of threads. O(V + E); two files are put in place when both are whole.
/// `length` of an edge is called by several threads at once. Throws UsageError (as above, and what a format can't
/// hold), InputError (a length that is no finite number, zero or more), WriteError, Stopped.
ExportAccount export_roadmap(const std::string& path, const RoadmapParts& parts, const VertexDistance& length,
                             const ExportOptions& options, const Execution& execution);

/// With the lengths that its world's metric gives its edges, by the file's ending. Throws UsageError for other endings
/// and for what a format can't hold, WriteError, Stopped.
ExportAccount export_of_roadmap(const Roadmap& roadmap, const std::string& path, const ExportOptions& options = {},
                                const Execution& execution = {});

/// The states of a lattice and its free edges. Throws Stopped.
RoadmapArrays arrays_of(const LatticePassages& passages, const Execution& execution);

}  // namespace warren
