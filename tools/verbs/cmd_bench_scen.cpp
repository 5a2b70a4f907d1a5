// SPDX-License-Identifier: BSD-3-Clause
// warren bench-scen: a Moving AI scenario file. Every scenario is solved by A* and by jump points; each length is
// compared with the published optimum, which is rounded to the digits that the file gives, and each path is walked over
// the map again. Exit code 0 only if all agree.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "parallel/chunks.hpp"
#include "planners/grid/grid_search.hpp"
#include "scenes/formats/moving_ai_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/question/write_answer_io.hpp"
#include "studies/measure/human_units.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"

namespace warren {
namespace {

constexpr double least_tolerance = 1e-3;
constexpr OptionSpec bench_scen_specs[] = {
    {"--map", "FILE", "the map, where the scenario file's own name for it leads nowhere"},
    {"--json", "FILE", "write the figures as JSON; - is standard output"},
};

/// One method on one scenario.
struct Trial {
  double length = std::numeric_limits<double>::infinity();  ///< infinity: no path
  double seconds = 0.0;
  std::uint64_t expanded = 0;
  bool walked = true;  ///< the path's cells are free, follow the rule and add up to the length
};

struct ScenarioTrials {
  Trial astar;
  Trial jumps;
  bool agrees(const Scenario& s) const {
    const double rounding = 1e-12 * s.length;
    const double tolerance = std::max(least_tolerance, s.half_unit) + rounding;
    return astar.walked && jumps.walked && std::abs(astar.length - s.length) <= tolerance &&
           std::abs(jumps.length - s.length) <= tolerance;
  }
};

std::string folder_prefix(const std::string& file) { return file.substr(0, file.rfind('/') + 1); }

/// The map beside the scenario file, by its whole name or its last part; as it stands from here; or without ".scen".
OccupancyMap read_its_map(const Arguments& arguments, const std::string& map, const Execution& execution) {
  const std::string& scen = arguments.operand(0);
  const std::string last = map.substr(map.rfind('/') + 1);
  std::vector<std::string> places{folder_prefix(scen) + map, folder_prefix(scen) + last, map};
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

Trial trial(GridSearch& search, const Bitmap& blocked, Cell start, Cell goal, GridMethod method,
            const Execution& execution) {
  const auto begin = std::chrono::steady_clock::now();
  const GridPath path = search.find(start, goal, {Diagonal::sqrt2, method}, execution);
  Trial result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.expanded = path.expanded;
  if (path.status != SearchStatus::found) return result;
  result.length = path.cost;
  result.walked = is_walk(blocked, path, start, goal);
  return result;
}

/// Scenarios in parts of a size that depends on their count alone, each part with a search of its own. Lengths grow
/// along the file, so parts are small enough that no thread is left alone with the long ones; progress counts parts.
std::vector<ScenarioTrials> run_all(const OccupancyMap& map, const std::vector<Scenario>& scenarios,
                                    const std::string& file, const Execution& execution) {
  constexpr std::size_t parts = 128;
  constexpr std::size_t least_part = 4;
  const std::size_t part = std::max(least_part, chunk_count(scenarios.size(), parts));
  std::vector<ScenarioTrials> results(scenarios.size());
  double unused = 0.0;
  const StageTimer timer(execution, "scenarios", unused, scenarios.size());
  for_chunks(scenarios.size(), part, execution, [&](Range r) {
    std::optional<GridSearch> search;
    Bitmap blocked;
    bool on_water = false;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const Cell start = cell_of(map, scenarios[i], scenarios[i].start, file);
      const Cell goal = cell_of(map, scenarios[i], scenarios[i].goal, file);
      const bool water = !map.water.empty() && map.water.test(start.x, start.y);
      if (!search || water != on_water) {
        blocked = blocked_from(map, start);
        search.emplace(blocked);
        on_water = water;
      }
      results[i].astar = trial(*search, blocked, start, goal, GridMethod::astar, execution);
      results[i].jumps = trial(*search, blocked, start, goal, GridMethod::jump_points, execution);
      execution.check();
    }
  });
  return results;
}

struct Totals {
  std::size_t wrong = 0;
  double astar_s = 0.0;
  double jumps_s = 0.0;
  std::uint64_t astar_expanded = 0;
  std::uint64_t jumps_expanded = 0;
  double median_speedup = 0.0;  // time of A* over that of jump points, by scenario
};

Totals totals_of(const std::vector<Scenario>& scenarios, const std::vector<ScenarioTrials>& results) {
  Totals totals;
  std::vector<double> speedups;
  for (std::size_t i = 0; i < results.size(); ++i) {
    totals.wrong += results[i].agrees(scenarios[i]) ? 0 : 1;
    totals.astar_s += results[i].astar.seconds;
    totals.jumps_s += results[i].jumps.seconds;
    totals.astar_expanded += results[i].astar.expanded;
    totals.jumps_expanded += results[i].jumps.expanded;
    if (results[i].jumps.seconds > 0.0) speedups.push_back(results[i].astar.seconds / results[i].jumps.seconds);
  }
  if (!speedups.empty()) {
    const auto middle = speedups.begin() + static_cast<std::ptrdiff_t>(speedups.size() / 2);
    std::nth_element(speedups.begin(), middle, speedups.end());
    totals.median_speedup = *middle;
  }
  return totals;
}

std::string json_of(const std::string& file, const OccupancyMap& map, const std::vector<Scenario>& scenarios,
                    const std::vector<ScenarioTrials>& results) {
  const Totals t = totals_of(scenarios, results);
  std::string text = fmt::format(
      "{{\"schema\": \"warren.bench-scen/1\",\n \"file\": {},\n \"map\": {},\n \"scenarios\": {},\n \"differing\": "
      "{},\n "
      "\"astar_s\": {},\n \"jump_points_s\": {},\n \"astar_expanded\": {},\n \"jump_points_expanded\": {},\n "
      "\"median_speedup\": {},\n \"differences\": [",
      json_string(file), json_string(map.source), scenarios.size(), t.wrong, json_number(t.astar_s),
      json_number(t.jumps_s), t.astar_expanded, t.jumps_expanded, json_number(t.median_speedup));
  bool first = true;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].agrees(scenarios[i])) continue;
    text += fmt::format("{}{{\"line\": {}, \"published\": {}, \"astar\": {}, \"jump_points\": {}}}", first ? "" : ", ",
                        scenarios[i].line, json_number(scenarios[i].length), json_number(results[i].astar.length),
                        json_number(results[i].jumps.length));
    first = false;
  }
  return text + "]}\n";
}

