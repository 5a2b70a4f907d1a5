// SPDX-License-Identifier: BSD-3-Clause
// A Moving AI scenario file checked: every scenario is solved by A* and by jump points; each length is compared with
// the published optimum, which is rounded to the digits that the file gives, and each path is walked over the map
// again.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "scenes/formats/moving_ai_io.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "studies/measure/text_table.hpp"

namespace warren::studies {

/// One method on one scenario.
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
  bool agrees() const;
};

struct ScenarioCheck {
  std::string file;  ///< that names the scenarios
  std::string map;   ///< that they are on
  std::vector<CheckedScenario> scenarios;

  std::size_t differing() const;
};

/// `file`: what errors name. Throws InputError for scenarios that are not on the map, Stopped.
ScenarioCheck check_scenarios(const OccupancyMap& map, const std::vector<Scenario>& scenarios, const std::string& file,
                              const Execution& execution);

/// The scenarios that differ, at most 50 of them, and a line of totals.
std::string scenario_summary(const ScenarioCheck& check, const Palette& palette);
/// warren.bench-scen/1
std::string scenario_json(const ScenarioCheck& check);

}  // namespace warren::studies
