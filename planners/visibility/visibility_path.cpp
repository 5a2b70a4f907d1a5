// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/visibility_path.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/no_path.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren {

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
    if (!(start_ == goal_)) return true;
    solution_.path = {start_, goal_};
    return end(Outcome::solved), false;
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
    finish(visibility.positions(), found);
  }

  void search_lazily(const VisibleCorners& corners) {
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    std::vector<Edge> edges;
    const SearchResult found = lazy_visibility_search(corners, start_, goal_, execution_, solution_.counters, &edges);
    if (found.status == SearchStatus::stopped) execution_.check();
    std::vector<Vec2> positions(corners.size());
    for (VertexId v = 0; v < positions.size(); ++v) positions[v] = corners.position(v);
    for (Edge& e : edges) e = {std::min(e.from, e.to), std::max(e.from, e.to)};
    polled_sort(edges.begin(), edges.end(), execution_);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    solution_.roadmap.edges = edges.size();
    if (keep_ != nullptr) roadmap_.graph = assemble_graph(corners.size() + 2, edges, execution_);
    finish(positions, found);
  }

  void finish(std::span<const Vec2> positions, const SearchResult& found) {
    if (found.status == SearchStatus::stopped) execution_.check();
    solution_.counters.expanded += found.expanded;
    roadmap_.states.assign(positions.begin(), positions.end());
    roadmap_.states.push_back(start_);
    roadmap_.states.push_back(goal_);
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
