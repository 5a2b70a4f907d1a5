// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/skeleton_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/trigonometry.hpp"
#include "core/search/search.hpp"
#include "parallel/assemble_graph.hpp"
#include "parallel/components.hpp"
#include "parallel/polled_sort.hpp"
#include "planners/grid/map_skeleton.hpp"
#include "planners/grid/numbered_cells.hpp"
#include "planners/roadmap/queue_choice.hpp"
#include "planners/roadmap/separation.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {
namespace {

constexpr double sqrt2 = 1.4142135623730951;

/// One plan: the steps share the question and fill in the answer.
class SkeletonPlan {
 public:
  SkeletonPlan(const SkeletonRoadmap& roadmap, Cell start, Cell goal, const SkeletonOptions& options,
               const Execution& execution)
      : start_(start),
        goal_(goal),
        options_(options),
        execution_(execution),
        blocked_(roadmap.blocked),
        field_(roadmap.field) {}

  SkeletonPath run(std::vector<std::pair<Cell, Cell>>* steps) {
    if (blocked_.test(start_.x, start_.y)) return ended(Outcome::start_blocked);
    if (blocked_.test(goal_.x, goal_.y)) return ended(Outcome::goal_blocked);
    thin();
    link();
    if (steps != nullptr) {
      for (const Edge& e : edges_) steps->push_back({cells_->cell(e.from), cells_->cell(e.to)});
    }
    if (joined()) search();
    return std::move(plan_);
  }

 private:
  SkeletonPath ended(Outcome outcome) {
    plan_.outcome = outcome;
    return std::move(plan_);
  }
  VertexId start() const { return cells_->number(start_.x, start_.y); }
  VertexId goal() const { return cells_->number(goal_.x, goal_.y); }
  std::uint32_t squared(VertexId v) const { return field_.squared(cells_->cell(v).x, cells_->cell(v).y); }
  double length(VertexId v, VertexId w) const {
    const Cell a = cells_->cell(v);
    const Cell b = cells_->cell(w);
    return a.x != b.x && a.y != b.y ? sqrt2 : 1.0;
  }
  void thin();
  void link();
  bool joined();
  std::vector<std::uint32_t> widths() const;
  void join_end_to_axis(VertexId end, std::vector<std::uint32_t>& widths) const;
  static std::vector<Edge> at_least(std::span<const Edge> edges, std::span<const std::uint32_t> widths,
                                    std::uint32_t least);
  std::uint32_t widest(std::span<const std::uint32_t> widths) const;
  void search();
  SearchResult found(const Graph& graph) const;

  Cell start_, goal_;
  const SkeletonOptions& options_;
  const Execution& execution_;
  const Bitmap& blocked_;
  const DistanceField& field_;
  std::optional<NumberedCells> cells_;
  std::vector<Edge> edges_;
  SkeletonPath plan_;
};

void SkeletonPlan::thin() {
  const StageTimer timer(execution_, "skeleton", plan_.seconds.graph, blocked_.size());
  const std::array<Cell, 2> kept{start_, goal_};
  cells_.emplace(map_skeleton(blocked_, field_, kept, execution_));
}

void SkeletonPlan::link() {
  const StageTimer timer(execution_, "connect", plan_.seconds.connect, cells_->size());
  for (VertexId v = 0; v < cells_->size(); ++v) {
    if (v % 4096 == 0) execution_.check();
    const Cell c = cells_->cell(v);
    for (const auto& [dx, dy] : cell_steps) {
      const std::int64_t x = std::int64_t{c.x} + dx;
      const std::int64_t y = std::int64_t{c.y} + dy;
      if (dy < 0 || (dy == 0 && dx < 0) || !cells_->holds(x, y)) continue;  // each step once
      if (dx != 0 && dy != 0 && (blocked_.holds(x, c.y) || blocked_.holds(c.x, y))) continue;
      edges_.push_back({v, cells_->number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))});
    }
  }
}

bool SkeletonPlan::joined() {
  const Graph graph = assemble_graph(cells_->size(), edges_, execution_);
  const Components parts = components(graph, execution_);
  plan_.roadmap = {cells_->size(), edges_.size(), parts.count};
  if (parts.connected(start(), goal())) return true;
  const auto points_of = [&](VertexId end) {
    std::vector<Vec2> points;
    for (VertexId v = 0; v < cells_->size(); ++v) {
      const Cell c = cells_->cell(v);
      if (parts.connected(v, end)) points.push_back({c.x + 0.5, c.y + 0.5});
    }
    return points;
  };
  plan_.separation = separation_between<2>(points_of(start()), points_of(goal()), execution_);
  return false;
}

/// How wide the skeleton is at each cell: its squared distance; without limit on the ways from start and goal to the
/// first fork, which every path takes.
std::vector<std::uint32_t> SkeletonPlan::widths() const {
  std::vector<std::uint32_t> widths;
  widths.reserve(cells_->size());
  for (VertexId v = 0; v < cells_->size(); ++v) widths.push_back(squared(v));
  join_end_to_axis(start(), widths);
  join_end_to_axis(goal(), widths);
  return widths;
}

