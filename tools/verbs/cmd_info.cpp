// SPDX-License-Identifier: BSD-3-Clause
// warren info: what is in this file, a world or a roadmap.
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "core/base/printable.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/kept/roadmap_sections.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec info_specs[] = {
    {"--json", "FILE", "write it as JSON; - is standard output"},
    {"--srdf", "FILE", "of a URDF: what MoveIt says of the robot"},
    {"--group", "NAME", "of a URDF: the group of joints that moves"},
    {"--package-path", "DIR", "of a URDF: where package:// is looked for, beside the file's own folders"},
    {"--check", "all", "check every byte of a roadmap file, however large it is", "all"},
};

/// Of a world nullptr. What comes through a pipe is read once.
std::unique_ptr<RoadmapFile> opened_roadmap(const InputFile& file, const std::string& path,
                                            const Execution& execution) {
  if (!is_roadmap_file(file.bytes())) return nullptr;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) return std::make_unique<RoadmapFile>(path, execution);
  execution.reserve(file.bytes().size());
  return std::unique_ptr<RoadmapFile>(
      new RoadmapFile(RoadmapFile::of_bytes(file.name(), file.bytes(), execution)));  // it can't be moved
}

/// file: none of a world that is made. A .maze file whose walls are left out is asked for their number.
std::vector<Fact> world_facts(const std::string& path, const std::optional<InputFile>& file, const Arguments& arguments,
                              const Execution& execution) {
  const bool is_packed = file && is_maze_file(file->bytes());
  const Scene scene = is_packed ? load_planned_world(path, std::nullopt, arguments, execution)
                      : file    ? load_world(*file, arguments, execution)
                                : load_world(path, arguments, execution);
  if (!is_packed || !is_unmade(scene)) return facts_of(scene, execution);
  const MazeFile maze(*file);
  maze.check(execution);
  const std::uint64_t walls = maze.wall_count(execution);
  std::vector<Fact> facts = facts_of(scene, execution);
  for (Fact& fact : facts) {
    if (fact.name == std::string_view("walls")) fact = {"walls", grouped(walls), std::to_string(walls)};
  }
  return facts;
}

std::vector<Fact> robot_facts(const InputFile& file, const Arguments& arguments, const Execution& execution) {
  ArmFiles files{.urdf = arguments.operand(0)};
  const auto said = [&](std::string_view option) { return std::string(arguments.value(option).value_or("")); };
  files.srdf = said("--srdf");
  files.group = said("--group");
  if (const std::string folder = said("--package-path"); !folder.empty()) files.packages.push_back(folder);
  ArmModel model = read_urdf(files, file, execution);
  leave_out_touching(model, execution);
  return facts_of(model);
}

int info(const Arguments& arguments) {
  const auto json = output_file(arguments, "--json");
  const std::string& path = arguments.operand(0);
  if (const auto what = arguments.value("--check"); what && *what != "all")
    throw UsageError(fmt::format("--check: takes `all` (found: '{}')", *what));
  Run run(arguments);
  std::optional<InputFile> file;
  if (!is_made_source(path)) file.emplace(named_world(path), run.execution());
  auto roadmap = file ? opened_roadmap(*file, path, run.execution()) : nullptr;
  constexpr std::size_t head = 4096;
  const bool is_robot = file && roadmap == nullptr && file->bytes().substr(0, head).find("<robot") != std::string::npos;
  const bool is_world = roadmap == nullptr && !is_robot;
  if (is_world) check_robot_has_use(file ? &*file : nullptr, arguments);
  if (!is_world) arguments.refuse({"--robot"}, "is for a scene or request of MoveIt");
  if (roadmap == nullptr) arguments.refuse({"--check"}, "is for roadmap files; others are checked as they are read");
  if (!is_robot) arguments.refuse({"--srdf", "--group", "--package-path"}, "is for a URDF");
  std::string text;
  std::string as_json;
  if (roadmap != nullptr) {
    as_json = text = roadmap_meta(*roadmap, run.execution());
    if (arguments.has("--check")) {
      roadmap->check_all(run.execution());
      check_roadmap(*roadmap, run.execution());
      if (has_world(*roadmap)) read_roadmap(std::move(roadmap), run.execution()).world.whole(run.execution());
    }
  } else {
    const std::vector<Fact> facts =
        is_robot ? robot_facts(*file, arguments, run.execution()) : world_facts(path, file, arguments, run.execution());
    as_json = facts_json(facts);
    for (const Fact& fact : facts) {
      text += fmt::format("{}{}\n", run.palette().faint(fmt::format("{:<10} ", fact.name)), printable(fact.text));
    }
  }
  run.end();
  if (json) write_file(*json, as_json, run.execution());
  run.conclude([&] { return text; });
  return exit_code::success;
}

}  // namespace

Command info_command() {
  return {"info", "FILE", "say what is in a world or a roadmap",
          joined_options({info_specs, std::span(&moveit_robot_option, 1), world_option_specs(), run_option_specs()}),
          info};
}

}  // namespace warren::tools
