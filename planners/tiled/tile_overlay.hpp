// SPDX-License-Identifier: BSD-3-Clause
// The overlay: the graph of what the tiles' reductions left over. Its vertices are the keys, numbered tile by tile,
// then start, then goal; its edges the chains inside tiles, the crossings between tiles and the links of start and
// goal.
//
// A key has at most four edges, as its lattice point has, so each has a row of fixed size: 32 bytes, two a cache line,
// and nothing to look up before it. Rows are written tile by tile in parallel. Then dead ends are peeled again, now
// across borders: first by ranges of tiles in parallel, where a range lets vertices alone that have an edge out of it,
// so that no two ranges ever meet; then from the vertices where that had to stop. Cost: O(keys); 33 bytes a key.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "planners/tiles/lattice_end_links.hpp"
#include "planners/tiles/lattice_tile_reduction.hpp"
#include "planners/tiles/tile_grid.hpp"

namespace warren {

/// One end of an overlay edge.
struct OverlayEnd {
  VertexId target;
  std::uint32_t steps;  ///< between lattice points: the length; 0: a link of start or goal
};

/// Start and goal, and the edges from them.
struct OverlayEnds {
  EndLinks start;
  EndLinks goal;
  bool direct = false;  ///< joined to each other
};

class Overlay {
 public:
  /// Throws Stopped at the deadline or before memory would pass its limit, InputError at 2^32 keys.
  Overlay(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends,
          const Execution& execution);

  std::size_t vertex_count() const { return std::size_t{first_key_.back()} + 2; }
  VertexId start() const { return first_key_.back(); }
  VertexId goal() const { return first_key_.back() + 1; }
  bool is_key(VertexId v) const { return v < start(); }
  /// The edges of a key to other keys; of start and goal, the links in their order, and the direct edge.
  std::span<const OverlayEnd> ends(VertexId v) const;
  /// Four ends of a key; those that are none lead to the key itself in 0 steps.
  const std::array<OverlayEnd, 4>& row(VertexId key) const { return rows_[key]; }
  /// Steps of the shortest edge from key v to key w; there must be one.
  std::uint32_t steps_between(VertexId v, VertexId w) const;
  /// No edge between keys has more steps.
  std::uint32_t longest() const { return longest_; }
  /// The tile that a key is of; O(log tiles).
  std::size_t tile_of(VertexId v) const;
  /// First key of a tile; the tile's key k is the overlay's vertex first_key(tile) + k.
  VertexId first_key(std::size_t tile) const { return first_key_[tile]; }

  /// Peels dead ends off (not start and goal, nor what they join). Returns the components that ended as a single
  /// vertex.
  std::uint64_t peel(const Execution& execution);
  bool is_peeled(VertexId v) const { return left_[v] == peeled; }
  /// This vertex, so another process has found, is peeled: so are the dead ends that it leaves.
  void peel_after(VertexId gone);

 private:
  static constexpr std::uint8_t peeled = 255;
  void number_keys(std::span<const TileSummary> tiles);
  std::uint32_t fill_tile(const TileGrid& grid, std::span<const TileSummary> tiles, std::size_t tile);
  void fill_ends(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends);
  VertexId key_at(const TileGrid& grid, std::span<const TileSummary> tiles, const EndLink& link) const;
  void add_end(VertexId key, VertexId target, std::uint32_t steps) { rows_[key][left_[key]++] = {target, steps}; }
  VertexId peel_from(VertexId v, VertexId first, VertexId last, std::uint64_t& closed);
  std::size_t tile_count() const { return first_key_.size() - 1; }

  std::vector<VertexId> first_key_;  // by tile, and the end
  RawVector<std::array<OverlayEnd, 4>> rows_;
  std::array<std::vector<OverlayEnd>, 2> links_;  // of start and goal
  RawVector<std::uint8_t> left_;                  // edges that are left of each vertex, or `peeled`
  std::uint32_t longest_ = 1;
};

}  // namespace warren
