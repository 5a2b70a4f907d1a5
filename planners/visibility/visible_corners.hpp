// SPDX-License-Identifier: BSD-3-Clause
// The vertices of a visibility graph among polygons and walls, and who sees whom, one vertex at a time.
//
// A vertex is a corner of a polygon or an end of a wall together with one free sector there: where obstacles touch, a
// corner has several free sectors, and no way leads from one into another (contact rule). Vertices are numbered by
// corners in the order in which they first appear (polygons, then walls), sectors anticlockwise from +x; a corner
// inside of another polygon has none. Two vertices are neighbours if the straight way between them leaves and arrives
// by their sectors, enters no polygon and changes no wall's side. It may pass other corners.
// Tangent neighbours: both sectors are wider than half a turn, and the line through both leaves the obstacles at each
// on one side. Shortest paths bend nowhere else.
//
// Cost of one look: planners/visibility/pieces_in_sight and planners/visibility/rotational_sweep, O(k log k) for k
// pieces that may be seen.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/execution.hpp"
#include "planners/pieces/plane_pieces.hpp"
#include "planners/visibility/pieces_in_sight.hpp"
#include "planners/visibility/rotational_sweep.hpp"
#include "planners/visibility/sectors_at_corner.hpp"

namespace warren {

/// Immutable; any number of threads may read.
class VisibleCorners {
 public:
  VisibleCorners(const PlaneObstacles& obstacles, const Execution& execution);

  std::size_t size() const { return point_.size(); }
  Vec2 position(VertexId v) const { return pieces_.points()[point_[v]]; }
  PointId point(VertexId v) const { return point_[v]; }
  Sector sector(VertexId v) const { return {pieces_.points()[ends_[v].first], pieces_.points()[ends_[v].last], false}; }
  bool is_reflex(VertexId v) const { return ends_[v].reflex; }
  /// The vertices at a point: vertices_first(p) .. vertices_first(p + 1) - 1.
  VertexId vertices_first(PointId p) const { return first_vertex_[p]; }
  const PlanePieces& pieces() const { return pieces_; }
  /// Is the point in the open inside of some polygon, or outside of the bounds? O(corners).
  bool is_blocked(Vec2 at) const;

 private:
  friend class CornerSight;
  struct SectorEnds {
    PointId first;
    PointId last;
    bool reflex;
  };

  const PolygonSet polygons_;
  std::optional<Box> bounds_;
  PlanePieces pieces_;
  std::vector<PointId> point_;    // of each vertex
  std::vector<SectorEnds> ends_;  // of each vertex's sector
  std::vector<VertexId> first_vertex_;
  std::vector<std::uint8_t> any_;     // one a point: has it a vertex?
  std::vector<std::uint8_t> reflex_;  // one a point: has it a reflex one?
};

/// Which neighbours count.
enum class SightLines : std::uint8_t { all, tangent };

/// Looks from vertices and from other points; scratch of one thread. The corners and the execution must outlive it.
/// Throws Stopped.
class CornerSight {
 public:
  /// What is told instead of a vertex where the extra target is seen.
  static constexpr VertexId target = no_vertex;

  CornerSight(const VisibleCorners& corners, const Execution& execution);

  /// Replaces `seen` by half of the neighbours of v, ascending: those above it and, at its height, on its right. So of
  /// each pair of neighbours one sees the other.
  void above_vertex(VertexId v, SightLines which, std::vector<VertexId>& seen);
  /// The tangent neighbours of v to which a way that came straight from `from` may bend and still be taut, ascending,
  /// `target` last. extra: one more target.
  void taut_from_vertex(VertexId v, Vec2 from, std::optional<Vec2> extra, std::vector<VertexId>& seen);
  /// The vertices (with SightLines::tangent those of which the way there is a tangent) that are seen from any point
  /// that is not blocked.
  void from_point(Vec2 p, SightLines which, std::optional<Vec2> extra, std::vector<VertexId>& seen);

 private:
  template <class Departure>
  void look(Vec2 eye, RotationalSweep::Turn how_far, std::span<const PlaceRange> ranges, SightLines which,
            std::optional<Vec2> extra, const Departure& departure, std::vector<VertexId>& seen);
  void arrive(Vec2 eye, PointId p, Lanes lanes, SightLines which, std::vector<VertexId>& seen) const;

  const VisibleCorners& corners_;
  NearPieces near_;
  RotationalSweep sweep_;
};

}  // namespace warren
