// SPDX-License-Identifier: BSD-3-Clause
// Files of walls and polygons. Whatever is read can be written as scene text and read again, the same to the last bit;
// what has a writer of its own, by that too.
#include <array>

#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "tests/fuzz/fuzz_reader.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace warren::fuzz {
namespace {

using PlaneReader = Scene (*)(const InputFile&, const Execution&);

/// The scene with polygons that are simple, as every verb gets it.
std::optional<Scene> scene_in(std::string_view bytes, PlaneReader reader) {
  return read_or_refuse([&] {
    Scene scene = reader(InputFile::of_bytes("fuzzed", bytes), fuzz_execution());
    check_polygons(scene, fuzz_execution());
    return scene;
  });
}

/// The scene that is read from `name` after it was written there.
Scene rewritten(const Scene& scene, std::string_view name) {
  const std::string path = scratch_file(name);
  write_scene(scene, path, fuzz_execution());
  return read_world(path, fuzz_execution());
}

void read_as_text(std::string_view bytes, PlaneReader reader) {
  const auto scene = scene_in(bytes, reader);
  if (scene) demand_same_scene(*scene, rewritten(*scene, "again.scene"), false);
}

void read_scenes(std::string_view bytes) { read_as_text(bytes, read_scene_text); }
void read_ring_lists(std::string_view bytes) { read_as_text(bytes, read_ring_list); }
void read_mice(std::string_view bytes) { read_as_text(bytes, read_micromouse); }

void read_arrays(std::string_view bytes) {
  const auto scene = scene_in(bytes, read_npy);
  if (scene) demand_same_scene(*scene, rewritten(*scene, "again.npy"), false);
}

/// What is read is written as it was.
void read_maze_files(std::string_view bytes) {
  const auto scene = scene_in(bytes, read_maze_file);
  if (!scene) return;
  const std::string path = scratch_file("again.maze");
  write_scene(*scene, path, fuzz_execution());
  demand(InputFile(path, fuzz_execution()).bytes() == bytes, "the same bytes");
}

void read_geojson_files(std::string_view bytes) {
  const auto scene = scene_in(bytes, read_geojson);
  if (scene) demand_same_scene(*scene, rewritten(*scene, "again.geojson"), true);
}

void read_wkt_files(std::string_view bytes) {
  const auto scene = scene_in(bytes, read_wkt);
  if (scene) demand_same_scene(*scene, rewritten(*scene, "again.wkt"), true);
}

/// Whatever kind of file the bytes look like.
void read_worlds(std::string_view bytes) {
  read_or_refuse([&] { return read_scene(InputFile::of_bytes("fuzzed", bytes), fuzz_execution()); });
}

constexpr std::array plane_table{
    FuzzReader{"scene", read_scenes},          FuzzReader{"npy", read_arrays},
    FuzzReader{"geojson", read_geojson_files}, FuzzReader{"wkt", read_wkt_files},
    FuzzReader{"ring_list", read_ring_lists},  FuzzReader{"micromouse", read_mice},
    FuzzReader{"maze_file", read_maze_files},  FuzzReader{"world", read_worlds},
};

}  // namespace

std::span<const FuzzReader> plane_readers() { return plane_table; }

}  // namespace warren::fuzz
