// SPDX-License-Identifier: BSD-3-Clause
// A map of cells, each a closed square that is blocked or free: what the readers of Moving AI, map server and maze
// image files give. Row 0 is the bottom row, whatever the file's order; outside of the map everything is blocked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// Which file a map was read from; of cells that a program gives: image.
enum class MapFormat : std::uint8_t { moving_ai, ros, image };

/// Cells of a plane, each free or not. Row 0 is the bottom row.
struct OccupancyMap {
  MapFormat format = MapFormat::image;  ///< of its file
  Bitmap blocked;          ///< all cells that a robot may not touch: occupied, unknown, between the thresholds, water
  Bitmap unknown;          ///< blocked because nothing is known; empty where there are none
  Bitmap water;            ///< Moving AI: passable, but only from water; empty where there is none
  std::uint64_t free = 0;  ///< cells; the four counts add up to all cells, water counts as occupied
  std::uint64_t occupied = 0;       ///< cells
  std::uint64_t unknown_count = 0;  ///< cells
  std::uint64_t between = 0;        ///< map server, modes scale and raw: neither free nor occupied nor unknown
  std::uint64_t grey_free = 0;      ///< map server: free pixels of grey 205, by which map_saver means unknown
  double cell = 1.0;                ///< side of a cell, in world units; > 0
  Vec2 origin;                      ///< lower left corner of cell (0, 0)
  double yaw_rad = 0.0;             ///< the map is turned about its origin, counter-clockwise
  std::optional<Vec2> start;        ///< world coordinates; maze images: the entrance in the first row
  std::optional<Vec2> goal;         ///< the same; maze images: the exit
  std::string source;               ///< name of the file, as it was given
  std::string image = {};           ///< map server: the file that the pixels come from

  /// Columns of cells.
  std::uint32_t width() const { return blocked.width(); }
  /// Rows of cells.
  std::uint32_t height() const { return blocked.height(); }
};

/// The world's point at map coordinates (cells; (0.5, 0.5) is the middle of the first cell), and back.
Vec2 world_point(const OccupancyMap& map, Vec2 in_cells);
/// The place in the map's cells of a point of the world.
Vec2 map_point(const OccupancyMap& map, Vec2 in_world);
/// The middle of a cell, in world coordinates.
Vec2 cell_centre(const OccupancyMap& map, Cell cell);
/// The world's box around a box of the map's coordinates.
Box world_box(const OccupancyMap& map, const Box& in_cells);
/// The same around all of the map.
Box world_box(const OccupancyMap& map);
/// The cell that holds a point (on a border: the upper or right one); nothing outside of the map.
std::optional<Cell> cell_at(const OccupancyMap& map, Vec2 in_world);

/// All cells clear. Throws Stopped where the memory lacks, or while it is filled.
Bitmap cell_bitmap(std::uint32_t width, std::uint32_t height, const Execution& execution);

/// Throws InputError unless 1 <= width, height < 2^31 and width x height < 2^32; `where` names the place.
void check_map_size(const std::string& where, std::uint64_t width, std::uint64_t height);

}  // namespace warren
