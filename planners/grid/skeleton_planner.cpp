// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/skeleton_planner.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/search/search.hpp"
#include "core/search/union_find.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {
namespace {

/// The eight cells around one, in turn, from the right anticlockwise: even ones share a side with it.
constexpr std::array<std::array<int, 2>, 8> ring{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Can the middle go, where bit i of `around` says whether ring[i] is there? Its neighbours over sides must be one
/// piece over sides within the ring, and something that is missing must be among the eight: then the missing ones are
/// one piece over corners.
constexpr bool is_simple(unsigned around) {
  const auto is_there = [&](unsigned i) { return (around >> (i % 8) & 1U) != 0; };
  if (around == 255U) return false;
  unsigned pieces = 0;
  for (unsigned side = 0; side < 8; side += 2) {
    // A piece begins at a side whose neighbour over the corner before it does not lead on to the side before.
    if (is_there(side) && !(is_there(side + 7) && is_there(side + 6))) ++pieces;
  }
  return pieces == 1;
}

constexpr std::array<bool, 256> simple_table = [] {
  std::array<bool, 256> table{};
  for (unsigned around = 0; around < table.size(); ++around) table[around] = is_simple(around);
  return table;
}();

class Thinning {
 public:
  Thinning(const Bitmap& blocked, const DistanceField& field, std::span<const Cell> kept, SkeletonEnds ends,
           const Execution& execution)
      : field_(field),
        ends_(ends),
        execution_(execution),
        width_((execution.reserve(2 * blocked.bytes()), blocked.width())),
        rest_(blocked.width(), blocked.height(), true, [&] { execution.check(); }),
        waits_(blocked.width(), blocked.height(), false, [&] { execution.check(); }),
        kept_(kept) {
    rest_.remove(blocked, [&] { execution.check(); });
  }

  Bitmap run() {
    line_up();
    constexpr std::uint64_t batch = 1 << 14;
    for (std::uint64_t done = 1; !waiting_.empty(); ++done) {
      if (done % batch == 0) execution_.check();
      const auto nearest = waiting_.begin();
      Line& line = nearest->second;
      const std::uint32_t number = line.cells[line.next++];
      if (line.next == line.cells.size()) waiting_.erase(nearest);
      const Cell cell{number % width_, number / width_};
      waits_.clear(cell.x, cell.y);
      const unsigned near = around(cell);
      if (simple_table[near] && !is_kept(cell) && !stays_as_end(cell, near)) remove(cell);
    }
    return std::move(rest_);
  }

 private:
  /// Cells of one distance, in the order in which they came.
  struct Line {
    std::vector<std::uint32_t> cells;
    std::size_t next = 0;
  };
  unsigned around(Cell cell) const {
    unsigned bits = 0;
    for (unsigned i = 0; i < ring.size(); ++i) {
      bits |= rest_.holds(std::int64_t{cell.x} + ring[i][0], std::int64_t{cell.y} + ring[i][1]) ? 1U << i : 0U;
    }
    return bits;
  }
  bool is_kept(Cell cell) const { return std::find(kept_.begin(), kept_.end(), cell) != kept_.end(); }
  /// The cell has one neighbour over a side, and the distance is nearly as large here as around it.
  bool stays_as_end(Cell cell, unsigned near) const {
    constexpr unsigned sides = 0x55U;
    constexpr double least_slope = 0.5;
    if (ends_ == SkeletonEnds::go || std::popcount(near & sides) != 1) return false;
    return steepest(cell, 1) < least_slope && steepest(cell, 3) < least_slope;
  }
  /// How much the distance grows from there on, a cell of the way.
  double steepest(Cell cell, int reach) const {
    double slope = 0.0;
    for (const auto& [dx, dy] : ring) {
      const std::uint32_t x = cell.x + static_cast<std::uint32_t>(reach * dx);  // before 0: far beyond the width
      const std::uint32_t y = cell.y + static_cast<std::uint32_t>(reach * dy);
      if (x >= rest_.width() || y >= rest_.height()) continue;
      const double run = reach * (dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0);
      slope = std::max(slope, (field_.distance(x, y) - field_.distance(cell.x, cell.y)) / run);
    }
    return slope;
  }
  void wait(Cell cell) {
    if (waits_.test(cell.x, cell.y)) return;
    waits_.set(cell.x, cell.y);
    push_asked(waiting_[field_.squared(cell.x, cell.y)].cells, cell.y * width_ + cell.x, execution_);
  }
  /// The cells at a border; those inside follow when their neighbours go.
  void line_up() {
    for (std::uint32_t y = 0; y < rest_.height(); ++y) {
      for (std::uint32_t x = 0; x < width_; ++x) {
        execution_.poll(x);
        if (rest_.test(x, y) && around({x, y}) != 255U) wait({x, y});
      }
    }
  }
  void remove(Cell cell) {
    rest_.clear(cell.x, cell.y);
    for (const auto& [dx, dy] : ring) {
      const std::int64_t x = std::int64_t{cell.x} + dx;
      const std::int64_t y = std::int64_t{cell.y} + dy;
      if (rest_.holds(x, y)) wait({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)});
    }
  }

  const DistanceField& field_;
  SkeletonEnds ends_;
  const Execution& execution_;
  std::uint32_t width_;
  Bitmap rest_;
  Bitmap waits_;
  std::span<const Cell> kept_;
  std::map<std::uint32_t, Line> waiting_;  // by their distance
};

/// The set cells of a bitmap, such as a map's skeleton, as vertices of a graph, numbered row by row.
class NumberedCells {
 public:
  NumberedCells(Bitmap cells, const Execution& execution) : bits_(std::move(cells)) {
    std::uint32_t count = 0;
    for (const std::uint64_t word : bits_.words()) {
      execution.poll(before_.size());
      push_asked(before_, count, execution);
      count += static_cast<std::uint32_t>(std::popcount(word));
    }
    execution.reserve(count * sizeof(Cell));
    cells_.reserve(count);
    for (std::uint32_t y = 0; y < bits_.height(); ++y) {
      execution.check();
      bits_.for_each_in_row(y, [&](std::uint32_t x) { cells_.push_back({x, y}); });
    }
  }
  std::size_t size() const { return cells_.size(); }
  Cell cell(VertexId v) const { return cells_[v]; }
  bool holds(std::int64_t x, std::int64_t y) const { return bits_.holds(x, y); }
  /// Of a cell that is set.
  VertexId number(std::uint32_t x, std::uint32_t y) const {
    const std::size_t word = y * bits_.row(0).size() + x / 64;
    const std::uint64_t below = (std::uint64_t{1} << x % 64) - 1;
    return before_[word] + static_cast<VertexId>(std::popcount(bits_.words()[word] & below));
  }
  /// Of a cell, over its sides: from the right anticlockwise.
  struct Neighbours {
    std::array<VertexId, 4> cell{};
    std::size_t count = 0;
    auto begin() const { return cell.begin(); }
    auto end() const { return cell.begin() + static_cast<std::ptrdiff_t>(count); }
  };
  Neighbours neighbours(VertexId v) const {
    Neighbours found;
    const Cell c = cells_[v];
    for (std::size_t side = 0; side < ring.size(); side += 2) {
      const std::int64_t x = std::int64_t{c.x} + ring[side][0];
      const std::int64_t y = std::int64_t{c.y} + ring[side][1];
      if (!holds(x, y)) continue;
      found.cell[found.count++] = number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    }
    return found;
  }