void print_report(const std::string& file, const std::vector<Scenario>& scenarios,
                  const std::vector<ScenarioTrials>& results, const Palette& palette) {
  constexpr std::size_t most_lines = 50;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < results.size() && shown < most_lines; ++i) {
    if (results[i].agrees(scenarios[i])) continue;
    print_text(fmt::format("{}:{}: published {}, A* {}, jump points {}\n", printable(file), scenarios[i].line,
                           scenarios[i].length, results[i].astar.length, results[i].jumps.length));
    ++shown;
  }
  const Totals t = totals_of(scenarios, results);
  const std::string verdict =
      t.wrong == 0 ? palette.good(fmt::format("all {} optimal", grouped(results.size())))
                   : palette.bad(fmt::format("{} of {} differ", grouped(t.wrong), grouped(results.size())));
  print_text(fmt::format(
      "{}: {}; A* {:.3f} s, {} cells; jump points {:.3f} s, {} cells: {:.1f} times as fast, median {:.1f}\n",
      printable(file), verdict, t.astar_s, grouped(t.astar_expanded), t.jumps_s, grouped(t.jumps_expanded),
      t.jumps_s > 0.0 ? t.astar_s / t.jumps_s : 0.0, t.median_speedup));
}

int bench_scen(const Arguments& arguments) {
  const auto json = output_file(arguments, "--json");
  Run run(arguments);
  const std::string& file = arguments.operand(0);
  const std::vector<Scenario> scenarios = read_scenarios(InputFile(file, run.execution()), run.execution());
  for (const Scenario& s : scenarios) {
    if (s.map != scenarios.front().map) {
      throw InputError(fmt::format("{}:{}", file, s.line), "expected one map in all lines", s.map);
    }
  }
  const auto given = arguments.value("--map");
  const OccupancyMap map = given ? read_moving_ai_map(InputFile(std::string{*given}, run.execution()), run.execution())
                                 : read_its_map(arguments, scenarios.front().map, run.execution());
  const std::vector<ScenarioTrials> results = run_all(map, scenarios, file, run.execution());
  run.end();
  if (json) write_file(*json, json_of(file, map, scenarios, results), run.execution());
  if (!run.quiet() && json != "-") print_report(file, scenarios, results, run.palette());
  return totals_of(scenarios, results).wrong == 0 ? exit_code::success : exit_code::no_path;
}

}  // namespace

Command bench_scen_command() {
  Command command{"bench-scen", "FILE.scen", "check a Moving AI scenario file against its optima", {}, bench_scen};
  add_options(command.options, bench_scen_specs);
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
