// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/formats/unmade_maze_io.hpp"

#include "scenes/formats/maze_file_io.hpp"
#include "scenes/formats/npy_io.hpp"
#include "scenes/formats/npy_maze_io.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {

std::optional<Scene> unmade_maze(const std::string& source) {
  const MazeOptions maze = parse_maze_source(source);
  if (maze.algorithm != MazeAlgorithm::mst) return std::nullopt;
  Scene scene = unmade_maze_scene(maze);
  scene.source = source;
  return scene;
}

std::optional<Scene> unmade_maze(const InputFile& file) {
  if (is_maze_file(file.bytes())) return unmade_maze_file(file);
  return is_npy(file.bytes()) ? unmade_npy(file) : std::nullopt;
}

}  // namespace warren