 private:
  Bitmap bits_;
  std::vector<std::uint32_t> before_;  // set cells before each word
  std::vector<Cell> cells_;
};

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
    if (blocked_.test(goal_.x, goal_.y)) plan_.outcome = Outcome::goal_blocked;
    if (blocked_.test(start_.x, start_.y)) plan_.outcome = Outcome::start_blocked;
    if (is_blocked(plan_.outcome)) return std::move(plan_);
    {
      const StageTimer timer(execution_, "skeleton", plan_.seconds.graph, blocked_.size());
      cells_.emplace(map_skeleton(blocked_, field_, std::array{start_, goal_}, execution_), execution_);
    }
    link();
    if (steps != nullptr) {
      execution_.reserve(edges_.size() * sizeof(steps->front()));
      steps->reserve(edges_.size());
      for (const Edge& e : edges_) {
        execution_.poll(steps->size());
        steps->push_back({cells_->cell(e.from), cells_->cell(e.to)});
      }
    }
    if (joined()) search();
    return std::move(plan_);
  }

 private:
  VertexId start() const { return cells_->number(start_.x, start_.y); }
  VertexId goal() const { return cells_->number(goal_.x, goal_.y); }
  std::uint32_t squared(VertexId v) const { return field_.squared(cells_->cell(v).x, cells_->cell(v).y); }
  void link() {
    const StageTimer timer(execution_, "connect", plan_.seconds.connect, cells_->size());
    for (VertexId v = 0; v < cells_->size(); ++v) {
      execution_.poll(v);
      const Cell c = cells_->cell(v);
      for (const auto& [dx, dy] : cell_steps) {
        const std::int64_t x = std::int64_t{c.x} + dx;
        const std::int64_t y = std::int64_t{c.y} + dy;
        if (dy < 0 || (dy == 0 && dx < 0) || !cells_->holds(x, y)) continue;  // each step once
        if (dx != 0 && dy != 0 && (blocked_.holds(x, c.y) || blocked_.holds(c.x, y))) continue;
        push_asked(edges_, {v, cells_->number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))},
                   execution_);
      }
    }
  }

  bool joined() {
    const Graph graph = assemble_graph(cells_->size(), edges_, execution_);
    const Components parts = components(graph, execution_);
    plan_.roadmap = {cells_->size(), edges_.size(), parts.count};
    if (parts.connected(start(), goal())) return true;
    plan_.separation = separation_of_parts<2>(parts, start(), goal(), execution_, [&](VertexId v) {
      return Vec2{cells_->cell(v).x + 0.5, cells_->cell(v).y + 0.5};
    });
    return false;
  }

  /// How wide the skeleton is at each cell: its squared distance; without limit on the ways from start and goal to the
  /// first fork, which every path takes.
  std::vector<std::uint32_t> widths() const {
    std::vector<std::uint32_t> widths;
    widths.reserve(cells_->size());
    for (VertexId v = 0; v < cells_->size(); ++v) {
      execution_.poll(v);
      widths.push_back(squared(v));
    }
    join_end_to_axis(start(), widths);
    join_end_to_axis(goal(), widths);
    return widths;
  }

  void join_end_to_axis(VertexId end, std::vector<std::uint32_t>& widths) const {
    VertexId before = no_vertex;
    std::uint64_t steps = 0;
    for (VertexId v = end;;) {
      execution_.poll(++steps);
      widths[v] = DistanceField::far;
      VertexId next = no_vertex;
      int ways = 0;
      for (const VertexId w : cells_->neighbours(v)) {
        if (w == before) continue;
        next = w;
        ++ways;
      }
      if (ways != 1 || widths[next] == DistanceField::far) return;
      before = std::exchange(v, next);
    }
  }

  /// Leaves the edges of the largest width at which start and goal, which are joined, still are.
  void narrow_to_widest() {
    // The widths, the sets that are joined, and the edges by their widths.
    execution_.reserve(cells_->size() * 2 * sizeof(std::uint32_t) + edges_.size() * sizeof(Edge));
    const std::vector<std::uint32_t> widths = this->widths();
    const auto width = [&](const Edge& e) { return std::min(widths[e.from], widths[e.to]); };
    std::vector<Edge> order = edges_;
    polled_sort(order.begin(), order.end(), execution_,
                [&](const Edge& e, const Edge& f) { return width(e) > width(f); });
    std::vector<VertexId> parent(cells_->size());
    std::iota(parent.begin(), parent.end(), 0U);
    std::uint32_t least = DistanceField::far;
    for (std::size_t i = 0; root_of(parent, start()) != root_of(parent, goal()); ++i) {
      execution_.poll(i);
      least = width(order[i]);
      unite(parent, order[i].from, order[i].to);
    }
    std::erase_if(edges_, [&](const Edge& e) { return width(e) < least; });
  }

  void search() {
    const StageTimer timer(execution_, "search", plan_.seconds.search, cells_->size());
    if (options_.objective == AxisObjective::clearance) narrow_to_widest();
    const auto length = [&](VertexId v, VertexId w) {
      const Cell a = cells_->cell(v);
      const Cell b = cells_->cell(w);
      return a.x != b.x && a.y != b.y ? std::numbers::sqrt2 : 1.0;
    };
    const auto estimate = [&](VertexId v, VertexId to) {
      const Cell a = cells_->cell(v);
      const Cell b = cells_->cell(to);
      return portable::hypot(static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y);
    };
    const RoadmapSearch asked{.start = start(),
                              .goal = goal(),
                              .length = VertexDistance(length),
                              .estimate = VertexDistance(estimate),
                              .search = options_.search,
                              .queue = options_.queue,
                              .execution = execution_,
                              .estimate_fits = false};  // from the start alone
    const SearchResult result = search_roadmap(assemble_graph(cells_->size(), edges_, execution_), asked);
    plan_.counters.expanded = result.expanded;
    if (result.status != SearchStatus::found) return;
    plan_.outcome = Outcome::solved;
    std::uint32_t least = DistanceField::far;
    execution_.reserve(result.path.size() * sizeof(Cell));
    plan_.path.reserve(result.path.size());
    for (const VertexId v : result.path) {
      execution_.poll(plan_.path.size());
      plan_.path.push_back(cells_->cell(v));
      least = std::min(least, squared(v));
    }
    plan_.clearance = 0.5 * std::sqrt(least);
  }

  Cell start_, goal_;
  const SkeletonOptions& options_;
  const Execution& execution_;
  const Bitmap& blocked_;
  const DistanceField& field_;
  std::optional<NumberedCells> cells_;
  std::vector<Edge> edges_;
  SkeletonPath plan_;
};

