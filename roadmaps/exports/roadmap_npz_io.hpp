// SPDX-License-Identifier: BSD-3-Clause
// A roadmap for SciPy and NumPy: the matrix of lengths in compressed rows as scipy.sparse.load_npz reads it (indices,
// indptr, format, shape, data; both ways of an undirected edge), and by numpy.load also `states` (vertex_count x
// dimension), `component`, and where unchecked edges are asked for `edge_states`, one a length: 0 unchecked, 1 free.
#pragma once

#include <string>

#include "roadmaps/exports/exported_edges.hpp"

namespace warren {

/// Throws InputError (a length that is no number), and as OutputFile.
ExportAccount write_roadmap_npz(const ExportedRoadmapView& roadmap, const std::string& path,
                                const Execution& execution);

}  // namespace warren
