// SPDX-License-Identifier: BSD-3-Clause
#include "studies/contests/scenario_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/base/printable.hpp"
#include "parallel/chunks.hpp"
#include "planners/grid/grid_search.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/answer/write_answer_io.hpp"

namespace warren::studies {
namespace {

constexpr double least_tolerance = 1e-3;

/// Independent of the search: may one go from cell to cell, and what does it cost?
bool is_walk(const Bitmap& blocked, const GridPath& path, Cell start, Cell goal) {
  if (path.cells.empty() || !(path.cells.front() == start) || !(path.cells.back() == goal)) return false;
  double length = 0.0;
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    const Cell a = path.cells[i - 1];
    const Cell b = path.cells[i];
    const std::int64_t dx = std::abs(std::int64_t{b.x} - a.x);
    const std::int64_t dy = std::abs(std::int64_t{b.y} - a.y);
    if (dx > 1 || dy > 1 || dx + dy == 0) return false;
    if (blocked.test(b.x, b.y) || blocked.test(a.x, b.y) || blocked.test(b.x, a.y)) return false;
    length += dx + dy == 2 ? std::sqrt(2.0) : 1.0;
  }
  return std::abs(length - path.cost) < least_tolerance;
}

ScenarioTrial timed_search(GridSearch& search, const Bitmap& blocked, Cell start, Cell goal, GridMethod method,
                           const Execution& execution) {
  const auto begin = std::chrono::steady_clock::now();
  const GridPath path = search.find(start, goal, {Diagonal::sqrt2, method}, execution);
  ScenarioTrial trial;
  trial.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  trial.expanded = path.expanded;
  if (path.status != SearchStatus::found) return trial;
  trial.length = path.cost;
  trial.walked = is_walk(blocked, path, start, goal);
  return trial;
}

/// Those of a range, with a search of their own; another where they change between land and water.
void search_range(const OccupancyMap& map, const std::string& file, Range range,
                  std::vector<CheckedScenario>& scenarios, const Execution& execution) {
  std::optional<GridSearch> search;
  Bitmap blocked;
  bool on_water = false;
  for (std::size_t i = range.first; i < range.last; ++i) {
    CheckedScenario& checked = scenarios[i];
    const Cell start = cell_of(map, checked.scenario, checked.scenario.start, file);
    const Cell goal = cell_of(map, checked.scenario, checked.scenario.goal, file);
    const bool water = !map.water.empty() && map.water.test(start.x, start.y);
    if (!search || water != on_water) {
      blocked = blocked_from(map, start);
      search.emplace(blocked);
      on_water = water;
    }
    checked.astar = timed_search(*search, blocked, start, goal, GridMethod::astar, execution);
    checked.jumps = timed_search(*search, blocked, start, goal, GridMethod::jump_points, execution);
    execution.check();
  }
}

struct ScenarioTotals {
  double astar_s = 0.0;
  double jumps_s = 0.0;
  std::uint64_t astar_expanded = 0;
  std::uint64_t jumps_expanded = 0;
  double median_speedup = 0.0;  // time of A* over that of jump points, by scenario
};

ScenarioTotals totals_of(const std::vector<CheckedScenario>& scenarios) {
  ScenarioTotals totals;
  std::vector<double> speedups;
  for (const CheckedScenario& s : scenarios) {
    totals.astar_s += s.astar.seconds;
    totals.jumps_s += s.jumps.seconds;
    totals.astar_expanded += s.astar.expanded;
    totals.jumps_expanded += s.jumps.expanded;
    if (s.jumps.seconds > 0.0) speedups.push_back(s.astar.seconds / s.jumps.seconds);
  }
  if (!speedups.empty()) {
    const auto middle = speedups.begin() + static_cast<std::ptrdiff_t>(speedups.size() / 2);
    std::nth_element(speedups.begin(), middle, speedups.end());
    totals.median_speedup = *middle;
  }
  return totals;
}

}  // namespace

