// SPDX-License-Identifier: BSD-3-Clause
// The exact reduction of a tile's roadmap that shortest paths allow. A dead end (a vertex with one edge that is neither
// start nor goal) lies on no shortest path but its own, so dead ends are peeled off until none is left; what lies
// between two vertices that remain and offers no choice (vertices with two edges) becomes one chain. Vertices with an
// edge over the border, and those that start or goal join, are kept. The number of components doesn't change under
// either.
//
// Peeling follows each dead end inwards as far as it goes, so one pass over the plane is enough: O(points). What is
// left in a maze is a few per cent of the vertices, in open space nearly all. Lengths are counted in steps between
// lattice points. planners/graph/reduce_graph.hpp does the same to a graph, which would have to be made first: 20 bytes
// a point, where the plane has one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/packed_values.hpp"
#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/tile_plane.hpp"

namespace warren {

/// A way between two keys of a tile, over vertices without choice.
struct Chain {
  std::uint16_t from;  ///< key number; different from `to`
  std::uint16_t to;
  std::uint32_t first_step;  ///< in TileSummary::steps
  std::uint32_t length;      ///< in steps, >= 1
};

/// What a tile says to the rest: all that a search needs, and how to find the vertices of a chain again. Values only,
/// so that it can come from another process.
struct TileSummary {
  std::vector<std::uint16_t> keys;  ///< vertices that are left: row * side + col, ascending
  std::vector<Chain> chains;        ///< ascending by `from`
  std::vector<std::uint8_t> steps;  ///< directions of the chains, from -> to
  /// Keys with a free edge over the right, upper, left, lower border, ascending along it: the same number, in the same
  /// order, as the neighbour has on its side.
  std::array<std::vector<std::uint16_t>, 4> crossings;
  std::uint64_t milestones = 0;         ///< free lattice points of the tile
  std::uint64_t candidate_edges = 0;    ///< pairs of free neighbours whose lower left end is in the tile
  std::uint64_t free_edges = 0;         ///< those of them that no wall blocks
  std::uint64_t closed_components = 0;  ///< components that have no key: they lie inside the tile

  std::size_t bytes() const {
    std::size_t total = sizeof(*this) + keys.size() * 2 + chains.size() * sizeof(Chain) + steps.size();
    for (const auto& side : crossings) total += side.size() * 2;
    return total;
  }
};

/// Scratch of one thread.
class TileReduction {
 public:
  explicit TileReduction(const TilePlane& plane);
  /// Reduces the plane, which is used up.
  TileSummary reduce(TilePlane& plane);

 private:
  void peel(TilePlane& plane);
  void follow_dead_end(std::uint8_t* at) const;
  void number_keys(TilePlane& plane, TileSummary& summary);
  void cut_crossings(TilePlane& plane, TileSummary& summary);
  void chain_keys(TilePlane& plane);
  void follow(std::uint8_t* from, unsigned direction, const TilePlane& plane);
  void close_rings(TilePlane& plane, TileSummary& summary) const;

  static constexpr int bulk_passes = 4;

  std::array<int, 4> offset_;
  std::vector<std::uint8_t> found_;  // scratch for a row
  RawVector<std::uint16_t> number_;  // of a key, by place in the plane; of others none
  std::vector<std::uint16_t> keys_;
  std::vector<std::int32_t> places_;  // of the keys, in the plane
  std::vector<Chain> chains_;
  RawVector<std::uint8_t> steps_;  // room for all edges of a tile
  std::uint32_t step_count_ = 0;
};

/// Tile summaries as bytes, for files and other processes.
void pack_summary(const TileSummary& tile, ValuePacker& to);
/// Throws InputError where the bytes are no summary of a tile of this side.
TileSummary unpack_summary(ValueUnpacker& from, std::uint32_t side);

/// Do neighbouring tiles that were reduced elsewhere, or at another time, say the same of the border between them?
/// Compares the points with a free edge over each border. Throws InputError where they differ, Stopped.
void check_borders(const TileGrid& grid, std::span<const TileSummary> tiles, const Execution& execution);

}  // namespace warren
