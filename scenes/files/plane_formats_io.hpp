// SPDX-License-Identifier: BSD-3-Clause
// Worlds as files of text hold them: the program's own scenes, and as other programs have them: GeoJSON, well-known
// text, lists of rings, micromouse mazes, Moving AI's maps and scenarios, maps of map_server. What is taken of each is
// said where it is read: scene_io.cpp, geojson_io.cpp, wkt_io.cpp, ring_lists_io.cpp, micromouse_io.cpp,
// moving_ai_io.cpp, ros_map_io.cpp. All that read throw InputError naming file and line, and Stopped; all that write
// throw InputError for what the format can't hold, WriteError, Stopped.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

Scene read_scene_text(const InputFile& file, const Execution& execution);
using SceneTextSink = std::function<void(std::string_view)>;
/// Hands everything that the scene holds to `write`, piece by piece. path: of the file, beside which masks are.
void write_scene_text(const Scene& scene, const SceneTextSink& write, const Execution& execution,
                      const std::string& path = "-");
/// Writes everything that the scene holds.
void write_scene_text(const Scene& scene, const std::string& path, const Execution& execution);

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

/// nav2: p >= occupied_thresh is occupied, p <= free_thresh free, a transparent pixel unknown. ros1: strictly beyond
/// the thresholds; in trinary mode alpha counts as one more colour, in scale mode a fully transparent pixel is unknown.
enum class MapServerRules : std::uint8_t { nav2, ros1 };
constexpr auto enum_names(MapServerRules) { return std::array<std::string_view, 2>{"nav2", "ros1"}; }

/// Reads the YAML and its image (absolute, ~/…, or relative to the YAML file). Throws InputError naming file and line,
/// ReadError naming the image and who asks for it, Stopped.
OccupancyMap read_ros_map(const InputFile& yaml, const Execution& execution,
                          MapServerRules rules = MapServerRules::nav2);

/// The same files as a mask: the values that a map server of Nav2 publishes. Throws as read_ros_map.
MaskCells read_mask(const InputFile& yaml, const Execution& execution);

/// NAME.pgm, the image that write_ros_map writes beside NAME.yaml.
std::string map_image_of(const std::string& yaml);

/// Writes NAME.yaml and, beside it, NAME.pgm: the YAML only where its image is whole. Throws as OutputFile does.
void write_ros_map(const OccupancyMap& map, const std::string& path, const Execution& execution);

/// Reads the masks that nobody has read yet. What `keep-out` names may be a GeoJSON or scene, too: its polygons become
/// keep_out or, with a factor, areas, and it is no mask more. Throws ReadError, InputError naming file and line,
/// Stopped.
void read_masks(Prices& prices, const Execution& execution);

/// `name` as a file that stands in `file` means it: absolute, ~/…, or beside that.
std::string path_beside(const std::string& file, const std::string& name);
/// What `path` is called in a file that is written to `file`; read back by path_beside.
std::string name_beside(const std::string& file, const std::string& path);

}  // namespace warren
