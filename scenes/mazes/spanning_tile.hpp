// SPDX-License-Identifier: BSD-3-Clause
// The minimum spanning tree of one tile of the unit grid, and what the tree says to the tiles around it.
//
// Most edges are decided where they stand: the least edge of a cell is in the tree, the greatest of the four around a
// corner is not. The first are contracted; Kruskal's algorithm decides the rest, about 0.55 of the two edges a cell,
// sorted by radix. Weights are looked at as 32 bits first; where that many tie, nothing is decided early and the sort
// looks at all 64.
//
// To the rest of the maze a tile is its rim: cells with a neighbour beyond. Two parts of the tree that both hold rim
// cells and are joined by an edge of weight w can't be told from two rim cells, one of each, joined by an edge of that
// weight: so the tile stands for as many edges as rim cells, less one, and each decides about one edge of the tree
// (spanning_maze.hpp). For that, parts with rim cells must join in the order of their weights: cells of the rim are not
// contracted. (A path through a contracted part has no edge in it that is heavier than those by which it comes and
// goes, so contraction hides no bottleneck.)
//
// Cost: about 20 ns of CPU a cell, 1.3 MB of scratch at side 256.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/mazes/grid_edges.hpp"

namespace warren::maze {

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

/// Scratch of one thread.
class SpanningTile {
 public:
  static constexpr std::uint32_t largest_side = 256;
  static constexpr std::uint8_t right = 1, up = 2;

  explicit SpanningTile(std::uint64_t seed);
  /// width, height: 1 .. largest_side.
  void make(const GridPiece& piece);
  /// How the edges were decided that are neither least nor greatest around a corner: a bit each, 0.6 a cell.
  void choices(std::vector<std::uint64_t>& bits) const;
  /// As make(), of the same piece, from its choices: nothing is sorted, a fourth of the time. There are no rim_edges.
  void remake(const GridPiece& piece, std::span<const std::uint64_t> choices);
  /// Edges of the tree, cell by cell (row * width + col), as bits of the cell on whose right or upper side they lie.
  std::span<const std::uint8_t> open() const { return {open_.data(), cells_}; }
  /// By weight, ascending; with no neighbour beyond: none.
  std::span<const RimEdge> rim_edges() const { return rim_edges_; }

 private:
  struct Candidate {
    std::uint32_t weight;  // its upper half
    std::uint32_t place;   // 2 * cell + direction
  };
  using Count = std::array<std::uint32_t, 2048>;

  void weigh();
  void find_least();
  void cut_at_rim();
  void find_greatest();
  void mark();
  void contract();
  void collect();
  void sort();
  void pass(unsigned shift, std::uint32_t mask);
  void sort_ties();
  void number_rim();
  void join();
  std::uint64_t number_of(std::uint32_t place) const;

  EdgeWeights weights_;
  GridPiece piece_{};
  std::size_t cells_ = 0;
  std::vector<std::uint32_t> right_, up_;  // upper halves of weights; a row of none before and after the tile's
  std::vector<std::uint8_t> least_;        // bits: right, up, left, down; a row of 0 before and after
  std::vector<std::uint8_t> greatest_;  // of the corner above right of a cell, bits: its lower edge, left, upper, right
  std::vector<std::uint8_t> open_;
  std::vector<std::uint8_t> contested_;
  std::vector<std::uint16_t> parent_;
  std::vector<std::uint16_t> on_rim_;  // of a part's root: a side number, or none
  std::vector<Candidate> candidates_, sorted_;
  std::size_t candidate_count_ = 0;
  std::vector<RimEdge> rim_edges_;
};

}  // namespace warren::maze
