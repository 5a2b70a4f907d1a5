// SPDX-License-Identifier: BSD-3-Clause
// A graph in the plane with a question: what `warren compare` runs its searches on. Anything that can give one is a
// source of graphs; random geometric graphs of any size are the one that needs no world.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/types.hpp"
#include "core/search/graph.hpp"
#include "parallel/execution.hpp"

namespace warren::studies {

struct SearchGraph {
  std::string source;                                        ///< "maze:41x41", "geometric:300"
  std::string kind;                                          ///< whose graph it is: a planner's name, or "geometric"
  std::vector<std::pair<std::string, std::string>> options;  ///< how it was made: name, value as JSON
  Graph graph;                                               ///< with lengths, world units
  std::vector<Vec2> at;
  VertexId start = 0;
  VertexId goal = 0;
  std::string unit = {};  ///< of lengths: "m" or "cells"; empty: nobody says
};

/// The same edges with the straight distances between their ends as lengths. O(V + E).
Graph with_plane_lengths(const Graph& graph, const std::vector<Vec2>& at);

/// `size` points drawn uniformly from a square of area `size` (so that their density is the same at any size), joined
/// where no farther apart than the radius whose disc holds `degree` points on average. Start and goal are those nearest
/// to the lower left and upper right corner among the vertices of the largest component. Vertices in tile order; a pure
/// function of the arguments. size 2 .. 2^31, degree > 0. O(size · degree). Throws Stopped, InputError for 2^32 edge
/// ends.
SearchGraph geometric_graph(std::uint32_t size, double degree, std::uint64_t seed, const Execution& execution);

}  // namespace warren::studies
