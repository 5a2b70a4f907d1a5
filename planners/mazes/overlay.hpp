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
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "core/search/bidirectional_search.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/asked_memory.hpp"
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

/// Components of the vertices of a range that are not peeled, and the edges between them, by a lock-free union on all
/// cores. A label is a place in the range, and stands at a place. O(vertices); 4 bytes each. Throws Stopped.
Components components(const Overlay& overlay, Range vertices, const Execution& execution);

/// The overlay of some rows of tiles, peeled by itself before it meets the others': what has an edge out of the band
/// stays, dead ends that end within it go. What is left is said as summaries again, keys and edges in their order, so
/// that the overlay of all bands is that of all tiles but for what its own peeling would have taken away. tiles:
/// summaries without steps of the tile rows first_row .. last_row - 1; components that are gone are counted as closed
/// in the first of them. ends: what they join stays. As much memory as the band's overlay. Throws Stopped, InputError
/// where the tiles contradict each other.
void peel_band(const TileGrid& grid, std::size_t first_row, std::size_t last_row, const OverlayEnds& ends,
               std::span<TileSummary> tiles, const Execution& execution);

// The shortest path in an overlay's core: Dijkstra's search from both ends at once, a thread an end.
//
// Edges between keys are whole numbers of steps, so a side's open vertices lie in a circle of buckets, one a step (Dial
// 1969): pushing and popping cost the same whatever is open, and what lies in the bucket that is emptied can't improve
// each other, since no edge is shorter than a step. (Links of start and goal have any length; they are the first labels
// of a side, and only those bring fractions.) A bucket is known before it is emptied, so rows and labels are asked of
// the memory ahead of time.
//
// Rounds, as in core/search/bidirectional_search.hpp: each side empties buckets until it has settled some thousand
// vertices, reading nothing of the other; then both compare the labels that they set in the round with the other's.
// With F and F' the least open labels of both sides and L the best sum of two labels, the search is over when F + F' >=
// L. Then L is the distance: on a shortest path of length d < F + F' let w be the vertex after the last one that one
// side has settled; its label is right, and d - d(w) < F', so the other side has settled it: the round in which the
// later of the two labels was set has compared them.
//
// No estimate of the rest of the way: mazes leave it nothing to prune, and open space, where it would, costs the
// overlay more than this search. Measured against NBA* with an indexed heap: docs/performance.md.
// What a side has settled when a round ends follows from labels alone, not from the order within a bucket: so processes
// that have a band of the keys each can search in the same rounds, bucket by bucket
// (apps/distributed/shared_search.cpp). A side then settles its own keys, and tells the labels of others instead.
// Memory: 8 bytes a vertex and side, 16 an open one; parents are found again on the way back, from the labels.

/// Like SearchBorder, but least keys are distances from the sides' own ends, so that their sum bounds a path.
struct StepBorder : SearchBorder {};
StepBorder agree(const StepBorder& forward, const StepBorder& backward);

/// The search from one end; refers to the overlay.
class StepSide {
 public:
  /// longest: no edge or link is longer. Labels are not set yet. Asks for the memory of the labels and, as they grow,
  /// of its lists: Stopped comes from the constructor, begin(), advance(). own: the keys that it may settle.
  StepSide(const Overlay& overlay, std::uint32_t longest, const Execution& execution, Range own);
  /// Sets the labels of vertices first .. last - 1; any thread. Peeled vertices seem to be reached already.
  void clear(VertexId first, VertexId last);
  /// Where the search begins: a key and its link's length.
  void begin(VertexId key, double length);

  /// Settles buckets until `limit` vertices are settled. Reads nothing that the other side writes, and leaves alone
  /// what border() shows, which the other side may be reading.
  void advance(const StepSide& other, const StepBorder& agreed, double other_least_key, std::uint64_t limit);
  /// Compares what was labelled in the round with the other side's labels, and brings border() up to date.
  void exchange(const StepSide& other, bool stop);

  const StepBorder& border() const { return border_; }
  const StepSide& state() const { return *this; }
  std::uint64_t settled() const { return settled_; }
  /// A shortest path from the key where the search began to v, which has a label.
  RawVector<VertexId> path_to(VertexId v) const;
  /// The same from v on, but no further than to the first vertex that is not its own.
  RawVector<VertexId> path_from(VertexId v) const;

