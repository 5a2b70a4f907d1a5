// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/visibility_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/items_by_key.hpp"
#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "parallel/sort.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren {
namespace {

/// Half a turn round from a place.
double opposite(double place) { return place < 2.0 ? place + 2.0 : place - 2.0; }

/// The sector's directions, all where rounded places can't tell next to none from next to all.
PlaceRange range_of(Vec2 at, const Sector& sector) {
  constexpr double doubt = 1e-9;
  if (sector.whole || sector.first == sector.last) return all_round;
  const PlaceRange range{direction_place(sector.first - at), direction_place(sector.last - at)};
  const double apart = std::abs(range.last - range.first);
  return apart < doubt || apart > 4.0 - doubt ? all_round : range;
}

/// Of each chunk's vertices in a row the neighbours above, ascending, and no_vertex behind them.
std::vector<RawVector<VertexId>> rows_above(const VisibleCorners& corners, VisibilityEdges which,
                                            const Execution& execution) {
  // Few enough to share the work, enough to pay for a chunk's scratch, which is O(n).
  const std::size_t grain = std::clamp<std::size_t>(corners.size() / 256, 16, 1024);
  return parts_of_chunks(corners.size(), grain, execution, [&](Range r) {
    CornerSight sight(corners, execution);
    std::vector<VertexId> seen;
    RawVector<VertexId> part;
    for (std::size_t v = r.first; v < r.last; ++v) {
      execution.check();
      sight.above_vertex(static_cast<VertexId>(v), which, seen);
      seen.push_back(no_vertex);
      part.insert(part.end(), seen.begin(), seen.end());
    }
    execution.reserve(part.size() * sizeof(VertexId));
    return part;
  });
}

/// Each edge was found at its lower end: writes it into both rows, those below before those above, and merges these.
Graph graph_of_rows(std::size_t n, std::vector<RawVector<VertexId>>& parts, const Execution& execution) {
  std::uint64_t ends = 0;
  for (const RawVector<VertexId>& part : parts) ends += 2 * part.size();
  ends -= 2 * n;
  if (ends > std::numeric_limits<EdgeEnd>::max()) throw InputError("visibility graph", "more than 2^32 - 1 edge ends");
  execution.reserve(ends * sizeof(VertexId));
  const auto each_pair = [&](const auto& visit) {
    VertexId v = 0;
    for (const RawVector<VertexId>& part : parts) {
      for (const VertexId w : part) {
        if (w != no_vertex) {
          visit(v, w);
        } else if (++v % 16 == 0) {
          execution.check();
        }
      }
    }
  };
  const auto each_end = [&](const auto& visit) {
    each_pair([&](VertexId v, VertexId w) { visit(w, v); });
    each_pair(visit);
  };
  ItemsByKey rows = items_by_key(n, each_end, [&] { execution.check(); });
  parts.clear();
  for_each_index(n, 1024, execution, [&](std::size_t v) {
    const auto first = rows.items.begin() + rows.first[v];
    const auto last = rows.items.begin() + rows.first[v + 1];
    std::inplace_merge(first, std::is_sorted_until(first, last), last);
  });
  return {std::move(rows.first), std::move(rows.items)};
}

Vec2 unit_of(Vec2 v) { return (1.0 / norm(v)) * v; }

DiscCircle circle_around(const VisibleCorners& corners, VertexId v) {
  const Vec2 centre = corners.position(v);
  const Sector sector = corners.sector(v);
  DiscCircle circle{centre, unit_of(sector.first - centre), unit_of(sector.last - centre), {}, 0.0, v};
  circle.begin = {-circle.first.y, circle.first.x};
  const Vec2 end{circle.last.y, -circle.last.x};
  const double width = portable::atan2(cross(circle.begin, end), dot(circle.begin, end));
  circle.width = sector.first == sector.last ? std::numbers::pi : std::max(width, 0.0);
  return circle;
}

}  // namespace

