// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/roadmap_files.hpp"

#include <optional>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "solve/roadmaps/roadmap_file_io.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/world_files.hpp"

namespace warren {

void check_rules_of_maps(const Arguments& arguments) {
  if (!arguments.has("--map-rules") || arguments.has("--world")) return;
  throw UsageError("--map-rules: is for the world that --world names; a roadmap has its own inside");
}

Roadmap load_roadmap(const Arguments& arguments, const Execution& execution, StageTimes& seconds) {
  const std::string& file = arguments.operand(0);
  if (is_maze_source(file)) {
    throw InputError(file, "is a world where a roadmap is expected; make one by `warren build`");
  }
  std::optional<Scene> world;
  if (const auto name = arguments.value("--world")) world = load_world(*name, arguments, execution, seconds);
  const StageTimer timer(execution, "read", seconds.read);
  Roadmap roadmap = read_roadmap(file, execution, std::move(world));
  check_not_written(arguments, roadmap.robot);
  return roadmap;
}

}  // namespace warren