void SkeletonPlan::join_end_to_axis(VertexId end, std::vector<std::uint32_t>& widths) const {
  constexpr std::array<std::array<int, 2>, 4> sides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  VertexId before = no_vertex;
  for (VertexId v = end; v != no_vertex;) {
    widths[v] = DistanceField::far;
    VertexId next = no_vertex;
    int ways = 0;
    const Cell c = cells_->cell(v);
    for (const auto& [dx, dy] : sides) {
      const std::int64_t x = std::int64_t{c.x} + dx;
      const std::int64_t y = std::int64_t{c.y} + dy;
      if (!cells_->holds(x, y)) continue;
      const VertexId w = cells_->number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      if (w == before) continue;
      next = w;
      ++ways;
    }
    const bool goes_on = ways == 1 && widths[next] != DistanceField::far;
    before = v;
    v = goes_on ? next : no_vertex;
  }
}

std::vector<Edge> SkeletonPlan::at_least(std::span<const Edge> edges, std::span<const std::uint32_t> widths,
                                         std::uint32_t least) {
  std::vector<Edge> wide;
  for (const Edge& e : edges) {
    if (widths[e.from] >= least && widths[e.to] >= least) wide.push_back(e);
  }
  return wide;
}

/// The largest width at which start and goal are joined; they are at the least one.
std::uint32_t SkeletonPlan::widest(std::span<const std::uint32_t> widths) const {
  std::vector<std::uint32_t> levels(widths.begin(), widths.end());
  polled_sort(levels.begin(), levels.end(), execution_);
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  std::size_t low = 0;  // joins; from `high` on nothing does
  for (std::size_t high = levels.size(); high - low > 1;) {
    const std::size_t middle = low + (high - low) / 2;
    const Graph wide = assemble_graph(cells_->size(), at_least(edges_, widths, levels[middle]), execution_);
    (components(wide, execution_).connected(start(), goal()) ? low : high) = middle;
  }
  return levels[low];
}

SearchResult SkeletonPlan::found(const Graph& graph) const {
  SearchState state;
  state.resize(graph.vertex_count(), [&] { execution_.check(); });
  const auto should_stop = [&] { return execution_.should_stop(); };
  if (options_.search == SearchKind::bfs) return breadth_first(graph, start(), goal(), state, should_stop);
  if (options_.search == SearchKind::dfs) return depth_first(graph, start(), goal(), state, should_stop);
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : graph.neighbours(v)) visit(w, length(v, w));
  };
  const bool informed = options_.search == SearchKind::astar;
  const auto estimate = [&](VertexId v) {
    const Cell c = cells_->cell(v);
    return informed ? portable::hypot(static_cast<double>(c.x) - goal_.x, static_cast<double>(c.y) - goal_.y) : 0.0;
  };
  return with_queue(options_.queue, graph.vertex_count(), execution_, [&](auto& queue) {
    return best_first(start(), goal(), neighbours, estimate, queue, state, should_stop);
  });
}

void SkeletonPlan::search() {
  const StageTimer timer(execution_, "search", plan_.seconds.search, cells_->size());
  if (options_.objective == AxisObjective::clearance) {
    const std::vector<std::uint32_t> wide = widths();
    edges_ = at_least(edges_, wide, widest(wide));
  }
  const SearchResult result = found(assemble_graph(cells_->size(), edges_, execution_));
  if (result.status == SearchStatus::stopped) execution_.check();
  plan_.expanded = result.expanded;
  if (result.status != SearchStatus::found) return;
  plan_.outcome = Outcome::solved;
  std::uint32_t least = DistanceField::far;
  for (const VertexId v : result.path) {
    plan_.cells.push_back(cells_->cell(v));
    least = std::min(least, squared(v));
  }
  plan_.clearance = 0.5 * std::sqrt(least);
}

}  // namespace

SkeletonRoadmap::SkeletonRoadmap(const Bitmap& map, double radius, const Execution& execution)
    : blocked(blocked_for_disc(map, radius, execution)), field(map, CellDistance::squares, true, execution) {}

SkeletonPath plan_on_skeleton(const Bitmap& blocked, Cell start, Cell goal, const SkeletonOptions& options,
                              const Execution& execution, std::vector<std::pair<Cell, Cell>>* steps) {
  std::optional<SkeletonRoadmap> roadmap;
  double index_s = 0.0;
  {
    const StageTimer timer(execution, "index", index_s, blocked.size());
    roadmap.emplace(blocked, options.radius, execution);
  }
  SkeletonPath plan = plan_on_skeleton(*roadmap, start, goal, options, execution, steps);
  plan.seconds.index += index_s;
  return plan;
}

SkeletonPath plan_on_skeleton(const SkeletonRoadmap& roadmap, Cell start, Cell goal, const SkeletonOptions& options,
                              const Execution& execution, std::vector<std::pair<Cell, Cell>>* steps) {
  return SkeletonPlan(roadmap, start, goal, options, execution).run(steps);
}

}  // namespace warren
