// SPDX-License-Identifier: BSD-3-Clause
// warren bench-scen: a Moving AI scenario file, checked. Every scenario is solved by A* and by jump points; each length
// is compared with the published optimum, which is rounded to the digits that the file gives, and each path is walked
// over the map again. Exit code 0 only if all lengths agree.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "parallel/chunks.hpp"
#include "planners/grid/grid_search.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/text/json_text.hpp"
#include "scenes/text/output_file_io.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"

namespace warren::tools {
namespace {

constexpr double least_tolerance = 1e-3;

struct ScenarioTrial {
  double length = std::numeric_limits<double>::infinity();  ///< infinity: no path
  double seconds = 0.0;
  std::uint64_t expanded = 0;
  bool walked = true;  ///< the path's cells are free, follow the rule and add up to the length
};

struct CheckedScenario {
  Scenario scenario;
  ScenarioTrial astar = {};
  ScenarioTrial jumps = {};
  /// Are both as long as the file says?
  bool agrees() const {
    const double rounding = 1e-12 * scenario.length;
    const double tolerance = std::max(least_tolerance, scenario.half_unit) + rounding;
    return astar.walked && jumps.walked && std::abs(astar.length - scenario.length) <= tolerance &&
           std::abs(jumps.length - scenario.length) <= tolerance;
  }
};

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

struct ScenarioTotals {
  std::size_t scenarios = 0;
  std::vector<const CheckedScenario*> differing = {};  // of those that outlive it
  double astar_s = 0.0;
  double jumps_s = 0.0;
  std::uint64_t astar_expanded = 0;
  std::uint64_t jumps_expanded = 0;
  double median_speedup = 0.0;  // time of A* over that of jump points, by scenario
};

ScenarioTotals totals_of(const std::vector<CheckedScenario>& scenarios) {
  ScenarioTotals totals{scenarios.size()};
  std::vector<double> speedups;
  for (const CheckedScenario& s : scenarios) {
    if (!s.agrees()) totals.differing.push_back(&s);
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

/// `file`: what errors name. Lengths grow along the file, so parts are small enough that no thread is left alone with
/// the long ones. Their size depends on the count of scenarios alone; progress counts parts. Throws InputError for
/// scenarios that are not on the map, Stopped.
std::vector<CheckedScenario> check_scenarios(const OccupancyMap& map, const std::vector<Scenario>& scenarios,
                                             const std::string& file, const Execution& execution) {
  constexpr std::size_t parts = 128;
  constexpr std::size_t least_part = 4;
  std::vector<CheckedScenario> all;
  for (const Scenario& scenario : scenarios) all.push_back({scenario});
  const std::size_t part = std::max(least_part, chunk_count(scenarios.size(), parts));
  const StageTimer timer(execution, "scenarios", nullptr, scenarios.size());
  for_chunks(scenarios.size(), part, execution, [&](Range range) {
    std::optional<GridSearch> search;  // another one where they change between land and water
    Bitmap blocked;
    bool on_water = false;
    for (std::size_t i = range.first; i < range.last; ++i) {
      CheckedScenario& checked = all[i];
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
  });
  return all;
}

/// The scenarios of the file that differ, at most 50 of them, and a line of totals.
std::string scenario_summary(const std::string& file, const ScenarioTotals& t, const Palette& palette) {
  constexpr std::size_t most_lines = 50;
  std::string text;
  for (std::size_t i = 0; i < std::min(most_lines, t.differing.size()); ++i) {
    const CheckedScenario& s = *t.differing[i];
    text += fmt::format("{}:{}: published {}, A* {}, jump points {}\n", printable(file), s.scenario.line,
                        s.scenario.length, s.astar.length, s.jumps.length);
  }
  const std::string all = grouped(t.scenarios);
  const std::string verdict = t.differing.empty()
                                  ? palette.good(fmt::format("all {} optimal", all))
                                  : palette.bad(fmt::format("{} of {} differ", grouped(t.differing.size()), all));
  return text + fmt::format(
                    "{}: {}; A* {:.3f} s, {} cells; jump points {:.3f} s, {} cells: {:.1f} times as fast, "
                    "median {:.1f}\n",
                    printable(file), verdict, t.astar_s, grouped(t.astar_expanded), t.jumps_s,
                    grouped(t.jumps_expanded), t.jumps_s > 0.0 ? t.astar_s / t.jumps_s : 0.0, t.median_speedup);
}

/// warren.bench-scen/1
std::string scenario_json(const std::string& file, const std::string& map, const ScenarioTotals& t) {
  JsonObject json(",\n ", ": ");
  json.add("schema", "warren.bench-scen/1", "file", file, "map", map, "scenarios", t.scenarios, "differing",
           t.differing.size(), "astar_s", t.astar_s, "jump_points_s", t.jumps_s, "astar_expanded", t.astar_expanded,
           "jump_points_expanded", t.jumps_expanded, "median_speedup", t.median_speedup);
  json.add_json("differences", json_list_of(t.differing, ", ", [](const CheckedScenario* s) {
                  JsonObject one(", ", ": ");
                  one.add("line", s->scenario.line, "published", s->scenario.length, "astar", s->astar.length,
                          "jump_points", s->jumps.length);
                  return one.closed();
                }));
  return json.closed() + "\n";
}

constexpr OptionSpec bench_scen_specs[] = {
    {"--map", "FILE", "the map, where the scenario file's own name for it leads nowhere"},
    {"--json", "FILE", "write the figures as JSON; - is standard output"},
};

/// The map beside the scenario file, by its whole name or its last part; as it stands from here; or without ".scen".
OccupancyMap read_its_map(const Arguments& arguments, const std::string& map, const Execution& execution) {
  const std::string& scen = arguments.operand(0);
  const std::string folder = scen.substr(0, scen.rfind('/') + 1);
  std::vector<std::string> places{folder + map, folder + map.substr(map.rfind('/') + 1), map};
  if (scen.ends_with(".scen")) places.push_back(scen.substr(0, scen.size() - 5));
  for (const std::string& place : places) {
    std::optional<InputFile> file;
    try {
      file.emplace(place, execution);
    } catch (const ReadError&) {
      continue;
    }
    check_not_written(arguments, place);
    return read_moving_ai_map(*file, execution);
  }
  throw ReadError(scen, fmt::format("its map {} is neither beside it nor here; --map says where it is", map));
}

int bench_scen(const Arguments& arguments) {
  const auto json = output_file(arguments, "--json");
  static constexpr ExpectedStage searches[] = {{"scenarios", 1.0}};  // little comes before and after
  Run run(arguments, RunScope::whole_command, searches);
  const std::string& file = arguments.operand(0);
  const std::vector<Scenario> scenarios = read_scenarios(InputFile(file, run.execution()), run.execution());
  for (const Scenario& s : scenarios) {
    if (s.map != scenarios.front().map) {
      throw InputError(fmt::format("{}:{}", file, s.line), "expected one map in all lines", s.map);
    }
  }
  const auto given = arguments.value("--map");
  const OccupancyMap map = given ? read_moving_ai_map(InputFile(*given, run.execution()), run.execution())
                                 : read_its_map(arguments, scenarios.front().map, run.execution());
  const std::vector<CheckedScenario> checked = check_scenarios(map, scenarios, file, run.execution());
  run.end();
  const ScenarioTotals totals = totals_of(checked);
  if (json) write_file(*json, scenario_json(file, map.source, totals), run.execution());
  run.conclude([&] { return scenario_summary(file, totals, run.palette()); });
  return totals.differing.empty() ? exit_code::success : exit_code::no_path;
}

}  // namespace

Command bench_scen_command() {
  return {"bench-scen", "FILE.scen", "check a Moving AI scenario file against its published lengths",
          joined_options({bench_scen_specs, run_option_specs()}), bench_scen};
}

}  // namespace warren::tools
