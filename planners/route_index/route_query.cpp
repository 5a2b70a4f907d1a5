// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/route_query.hpp"

#include <algorithm>
#include <string>

#include "core/base/error.hpp"

namespace warren {

Place RouteQuery::checked(CellId cell) const {
  if (cell < index_.passages().cell_count()) return index_.places().place_of(cell);
  throw InputError("cell", "must be below " + std::to_string(index_.passages().cell_count()), std::to_string(cell));
}

std::optional<std::uint32_t> RouteQuery::length(CellId start, CellId goal) {
  const Place a = checked(start);
  const Place b = checked(goal);
  const CoreEntry from = trees_.core_entry(a);
  const CoreEntry to = trees_.core_entry(b);
  if (from.core == to.core) return from.steps + to.steps - 2 * trees_.meeting(a, b).depth;
  const std::uint32_t between = core_length(from.core, to.core);
  if (between >= no_way) return std::nullopt;
  return from.steps + between + to.steps;
}

std::uint32_t RouteQuery::core_length(Place start, Place goal) {
  near_start_.search(start);
  near_goal_.search(goal);
  return fronts_.length(near_start_.gates(), near_goal_.gates(), direct_length(goal));
}

/// By no gate but the two ends, or no_way.
std::uint32_t RouteQuery::direct_length(Place goal) const {
  const std::uint32_t seen = near_start_.number_of(goal);
  return seen == CoreSearch::none ? no_way : near_start_.seen(seen).steps;
}

RawVector<CellId> RouteQuery::path(CellId start, CellId goal) {
  const Place a = checked(start);
  const Place b = checked(goal);
  const CoreEntry from = trees_.core_entry(a);
  const CoreEntry to = trees_.core_entry(b);
  const bool one_tree = from.core == to.core;
  const TreeMeeting meeting = one_tree ? trees_.meeting(a, b) : TreeMeeting{from.core, 0};
  RawVector<Place> cells;
  trees_.append_climb(a, from.steps - meeting.depth, cells);
  cells.push_back(meeting.at);
  if (!one_tree && !append_core_path(from.core, to.core, cells)) return {};
  RawVector<Place> tail;
  trees_.append_climb(b, to.steps - meeting.depth, tail);
  append_reversed(tail, cells);
  for (Place& cell : cells) cell = index_.places().cell_of(cell);
  return cells;
}

void RouteQuery::append_reversed(RawVector<Place>& tail, RawVector<Place>& cells) {
  cells.insert(cells.end(), tail.rbegin(), tail.rend());
}

/// The first cell stands already.
bool RouteQuery::append_core_path(Place start, Place goal, RawVector<Place>& cells) {
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
  for (const FrontStep& step : way.steps) unpacking_.append(step, cells);
  RawVector<Place> tail;
  tail.push_back(goal);
  near_goal_.append_way(near_goal_.gates()[way.last].seen, tail);
  tail.pop_back();  // the gate, which stands already; or the goal, where it is the gate
  append_reversed(tail, cells);
  return true;
}

}  // namespace warren