/// Follows the skeleton from side to side: chains of cells with two neighbours each, between those that have more or
/// fewer. One use.
class LinesOfSkeleton {
 public:
  LinesOfSkeleton(const SkeletonRoadmap& roadmap, const Execution& execution)
      : blocked_(roadmap.blocked),
        execution_(execution),
        cells_(map_skeleton(roadmap.blocked, roadmap.field, {}, execution, SkeletonEnds::stay), execution),
        passed_((execution.reserve(cells_.size()), cells_.size()), 0) {}

  SkeletonLines run() {
    for (VertexId v = 0; v < cells_.size(); ++v) {
      execution_.poll(v);
      if (cells_.neighbours(v).count != 2) follow_all(v);
    }
    for (VertexId v = 0; v < cells_.size(); ++v) {  // what is left are rings
      execution_.poll(v);
      if (passed_[v] == 0 && cells_.neighbours(v).count == 2) follow(v, cells_.neighbours(v).cell[0]);
    }
    return numbered();
  }

 private:
  /// Each chain once: from the end that comes first, or from either where it is walked by its own cells.
  void follow_all(VertexId v) {
    passed_[v] = 1;
    for (const VertexId next : cells_.neighbours(v)) {
      const bool chain = cells_.neighbours(next).count == 2;
      if (chain ? passed_[next] == 0 : v < next) follow(v, next);
    }
    if (cells_.neighbours(v).count == 0) push_asked(points_, v, execution_);
  }

