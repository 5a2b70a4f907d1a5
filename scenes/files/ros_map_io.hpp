// SPDX-License-Identifier: BSD-3-Clause
// Maps of ROS's map_server: a YAML file with resolution, origin (yaw included), thresholds, negate and mode, and the
// PGM or PNG image that it names. A cell is free, occupied, unknown, or (modes scale and raw) between; only free cells
// may be driven on. Cells that are not free are blocked. The rules differ between ROS 1 and Nav2 at equality and for
// pictures with alpha, so they are an option.
//
// The files that prices name, read: masks of map servers, and polygons that are kept out of.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

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
