// SPDX-License-Identifier: BSD-3-Clause
// The overlay: the graph of what the tiles' reductions left over. Its vertices are the keys, numbered tile by tile,
// then start, then goal; its edges the chains inside tiles, the crossings between tiles and the links of start and
// goal.
//
// Rows (CSR) are written tile by tile in parallel. Then dead ends are peeled again, now across borders: first by ranges
// of tiles in parallel, where a range lets vertices alone that have an edge out of it, so that no two ranges ever meet;
// then what is left of that, in one go. Cost: O(keys + edges); 4 bytes a key, 16 an edge end.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/raw_vector.hpp"
#include "core/types.hpp"
#include "parallel/execution.hpp"
#include "planners/end_links.hpp"
#include "planners/tile_grid.hpp"
#include "planners/tile_reduction.hpp"

namespace warren {

/// One end of an overlay edge.
struct OverlayEnd {
  VertexId target;
  std::uint32_t chain;  ///< number in its tile; no_chain: a crossing or a link, without vertices between
  double length;
};
inline constexpr std::uint32_t no_chain = std::numeric_limits<std::uint32_t>::max();

/// Start and goal, and the edges from them.
struct OverlayEnds {
  EndLinks start;
  EndLinks goal;
  bool direct = false;  ///< joined to each other
};

class Overlay {
 public:
  /// Throws Stopped at the deadline or before memory would pass its limit, InputError at 2^32 keys or edge ends.
  Overlay(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends,
          const Execution& execution);

  std::size_t vertex_count() const { return first_end_.size() - 1; }
  VertexId start() const { return static_cast<VertexId>(vertex_count() - 2); }
  VertexId goal() const { return static_cast<VertexId>(vertex_count() - 1); }
  bool is_key(VertexId v) const { return v < start(); }
  std::span<const OverlayEnd> ends(VertexId v) const {
    return {ends_.data() + first_end_[v], ends_.data() + first_end_[v + 1]};
  }
  /// Asks for ends(v) ahead of time.
  void fetch(VertexId v) const { __builtin_prefetch(ends_.data() + first_end_[v]); }
  /// The tile that a key is of; O(log tiles).
  std::size_t tile_of(VertexId v) const;
  /// First key of a tile; the tile's key k is the overlay's vertex first_key(tile) + k.
  VertexId first_key(std::size_t tile) const { return first_key_[tile]; }

  /// Peels dead ends off (not start and goal). Returns the components that ended as a single vertex.
  std::uint64_t peel(const Execution& execution);
  /// Vertices that peel() has left, start and goal among them, ascending.
  std::span<const VertexId> core() const { return core_; }
  bool is_peeled(VertexId v) const { return left_[v] == peeled; }

 private:
  static constexpr std::uint8_t peeled = 255;
  void number_keys(std::span<const TileSummary> tiles);
  void count_ends(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends,
                  const Execution& execution);
  void fill_tile(const TileGrid& grid, std::span<const TileSummary> tiles, std::size_t tile);
  void fill_ends(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends);
  VertexId key_at(const TileGrid& grid, std::span<const TileSummary> tiles, const EndLink& link) const;
  void keep_core(std::vector<std::vector<VertexId>>& cores, const Execution& execution);
  std::uint64_t peel_from(VertexId v, VertexId first, VertexId last);
  std::size_t tile_count() const { return first_key_.size() - 1; }

  std::vector<VertexId> first_key_;     // by tile, and the end
  RawVector<std::uint32_t> first_end_;  // by vertex, and the end
  RawVector<OverlayEnd> ends_;
  RawVector<std::uint8_t> left_;  // edges that are left of each vertex, or `peeled`
  std::vector<VertexId> core_;
};

}  // namespace warren