  /// A label of a key that is not its own, or that another process has found, or that the search began with.
  struct Told {
    VertexId key;
    double label;
  };
  /// A step at a time: settles the bucket of so many steps; nothing that is open is nearer.
  void settle_at(std::uint64_t step);
  /// Label of an own key, from elsewhere; not nearer than the bucket that was settled last.
  void receive(const Told& told);
  /// Whole steps of the least open label; infinity: nothing is open.
  double least();
  /// Labels of others' keys since it was last asked.
  std::vector<Told> take_told() { return std::exchange(told_, {}); }
  /// For path_from(): the labels of others' keys that lead here; infinity: none.
  void set_label(VertexId key, double label) { label_[key] = label; }
  double label(VertexId v) const { return std::abs(label_[v]); }

 private:
  struct Entry {
    VertexId vertex;
    std::uint32_t next;  // in the same bucket, or in the list of free entries
  };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  bool is_own(VertexId v) const { return v >= own_.first && v < own_.last; }
  void push(VertexId v, double label);
  void find_bucket();
  void empty_bucket();
  void settle(VertexId v);
  VertexId before(VertexId v) const;

  const Overlay& overlay_;
  const Execution& execution_;
  const Range own_;
  std::uint64_t mask_;                  // buckets - 1
  RawVector<double> label_;             // with the sign bit set where settled
  std::vector<std::uint32_t> first_;    // entry of each bucket
  std::vector<std::uint64_t> is_used_;  // one bit a bucket
  alignas(bytes_apart) std::vector<Entry> entries_;
  std::vector<VertexId> bucket_;    // the one that is emptied
  std::vector<VertexId> labelled_;  // in this round, perhaps more than once
  std::vector<Told> told_;          // since it was last asked
  std::vector<Told> roots_;
  std::uint32_t free_ = none;
  std::uint64_t at_ = 0;    // least label of the bucket that is emptied next
  double least_ = 0.0;      // what exchange tells the other side of it; infinity: nothing is open
  std::uint64_t open_ = 0;  // entries in buckets
  std::uint64_t settled_ = 0;
  StepBorder border_;
};

/// The shortest path from start to goal over vertices that are not peeled. Throws Stopped at the deadline.
SearchResult search_steps(const Overlay& overlay, const OverlayEnds& ends, const Execution& execution);

/// Holds a path that comes in pieces: the taker of those who need all of its points. Appends to an empty path, which
/// must outlive it. begin() asks for the memory: Stopped.
class PathKeeper : public PathTaker {
 public:
  PathKeeper(Path<Vec2>& path, const Execution& execution) : path_(path), execution_(execution) {}

  void begin(std::uint64_t points) override { reserve_touched(path_, points, execution_); }
  void add(std::span<const Vec2> piece) override {
    const std::span<const Vec2> rest = path_.empty() ? piece : piece.subspan(1);
    path_.insert(path_.end(), rest.begin(), rest.end());
  }

 private:
  Path<Vec2>& path_;
  const Execution& execution_;
};

/// A key by its tile and its place in it (row * side + col), and the steps to the next key of a route.
struct RouteKey {
  std::uint64_t tile;
  std::uint32_t place;
  std::uint32_t steps;
};

/// A shortest path over an overlay that this process does not hold: its keys, as whoever searched tells them, made into
/// summaries of tiles that have these keys and their edges alone, so that a path is expanded in one way. What a search
/// elsewhere found.
struct ToldRoute {
  bool joined = false;           ///< start and goal are in one component
  std::uint64_t components = 0;  ///< of the overlay, start and goal among its vertices
  std::uint64_t expanded = 0;    ///< vertices settled
  std::vector<RouteKey> keys;    ///< from start's link to goal's; none: start is joined to goal
};

/// Summaries of all tiles, with the keys that start and goal join. Throws Stopped.
std::vector<TileSummary> tiles_of(const ToldRoute& route, const TileGrid& grid, const OverlayEnds& ends,
                                  const Execution& execution);

/// The route's vertices in the overlay of these summaries.
RawVector<VertexId> vertices_of(const ToldRoute& route, const Overlay& overlay, std::span<const TileSummary> tiles,
                                const Execution& execution);

}  // namespace warren
