// SPDX-License-Identifier: BSD-3-Clause
// The overlay: the graph of what the tiles' reductions left over. Its vertices are the keys, numbered tile by tile,
// then start, then goal; its edges the chains inside tiles, the crossings between tiles and the links of start and
// goal.
//
// A key has at most four edges, as its lattice point has, so each has a row of fixed size: 32 bytes, two a cache line,
// and nothing to look up before it. Rows are written tile by tile in parallel. Then dead ends are peeled again, now
// across borders: first by ranges of tiles in parallel, where a range lets vertices alone that have an edge out of it,
// so that no two ranges ever meet; then from the vertices where that had to stop. Keys keep their numbers, by which
// paths and other processes know them (planners/graph/roadmap_search.hpp would number them anew). Cost: O(keys); 33
// bytes a key.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "planners/mazes/tile_source.hpp"

namespace warren {

/// A free edge from start or goal to a lattice point.
struct EndLink {
  std::uint32_t col;
  std::uint32_t row;
  double length;
};

struct EndLinks {
  Vec2 at;
  bool free = false;
  std::vector<EndLink> links;
  std::uint64_t queries = 0;  ///< neighbour queries that the plain pipeline counts for it
  std::uint64_t checked = 0;  ///< edges put to the walls
};

/// What the look-up and the tiles need to know of the world.
struct LatticeWorld {
  const TileGrid& grid;
  const TileSource& tiles;
  Box box;           ///< the reference point stays in it
  double clearance;  ///< of planning
};

/// Start and goal in a lattice: are they free, and which lattice points are they joined to? Those within one step of
/// them by a free edge; where there is none, the nearest of the 256 nearest milestones that a free edge reaches. Cost:
/// the walls of the tile around them, or all walls where they stand outside the tiles or need the wider look.
EndLinks end_links(const LatticeWorld& world, Vec2 at);

/// May start and goal be joined directly: are they within one step?
bool is_direct_candidate(Vec2 a, Vec2 b);

/// Is the direct edge between them free?
bool is_direct_edge_free(const LatticeWorld& world, Vec2 a, Vec2 b);

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
  std::size_t tile_of(VertexId v) const {
    return static_cast<std::size_t>(std::upper_bound(first_key_.begin(), first_key_.end(), v) - first_key_.begin()) - 1;
  }
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
  std::uint32_t fill_tile(const TileGrid& grid, std::span<const TileSummary> tiles, std::size_t tile);
  void fill_ends(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends);
  void add_end(VertexId key, VertexId target, std::uint32_t steps) { rows_[key][left_[key]++] = {target, steps}; }
  VertexId peel_from(VertexId v, VertexId first, VertexId last, std::uint64_t& closed);
  std::size_t tile_count() const { return first_key_.size() - 1; }

  std::vector<VertexId> first_key_;  // by tile, and the end
  RawVector<std::array<OverlayEnd, 4>> rows_;
  std::array<std::vector<OverlayEnd>, 2> links_;  // of start and goal
  RawVector<std::uint8_t> left_;                  // edges that are left of each vertex, or `peeled`
  std::uint32_t longest_ = 1;
};

/// Components of the overlay: of its core, the vertices that are not peeled, or of a part of them. The search is
/// planners/mazes/overlay_search.hpp. Of the vertices of a range that are not peeled, and the edges between them, by a
/// lock-free union on all cores. O(vertices); 4 bytes each.
class OverlayComponents {
 public:
  /// Throws Stopped.
  OverlayComponents(const Overlay& overlay, Range vertices, const Execution& execution);
  std::uint64_t count() const { return count_; }
  /// A vertex of the range that stands for v's component.
  VertexId root(VertexId v) const { return first_ + label_[v - first_]; }

 private:
  const VertexId first_;
  RawVector<VertexId> label_;  // of each place in the range the smallest of its component
  std::uint64_t count_ = 0;
};

/// The overlay of some rows of tiles, peeled by itself before it meets the others': what has an edge out of the band
/// stays, dead ends that end within it go. What is left is said as summaries again, keys and edges in their order, so
/// that the overlay of all bands is that of all tiles but for what its own peeling would have taken away. tiles:
/// summaries without steps of the tile rows first_row .. last_row - 1; components that are gone are counted as closed
/// in the first of them. ends: what they join stays. As much memory as the band's overlay. Throws Stopped, InputError
/// where the tiles contradict each other.
void peel_band(const TileGrid& grid, std::size_t first_row, std::size_t last_row, const OverlayEnds& ends,
               std::span<TileSummary> tiles, const Execution& execution);

}  // namespace warren
