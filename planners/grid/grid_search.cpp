// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/grid_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "core/search/search_queues.hpp"
#include "parallel/asked_memory.hpp"

namespace warren {

StepRule rule_of(Diagonal diagonal) { return diagonal == Diagonal::none ? StepRule::four : StepRule::eight; }

namespace {

/// The first turn or the goal on the row to the right of v, before a blocked cell.
VertexId scan_up(const FreeCells& cells, VertexId v, VertexId goal) {
  const VertexId stride = cells.stride();
  for (VertexId at = v + 1;; at += 64) {
    const std::uint64_t free = cells.from(at);
    const std::uint64_t turns = (cells.from(at + stride) & ~cells.from(at + stride - 1)) |
                                (cells.from(at - stride) & ~cells.from(at - stride - 1));
    const std::uint64_t stops = ~free | turns;
    const auto first = static_cast<VertexId>(std::countr_zero(stops));
    if (goal - at < 64 && goal - at <= first) return goal;  // unsigned: a goal behind is far ahead
    if (first == 64) continue;
    return (free >> first & 1U) != 0 ? at + first : no_vertex;
  }
}

/// The same to the left.
VertexId scan_down(const FreeCells& cells, VertexId v, VertexId goal) {
  const VertexId stride = cells.stride();
  for (VertexId at = v - 1;; at -= 64) {
    const VertexId low = at - 63;  // bit 63 is `at`
    const std::uint64_t free = cells.from(low);
    const std::uint64_t turns = (cells.from(low + stride) & ~cells.from(low + stride + 1)) |
                                (cells.from(low - stride) & ~cells.from(low - stride + 1));
    const std::uint64_t stops = ~free | turns;
    const auto first = static_cast<VertexId>(std::countl_zero(stops));
    if (at - goal < 64 && at - goal <= first) return goal;
    if (first == 64) continue;
    return (free << first >> 63 & 1U) != 0 ? at - first : no_vertex;
  }
}

int sign(std::int64_t x) { return (x > 0) - (x < 0); }

/// The number of a step in cell_steps.
constexpr unsigned step_of(int dx, int dy) {
  const int nine = 3 * (dy + 1) + dx + 1;
  return static_cast<unsigned>(nine > 4 ? nine - 1 : nine);
}

double diagonal_cost(Diagonal diagonal) { return diagonal == Diagonal::unit ? 1.0 : std::numbers::sqrt2; }

/// Length of a shortest path from a cell without obstacles: consistent.
auto free_distance_to(VertexId goal, const FreeCells& cells, Diagonal diagonal) {
  return [&cells, to = cells.cell(goal), diagonal](VertexId v) {
    const Cell c = cells.cell(v);
    const double dx = std::abs(static_cast<double>(c.x) - to.x);
    const double dy = std::abs(static_cast<double>(c.y) - to.y);
    if (diagonal == Diagonal::none) return dx + dy;
    if (diagonal == Diagonal::unit) return std::max(dx, dy);
    return std::max(dx, dy) + (std::numbers::sqrt2 - 1.0) * std::min(dx, dy);
  };
}

/// The steps of a cell, as a search asks for them.
class Steps {
 public:
  Steps(const FreeCells& cells, StepRule rule, Diagonal diagonal) : cells_(cells), allowed_(allowed_steps(rule)) {
    const auto stride = static_cast<std::int64_t>(cells.stride());
    for (unsigned s = 0; s < cell_steps.size(); ++s) {
      offsets_[s] = static_cast<VertexId>(cell_steps[s][1] * stride + cell_steps[s][0]);  // wraps around for steps back
      costs_[s] = is_diagonal(s) ? diagonal_cost(diagonal) : 1.0;
    }
  }
  template <class Visit>
  void operator()(VertexId v, const Visit& visit) const {
    for (unsigned rest = allowed_[cells_.around(v)]; rest != 0; rest &= rest - 1) {
      const auto s = static_cast<unsigned>(std::countr_zero(rest));
      visit(v + offsets_[s], costs_[s]);
    }
  }
  VertexId offset(unsigned step) const { return offsets_[step]; }
  unsigned allowed(VertexId v) const { return allowed_[cells_.around(v)]; }

