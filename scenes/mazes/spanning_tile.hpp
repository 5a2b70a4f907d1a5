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
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/rng.hpp"

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

/// Which of the walls that the tree leaves are taken out: each by itself, with probability `loops`, 0 to 1.
class LoopDraw {
 public:
  explicit LoopDraw(double loops) : least_kept_(static_cast<std::uint64_t>(std::ceil(loops * 0x1.0p53))) {}
  bool any() const { return least_kept_ > 0; }
  bool operator()(std::uint64_t weight) const { return mix64(~weight) >> 11 < least_kept_; }

 private:
  std::uint64_t least_kept_;
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

  void decide_early(const GridPiece& piece);
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
