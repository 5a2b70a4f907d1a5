// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/route_query.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse_length() {
  throw InputError("route index", "a way in it is longer than the lattice: build it again");
}

}  // namespace

LatticePlace RouteQuery::checked(CellId cell) const {
  if (cell < index_.passages().cell_count()) return index_.places().place_of(cell);
  throw InputError("cell", "must be below " + std::to_string(index_.passages().cell_count()), std::to_string(cell));
}

std::optional<std::uint32_t> RouteQuery::length(CellId start, CellId goal) {
  const TreeJoin join = trees_.join(checked(start), checked(goal));
  const std::uint32_t between = join.in_tree() ? 0 : core_length(join.start_core, join.goal_core);
  if (between >= no_way) return std::nullopt;
  return join.start_steps + between + join.goal_steps;
}

std::uint32_t RouteQuery::core_length(LatticePlace start, LatticePlace goal) {
  near_start_.search(start);
  near_goal_.search(goal);
  return fronts_.length(near_start_.gates(), near_goal_.gates(), direct_length(goal));
}

/// By no gate but the two ends, or no_way.
std::uint32_t RouteQuery::direct_length(LatticePlace goal) const {
  const std::uint32_t seen = near_start_.number_of(goal);
  return seen == CoreSearch::none ? no_way : near_start_.seen(seen).steps;
}

RawVector<CellId> RouteQuery::path(CellId start, CellId goal, const Execution& execution) {
  const LatticePlace a = checked(start);
  const LatticePlace b = checked(goal);
  const TreeJoin join = trees_.join(a, b);
  const std::size_t most = index_.places().place_count();
  if (join.start_steps > most || join.goal_steps > most) {
    refuse_length();
  }
  execution.reserve((std::size_t{join.start_steps} + 1 + join.goal_steps) * sizeof(CellId));
  RawVector<CellId> cells(std::size_t{join.start_steps} + 1 + (join.in_tree() ? join.goal_steps : 0));
  cells[join.start_steps] = index_.places().cell_of(join.start_core);
  if (!join.in_tree()) {
    if (!append_core_path(join.start_core, join.goal_core, cells, execution)) return {};
    cells.resize(cells.size() + join.goal_steps);
  }
  std::vector<ClimbLeg> legs;
  trees_.cut({a, join.start_core, join.start_steps, 1, cells.data()}, legs);
  trees_.cut({b, join.goal_core, join.goal_steps, -1, &cells.back()}, legs);
  write_climbs(index_, legs, execution);
  return cells;
}

/// The first cell stands already.
bool RouteQuery::append_core_path(LatticePlace start, LatticePlace goal, RawVector<CellId>& cells,
                                  const Execution& execution) {
  near_start_.search(start);
  near_goal_.search(goal);
  const std::uint32_t direct = direct_length(goal);
  const FrontQuery::Way way = fronts_.way(near_start_.gates(), near_goal_.gates(), direct);
  if (way.length >= no_way) return false;
  if (way.length == direct) {
    near_start_.append_way(near_start_.number_of(goal), cells);
    return true;
  }
  near_start_.append_way(near_start_.gates()[way.first].seen, cells);
  const std::size_t gate = cells.size() - 1;
  if (way.length > index_.places().place_count()) refuse_length();
  std::size_t between = 0;
  for (const FrontStep& step : way.steps) between += step.length;
  execution.reserve(between * sizeof(CellId));
  cells.resize(cells.size() + between);
  unpacking_.write(way.steps, cells.data() + gate, execution);
  RawVector<CellId> tail{index_.places().cell_of(goal)};
  near_goal_.append_way(near_goal_.gates()[way.last].seen, tail);
  tail.pop_back();  // the gate, which stands already; or the goal, where it is the gate
  cells.insert(cells.end(), tail.rbegin(), tail.rend());
  return true;
}

}  // namespace warren