  /// From one cell over the next to where the chain ends, or closes.
  void follow(VertexId from, VertexId next) {
    chain_.assign({from, next});
    while (next != from && cells_.neighbours(next).count == 2) {
      execution_.poll(chain_.size());
      passed_[next] = 1;
      const auto near = cells_.neighbours(next);
      const VertexId before = chain_[chain_.size() - 2];
      next = near.cell[0] == before ? near.cell[1] : near.cell[0];
      push_asked(chain_, next, execution_);
    }
    passed_[from] = 1;
    cut_corners();
    add_lines();
  }

  std::pair<std::int64_t, std::int64_t> step(VertexId v, VertexId w) const {
    const Cell a = cells_.cell(v);
    const Cell b = cells_.cell(w);
    return {std::int64_t{b.x} - a.x, std::int64_t{b.y} - a.y};
  }
  bool is_diagonal(VertexId v, VertexId w) const {
    const auto [dx, dy] = step(v, w);
    const Cell a = cells_.cell(v);
    return dx != 0 && dy != 0 && !blocked_.holds(a.x + dx, a.y) && !blocked_.holds(a.x, a.y + dy);
  }

  /// Two steps round a corner become one across it, from the chain's begin on.
  void cut_corners() {
    std::size_t kept = 1;
    for (std::size_t i = 1; i < chain_.size(); ++i) {
      execution_.poll(i);
      if (i + 1 < chain_.size() && is_diagonal(chain_[kept - 1], chain_[i + 1])) ++i;
      chain_[kept++] = chain_[i];
    }
    chain_.resize(kept);
  }

