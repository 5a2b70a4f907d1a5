// SPDX-License-Identifier: BSD-3-Clause
// Holds the arrays of a roadmap against what roadmap_parts.hpp promises, so that nobody who reads them afterwards can
// look beyond an array or go round for ever, whoever made them: right checksums prove nothing about meaning.
//
// First the sizes, then every element in parallel, each rule in a pass of its own and each pass only over what the ones
// before it have found sound. An edge's other end is found by a search in its row, from the lower vertex alone: where
// each of these has its twin and both kinds are as many, all have one. Components are computed again from the free
// edges by a lock-free union and compared. O(V + E log degree) time; memory: 4 bytes a vertex.
#pragma once

#include <string>

#include "parallel/execution.hpp"
#include "roadmaps/graph/roadmap_parts.hpp"

namespace warren {

/// Throws InputError, which names the array, the first element that breaks its rule and what it is, as part of `where`;
/// Stopped. The same error for any number of threads.
void check_parts(const RoadmapParts& parts, const std::string& where, const Execution& execution);

}  // namespace warren