 private:
  const FreeCells& cells_;
  const std::array<std::uint8_t, 512>& allowed_;
  std::array<VertexId, 8> offsets_{};
  std::array<double, 8> costs_{};
};

/// Fewest steps. A byte a cell, and no graph is made for core's breadth_first.
SearchResult breadth_first_over(const FreeCells& cells, const Steps& steps, VertexId start, VertexId goal,
                                const Execution& execution) {
  constexpr std::uint8_t origin = 9;
  RawVector<std::uint8_t> arrived_by;  // how each cell was first reached: a step and one, 0 where it was not
  execution.reserve(cells.number_end());
  assign_polled(arrived_by, cells.number_end(), std::uint8_t{0}, [&] { execution.check(); });
  SearchResult result;
  std::vector<VertexId> level{start};
  std::vector<VertexId> next;
  arrived_by[start] = origin;
  while (!level.empty() && arrived_by[goal] == 0) {
    if (execution.should_stop()) {
      result.status = SearchStatus::stopped;
      return result;
    }
    next.clear();
    for (const VertexId v : level) {
      for (unsigned rest = steps.allowed(v); rest != 0; rest &= rest - 1) {
        const auto s = static_cast<unsigned>(std::countr_zero(rest));
        const VertexId w = v + steps.offset(s);
        if (arrived_by[w] != 0) continue;
        arrived_by[w] = static_cast<std::uint8_t>(s + 1);
        next.push_back(w);
      }
    }
    result.expanded += level.size();
    level.swap(next);
  }
  if (arrived_by[goal] == 0) return result;
  result.status = SearchStatus::found;
  for (VertexId v = goal; v != start; v -= steps.offset(arrived_by[v] - 1U)) push_asked(result.path, v, execution);
  push_asked(result.path, start, execution);
  std::reverse(result.path.begin(), result.path.end());
  return result;
}

}  // namespace

/// Jump point search (Harabor, Grastien 2011) for octile maps on which a diagonal step needs both cells beside it free:
/// the successors of a cell are the next cells where a shortest path may have to turn. Rows and columns are scanned 64
/// cells at a time (block-based scanning, Harabor, Grastien 2014), columns in a transposed copy of the map.
///
/// With this rule only straight moves have forced neighbours: moving along +x, the cell beside is a turn where it is
/// free and the cell behind it is not; a diagonal move goes on until a straight scan from it finds a turn or the goal.
/// Refers to the cells, which must outlive it. Immutable; any number of threads may read.
class JumpPoints {
 public:
  /// `blocked`: the map of the cells. O(cells). Throws Stopped.
  JumpPoints(const FreeCells& cells, const Bitmap& blocked, const Execution& execution)
      : rows_(cells), columns_(transposed(blocked, execution)) {}

  /// Calls visit(w, length) for the jump points after v, which was reached from `parent` (no_vertex: it is the start).
  template <class Visit>
  void visit(VertexId v, VertexId parent, VertexId goal, const Visit& visit) const {
    for (unsigned rest = directions(v, parent); rest != 0; rest &= rest - 1) {
      const auto s = static_cast<unsigned>(std::countr_zero(rest));
      const auto [dx, dy] = cell_steps[s];
      const VertexId w = is_diagonal(s) ? jump_diagonal(v, dx, dy, goal) : jump_straight(v, dx, dy, goal);
      if (w != no_vertex) visit(w, distance(v, w));
    }
  }

  /// Jump points with the cells between them.
  RawVector<VertexId> with_steps(std::span<const VertexId> jump_points, const Execution& execution) const {
    RawVector<VertexId> path;
    for (const VertexId to : jump_points) {
      if (!path.empty()) {
        const Cell a = rows_.cell(path.back());
        const Cell b = rows_.cell(to);
        const auto offset = static_cast<VertexId>(
            sign(std::int64_t{b.y} - a.y) * static_cast<std::int64_t>(rows_.stride()) + sign(std::int64_t{b.x} - a.x));
        while (path.back() + offset != to) {
          execution.poll(path.size());
          push_asked(path, path.back() + offset, execution);
        }
      }
      push_asked(path, to, execution);
    }
    return path;
  }

