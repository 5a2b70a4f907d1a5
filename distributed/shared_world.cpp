// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/shared_world.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <system_error>

#include "core/base/error.hpp"
#include "scenes/formats/maze_file_io.hpp"
#include "scenes/formats/npy_io.hpp"
#include "scenes/formats/npy_maze_io.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse() {
  throw UsageError(
      "WORLD: ranks share mazes named maze:ROWSxCOLS,algorithm=mst, whose tiles any of them can make, and files .maze "
      "and .npy of mazes, of which each reads its part");
}

Scene named_maze(const std::string& source) {
  const MazeOptions maze = parse_maze_source(source);
  if (maze.algorithm != MazeAlgorithm::mst) refuse();
  Scene scene = unmade_maze_scene(maze);
  scene.source = source;
  return scene;
}

SharedWorld maze_in(const InputFile& file) {
  Scene scene = unmade_maze_file(file);
  std::string facts = fmt::format("{} bytes with checksums {:016x}", file.bytes().size(), *scene.packed->hash);
  return {std::move(scene), std::move(facts)};
}

SharedWorld array_in(const InputFile& file) {
  std::optional<Scene> scene = unmade_npy(file);
  if (!scene) {
    throw InputError(file.name(),
                     "its first four rows are no outline of a maze as 'warren generate' writes it; only the walls of "
                     "such mazes can be shared");
  }
  const NpyWalls array = npy_walls(file);
  std::string facts = fmt::format("{} walls of {} x {} cells in {} bytes", array.walls, scene->maze->rows,
                                  scene->maze->cols, file.bytes().size());
  return {std::move(*scene), std::move(facts)};
}

}  // namespace

SharedWorld shared_world(const std::string& source, const Execution& execution) {
  if (is_maze_source(source)) return {named_maze(source), ""};
  std::error_code missing;
  if (source == "-" || std::filesystem::is_other(source, missing)) refuse();  // a pipe has one reader
  const InputFile file(source, execution);
  if (is_maze_file(file.bytes())) return maze_in(file);
  if (is_npy(file.bytes())) return array_in(file);
  refuse();
}

}  // namespace warren
