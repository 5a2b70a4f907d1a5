// SPDX-License-Identifier: BSD-3-Clause
// The visibility graph (Lozano-Pérez, Wesley 1979) among polygons and walls, contact allowed: the shortest path for a
// point is the shortest path in it. Each corner's neighbours are found by a rotational sweep over what can be seen from
// it; corners are spread over the cores.
//   reduced   tangent edges at convex corners only (Rohnert 1986; Liu, Arimoto 1992): enough for shortest paths
//   full      all visible edges, sides of polygons included
//   discs     those between corners that a disc goes around
// Time O(n (s + k log k)) where a look meets k of the n pieces in s cells, so at worst O(n^2 log n), where everything
// sees everything; with crossing obstacles O(k * pieces crossed) a look. Memory: 4 bytes an edge end, lengths
// are computed as they are needed, and 150 bytes a corner. Start and goal are linked by a sweep each and
// never become part of the graph.
//
// And sampled_visibility(), a visibility graph as it must not be made, for comparison: two corners are joined if none
// of some points of the way between them is inside a polygon. Ways between corners are looked at every `step`, ways
// from start and goal at a hundred places, however long they are. It accepts edges that cut through obstacles between
// two of these points. A point counts as inside if it is farther from the outline than its own rounding, so that sides
// of polygons pass. O(n^2 samples log n) for n corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/visibility/plane_pieces.hpp"
#include "spatial/obstacles/polygon_index.hpp"
#include "spatial/obstacles/segment_grid.hpp"

namespace warren {

/// The vertices of a visibility graph among polygons and walls, and who sees whom, one vertex at a time.
///
/// A vertex is a corner of a polygon or an end of a wall together with one free sector there: where obstacles touch, a
/// corner has several free sectors, and no way leads from one into another (contact rule). Vertices are numbered by
/// corners in the order in which they first appear (polygons, then walls), sectors anticlockwise from +x; a corner
/// inside of another polygon has none. Two vertices are neighbours if the straight way between them leaves and arrives
/// by their sectors, enters no polygon and changes no wall's side. It may pass other corners. Tangent neighbours: both
/// sectors are wider than half a turn, and the line through both leaves the obstacles at each on one side. Shortest
/// paths bend nowhere else.
///
/// Cost of one look: O(k log k) for k pieces that may be seen. Immutable; any number of threads may read.
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

  const PolygonSet polygons_;
  std::optional<Box> bounds_;
  PlanePieces pieces_;
  std::vector<PointId> point_;        // of each vertex
  std::vector<SectorOfPoints> ends_;  // of each vertex's sector
  std::vector<VertexId> first_vertex_;
  std::vector<std::uint8_t> any_;     // one a point: has it a vertex?
  std::vector<std::uint8_t> reflex_;  // one a point: has it a reflex one?
};

/// Which neighbours count, as edges of a graph too. reduced: those that are tangent, which a point's shortest paths
/// take; full: all; discs: those with a sector wider than half a turn, which a disc's could follow.
enum class VisibilityEdges : std::uint8_t { reduced, full, discs };

/// Looks from vertices and from other points; scratch of one thread. The corners and the execution must outlive it.
/// Throws Stopped.
class CornerSight {
 public:
  /// What is told instead of a vertex where the extra target is seen.
  static constexpr VertexId target = no_vertex;

  CornerSight(const VisibleCorners& corners, const Execution& execution);

  /// Replaces `seen` by half of the neighbours of v, ascending: those above it and, at its height, on its right. So of
  /// each pair of neighbours one sees the other.
  void above_vertex(VertexId v, VisibilityEdges which, std::vector<VertexId>& seen);
  /// The neighbours of v with a sector wider than half a turn that lie in the ranges, and beyond their reach some that
  /// are none; ascending, `target` last. v has such a sector, too. extra: one more target.
  void within_ranges(VertexId v, std::span<const PlaceRange> ranges, std::optional<Vec2> extra,
                     std::vector<VertexId>& seen);
  /// The tangent neighbours of v to which a way that came straight from `from` may bend and still be taut, ascending,
  /// `target` last. extra: one more target.
  void taut_from_vertex(VertexId v, Vec2 from, std::optional<Vec2> extra, std::vector<VertexId>& seen);
  /// The vertices (with VisibilityEdges::reduced those of which the way there is a tangent) that are seen from any
  /// point that is not blocked.
  void from_point(Vec2 p, VisibilityEdges which, std::optional<Vec2> extra, std::vector<VertexId>& seen);