 private:
  /// A bit for each of cell_steps that a shortest path may take from v.
  unsigned directions(VertexId v, VertexId parent) const {
    const unsigned around = rows_.around(v);
    const unsigned allowed = allowed_steps(StepRule::eight)[around];
    if (parent == no_vertex) return allowed;
    const Cell c = rows_.cell(v);
    const Cell p = rows_.cell(parent);
    const int dx = sign(std::int64_t{c.x} - p.x);
    const int dy = sign(std::int64_t{c.y} - p.y);
    unsigned kept = 1U << step_of(dx, dy);
    if (dx != 0 && dy != 0) return allowed & (kept | 1U << step_of(dx, 0) | 1U << step_of(0, dy));
    for (const int side : {-1, 1}) {
      const int behind_x = dx != 0 ? -dx : side;
      const int behind_y = dy != 0 ? -dy : side;
      const bool behind_is_free = (around >> (3 * (behind_y + 1) + behind_x + 1) & 1U) != 0;
      if (behind_is_free) continue;
      kept |= 1U << (dx != 0 ? step_of(0, side) : step_of(side, 0));
      kept |= 1U << (dx != 0 ? step_of(dx, side) : step_of(side, dy));
    }
    return allowed & kept;
  }

  VertexId jump_straight(VertexId v, int dx, int dy, VertexId goal) const {
    if (dy == 0) return dx > 0 ? scan_up(rows_, v, goal) : scan_down(rows_, v, goal);
    const auto column_number = [&](VertexId number) {
      const Cell c = rows_.cell(number);
      return columns_.number({c.y, c.x});
    };
    const VertexId from = column_number(v);
    const VertexId to = column_number(goal);
    const VertexId found = dy > 0 ? scan_up(columns_, from, to) : scan_down(columns_, from, to);
    if (found == no_vertex) return no_vertex;
    const Cell c = columns_.cell(found);
    return rows_.number({c.y, c.x});
  }

  VertexId jump_diagonal(VertexId v, int dx, int dy, VertexId goal) const {
    const auto offset = static_cast<VertexId>(dy * static_cast<std::int64_t>(rows_.stride()) + dx);
    const unsigned step = 1U << step_of(dx, dy);
    for (VertexId at = v; (allowed_steps(StepRule::eight)[rows_.around(at)] & step) != 0;) {
      at += offset;
      if (at == goal) return at;
      if (jump_straight(at, dx, 0, goal) != no_vertex || jump_straight(at, 0, dy, goal) != no_vertex) return at;
    }
    return no_vertex;
  }

  double distance(VertexId v, VertexId w) const {
    const Cell a = rows_.cell(v);
    const Cell b = rows_.cell(w);
    const double dx = std::abs(static_cast<double>(a.x) - b.x);
    const double dy = std::abs(static_cast<double>(a.y) - b.y);
    return dx == dy ? std::numbers::sqrt2 * dx : dx + dy;  // along a row, a column or a diagonal
  }

  const FreeCells& rows_;
  FreeCells columns_;  // the same map, x and y exchanged
};

bool has_diagonal_steps(const Bitmap& blocked, const Execution& execution) {
  const FreeCells cells(blocked, execution);
  for (std::uint32_t y = 0; y + 1 < cells.height(); ++y) {
    execution.poll(y);
    for (std::uint32_t x = 0; x < cells.width(); x += Bitmap::word_bits) {
      const VertexId v = cells.number({x, y});
      const std::uint64_t both = cells.from(v) & cells.from(v + cells.stride());
      const std::uint64_t shifted = cells.from(v + 1) & cells.from(v + 1 + cells.stride());
      if ((both & shifted) != 0) return true;
    }
  }
  return false;
}

bool cells_connect(const Bitmap& blocked, Cell start, Cell goal, bool squeezing, const Execution& execution) {
  const FreeCells cells(blocked, execution);
  const Steps steps(cells, squeezing ? StepRule::eight_squeezing : StepRule::four, Diagonal::unit);
  const VertexId from = cells.number(start);
  const VertexId to = cells.number(goal);
  if (!cells.is_free(from) || !cells.is_free(to)) return false;
  const SearchResult result = breadth_first_over(cells, steps, from, to, execution);
  if (result.status == SearchStatus::stopped) execution.check();
  return result.status == SearchStatus::found;
}

double cost_of(const std::vector<Cell>& cells, Diagonal diagonal) {
  std::uint64_t sideways = 0;
  std::uint64_t diagonals = 0;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    (cells[i].x != cells[i - 1].x && cells[i].y != cells[i - 1].y ? diagonals : sideways) += 1;
  }
  return static_cast<double>(sideways) + static_cast<double>(diagonals) * diagonal_cost(diagonal);
}

