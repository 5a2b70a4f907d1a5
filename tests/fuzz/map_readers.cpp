// SPDX-License-Identifier: BSD-3-Clause
// Files of cells. What is read is written in the same format and read again: the same cells.
#include <algorithm>
#include <array>

#include "scenes/files/image_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/fuzz/fuzz_reader.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace warren::fuzz {
namespace {

void demand_counts(const OccupancyMap& map) {
  demand(map.width() > 0 && map.height() > 0 && map.blocked.size() == std::uint64_t{map.width()} * map.height(),
         "a map has cells");
  demand(map.free + map.occupied + map.unknown_count + map.between == map.blocked.size(), "each cell counts once");
  demand(map.free == map.blocked.size() - map.blocked.count(), "what is not free is blocked");
}

void read_moving_ai(std::string_view bytes) {
  const auto map =
      read_or_refuse([&] { return read_moving_ai_map(InputFile::of_bytes("fuzzed", bytes), fuzz_execution()); });
  if (!map) return;
  demand_counts(*map);
  const std::string path = scratch_file("again.map");
  write_map(*map, path, fuzz_execution());
  demand_same_cells(*map, read_moving_ai_map(InputFile(path, fuzz_execution()), fuzz_execution()));
}

/// On a map of 8 x 8 cells.
void read_scen(std::string_view bytes) {
  const auto scenarios =
      read_or_refuse([&] { return read_scenarios(InputFile::of_bytes("fuzzed", bytes), fuzz_execution()); });
  if (!scenarios) return;
  OccupancyMap map;
  map.blocked = Bitmap(8, 8);
  for (const Scenario& scenario : *scenarios) {
    demand(scenario.length >= 0.0, "a length is a length");
    const auto cell = read_or_refuse([&] { return cell_of(map, scenario, scenario.start, "fuzzed"); });
    if (cell) demand(cell->x < 8 && cell->y < 8, "a cell of the map");
  }
}

void read_maze_images(std::string_view bytes) {
  const auto map =
      read_or_refuse([&] { return read_maze_image(InputFile::of_bytes("fuzzed", bytes), fuzz_execution()); });
  if (!map) return;
  demand_counts(*map);
  for (const char* name : {"again.png", "again.pgm"}) {
    const std::string path = scratch_file(name);
    write_map(*map, path, fuzz_execution());
    demand_same_cells(*map, read_maze_image(InputFile(path, fuzz_execution()), fuzz_execution()));
  }
}

/// A YAML, a zero byte, and the image of which the YAML says that it is `image: i`.
void read_ros_maps(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  write_scratch("i", bytes.substr(std::min(end + 1, bytes.size())));
  const InputFile yaml = InputFile::of_bytes(scratch_file("fuzzed.yaml"), bytes.substr(0, end));
  for (const MapServerRules rules : {MapServerRules::nav2, MapServerRules::ros1}) {
    const auto map = read_or_refuse([&] { return read_ros_map(yaml, fuzz_execution(), rules); });
    if (!map) continue;
    demand_counts(*map);
    const std::string path = scratch_file("again.yaml");
    write_map(*map, path, fuzz_execution());
    const OccupancyMap again = read_ros_map(InputFile(path, fuzz_execution()), fuzz_execution());
    demand_same_cells(*map, again);
    demand(map->cell == again.cell && map->origin == again.origin && map->yaw_rad == again.yaw_rad, "the same frame");
  }
}

constexpr std::array map_table{
    FuzzReader{"moving_ai", read_moving_ai},
    FuzzReader{"scenarios", read_scen},
    FuzzReader{"maze_image", read_maze_images},
    FuzzReader{"ros_map", read_ros_maps},
};

}  // namespace

std::span<const FuzzReader> map_readers() { return map_table; }

}  // namespace warren::fuzz
