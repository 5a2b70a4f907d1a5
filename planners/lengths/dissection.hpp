// SPDX-License-Identifier: BSD-3-Clause
// Nested dissection of the core: the map is cut in two by few junctions (planners/lengths/dissection.cpp), the
// parts again, until they have no more than a leaf's junctions. Nodes are the cuts and the leaves, listed children
// first; a node's junctions have chains to its own, to those of its descendants and of its ancestors only.
//
// Large regions are cut one beside the other, the small ones whole by one thread each. Which is large follows from the
// number of junctions, and all parts are joined in their order, so the result is the same for any thread count.
// Cost: O(junctions log junctions); about 60 bytes a junction of the regions being cut.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "planners/lengths/core_graph.hpp"

namespace warren {

struct DissectionNode {
  std::uint32_t members;   ///< how many of the junctions are its own
  std::uint32_t children;  ///< nodes right below it, listed before it
  std::uint32_t is_leaf;   ///< 1: what is left between cuts
};

struct Dissection {
  RawVector<DissectionNode> node;  ///< children before parents
  RawVector<JunctionId> member;    ///< node by node, ascending in each
};

/// The most junctions of a leaf: a way through so many is told by less than 63 bits
/// (planners/lengths/separator_fronts.hpp).
inline constexpr std::size_t most_leaf_junctions = 36;

/// leaf: 1 .. most_leaf_junctions. Throws Stopped.
Dissection dissect(const CoreGraph& graph, std::size_t leaf, const Execution& execution);

}  // namespace warren