VisibleCorners::VisibleCorners(const PlaneObstacles& obstacles, const Execution& execution)
    : polygons_(obstacles.polygons), bounds_(obstacles.bounds), pieces_(obstacles, execution) {
  constexpr std::size_t grain = 4096;
  const std::size_t corners = pieces_.corner_count();
  first_vertex_.assign(pieces_.points().size() + 1, 0);
  const auto parts = parts_of_chunks(corners, grain, execution, [&](Range r) {
    std::vector<SectorOfPoints> part;
    for (std::size_t p = r.first; p < r.last; ++p) {
      if (p % 64 == 0) execution.check();
      const std::vector<SectorOfPoints> sectors = free_sectors_at(pieces_, static_cast<PointId>(p), execution);
      first_vertex_[p + 1] = static_cast<VertexId>(sectors.size());
      part.insert(part.end(), sectors.begin(), sectors.end());
    }
    return part;
  });
  for (std::size_t p = 0; p < pieces_.points().size(); ++p) first_vertex_[p + 1] += first_vertex_[p];
  for (const auto& part : parts) ends_.insert(ends_.end(), part.begin(), part.end());
  execution.check();
  point_.resize(ends_.size());
  any_.assign(pieces_.points().size(), 0);
  reflex_.assign(pieces_.points().size(), 0);
  for (PointId p = 0; p < pieces_.points().size(); ++p) {
    for (VertexId v = first_vertex_[p]; v < first_vertex_[p + 1]; ++v) {
      point_[v] = p;
      any_[p] = 1;
      if (ends_[v].reflex) reflex_[p] = 1;
    }
  }
}

bool VisibleCorners::is_blocked(Vec2 at) const {
  if (bounds_ && !bounds_->contains(at)) return true;
  return free_sectors(pieces_, at).empty() && strictly_inside(polygons_, at);
}

CornerSight::CornerSight(const VisibleCorners& corners, const Execution& execution)
    : corners_(corners), near_(corners.pieces(), execution), sweep_(corners.pieces(), execution) {}

void CornerSight::arrive(Vec2 eye, PointId p, Lanes lanes, VisibilityEdges which, std::vector<VertexId>& seen) const {
  const Vec2 at = corners_.pieces().points()[p];
  const VertexId first = corners_.vertices_first(p);
  const VertexId end = corners_.vertices_first(p + 1);
  for (VertexId v = first; v < end; ++v) {
    const Sector sector = corners_.sector(v);
    if (end - first > 1) {  // looking back, the right lane lies anticlockwise
      const Lanes back = lanes_in_sector(at, sector, eye);
      const bool left = (lanes & left_lane) != 0 && (back & right_lane) != 0;
      const bool right = (lanes & right_lane) != 0 && (back & left_lane) != 0;
      if (!left && !right) continue;
    }
    if (which != VisibilityEdges::full && !corners_.is_reflex(v)) continue;
    if (which == VisibilityEdges::reduced && !is_tangent(at, sector, eye)) continue;
    seen.push_back(v);
  }
}

template <class Departure>
void CornerSight::look(Vec2 eye, bool upwards, std::span<const PlaceRange> ranges, VisibilityEdges which,
                       std::optional<Vec2> extra, const Departure& departure, std::vector<VertexId>& seen) {
  const std::vector<std::uint8_t>& wanted = which == VisibilityEdges::full ? corners_.any_ : corners_.reflex_;
  const auto near = near_.look(eye, ranges, upwards);
  sweep_.run(eye, upwards, near, wanted, extra, departure, [&](PointId p, Lanes lanes) {
    if (p == RotationalSweep::target) {
      seen.push_back(target);
    } else {
      arrive(eye, p, lanes, which, seen);
    }
  });
  std::sort(seen.begin(), seen.end());
}

