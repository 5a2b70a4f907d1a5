// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/route_query.hpp"

#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse_length() {
  throw InputError("route index", "a way in it is longer than the lattice, or than its parts: build it again");
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
  FrontQuery::Way between{};
  if (!join.in_tree()) between = core_way(join.start_core, join.goal_core);
  if (between.length >= no_way) return {};
  for (const std::uint32_t length : {join.start_steps, between.length, join.goal_steps}) {
    if (length > index_.places().place_count()) refuse_length();
  }
  const std::size_t count = std::size_t{join.start_steps} + between.length + join.goal_steps + 1;
  execution.reserve(count * sizeof(CellId));
  RawVector<CellId> cells(count);
  CellId* const core = cells.data() + join.start_steps;
  *core = index_.places().cell_of(join.start_core);
  if (!join.in_tree()) write_core_way(between, join.goal_core, core, execution);
  std::vector<ClimbLeg> legs;
  trees_.cut({a, join.start_core, join.start_steps, 1, cells.data()}, legs);
  trees_.cut({b, join.goal_core, join.goal_steps, -1, &cells.back()}, legs);
  write_climbs(index_, legs, execution);
  return cells;
}

/// As long as its parts together, or refused.
FrontQuery::Way RouteQuery::core_way(LatticePlace start, LatticePlace goal) {
  near_start_.search(start);
  near_goal_.search(goal);
  const std::uint32_t direct = direct_length(goal);
  FrontQuery::Way way = fronts_.way(near_start_.gates(), near_goal_.gates(), direct);
  if (way.length == direct) return way;
  std::size_t length = std::size_t{near_start_.gates()[way.first].steps} + near_goal_.gates()[way.last].steps;
  for (const FrontStep& step : way.steps) length += step.length;
  if (length != way.length) refuse_length();
  return way;
}

/// cells: the first one stands already.
void RouteQuery::write_core_way(const FrontQuery::Way& way, LatticePlace goal, CellId* cells,
                                const Execution& execution) {
  if (way.length == direct_length(goal)) return near_start_.write_way(near_start_.number_of(goal), cells, 1);
  const SeenGate& first = near_start_.gates()[way.first];
  near_start_.write_way(first.seen, cells, 1);
  unpacking_.write(way.steps, cells + first.steps, execution);
  cells[way.length] = index_.places().cell_of(goal);
  near_goal_.write_way(near_goal_.gates()[way.last].seen, cells + way.length, -1);
}

}  // namespace warren
