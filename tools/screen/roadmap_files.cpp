// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/roadmap_files.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "pictures/draw_roadmap.hpp"
#include "roadmaps/file/file_layout.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/roadmaps/roadmap_file_io.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"

namespace warren::tools {

void check_rules_of_maps(const Arguments& arguments) {
  if (!arguments.has("--map-rules") || arguments.has("--world")) return;
  throw UsageError("--map-rules: is for the world that --world names; a roadmap has its own inside");
}

Roadmap load_roadmap(const Arguments& arguments, const Execution& execution, StageTimes& seconds) {
  const std::string& file = arguments.operand(0);
  if (is_made_source(file)) {
    throw InputError(file, "is a world where a roadmap is expected; make one by `warren build`");
  }
  std::optional<Scene> world;
  if (const auto name = arguments.value("--world")) world = load_world(*name, arguments, execution, seconds);
  const StageTimer timer(execution, "read", seconds.read);
  Roadmap roadmap = read_roadmap(file, execution, std::move(world));
  check_not_written(arguments, roadmap.robot);
  return roadmap;
}

bool is_roadmap_named(const std::string& file) {
  std::ifstream stream;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) stream.open(file, std::ios::binary);
  std::array<char, roadmap_magic.size()> head{};
  stream.read(head.data(), head.size());
  return stream && is_roadmap_file({head.data(), head.size()});
}

int draw_roadmap(const Arguments& arguments, const std::string& file, const PictureOptions& options) {
  Run run(arguments);
  StageTimes seconds;
  const Roadmap roadmap = load_roadmap(arguments, run.execution(), seconds);
  std::vector<std::string> notes;
  {
    double draw_seconds = 0.0;
    const StageTimer timer(run.execution(), "draw", draw_seconds);
    notes = write_picture(file, roadmap, options, arguments.command_line(), run.execution());
  }
  run.end();
  say_of_picture(arguments, file, notes);
  run.conclude(file == "-", {}, [&] {
    const EdgeCounts edges = count_edges(roadmap, run.execution());
    return fmt::format("{}: {}, {}, edges: {} free, {} blocked, {} unchecked\n", run.palette().strong(file),
                       description_of(roadmap.world.whole(run.execution())),
                       counted(count_states(roadmap), "state", "states"), grouped(edges.free), grouped(edges.blocked),
                       grouped(edges.unchecked));
  });
  return exit_code::success;
}

}  // namespace warren::tools
