// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/grid_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"
#include "core/search/search_queues.hpp"
#include "planners/grid/jump_point_search.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {
namespace {

double diagonal_cost(Diagonal diagonal) { return diagonal == Diagonal::unit ? 1.0 : std::numbers::sqrt2; }

StepRule rule_of(Diagonal diagonal) { return diagonal == Diagonal::none ? StepRule::four : StepRule::eight; }

/// Length of a shortest path without obstacles: consistent.
class FreeDistance {
 public:
  FreeDistance(const FreeCells& cells, VertexId goal, Diagonal diagonal)
      : cells_(cells), goal_(cells.cell(goal)), diagonal_(diagonal) {}
  double operator()(VertexId v) const {
    const Cell c = cells_.cell(v);
    const double dx = std::abs(static_cast<double>(c.x) - goal_.x);
    const double dy = std::abs(static_cast<double>(c.y) - goal_.y);
    if (diagonal_ == Diagonal::none) return dx + dy;
    if (diagonal_ == Diagonal::unit) return std::max(dx, dy);
    return std::max(dx, dy) + (std::numbers::sqrt2 - 1.0) * std::min(dx, dy);
  }

 private:
  const FreeCells& cells_;
  Cell goal_;
  Diagonal diagonal_;
};

/// The steps of a cell, as a search asks for them.
class Steps {
 public:
  Steps(const FreeCells& cells, Diagonal diagonal) : Steps(cells, diagonal, rule_of(diagonal)) {}
  Steps(const FreeCells& cells, Diagonal diagonal, StepRule rule) : cells_(cells), allowed_(allowed_steps(rule)) {
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

/// How each cell was first reached: a step and one, 0 where it was not.
class BreadthFirst {
 public:
  BreadthFirst(const FreeCells& cells, const Steps& steps, const Execution& execution)
      : steps_(steps), execution_(execution) {
    execution.reserve(cells.number_end());
    assign_polled(arrived_by_, cells.number_end(), std::uint8_t{0}, [&] { execution.check(); });
  }

  SearchResult find(VertexId start, VertexId goal) {
    SearchResult result;
    std::vector<VertexId> level{start};
    std::vector<VertexId> next;
    arrived_by_[start] = origin;
    while (!level.empty() && arrived_by_[goal] == 0) {
      if (execution_.should_stop()) {
        result.status = SearchStatus::stopped;
        return result;
      }
      next.clear();
      for (const VertexId v : level) expand(v, next);
      result.expanded += level.size();
      level.swap(next);
    }
    if (arrived_by_[goal] == 0) return result;
    result.status = SearchStatus::found;
    for (VertexId v = goal; v != start; v -= steps_.offset(arrived_by_[v] - 1U)) result.path.push_back(v);
    result.path.push_back(start);
    std::reverse(result.path.begin(), result.path.end());
    return result;
  }

 private:
  static constexpr std::uint8_t origin = 9;
  void expand(VertexId v, std::vector<VertexId>& next) {
    for (unsigned rest = steps_.allowed(v); rest != 0; rest &= rest - 1) {
      const auto s = static_cast<unsigned>(std::countr_zero(rest));
      const VertexId w = v + steps_.offset(s);
      if (arrived_by_[w] != 0) continue;
      arrived_by_[w] = static_cast<std::uint8_t>(s + 1);
      next.push_back(w);
    }
  }

  const Steps& steps_;
  const Execution& execution_;
  RawVector<std::uint8_t> arrived_by_;
};

}  // namespace

bool has_diagonal_steps(const Bitmap& blocked) {
  const FreeCells cells(blocked);
  for (std::uint32_t y = 0; y + 1 < cells.height(); ++y) {
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
  const FreeCells cells(blocked);
  const Steps steps(cells, Diagonal::unit, squeezing ? StepRule::eight_squeezing : StepRule::four);
  const VertexId from = cells.number(start);
  const VertexId to = cells.number(goal);
  if (!cells.is_free(from) || !cells.is_free(to)) return false;
  const SearchResult result = BreadthFirst(cells, steps, execution).find(from, to);
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
  explicit Scratch(const Bitmap& blocked) : cells(blocked) {}

  SearchResult best_first_search(VertexId start, VertexId goal, const GridSearchOptions& options,
                                 const Execution& execution);
  SearchResult jump_point_search(VertexId start, VertexId goal, const Execution& execution);
  void prepare(const Execution& execution);

  FreeCells cells;
  SearchState state;
  BucketQueue queue;
  std::optional<JumpPoints> jumps;  // made where it is first asked for
};

void GridSearch::Scratch::prepare(const Execution& execution) {
  constexpr std::size_t bytes_a_cell = 12;
  if (state.vertex_count() < cells.number_end()) execution.reserve(cells.number_end() * bytes_a_cell);
  state.resize(cells.number_end(), [&] { execution.check(); });
  queue.clear();
}

SearchResult GridSearch::Scratch::best_first_search(VertexId start, VertexId goal, const GridSearchOptions& options,
                                                    const Execution& execution) {
  const auto should_stop = [&] { return execution.should_stop(); };
  const Steps steps(cells, options.diagonal);
  if (options.method == GridMethod::bfs) return BreadthFirst(cells, steps, execution).find(start, goal);
  prepare(execution);
  if (options.method == GridMethod::dijkstra) {
    return best_first(
        start, goal, steps, [](VertexId) { return 0.0; }, queue, state, should_stop);
  }
  return best_first(start, goal, steps, FreeDistance(cells, goal, options.diagonal), queue, state, should_stop);
}

SearchResult GridSearch::Scratch::jump_point_search(VertexId start, VertexId goal, const Execution& execution) {
  if (!jumps) jumps.emplace(cells, execution);
  prepare(execution);
  const auto successors = [&](VertexId v, const auto& visit) { jumps->visit(v, state.parent(v), goal, visit); };
  SearchResult result = best_first(start, goal, successors, FreeDistance(cells, goal, Diagonal::sqrt2), queue, state,
                                   [&] { return execution.should_stop(); });
  result.path = jumps->with_steps(result.path);
  return result;
}

GridSearch::GridSearch(const Bitmap& blocked) : scratch_(std::make_unique<Scratch>(blocked)) {}
GridSearch::~GridSearch() = default;
GridSearch::GridSearch(GridSearch&&) noexcept = default;
GridSearch& GridSearch::operator=(GridSearch&&) noexcept = default;

GridPath GridSearch::find(Cell start, Cell goal, const GridSearchOptions& options, const Execution& execution) {
  const FreeCells& cells = scratch_->cells;
  for (const Cell c : {start, goal}) {
    if (c.x >= cells.width() || c.y >= cells.height()) {
      throw InputError("cell", "lies outside of the map", std::to_string(c.x) + ", " + std::to_string(c.y));
    }
  }
  const bool jumps = options.method == GridMethod::jump_points;
  if (jumps && options.diagonal != Diagonal::sqrt2) {
    throw InputError("jump point search", "needs diagonal steps that cost the root of 2");
  }
  const VertexId from = cells.number(start);
  const VertexId to = cells.number(goal);
  GridPath path;
  if (!cells.is_free(from) || !cells.is_free(to)) return path;
  const SearchResult result = jumps ? scratch_->jump_point_search(from, to, execution)
                                    : scratch_->best_first_search(from, to, options, execution);
  if (result.status == SearchStatus::stopped) execution.check();
  path.status = result.status;
  path.expanded = result.expanded;
  path.cells.reserve(result.path.size());
  for (const VertexId v : result.path) path.cells.push_back(cells.cell(v));
  path.cost = cost_of(path.cells, options.diagonal);
  return path;
}

}  // namespace warren