 private:
  template <class Departure>
  void look(Vec2 eye, bool upwards, std::span<const PlaceRange> ranges, VisibilityEdges which,
            std::optional<Vec2> extra, const Departure& departure, std::vector<VertexId>& seen);
  void arrive(Vec2 eye, PointId p, Lanes lanes, VisibilityEdges which, std::vector<VertexId>& seen) const;

  const VisibleCorners& corners_;
  NearPieces near_;
  RotationalSweep sweep_;
};

/// What start and goal see: vertices of the graph, ascending.
struct VisibilityLinks {
  Vec2 start;
  Vec2 goal;
  std::vector<VertexId> from_start;
  std::vector<VertexId> from_goal;
  std::vector<std::uint8_t> sees_goal;  ///< one a vertex
  bool direct = false;                  ///< start sees goal
  std::size_t count() const { return from_start.size() + from_goal.size() + (direct ? 1 : 0); }
};

/// Immutable after construction; any number of threads may link and search.
class VisibilityGraph {
 public:
  /// known: its graph, where that is there already: it has a vertex a corner. Throws Stopped at the deadline or the
  /// memory limit, InputError for more than 2^32 - 1 edge ends.
  VisibilityGraph(const VisibleCorners& corners, VisibilityEdges edges, const Execution& execution,
                  std::optional<Graph> known = {});

  /// Over the vertices of the corners, without start and goal.
  const Graph& graph() const { return graph_; }
  std::size_t size() const { return positions_.size(); }
  std::span<const Vec2> positions() const { return positions_; }
  VertexId start_vertex() const { return static_cast<VertexId>(size()); }
  VertexId goal_vertex() const { return static_cast<VertexId>(size() + 1); }

  /// Two sweeps, O(vertices). Start and goal are not blocked, and different. Throws Stopped.
  VisibilityLinks link(Vec2 start, Vec2 goal, const Execution& execution) const;
  /// The graph with start and goal as the last two vertices; O(vertices + edges). Throws Stopped.
  Graph joined(const VisibilityLinks& links, const Execution& execution) const;

  /// A* or Dijkstra between start and goal without joining them to the graph. Whether it was stopped is in the result;
  /// sizing the state throws Stopped.
  SearchResult search(const VisibilityLinks& links, SearchKind search, QueueKind queue, SearchState& state,
                      const Execution& execution) const;

 private:
  const VisibleCorners& corners_;
  VisibilityEdges which_;
  RawVector<Vec2> positions_;
  Graph graph_;
};

/// Edges, ascending, with from < to: corners in the polygons' order, then start, then goal. step > 0. Walls and bounds
/// are not looked at. The same for any number of threads; throws Stopped.
std::vector<Edge> sampled_visibility(const PolygonIndex& polygons, Vec2 start, Vec2 goal, double step,
                                     const Execution& execution);

/// How deep the segment runs inside of polygons: the greatest distance of one of `places` points of it to the outline
/// of a polygon around it; 0 if none of them is inside.
double depth_inside(const PolygonIndex& polygons, const Segment& segment, std::size_t places);

// What a disc of any radius meets among polygons and walls, contact allowed: the corners that its centre may go around
// on a circle, and which of them may follow each other on a path.
//
// Circles: around each corner with a free sector wider than half a turn (VisibleCorners), and
// around each wall without length that stands alone. The disc touches the corner, and nothing else that ends there, in
// the directions n with n . t <= 0 for both sides t of the sector: the circle's cone.
//
// Candidates: if a tangent of two circles is free for the disc, then the corners see each other as points do, because
// the strip, or the two triangles, between tangent and line of the corners is swept by the disc. So the neighbours of
// the visibility graph are all that can follow, for every radius. Walls without length hide nothing and are candidates
// of all. Without bounds the centre stays in the box of the obstacles, which is no wall.
//
// Build as VisibleCorners, O(n log n); 200 bytes a corner.

/// The circle around a corner; its radius is the disc's. Directions are unit vectors.
struct DiscCircle {
  Vec2 centre;
  Vec2 first, last;  ///< the sides of the free sector, which runs anticlockwise from first to last
  Vec2 begin;        ///< the first direction of the cone, anticlockwise
  double width;      ///< of the cone, radians, at most half a turn; a whole turn where the corner stands alone
  VertexId vertex;   ///< of the visible corners; no_vertex: a wall without length

  bool whole() const { return vertex == no_vertex; }
};

/// Immutable; any number of threads may read.
struct DiscGround {
  /// Throws Stopped at the deadline and the memory limit.
  DiscGround(const PlaneObstacles& obstacles, const Execution& execution);

