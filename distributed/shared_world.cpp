// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/shared_world.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <system_error>

#include "core/base/error.hpp"
#include "scenes/formats/maze_file_io.hpp"
#include "scenes/formats/npy_io.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "scenes/formats/unmade_maze_io.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren::distributed {
namespace {

[[noreturn]] void refuse() {
  throw UsageError(
      "WORLD: ranks share mazes named maze:ROWSxCOLS,algorithm=mst, whose tiles any of them can make, and files .maze "
      "and .npy of mazes, of which each reads its part");
}

/// What a file says of the walls beside their number of rows and columns.
std::string facts_of(const InputFile& file, const Scene& scene) {
  if (is_maze_file(file.bytes())) {
    return fmt::format("{} bytes with checksums {:016x}", file.bytes().size(), *scene.packed->hash);
  }
  return fmt::format("{} walls of {} x {} cells in {} bytes", npy_walls(file).walls, scene.maze->rows, scene.maze->cols,
                     file.bytes().size());
}

}  // namespace

SharedWorld shared_world(const std::string& source, const Execution& execution) {
  if (is_maze_source(source)) {
    std::optional<Scene> scene = unmade_maze(source);
    if (!scene) refuse();
    return {std::move(*scene), ""};
  }
  std::error_code missing;
  if (source == "-" || std::filesystem::is_other(source, missing)) refuse();  // a pipe has one reader
  const InputFile file(source, execution);
  std::optional<Scene> scene = unmade_maze(file);
  if (!scene && is_npy(file.bytes())) {
    throw InputError(file.name(),
                     "its first four rows are no outline of a maze as 'warren generate' writes it; only the walls of "
                     "such mazes can be shared");
  }
  if (!scene) refuse();
  std::string facts = facts_of(file, *scene);
  return {std::move(*scene), std::move(facts)};
}

}  // namespace warren::distributed
