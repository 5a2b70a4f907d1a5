// SPDX-License-Identifier: BSD-3-Clause
// The maze of the algorithm mst: the minimum spanning tree of the unit grid with the weights of spanning_tile.hpp, and
// the walls of any tile of it by itself. The same maze whatever the tiles and threads.
//
// Made in levels. A tile's tree (spanning_tile.hpp) is said in edges between cells of its rim; 8 x 8 neighbours are
// joined by Kruskal's algorithm over these and the edges between them, then 8 x 8 such groups, until one is left. An
// edge that a level refuses is in no tree of the whole; one that joins two parts of which one does not reach the
// group's rim is in it; the others the next level decides. What is kept is where the whole differs from the trees of
// the tiles, and how each tile's own contested edges were decided: 0.11 bytes a cell at side 256.
//
// Cost: as SpanningTile, and 2 ns of CPU a cell for the levels; 8 ns of CPU a cell to make a tile again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/packed_values.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "scenes/mazes/spanning_tile.hpp"

namespace warren::maze {

/// Rectangles of the unit grid that are decided but for what their rims stand for, joined to larger ones: a step of
/// SpanningMaze. Kruskal's algorithm over the parts' rim edges and the edges between the parts. A rectangle of tiles
/// whose inner edges are decided but for those that its rim stands for.
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

namespace warren {

/// Throws InputError for sizes and loops that SpanningMaze does not take.
void check_spanning_maze(std::uint32_t rows, std::uint32_t cols, double loops);

/// Rows of tiles first .. last - 1.
struct TileRows {
  std::size_t first, last;
};

class SpanningMaze : public CellWallSource {
 public:
  /// Of rows and columns: the sides of the 64 parts that are joined last have fewer than 2^32 cells.
  static constexpr std::uint32_t most_side = (1U << 27U) - 1;

  /// loops: the probability, 0 to 1, that a wall between two cells which the tree leaves is taken out. Throws
  /// InputError for sizes and loops out of range, Stopped at the deadline or before memory would pass its limit. kept:
  /// takes the trees of finished groups, and has those of an earlier run.
  SpanningMaze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops, const Execution& execution,
               unsigned side_log2 = 8, KeptParts* kept = nullptr);
  /// Some rows of tiles alone, at least one, whose tiles can be read when turn() was told what the rest of the maze
  /// makes of them. rim: receives what they say to it.
  SpanningMaze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops, TileRows own,
               maze::RimPart& rim, const Execution& execution, unsigned side_log2 = 8);
  /// Edges in which the whole differs from the tiles' trees (maze::JoinedParts), of the own tiles and those below.
  void turn(std::span<const std::uint64_t> edges);
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;
  class Builder;
  maze::GridPiece piece(std::size_t tile) const;

  std::uint64_t seed_;
  maze::LoopDraw loops_;
  /// By tile, the edges in which the whole differs from the tile's tree: those inside it that are not in the whole, and
  /// those that leave it to the right or above and are. 2 * (row * 256 + col) + direction.
  std::vector<std::vector<std::uint32_t>> turned_;
  std::vector<std::vector<std::uint64_t>> choices_;  ///< by tile: with these it is made again in a fourth of the time
};

}  // namespace warren