  void add_lines() {
    VertexId begin = chain_.front();
    for (std::size_t i = 1; i < chain_.size(); ++i) {
      execution_.poll(i);
      const bool goes_on = i + 1 < chain_.size() && step(chain_[i - 1], chain_[i]) == step(chain_[i], chain_[i + 1]);
      if (goes_on) continue;
      if (begin != chain_[i]) push_asked(lines_, {std::min(begin, chain_[i]), std::max(begin, chain_[i])}, execution_);
      begin = chain_[i];
    }
  }

  /// Cells that are vertices, numbered in their order.
  SkeletonLines numbered() {
    execution_.reserve(6 * lines_.size() * sizeof(Edge));  // two points a line, their cells, the edges
    for (const Edge& line : lines_) points_.insert(points_.end(), {line.from, line.to});
    polled_sort(points_.begin(), points_.end(), execution_);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    polled_sort(lines_.begin(), lines_.end(), execution_);
    lines_.erase(std::unique(lines_.begin(), lines_.end()), lines_.end());
    const auto number = [&](VertexId v) {
      return static_cast<VertexId>(std::lower_bound(points_.begin(), points_.end(), v) - points_.begin());
    };
    SkeletonLines result;
    for (const VertexId v : points_) {
      execution_.poll(result.cells.size());
      result.cells.push_back(cells_.cell(v));
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      execution_.poll(i);
      result.edges.push_back({number(lines_[i].from), number(lines_[i].to)});
    }
    return result;
  }

  const Bitmap& blocked_;
  const Execution& execution_;
  NumberedCells cells_;
  std::vector<std::uint8_t> passed_;
  std::vector<VertexId> chain_;
  std::vector<VertexId> points_;
  std::vector<Edge> lines_;
};

}  // namespace

Bitmap map_skeleton(const Bitmap& blocked, const DistanceField& field, std::span<const Cell> kept,
                    const Execution& execution, SkeletonEnds ends) {
  return Thinning(blocked, field, kept, ends, execution).run();
}

SkeletonRoadmap::SkeletonRoadmap(const Bitmap& map, double radius, const Execution& execution)
    : blocked(blocked_for_disc(map, radius, execution)), field(map, CellDistance::squares, true, execution) {}

SkeletonPath plan_on_skeleton(const SkeletonRoadmap& roadmap, Cell start, Cell goal, const SkeletonOptions& options,
                              const Execution& execution, std::vector<std::pair<Cell, Cell>>* steps) {
  return SkeletonPlan(roadmap, start, goal, options, execution).run(steps);
}

SkeletonLines skeleton_lines(const SkeletonRoadmap& roadmap, const Execution& execution) {
  return LinesOfSkeleton(roadmap, execution).run();
}

}  // namespace warren