struct GridSearch::Scratch {
  Scratch(const Bitmap& map, const Execution& execution)
      : blocked((execution.reserve(map.bytes()), map)), cells(map, execution) {}

  SearchResult search(VertexId start, VertexId goal, const GridSearchOptions& options, const Execution& execution) {
    const auto should_stop = [&] { return execution.should_stop(); };
    const Steps steps(cells, rule_of(options.diagonal), options.diagonal);
    if (options.method == GridMethod::bfs) return breadth_first_over(cells, steps, start, goal, execution);
    const bool is_jumping = options.method == GridMethod::jump_points;
    if (is_jumping && !jumps) jumps.emplace(cells, blocked, execution);
    constexpr std::size_t bytes_a_cell = 12;
    if (state.vertex_count() < cells.number_end()) execution.reserve(cells.number_end() * bytes_a_cell);
    state.resize(cells.number_end(), [&] { execution.check(); });
    queue.clear();
    const auto at_least = free_distance_to(goal, cells, options.diagonal);
    if (is_jumping) {
      const auto successors = [&](VertexId v, const auto& visit) { jumps->visit(v, state.parent(v), goal, visit); };
      SearchResult result = best_first(start, goal, successors, at_least, queue, state, should_stop);
      result.path = jumps->with_steps(result.path, execution);
      return result;
    }
    const auto remaining = [informed = options.method == GridMethod::astar, at_least](VertexId v) {
      return informed ? at_least(v) : 0.0;
    };
    return best_first(start, goal, steps, remaining, queue, state, should_stop);
  }

  Bitmap blocked;
  FreeCells cells;
  SearchState state;
  BucketQueue queue;
  std::optional<JumpPoints> jumps;  // made where it is first asked for
};

GridSearch::GridSearch(const Bitmap& blocked, const Execution& execution)
    : scratch_(std::make_unique<Scratch>(blocked, execution)) {}
GridSearch::~GridSearch() = default;

GridPath GridSearch::find(Cell start, Cell goal, const GridSearchOptions& options, const Execution& execution) {
  const FreeCells& cells = scratch_->cells;
  for (const Cell c : {start, goal}) {
    if (c.x >= cells.width() || c.y >= cells.height()) {
      throw InputError("cell", "lies outside of the map", std::to_string(c.x) + ", " + std::to_string(c.y));
    }
  }
  if (options.method == GridMethod::jump_points && options.diagonal != Diagonal::sqrt2) {
    throw InputError("jump point search", "needs diagonal steps that cost the root of 2");
  }
  const VertexId from = cells.number(start);
  const VertexId to = cells.number(goal);
  GridPath path;
  if (!cells.is_free(from) || !cells.is_free(to)) return path;
  const SearchResult result = scratch_->search(from, to, options, execution);
  if (result.status == SearchStatus::stopped) execution.check();
  path.status = result.status;
  path.expanded = result.expanded;
  execution.reserve(result.path.size() * sizeof(Cell));
  path.cells.reserve(result.path.size());
  for (const VertexId v : result.path) {
    execution.poll(path.cells.size());
    path.cells.push_back(cells.cell(v));
  }
  path.cost = cost_of(path.cells, options.diagonal);
  return path;
}

}  // namespace warren
