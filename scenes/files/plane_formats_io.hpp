// SPDX-License-Identifier: BSD-3-Clause
// Worlds of the plane as other programs have them: GeoJSON, well-known text, lists of rings, micromouse mazes, Moving
// AI's maps and scenarios. What is taken of each is said where it is read: geojson_io.cpp, wkt_io.cpp,
// ring_lists_io.cpp, micromouse_io.cpp, moving_ai_io.cpp. All that read throw InputError naming file and line, and
// Stopped; all that write throw InputError for what the format can't hold, WriteError, Stopped.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Does it begin as JSON does that is no answer of ours: with an array, or an object that has a "type"?
bool is_geojson(std::string_view bytes);
Scene read_geojson(const InputFile& file, const Execution& execution);
/// Rings closed and anticlockwise. No spheres, no states with angles.
void write_geojson(const Scene& scene, const std::string& path, const Execution& execution);

/// Does it begin with the name of a geometry and a parenthesis (or EMPTY), or with SRID=?
bool is_wkt(std::string_view bytes);
Scene read_wkt(const InputFile& file, const Execution& execution);
/// One geometry a line; rings closed and anticlockwise. No bounds, no spheres.
void write_wkt(const Scene& scene, const std::string& path, const Execution& execution);

/// Does it begin as an environment or a polymap does?
bool is_ring_list(std::string_view bytes);
Scene read_ring_list(const InputFile& file, const Execution& execution);

/// Is the first line a row of posts or a cell in numbers, as far as its first 64 KiB tell?
bool is_micromouse(std::string_view bytes);
/// Walls on the unit grid, cell centres at 1..W x 1..H, the maze hint; walls in a row are joined. Of several G the goal
/// is the one that takes the fewest cells from S, then the first in reading order.
Scene read_micromouse(const InputFile& file, const Execution& execution);

/// Passable: . G S; W (water) from water only; blocked: @ O T.
OccupancyMap read_moving_ai_map(const InputFile& file, const Execution& execution);

/// Free cells `.`, water `W`, all others `@`.
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

/// All lines of a scenario file, versions 0 and 1.
std::vector<Scenario> read_scenarios(const InputFile& file, const Execution& execution);

/// A scenario's cell as the map counts, scaled where the scenario was made for another size. Throws InputError naming
/// the line where it lies outside.
Cell cell_of(const OccupancyMap& map, const Scenario& scenario, Cell from, const std::string& file);

/// The cells that a robot at `start` may be on: water from water, else everything passable on land; a set bit is
/// blocked.
Bitmap blocked_from(const OccupancyMap& map, Cell start);

}  // namespace warren
