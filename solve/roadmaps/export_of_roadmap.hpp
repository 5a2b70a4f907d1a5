// SPDX-License-Identifier: BSD-3-Clause
// A roadmap in the words of other programs (roadmaps/exports), with the lengths that its world's metric gives its
// edges.
#pragma once

#include <string>

#include "parallel/execution.hpp"
#include "roadmaps/exports/export_roadmap.hpp"
#include "solve/roadmaps/roadmap.hpp"

namespace warren {

/// By the file's ending. Throws UsageError for other endings and for what a format can't hold, WriteError, Stopped.
ExportAccount export_of_roadmap(const Roadmap& roadmap, const std::string& path, const ExportOptions& options = {},
                                const Execution& execution = {});

/// The states of a lattice and its free edges. Throws Stopped.
RoadmapArrays arrays_of(const LatticePassages& passages, const Execution& execution);

}  // namespace warren
