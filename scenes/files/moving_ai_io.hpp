// SPDX-License-Identifier: BSD-3-Clause
// Moving AI's grid maps (`type octile`) and scenario files. In the files row 0 is the top row; in an OccupancyMap it is
// the bottom row, so a scenario's (x, y) is the cell (x, height - 1 - y). LF or CRLF; blanks may follow a line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Passable: . G S; W (water) from water only; blocked: @ O T. Throws InputError naming file, line and what was
/// expected; Stopped.
OccupancyMap read_moving_ai_map(const InputFile& file, const Execution& execution);

/// Free cells `.`, water `W`, all others `@`. Throws as OutputFile does.
void write_moving_ai_map(const OccupancyMap& map, const std::string& path, const Execution& execution);

struct Scenario {
  std::uint32_t bucket = 0;
  std::string map;              ///< as the file names it
  std::uint32_t map_width = 0;  ///< 0: not said (version 0)
  std::uint32_t map_height = 0;
  Cell start;  ///< as the file counts: row 0 at the top
  Cell goal;
  double length = 0.0;     ///< the published optimum
  double half_unit = 0.0;  ///< of its last digit: by so much it may be rounded
  std::size_t line = 0;
};

/// All lines of a scenario file, versions 0 and 1. Throws InputError naming file, line and what was expected.
std::vector<Scenario> read_scenarios(const InputFile& file, const Execution& execution);

/// A scenario's cell as the map counts, scaled where the scenario was made for another size. Throws InputError naming
/// the line where it lies outside.
Cell cell_of(const OccupancyMap& map, const Scenario& scenario, Cell from, const std::string& file);

/// The cells that a robot at `start` may be on: water from water, else everything passable on land; a set bit is
/// blocked.
Bitmap blocked_from(const OccupancyMap& map, Cell start);

}  // namespace warren
