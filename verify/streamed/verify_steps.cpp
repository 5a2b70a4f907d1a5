// SPDX-License-Identifier: BSD-3-Clause
#include "verify/streamed/verify_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/near/leg_boxes.hpp"
#include "verify/streamed/verify_cells.hpp"

namespace warren {
namespace {

constexpr double half = 0.5;  // from the middle of a cell to its walls

/// A cell by its column and row from 0.
struct Cell {
  std::ptrdiff_t col, row;
};

/// The cell whose middle this is.
std::optional<Cell> cell_at(const LookedUpWalls& walls, Vec2 p) {
  if (!(p.x >= 1.0 && p.y >= 1.0 && p.x <= walls.cols() && p.y <= walls.rows())) return std::nullopt;
  const Cell cell{bounded_whole<std::ptrdiff_t>(p.x) - 1, bounded_whole<std::ptrdiff_t>(p.y) - 1};
  const bool is_middle = static_cast<double>(cell.col + 1) == p.x && static_cast<double>(cell.row + 1) == p.y;
  return is_middle ? std::optional(cell) : std::nullopt;
}

/// Are they neighbours with no wall between them?
bool is_open(const LookedUpWalls& walls, Cell a, Cell b) {
  const Cell low{std::min(a.col, b.col), std::min(a.row, b.row)};
  const std::ptrdiff_t way = a.col + b.col - 2 * low.col + a.row + b.row - 2 * low.row;
  const unsigned between = a.row == b.row ? CellTile::right_wall : CellTile::upper_wall;
  return way == 1 && (walls.walls_at(low.col, low.row) & between) == 0;
}

bool has_wall(const LookedUpWalls& walls, Cell cell) {
  return walls.walls_at(cell.col, cell.row) != 0 ||
         (walls.walls_at(cell.col - 1, cell.row) & CellTile::right_wall) != 0 ||
         (walls.walls_at(cell.col, cell.row - 1) & CellTile::upper_wall) != 0;
}

/// What some legs in a row come to.
struct Steps {
  bool are_open = true;        ///< all are steps that no wall is in the way of
  bool pass_by_walls = false;  ///< a wall stands beside one of them
  double length = 0.0;         ///< added leg by leg, as LegBoxes does
};

/// Legs of the path; of its first and last leg the length alone, where these are no steps.
Steps look_at(const LookedUpWalls& walls, std::span<const Vec2> path, Range legs) {
  Steps steps;
  std::optional<Cell> from = cell_at(walls, path[legs.first]);
  for (std::size_t leg = legs.first; leg < legs.last; ++leg) {
    const std::optional<Cell> to = cell_at(walls, path[leg + 1]);
    const bool is_end = leg == 0 || leg + 2 == path.size();
    if (from && to && is_open(walls, *from, *to)) {
      steps.length += 1.0;
      steps.pass_by_walls = steps.pass_by_walls || has_wall(walls, *from);
    } else {
      steps.length += norm(path[leg + 1] - path[leg]);
      if (!is_end) return {.are_open = false};
    }
    from = to;
  }
  return steps;
}

/// The length where all legs but the first and the last are such steps.
std::optional<double> length_of_steps(const LookedUpWalls& walls, std::span<const Vec2> path,
                                      const Execution& execution) {
  constexpr std::size_t grain = LegBoxes::legs_a_sum;
  std::vector<Steps> parts(chunk_count(path.size() - 1, grain));
  for_chunks(path.size() - 1, grain, execution,
             [&](Range legs) { parts[legs.first / grain] = look_at(walls, path, legs); });
  Steps all;
  for (const Steps& part : parts) {
    all.are_open = all.are_open && part.are_open;
    all.pass_by_walls = all.pass_by_walls || part.pass_by_walls;
    all.length += part.length;
  }
  return all.are_open && all.pass_by_walls ? std::optional(all.length) : std::nullopt;
}

}  // namespace

Verification verify_steps(const LookedUpWalls& walls, std::span<const Vec2> path, const VerifyOptions& options,
                          const Execution& execution) {
  check_judged_path(path, options, execution);
  const bool may_be_steps = path.size() > 3 && options.reach() < half && options.contact == Contact::blocked;
  const std::optional<double> length = may_be_steps ? length_of_steps(walls, path, execution) : std::nullopt;
  if (!length) return verify_among_cells(walls, path, options, execution);
  const Verification first = verify_among_cells(walls, path.first(2), {options.radius, options.clearance}, execution);
  const Verification last = verify_among_cells(walls, path.last(2), {options.radius, options.clearance}, execution);
  if (!first.verified || !last.verified) return verify_among_cells(walls, path, options, execution);
  const LegReport legs{.least = half};
  Verification verdict = verdict_on(legs, wrong_start(path, options), wrong_goal(path, options));
  verdict.length = *length;
  verdict.min_clearance = std::min({half - options.radius, first.min_clearance, last.min_clearance});
  return verdict;
}

}  // namespace warren
