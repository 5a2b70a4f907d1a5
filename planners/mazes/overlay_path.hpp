// SPDX-License-Identifier: BSD-3-Clause
// A path of the overlay with all that its chains stand for, whole or in pieces: a piece needs the summaries of the
// tiles that it passes and no others. A leg leads from one vertex of the path to the next. Memory: 8 bytes a leg.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/mazes/overlay.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/tile_reduction.hpp"

namespace warren {

/// Some legs in a row.
struct PathPiece {
  Range legs;
  std::vector<std::size_t> tiles;  ///< those that it passes, ascending
};

/// A chain that a path takes: key numbers of its tile, the lower first.
struct PathChain {
  std::size_t tile;
  std::uint16_t from, to;
  std::uint32_t length;
};

/// Refers to all that it is made of.
class PathExpansion {
 public:
  /// path: from start to goal. Throws Stopped.
  PathExpansion(const Overlay& overlay, const TileGrid& grid, const OverlayEnds& ends, std::span<const VertexId> path,
                const Execution& execution);

  std::size_t leg_count() const { return path_.size() - 1; }
  std::size_t point_count() const { return first_.back(); }
  /// Points of a piece, its first leg's beginning among them.
  std::size_t point_count(Range legs) const { return first_[legs.last] - first_[legs.first] + 1; }
  /// As many legs from `first` on as have so many points and pass so many tiles, at least one.
  PathPiece piece_from(std::size_t first, std::size_t most_points, std::size_t most_tiles) const;
  /// Those of more than one step among these legs, in their order.
  std::vector<PathChain> chains_of(Range legs) const;
  /// Writes the points of a piece, its first leg's beginning among them; `tiles` has the summaries by number. In
  /// parallel. Throws Stopped.
  void write(Range legs, std::span<const TileSummary> tiles, Vec2* out) const;
  /// All points.
  Path<Vec2> points(std::span<const TileSummary> tiles) const;

 private:
  Vec2 place_of(VertexId v, std::span<const TileSummary> tiles) const;
  std::uint32_t steps_of(std::size_t leg) const;
  PathChain chain_of(std::size_t leg) const;
  void write_leg(std::size_t leg, std::span<const TileSummary> tiles, Vec2* out) const;

  const Overlay& overlay_;
  const TileGrid& grid_;
  const OverlayEnds& ends_;
  std::span<const VertexId> path_;
  const Execution& execution_;
  std::vector<std::size_t> first_;  // where the points of each leg go, its beginning not counted; and the end
};

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
