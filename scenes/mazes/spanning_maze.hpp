// SPDX-License-Identifier: BSD-3-Clause
// The maze of the algorithm mst: the minimum spanning tree of the unit grid with the weights of EdgeWeights, and the
// walls of any tile of it by itself. The same maze whatever the tiles and threads.
//
// The tree of one tile, and what it says to the tiles around it. Most edges are decided where they stand: the least
// edge of a cell is in the tree, the greatest of the four around a corner is not. The first are contracted; Kruskal's
// algorithm decides the rest, about 0.55 of the two edges a cell, sorted by radix. Weights are looked at as 32 bits
// first; where that many tie, nothing is decided early and the sort looks at all 64.
//
// To the rest of the maze a tile is its rim: cells with a neighbour beyond. Two parts of the tree that both hold rim
// cells and are joined by an edge of weight w can't be told from two rim cells, one of each, joined by an edge of that
// weight: so the tile stands for as many edges as rim cells, less one, and each decides about one edge of the tree. For
// that, parts with rim cells must join in the order of their weights: cells of the rim are not contracted. (A path
// through a contracted part has no edge in it that is heavier than those by which it comes and goes, so contraction
// hides no bottleneck.)
//
// The whole is made in levels. A tile's tree is said in edges between cells of its rim; 8 x 8 neighbours are joined by
// Kruskal's algorithm over these and the edges between them, then 8 x 8 such groups, until one is left. An edge that a
// level refuses is in no tree of the whole; one that joins two parts of which one does not reach the group's rim is in
// it; the others the next level decides. What is kept is where the whole differs from the trees of the tiles, and how
// each tile's own contested edges were decided: 0.11 bytes a cell at side 256.
//
// Cost: of a tile about 20 ns of CPU a cell and 1.3 MB of scratch at side 256, 2 ns of CPU a cell for the levels; 8 ns
// of CPU a cell to make a tile again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/packed_values.hpp"
#include "core/base/rng.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"

namespace warren::maze {
// The weights of the unit grid's edges, of which the algorithm mst makes mazes: a pure function of seed and edge, so
// that any part of a maze can be made by itself. The edge from cell (col, row), from 0, to its right (0) or upper (1)
// neighbour has the number row * 2^32 + 2 * col + direction, whatever the size of the maze. Weights of a seed are all
// different: each step from number to weight is a bijection of 64-bit numbers.

constexpr std::uint64_t edge_number(std::uint64_t col, std::uint64_t row, unsigned direction) {
  return row << 32 | col << 1 | direction;
}
constexpr std::uint32_t edge_col(std::uint64_t number) { return static_cast<std::uint32_t>(number) >> 1; }
constexpr std::uint32_t edge_row(std::uint64_t number) { return static_cast<std::uint32_t>(number >> 32); }
constexpr unsigned edge_direction(std::uint64_t number) { return static_cast<unsigned>(number & 1); }

class EdgeWeights {
 public:
  explicit constexpr EdgeWeights(std::uint64_t seed) : begin_(mix64(seed + golden)) {}
  constexpr std::uint64_t operator()(std::uint64_t number) const { return mix64(begin_ + golden * (number + 1)); }

 private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
  std::uint64_t begin_;
};

/// A rectangle of cells, and on which sides (bits: 1 right, 2 above, 4 left, 8 below) the maze goes on. The cells of
/// its four sides have numbers below 2 (width + height).
struct GridPiece {
  std::uint32_t first_col, first_row, width, height;
  unsigned more;

  bool on_rim(std::uint32_t col, std::uint32_t row) const {
    return (((more & 1U) != 0) && col + 1 == width) || (((more & 2U) != 0) && row + 1 == height) ||
           (((more & 4U) != 0) && col == 0) || (((more & 8U) != 0) && row == 0);
  }
  /// Of a cell on a side, counted from the piece's first column and row.
  std::uint32_t side_number(std::uint32_t col, std::uint32_t row) const {
    if (row == 0) return col;
    if (row + 1 == height) return width + col;
    return 2 * width + (col == 0 ? row : height + row);
  }
  /// Calls visit(col, row) with each cell of a side; with corners twice.
  template <class Visit>
  void each_on_sides(const Visit& visit) const {
    for (std::uint32_t row = 0; row < height; ++row) {
      visit(0U, row);
      visit(width - 1, row);
    }
    for (std::uint32_t col = 0; col < width; ++col) {
      visit(col, 0U);
      visit(col, height - 1);
    }
  }
};

/// Stands for two parts with rim cells that an edge of the tree joins.
struct RimEdge {
  std::uint32_t a, b;  ///< side numbers of a cell of each
  std::uint64_t edge;  ///< number of the grid's edge
};

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
  SpanningMaze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops, Range own, maze::RimPart& rim,
               const Execution& execution, unsigned side_log2 = 8);
  /// Edges in which the whole differs from the tiles' trees (maze::JoinedParts), of the own tiles and those below.
  void turn(std::span<const std::uint64_t> edges);
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;
  class Builder;
  maze::GridPiece piece(std::size_t tile) const;

  std::uint64_t seed_;
  /// Walls that the tree leaves are taken out, each by itself, where 53 bits that follow from its weight are below.
  std::uint64_t open_below_;
  /// By tile, the edges in which the whole differs from the tile's tree: those inside it that are not in the whole, and
  /// those that leave it to the right or above and are. 2 * (row * 256 + col) + direction.
  std::vector<std::vector<std::uint32_t>> turned_;
  std::vector<std::vector<std::uint64_t>> choices_;  ///< by tile: with these it is made again in a fourth of the time
};

}  // namespace warren