void CornerSight::above_vertex(VertexId v, VisibilityEdges which, std::vector<VertexId>& seen) {
  seen.clear();
  const bool tangent = which == VisibilityEdges::reduced;
  if (which != VisibilityEdges::full && !corners_.is_reflex(v)) return;
  const Vec2 eye = corners_.position(v);
  const Sector sector = corners_.sector(v);
  const PlaceRange all = range_of(eye, sector);
  std::array<PlaceRange, 2> ranges{all, all};
  if (tangent && sector.first != sector.last) {
    const double first = direction_place(sector.first - eye);
    const double last = direction_place(sector.last - eye);
    ranges = {{{first, opposite(last)}, {opposite(first), last}}};
  }
  const auto departure = [&](Vec2 q) {
    const Lanes lanes = lanes_in_sector(eye, sector, q);
    return tangent && lanes != no_lane && !is_tangent(eye, sector, q) ? no_lane : lanes;
  };
  look(eye, true, ranges, which, std::nullopt, departure, seen);
}

void CornerSight::within_ranges(VertexId v, std::span<const PlaceRange> ranges, std::optional<Vec2> extra,
                                std::vector<VertexId>& seen) {
  constexpr double doubt = 1e-9;
  seen.clear();
  const Vec2 eye = corners_.position(v);
  const Sector sector = corners_.sector(v);
  const auto departure = [&](Vec2 q) {  // elsewhere nothing was looked at
    const double place = direction_place(q - eye);
    const bool looked = std::any_of(ranges.begin(), ranges.end(), [&](const PlaceRange& r) {
      const double width = r.last - r.first + (r.last < r.first ? 4.0 : 0.0);
      const double on = place - r.first;
      return (on < -doubt ? on + 4.0 : on) <= width + doubt;
    });
    return looked ? lanes_in_sector(eye, sector, q) : no_lane;
  };
  look(eye, false, ranges, VisibilityEdges::discs, extra, departure, seen);
}

void CornerSight::taut_from_vertex(VertexId v, Vec2 from, std::optional<Vec2> extra, std::vector<VertexId>& seen) {
  seen.clear();
  const Vec2 eye = corners_.position(v);
  const Sector sector = corners_.sector(v);
  const int first_side = orient2d(from, eye, sector.first);
  const int last_side = orient2d(from, eye, sector.last);
  const bool left = first_side >= 0 && last_side >= 0;  // obstacles on the left: the way may bend to the left
  const bool right = first_side <= 0 && last_side <= 0;
  const double straight = direction_place(eye - from);
  std::array<PlaceRange, 2> ranges{{{straight, straight}, {straight, straight}}};
  if (left) ranges[0].last = direction_place(sector.last - eye);
  if (right) ranges[1].first = direction_place(sector.first - eye);
  // Exactly the directions of the ranges: elsewhere nothing was looked at.
  const auto is_taut = [&](Vec2 q) {
    const int side = orient2d(from, eye, q);
    if (side > 0) return left && orient2d(eye, sector.last, q) <= 0;
    if (side < 0) return right && orient2d(eye, sector.first, q) >= 0;
    return !DirectionOrder(eye).same(from, q);
  };
  const auto departure = [&](Vec2 q) { return is_taut(q) ? lanes_in_sector(eye, sector, q) : no_lane; };
  look(eye, false, ranges, VisibilityEdges::reduced, extra, departure, seen);
}

void CornerSight::from_point(Vec2 p, VisibilityEdges which, std::optional<Vec2> extra, std::vector<VertexId>& seen) {
  seen.clear();
  for (const Sector& sector : free_sectors(corners_.pieces(), p)) {
    const PlaceRange range = range_of(p, sector);
    const auto departure = [&](Vec2 q) { return lanes_in_sector(p, sector, q); };
    look(p, false, {&range, 1}, which, extra, departure, seen);
  }
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
}

VisibilityGraph::VisibilityGraph(const VisibleCorners& corners, VisibilityEdges edges, const Execution& execution,
                                 std::optional<Graph> known)
    : corners_(corners), which_(edges), positions_(corners.size()) {
  for (VertexId v = 0; v < positions_.size(); ++v) positions_[v] = corners.position(v);
  if (!known) {
    std::vector<RawVector<VertexId>> parts = rows_above(corners, which_, execution);
    known = graph_of_rows(positions_.size(), parts, execution);
  }
  graph_ = std::move(*known);
}

