// SPDX-License-Identifier: BSD-3-Clause
// The WORLD of a command line: a file (what it is, its content says first, its ending second), "-" for standard input,
// or maze:ROWSxCOLS[,seed=N][,algorithm=NAME][,loops=F]. And scenes out, by the ending of the file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

struct MoveItFrames;  // scenes/arms/arm_files_io.hpp

/// What a file of a world may be (docs/file_formats.md).
enum class WorldFormat : std::uint8_t {
  scene,
  npy,
  maze,
  moving_ai,
  ros_map,
  image,
  micromouse,
  geojson,
  wkt,
  ring_list,
  moveit
};

/// What the content says, or where it says nothing the name's ending; text of no known kind is a scene.
WorldFormat format_of(const InputFile& file);

/// Does this name a maze to be generated rather than a file?
bool is_maze_source(std::string_view source);
/// Does it name a world that is made here, a maze or empty:WIDTHxHEIGHT?
bool is_made_source(std::string_view source);
/// Throws UsageError for whatever is not maze:ROWSxCOLS[,seed=N][,algorithm=NAME][,loops=F].
MazeOptions parse_maze_source(std::string_view source);

/// Reads or generates a world of walls, polygons and spheres, or a map (Scene::map); a maze has unit walls in the
/// course's order. Throws UsageError, ReadError, InputError (also for polygons that are not simple), Stopped.
/// `rules` are for the maps of map_server alone.
Scene read_world(const std::string& source, const Execution& execution = {},
                 MapServerRules rules = MapServerRules::nav2);
/// The same for a file that is open already. frames: of poses in a scene of MoveIt, as read_moveit_scene() takes them.
Scene read_scene(const InputFile& file, const Execution& execution, MapServerRules rules = MapServerRules::nav2,
                 MoveItFrames* frames = nullptr);

/// Writes .npy, .maze, .geojson, .wkt, or for .walls, .scene, .txt and "-" scene text. Throws UsageError for other
/// endings, InputError for what the format can't hold, WriteError, Stopped.
void write_scene(const Scene& scene, const std::string& path, const Execution& execution = {});

/// What the scene, or the map that it becomes, has and a file of that ending, a world's or a map's, has no words for:
/// "bounds" (told of WKT alone), "start", "goal", "robot", "clearance", "grid", "solids"; of maps "resolution",
/// "origin", "yaw", "unknown cells" and "water", which become walls. A maze read anew from .npy has the same start and
/// goal.
std::vector<std::string_view> parts_left_out(const Scene& scene, std::string_view path,
                                             const OccupancyMap* becomes = nullptr);

/// Is this the ending of a map: .map (Moving AI), .yaml (map server, with a .pgm beside it) or .pgm?
bool is_map_ending(std::string_view path);
/// Writes a map by its ending, .png too. Throws UsageError for other endings, WriteError, Stopped.
void write_map(const OccupancyMap& map, const std::string& path, const Execution& execution);

}  // namespace warren