bool CheckedScenario::agrees() const {
  const double rounding = 1e-12 * scenario.length;
  const double tolerance = std::max(least_tolerance, scenario.half_unit) + rounding;
  return astar.walked && jumps.walked && std::abs(astar.length - scenario.length) <= tolerance &&
         std::abs(jumps.length - scenario.length) <= tolerance;
}

std::size_t ScenarioCheck::differing() const {
  return static_cast<std::size_t>(
      std::count_if(scenarios.begin(), scenarios.end(), [](const CheckedScenario& s) { return !s.agrees(); }));
}

/// Lengths grow along the file, so parts are small enough that no thread is left alone with the long ones. Their size
/// depends on the count of scenarios alone; progress counts parts.
ScenarioCheck check_scenarios(const OccupancyMap& map, const std::vector<Scenario>& scenarios, const std::string& file,
                              const Execution& execution) {
  constexpr std::size_t parts = 128;
  constexpr std::size_t least_part = 4;
  ScenarioCheck check{file, map.source, {}};
  for (const Scenario& scenario : scenarios) check.scenarios.push_back({scenario});
  const std::size_t part = std::max(least_part, chunk_count(scenarios.size(), parts));
  double unused = 0.0;
  const StageTimer timer(execution, "scenarios", unused, scenarios.size());
  for_chunks(scenarios.size(), part, execution,
             [&](Range range) { search_range(map, file, range, check.scenarios, execution); });
  return check;
}

std::string scenario_summary(const ScenarioCheck& check, const Palette& palette) {
  constexpr std::size_t most_lines = 50;
  std::string text;
  std::size_t shown = 0;
  for (const CheckedScenario& s : check.scenarios) {
    if (s.agrees() || shown == most_lines) continue;
    text += fmt::format("{}:{}: published {}, A* {}, jump points {}\n", printable(check.file), s.scenario.line,
                        s.scenario.length, s.astar.length, s.jumps.length);
    ++shown;
  }
  const ScenarioTotals t = totals_of(check.scenarios);
  const std::string all = grouped(check.scenarios.size());
  const std::string verdict = check.differing() == 0
                                  ? palette.good(fmt::format("all {} optimal", all))
                                  : palette.bad(fmt::format("{} of {} differ", grouped(check.differing()), all));
  return text + fmt::format(
                    "{}: {}; A* {:.3f} s, {} cells; jump points {:.3f} s, {} cells: {:.1f} times as fast, "
                    "median {:.1f}\n",
                    printable(check.file), verdict, t.astar_s, grouped(t.astar_expanded), t.jumps_s,
                    grouped(t.jumps_expanded), t.jumps_s > 0.0 ? t.astar_s / t.jumps_s : 0.0, t.median_speedup);
}

std::string scenario_json(const ScenarioCheck& check) {
  const ScenarioTotals t = totals_of(check.scenarios);
  std::string text = fmt::format(
      "{{\"schema\": \"warren.bench-scen/1\",\n \"file\": {},\n \"map\": {},\n \"scenarios\": {},\n \"differing\": "
      "{},\n \"astar_s\": {},\n \"jump_points_s\": {},\n \"astar_expanded\": {},\n \"jump_points_expanded\": {},\n "
      "\"median_speedup\": {},\n \"differences\": [",
      json_string(check.file), json_string(check.map), check.scenarios.size(), check.differing(),
      json_number(t.astar_s), json_number(t.jumps_s), t.astar_expanded, t.jumps_expanded,
      json_number(t.median_speedup));
  bool first = true;
  for (const CheckedScenario& s : check.scenarios) {
    if (s.agrees()) continue;
    text += fmt::format("{}{{\"line\": {}, \"published\": {}, \"astar\": {}, \"jump_points\": {}}}", first ? "" : ", ",
                        s.scenario.line, json_number(s.scenario.length), json_number(s.astar.length),
                        json_number(s.jumps.length));
    first = false;
  }
  return text + "]}\n";
}

}  // namespace warren::studies
