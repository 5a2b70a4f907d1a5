// SPDX-License-Identifier: BSD-3-Clause
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
// (apps/distributed/shared_search.hpp). A side then settles its own keys, and tells the labels of others instead.
// Memory: 8 bytes a vertex and side, 16 an open one; parents are found again on the way back, from the labels.
#pragma once

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
#include "core/search/search.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/mazes/overlay.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/tile_plane.hpp"

namespace warren {

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

  /// A label of a key that is not its own, or that another process has found.
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
  struct Root {
    VertexId key;
    double length;
  };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t block_size = 64;

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
  std::vector<std::uint8_t> is_near_;   // one a block of vertices: has it labels?
  std::vector<std::uint32_t> first_;    // entry of each bucket
  std::vector<std::uint64_t> is_used_;  // one bit a bucket
  alignas(bytes_apart) std::vector<Entry> entries_;
  std::vector<VertexId> bucket_;    // the one that is emptied
  std::vector<VertexId> labelled_;  // in this round, perhaps more than once
  std::vector<Told> told_;          // since it was last asked
  std::vector<Root> roots_;
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
