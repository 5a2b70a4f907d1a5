// SPDX-License-Identifier: BSD-3-Clause
// Rectangles of the unit grid that are decided but for what their rims stand for, joined to larger ones: a step of
// spanning_maze.hpp. Kruskal's algorithm over the parts' rim edges and the edges between the parts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/packed_values.hpp"
#include "parallel/execution.hpp"
#include "scenes/mazes/grid_edges.hpp"
#include "scenes/mazes/spanning_tile.hpp"

namespace warren::maze {

/// A rectangle of tiles whose inner edges are decided but for those that its rim stands for.
struct RimPart {
  GridPiece at{};
  std::vector<RimEdge> edges;

  void pack(ValuePacker& to) const;
  static RimPart unpack(ValueUnpacker& from);
};

struct JoinedParts {
  RimPart whole;
  /// Edges that are decided now, and in which the whole maze differs from its tiles' trees: those inside a tile that
  /// are out, and those between tiles that are in.
  std::vector<std::uint64_t> turned;
};

/// parts: a rectangle of them, `cols` a row; their edges are used up. side_log2: of the tiles. Throws Stopped.
JoinedParts join_parts(std::uint64_t seed, std::span<RimPart> parts, std::size_t cols, unsigned side_log2,
                       const Execution& execution);

}  // namespace warren::maze
