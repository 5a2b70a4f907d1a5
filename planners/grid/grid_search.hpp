// SPDX-License-Identifier: BSD-3-Clause
// Shortest paths over the cells of an occupancy map, without an explicit graph: the steps of a cell are looked up by
// the nine bits around it. A* and Dijkstra with exact octile, unit or Manhattan costs, breadth-first search, and jump
// point search (planners/grid/grid_search). Moving AI's rule: a diagonal step needs both cells beside it free, so
// a point never touches the closed square of a blocked cell.
//
// Two bits a cell for the map; 12 bytes a cell for A* and Dijkstra, allocated at the first such search and cleared by
// blocks of what the last one touched, so that thousands of searches on one map cost what they expand; 1 byte a cell
// for breadth-first search.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/enum_names.hpp"
#include "core/run/execution.hpp"
#include "core/search/search.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {

/// What a diagonal step costs; none: sides only. A step to the side costs 1.
enum class Diagonal : std::uint8_t { sqrt2, unit, none };
constexpr auto enum_names(Diagonal) { return std::array<std::string_view, 3>{"sqrt2", "unit", "none"}; }
/// The steps that there are, whatever they cost.
StepRule rule_of(Diagonal diagonal);

/// bfs minimises steps. jump_points: the same lengths as astar, only with Diagonal::sqrt2.
enum class GridMethod : std::uint8_t { astar, dijkstra, bfs, jump_points };
constexpr auto enum_names(GridMethod) {
  return std::array<std::string_view, 4>{"astar", "dijkstra", "bfs", "jump-points"};
}

/// How cells are searched.
struct GridSearchOptions {
  Diagonal diagonal = Diagonal::sqrt2;    ///< which steps there are, and their cost
  GridMethod method = GridMethod::astar;  ///< what finds the path
};

/// A path over cells, and what it took.
struct GridPath {
  SearchStatus status = SearchStatus::exhausted;  ///< exhausted: no path over cells; also where an end is blocked
  std::vector<Cell> cells;     ///< start to goal, each a step from the one before; empty unless found
  double cost = 0.0;           ///< sideways steps + diagonal steps times their cost
  std::uint64_t expanded = 0;  ///< cells settled
};

/// A map made ready for searches. Owns its scratch: one at a time, one object a thread.
class GridSearch {
 public:
  /// blocked: set bits are blocked; what lies outside is blocked. Throws InputError for maps of about 2^32 cells,
  /// Stopped.
  explicit GridSearch(const Bitmap& blocked, const Execution& execution = {});
  ~GridSearch();

  /// Throws InputError for cells outside the map and for jump points with other diagonals than sqrt2, Stopped.
  GridPath find(Cell start, Cell goal, const GridSearchOptions& options, const Execution& execution);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

/// Is there a square of two by two free cells? Without one no diagonal step is allowed, and breadth-first search finds
/// shortest paths whatever diagonals cost. O(cells / 64). Throws Stopped.
bool has_diagonal_steps(const Bitmap& blocked, const Execution& execution = {});

/// Does a way lead from cell to cell, over common sides, or (squeezing) over common corners too? O(cells). Throws
/// Stopped.
bool cells_connect(const Bitmap& blocked, Cell start, Cell goal, bool squeezing, const Execution& execution);

/// Sideways steps + diagonal steps times their cost: exact to one rounding.
double cost_of(const std::vector<Cell>& cells, Diagonal diagonal);

}  // namespace warren