VisibilityLinks VisibilityGraph::link(Vec2 start, Vec2 goal, const Execution& execution) const {
  VisibilityLinks links{start, goal, {}, {}, std::vector<std::uint8_t>(size(), 0), false};
  CornerSight sight(corners_, execution);
  sight.from_point(start, which_, goal, links.from_start);
  if (!links.from_start.empty() && links.from_start.back() == CornerSight::target) {
    links.direct = true;
    links.from_start.pop_back();
  }
  sight.from_point(goal, which_, std::nullopt, links.from_goal);
  for (const VertexId v : links.from_goal) links.sees_goal[v] = 1;
  return links;
}

Graph VisibilityGraph::joined(const VisibilityLinks& links, const Execution& execution) const {
  std::array<RawVector<Edge>, 2> edges;  // those of the graph are in order, those of start and goal are not
  execution.reserve((graph_.edge_count() + links.count()) * sizeof(Edge));
  edges[0].reserve(graph_.edge_count());
  for (VertexId v = 0; v < size(); ++v) {
    if (v % 256 == 0) execution.check();
    for (const VertexId w : graph_.neighbours(v)) {
      if (v < w) edges[0].push_back({v, w});
    }
  }
  for (const VertexId v : links.from_start) edges[1].push_back({v, start_vertex()});
  for (const VertexId v : links.from_goal) edges[1].push_back({v, goal_vertex()});
  if (links.direct) edges[1].push_back({start_vertex(), goal_vertex()});
  return assemble_graph(size() + 2, edges, execution);
}

SearchResult VisibilityGraph::search(const VisibilityLinks& links, SearchKind search, QueueKind queue,
                                     SearchState& state, const Execution& execution) const {
  const VertexId n = start_vertex();
  const auto neighbours = [&](VertexId v, const auto& visit) {
    const Vec2 at = v == n ? links.start : positions_[v];
    for (const VertexId w : v == n ? std::span<const VertexId>(links.from_start) : graph_.neighbours(v)) {
      visit(w, distance(at, positions_[w]));
    }
    if (v == n ? links.direct : links.sees_goal[v] != 0) visit(n + 1, distance(at, links.goal));
  };
  const bool informed = search == SearchKind::astar;
  const auto estimate = [&](VertexId v) {
    return !informed || v > n ? 0.0 : distance(v == n ? links.start : positions_[v], links.goal);
  };
  return search_best_first(queue, size() + 2, n, n + 1, neighbours, estimate, state, execution);
}

std::vector<Edge> sampled_visibility(const PolygonIndex& polygons, Vec2 start, Vec2 goal, double step,
                                     const Execution& execution) {
  constexpr double places_of_ends = 100.0;
  constexpr double units = 1e-14;
  const Box& box = polygons.box();
  const double rounding = units * std::max({0.0, -box.min.x, box.max.x, -box.min.y, box.max.y});
  const auto is_inside = [&](Vec2 p) {
    const auto polygon = polygons.polygon_around(p);
    if (!polygon) return false;
    return polygons.for_each_side_near(*polygon, Box{p, p}.grown(rounding),
                                       [&](std::size_t side) { return distance(p, polygons.side(side)) > rounding; });
  };
  const auto sees = [&](Vec2 a, Vec2 b, bool of_end) {
    const double length = distance(a, b);
    const double between = of_end ? length / places_of_ends : step;
    const double places = length > 0.0 ? std::floor(length / between) : 0.0;
    std::uint64_t looked_at = 0;
    for (double k = 0.0; k <= places; ++k) {
      execution.poll(++looked_at);
      const double t = length > 0.0 ? k * between / length : 0.0;
      if (is_inside(a + t * (b - a))) return false;
    }
    return true;
  };
  std::vector<Vec2> points = polygons.polygons().corners;
  const std::size_t corners = points.size();
  points.push_back(start);
  points.push_back(goal);
  const auto parts = parts_of_chunks(points.size(), 1, execution, [&](Range r) {
    const std::size_t i = r.first;
    std::vector<Edge> part;
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (execution.should_stop()) execution.check();
      if (sees(points[i], points[j], j >= corners))
        part.push_back({static_cast<VertexId>(i), static_cast<VertexId>(j)});
    }
    return part;
  });
  std::vector<Edge> edges;
  for (const std::vector<Edge>& part : parts) edges.insert(edges.end(), part.begin(), part.end());
  return edges;
}