  VisibleCorners corners;
  Box box;                        ///< of obstacles and bounds; empty where there is nothing
  std::optional<Box> room;        ///< where the centre must stay, where there are obstacles but no bounds
  std::vector<Segment> segments;  ///< pieces of the obstacles, then walls without length that stand alone
  SegmentGrid grid;               ///< of the segments
  std::vector<DiscCircle> circles;
  std::vector<std::uint32_t> circle_of;  ///< number of each vertex's, where its sector is wider than half a turn
  std::uint32_t first_whole = 0;         ///< the circles from here on go around walls without length
};

/// A ground, and which corners see each other, for questions that are many: the discs' radius, start and goal are each
/// question's own. Immutable; any number of threads may plan on it.
struct DiscRoadmap : NotCopied {
  /// Throws as VisibilityGraph; `known`: its graph, where that is there already.
  DiscRoadmap(const PlaneObstacles& obstacles, const Execution& execution, std::optional<Graph> known = {});

  const DiscGround ground;
  const VisibilityGraph graph;  ///< refers to the ground's corners
};

// The planner `visibility`: the shortest path for a point among polygons and walls, contact allowed, by the graph or
// lazily.

struct VisibilityOptions {
  VisibilityEdges edges = VisibilityEdges::reduced;
  bool lazy = false;                      ///< needs reduced edges and A* with the heap; InputError otherwise
  SearchKind search = SearchKind::astar;  ///< bfs: fewest edges, neighbours ascending; dfs: some path
  QueueKind queue = QueueKind::heap;

  void validate() const;
};

/// Plans from start to goal among the obstacles. start_blocked, goal_blocked: strictly inside of a polygon or outside
/// of the bounds (on a boundary is allowed). solved: with A* and Dijkstra the path is the shortest there is.
/// not_connected: no path exists. Never throws Stopped: a deadline or a memory limit gives Outcome::stopped.
/// `keep`, where given, receives the graph with start and goal (lazy: the edges that were found).
Solution<Vec2> visibility_path(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, const VisibilityOptions& options,
                               const Execution& execution, PlannedRoadmap<Vec2>* keep = nullptr);

/// The same where, without bounds, the obstacles' box confines the point (see confined()).
Solution<Vec2> confined_visibility_path(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal,
                                        const VisibilityOptions& options, const Execution& execution,
                                        PlannedRoadmap<Vec2>* keep = nullptr);

/// What of such a confined plan depends on neither start nor goal. Immutable; any number of threads may plan on it.
struct VisibilityRoadmap : NotCopied {
  /// Throws as VisibilityGraph; `known`: its graph, where that is there already.
  VisibilityRoadmap(const PlaneObstacles& obstacles, VisibilityEdges edges, const Execution& execution,
                    std::optional<Graph> known = {});

  const Box box;  ///< that confines the point; empty: none does
  const VisibleCorners corners;
  const VisibilityGraph graph;  ///< refers to the corners
};

/// The same plan on a graph that is there already. Of the options `edges` is the roadmap's; it is not lazy.
Solution<Vec2> visibility_path(const VisibilityRoadmap& roadmap, Vec2 start, Vec2 goal,
                               const VisibilityOptions& options, const Execution& execution,
                               PlannedRoadmap<Vec2>* keep = nullptr);

/// The shortest path among polygons and walls without building the visibility graph: A* over the reduced graph, whose
/// rows are found when a vertex is settled, and of which only those edges are looked for that a taut way can take: at
/// each vertex the range of directions between straight on and the obstacle round which the way bends. Any optimal way
/// through a vertex is taut at it whichever optimal way led there, so the path is as short as the graph's. One look a
/// vertex settled, each over what can be seen in that range; memory 150 bytes a corner. Start and goal are not blocked,
/// and different; start is vertex corners.size(), goal the next. Looks (neighbour_queries) and what they found
/// (edges_checked) are added to the counters; `found`, where given, receives the edges. Throws Stopped, or says in the
/// result that it was stopped.
SearchResult lazy_visibility_search(const VisibleCorners& corners, Vec2 start, Vec2 goal, const Execution& execution,
                                    Counters& counters, std::vector<Edge>* found = nullptr);

/// Worlds without bounds, whose obstacles' box confines the reference point and is no wall: paths may run along
/// polygons on it and around walls that end on it, and shortest paths don't leave it by themselves. But nobody gets
/// between the box and a wall that lies on its side: a maze's outline shall not be walked around on the outside. For
/// planners of shortest paths, which know bounds only: behind each wall on a side of the box stands a polygon that
/// reaches to bounds well outside of the box; without such walls, or with bounds, nothing is changed.
PlaneObstacles confined(PlaneObstacles obstacles);

}  // namespace warren