double depth_inside(const PolygonIndex& polygons, const Segment& segment, std::size_t places) {
  double deepest = 0.0;
  for (std::size_t k = 1; k < places; ++k) {
    const Vec2 p = segment.a + (static_cast<double>(k) / static_cast<double>(places)) * (segment.b - segment.a);
    const auto polygon = polygons.polygon_around(p);
    if (!polygon) continue;
    double depth = std::numeric_limits<double>::infinity();
    for_each_side(polygons.polygons()[*polygon], [&](Vec2 a, Vec2 b) {
      depth = std::min(depth, distance(p, Segment{a, b}));
    });
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

DiscGround::DiscGround(const PlaneObstacles& obstacles, const Execution& execution)
    : corners(obstacles, execution), box(box_around(obstacles)) {
  if (!obstacles.bounds && !box.empty()) room = box;
  const PlanePieces& pieces = corners.pieces();
  execution.reserve(pieces.pieces().size() * sizeof(Segment) + corners.size() * (sizeof(DiscCircle) + 4));
  segments.reserve(pieces.pieces().size());
  for (std::uint32_t i = 0; i < pieces.pieces().size(); ++i) segments.push_back(pieces.segment(i));
  circle_of.assign(corners.size(), no_vertex);
  for (VertexId v = 0; v < corners.size(); ++v) {
    execution.poll(v);
    if (!corners.is_reflex(v)) continue;
    circle_of[v] = static_cast<std::uint32_t>(circles.size());
    circles.push_back(circle_around(corners, v));
  }
  first_whole = static_cast<std::uint32_t>(circles.size());
  std::vector<Vec2> points;  // walls without length, each place once
  for (const Segment& wall : obstacles.walls) {
    if (wall.a == wall.b) push_asked(points, wall.a, execution);
  }
  polled_sort(points.begin(), points.end(), execution, is_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  execution.reserve(points.size() * (sizeof(Segment) + sizeof(DiscCircle)));
  for (const Vec2 p : points) {
    execution.check();
    const std::vector<Sector> sectors = free_sectors(pieces, p);
    if (sectors.empty() || !sectors.front().whole) continue;  // on an obstacle, or inside
    segments.push_back({p, p});
    circles.push_back({p, {}, {}, {1.0, 0.0}, 2.0 * std::numbers::pi, no_vertex});
  }
  grid = SegmentGrid(segments, execution);
}

DiscRoadmap::DiscRoadmap(const PlaneObstacles& obstacles, const Execution& execution, std::optional<Graph> known)
    : ground(obstacles, execution), graph(ground.corners, VisibilityEdges::discs, execution, std::move(known)) {}

PlaneObstacles confined(PlaneObstacles obstacles) {
  if (obstacles.bounds) return obstacles;
  const Box box = box_around(obstacles);
  const Box outer = box.grown(std::max(box.width(), box.height()));
  for (const Segment& wall : obstacles.walls) {
    const BoxSide side = side_under(wall, box);
    if (side == BoxSide::none) continue;
    Box behind = box_of(wall);
    if (side == BoxSide::left) behind.min.x = outer.min.x;
    if (side == BoxSide::right) behind.max.x = outer.max.x;
    if (side == BoxSide::bottom) behind.min.y = outer.min.y;
    if (side == BoxSide::top) behind.max.y = outer.max.y;
    obstacles.polygons.add(behind.corners());
    obstacles.bounds = outer;
  }
  return obstacles;
}

SearchResult lazy_visibility_search(const VisibleCorners& corners, Vec2 start, Vec2 goal, const Execution& execution,
                                    Counters& counters, std::vector<Edge>* found) {
  constexpr std::uint64_t looks_per_poll = 64;
  const auto n = static_cast<VertexId>(corners.size());
  CornerSight sight(corners, execution);
  SearchState state;
  std::vector<VertexId> seen;
  const auto at = [&](VertexId v) { return v < n ? corners.position(v) : v == n ? start : goal; };
  const auto neighbours = [&](VertexId v, const auto& visit) {
    if (++counters.neighbour_queries % looks_per_poll == 0) execution.check();
    if (v == n) {
      sight.from_point(start, VisibilityEdges::reduced, goal, seen);
    } else {
      sight.taut_from_vertex(v, at(state.parent(v)), goal, seen);
    }
    counters.edges_checked += seen.size();
    counters.edges_free += seen.size();
    for (const VertexId w : seen) {
      const VertexId to = w == CornerSight::target ? n + 1 : w;
      visit(to, distance(at(v), at(to)));
      if (found != nullptr) found->push_back({v, to});
    }
  };
  const auto estimate = [&](VertexId v) { return distance(at(v), goal); };
  return search_best_first(QueueKind::heap, n + 2, n, n + 1, neighbours, estimate, state, execution);
}

namespace {

/// One plan.
class VisibilityPlan {
 public:
  VisibilityPlan(const Box& box, Vec2 start, Vec2 goal, const VisibilityOptions& options, const Execution& execution,
                 PlannedRoadmap<Vec2>* keep)
      : box_(box), start_(start), goal_(goal), options_(options), execution_(execution), keep_(keep) {
    options.validate();
  }

  void run(const PlaneObstacles& obstacles) {
    const VisibleCorners corners = index(obstacles);
    if (!begin(corners)) return;
    if (options_.lazy) return search_lazily(corners);
    search(connect(corners));
  }
  void run(const VisibilityRoadmap& roadmap) {
    if (begin(roadmap.corners)) search(roadmap.graph);
  }
  Solution<Vec2>& solution() { return solution_; }

 private:
  void end(Outcome outcome) { solution_.outcome = outcome; }

  /// False where there is nothing to search.
  bool begin(const VisibleCorners& corners) {
    const auto fits = [&](Vec2 p) { return (box_.empty() || box_.contains(p)) && !corners.is_blocked(p); };
    if (!fits(start_)) return end(Outcome::start_blocked), false;
    if (!fits(goal_)) return end(Outcome::goal_blocked), false;
    solution_.roadmap.milestones = corners.size() + 2;
    if (start_ == goal_) {
      solution_.path = {start_, goal_};
      return end(Outcome::solved), false;
    }
    roadmap_.states.reserve(corners.size() + 2);
    for (VertexId v = 0; v < corners.size(); ++v) roadmap_.states.push_back(corners.position(v));
    roadmap_.states.insert(roadmap_.states.end(), {start_, goal_});
    return true;
  }

  VisibleCorners index(const PlaneObstacles& obstacles) {
    const StageTimer timer(execution_, "index", solution_.seconds.index);
    return VisibleCorners(obstacles, execution_);
  }

  VisibilityGraph connect(const VisibleCorners& corners) {
    const StageTimer timer(execution_, "connect", solution_.seconds.connect, corners.size());
    return VisibilityGraph(corners, options_.edges, execution_);
  }

  void search(const VisibilityGraph& visibility) {
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    const VisibilityLinks links = visibility.link(start_, goal_, execution_);
    solution_.roadmap.edges = visibility.graph().edge_count() + links.count();
    const bool plain = !has_queue(options_.search);
    SearchState state;
    if (plain || keep_ != nullptr) roadmap_.graph = visibility.joined(links, execution_);
    const SearchResult found = plain ? search_blindly(options_.search, roadmap_.graph, visibility.start_vertex(),
                                                      visibility.goal_vertex(), state, execution_)
                                     : visibility.search(links, options_.search, options_.queue, state, execution_);
    if (found.status == SearchStatus::exhausted) separate(visibility, visibility.joined(links, execution_));
    if (keep_ != nullptr) roadmap_.search_tree = search_tree(state);
    finish(found);
  }

  void search_lazily(const VisibleCorners& corners) {
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    std::vector<Edge> edges;
    const SearchResult found = lazy_visibility_search(corners, start_, goal_, execution_, solution_.counters, &edges);
    if (found.status == SearchStatus::stopped) execution_.check();
    for (Edge& e : edges) e = {std::min(e.from, e.to), std::max(e.from, e.to)};
    polled_sort(edges.begin(), edges.end(), execution_);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    solution_.roadmap.edges = edges.size();
    if (keep_ != nullptr) roadmap_.graph = assemble_graph(corners.size() + 2, edges, execution_);
    finish(found);
  }

  void finish(const SearchResult& found) {
    if (found.status == SearchStatus::stopped) execution_.check();
    solution_.counters.expanded += found.expanded;
    for (const VertexId v : found.path) solution_.path.push_back(roadmap_.states[v]);
    end(found.status == SearchStatus::found ? Outcome::solved : Outcome::not_connected);
    if (keep_ != nullptr) *keep_ = std::move(roadmap_);
  }

  /// What keeps start and goal apart.
  void separate(const VisibilityGraph& visibility, const Graph& graph) {
    const Components parts = components(graph, execution_);
    std::vector<Vec2> with_start{start_};
    std::vector<Vec2> with_goal{goal_};
    for (VertexId v = 0; v < visibility.size(); ++v) {
      if (parts.connected(v, visibility.start_vertex())) push_asked(with_start, visibility.positions()[v], execution_);
      if (parts.connected(v, visibility.goal_vertex())) push_asked(with_goal, visibility.positions()[v], execution_);
    }
    solution_.separation = separation_between<2>(std::move(with_start), std::move(with_goal), execution_);
  }

  const Box box_;  // that confines the point; empty: none does
  const Vec2 start_;
  const Vec2 goal_;
  const VisibilityOptions& options_;
  const Execution& execution_;
  PlannedRoadmap<Vec2>* keep_;
  PlannedRoadmap<Vec2> roadmap_;
  Solution<Vec2> solution_;
};

}  // namespace

void VisibilityOptions::validate() const {
  if (!lazy) return;
  if (edges != VisibilityEdges::reduced) throw InputError("lazy", "is for the reduced graph");
  if (search != SearchKind::astar || queue != QueueKind::heap) throw InputError("lazy", "is for A* with the heap");
}

Solution<Vec2> visibility_path(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, const VisibilityOptions& options,
                               const Execution& execution, PlannedRoadmap<Vec2>* keep) {
  VisibilityPlan plan(Box{}, start, goal, options, execution, keep);
  return run_plan(plan, obstacles);
}

Solution<Vec2> confined_visibility_path(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal,
                                        const VisibilityOptions& options, const Execution& execution,
                                        PlannedRoadmap<Vec2>* keep) {
  VisibilityPlan plan(box_around(obstacles), start, goal, options, execution, keep);
  return run_plan(plan, confined(obstacles));
}

VisibilityRoadmap::VisibilityRoadmap(const PlaneObstacles& obstacles, VisibilityEdges edges, const Execution& execution,
                                     std::optional<Graph> known)
    : box(box_around(obstacles)),
      corners(confined(obstacles), execution),
      graph(corners, edges, execution, std::move(known)) {}

Solution<Vec2> visibility_path(const VisibilityRoadmap& roadmap, Vec2 start, Vec2 goal,
                               const VisibilityOptions& options, const Execution& execution,
                               PlannedRoadmap<Vec2>* keep) {
  VisibilityPlan plan(roadmap.box, start, goal, options, execution, keep);
  return run_plan(plan, roadmap);
}

}  // namespace warren
