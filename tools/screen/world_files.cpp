// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/world_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <tuple>

#include "core/base/printable.hpp"
#include "pictures/draw_answer.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/kept/roadmap_file.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/question/question_of_arm.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec world_specs[] = {
    {"--map-rules", "NAME",
     "for maps of ROS (.yaml): by whose rules a pixel is free, Nav2's or those of ROS 1 (default: nav2)",
     choices_of<MapServerRules>},
    {"--request", "FILE", "a request of MoveIt (YAML): start and goal of the arm"},
};

[[noreturn]] void refuse_rules(const std::string& source) {
  throw UsageError(fmt::format("--map-rules: is for the YAML of map_server, and {} is none", source));
}

/// Of --robot, else of the other one.
std::optional<ArmFiles> files_of(const Arguments& arguments, const std::optional<RobotSpec>& other) {
  const auto words = arguments.value("--robot");
  const auto said = [&] { return robot_value("--robot", *words); };
  const std::optional<RobotSpec> robot = words ? std::optional(as_usage(said)) : other;
  return robot ? robot->files : std::nullopt;
}

/// A goal of one tool or group means nothing to another one. before: what the world says of the arm.
void refuse_another_robot(const ArmFiles& before, const Scene& scene, const Arguments& arguments) {
  const auto files = files_of(arguments, {});
  if (!files || !scene.arm) return;
  const bool has_ends = !files->base.empty() || !files->tip.empty();
  if (has_ends && scene.arm->group != before.group) {
    throw UsageError(
        fmt::format("--robot: says base and tip, the request group {}; leave them out of one", scene.arm->group));
  }
  for (const auto& [noun, own, world, asked] : {std::tuple("group", files->group, before.group, scene.arm->group),
                                                {"tool", files->tool, before.tool, scene.arm->tool}}) {
    if (own.empty() || asked == world || own == asked) continue;
    throw UsageError(fmt::format("--robot: says {} {}, the request {}; leave it out of one", noun, own, asked));
  }
}

}  // namespace

std::span<const OptionSpec> world_option_specs() { return world_specs; }

const std::string& named_world(const std::string& source) {
  const bool is_size = source == "maze" || source.find_first_not_of("0123456789x") == std::string::npos;
  std::error_code ignored;
  if (is_size && !std::filesystem::exists(source, ignored)) {
    throw ReadError(source.empty() ? "''" : source, "there is no such file; a maze is called maze:41x41");
  }
  return source;
}

Scene load_world(const std::string& source, const Arguments& arguments, const Execution& execution, StageTimes* seconds,
                 const std::optional<RobotSpec>& robot) {
  if (!is_made_source(source))
    return load_world(InputFile(named_world(source), execution), arguments, execution, seconds, robot);
  if (arguments.has("--map-rules")) refuse_rules(source);
  if (arguments.has("--request")) throw UsageError("--request: is for a world with an arm, and this one is made");
  const StageTimer timer(execution, "generate", seconds != nullptr ? &seconds->generate : nullptr);
  return read_world(source, execution);
}

Scene load_planned_world(const std::string& source, std::optional<PipelineKind> pipeline, const Arguments& arguments,
                         const Execution& execution, StageTimes* seconds, const std::optional<RobotSpec>& robot) {
  const auto is_large = [&](MazeHint maze) {
    constexpr double bytes_a_cell = 25.0;  // walls and tiles at their peak (docs/performance.md)
    constexpr double most_held = 4294967295.0;
    const double cells = static_cast<double>(maze.rows) * maze.cols;
    const double memory = execution.deadline == nullptr ? most_held * bytes_a_cell
                                                        : static_cast<double>(execution.deadline->memory_bytes());
    return cells > most_held || cells * bytes_a_cell > memory;
  };
  const bool is_streamed = pipeline == PipelineKind::streamed;
  const auto is_left_out = [&](MazeHint maze) { return is_streamed || (!pipeline && is_large(maze)); };
  if (is_made_source(source)) {
    std::optional<Scene> scene = is_maze_source(source) ? unmade_maze(source) : std::nullopt;
    if (scene && is_left_out(*scene->maze) && !arguments.has("--request")) return std::move(*scene);
    return load_world(source, arguments, execution, seconds);
  }
  const InputFile file(named_world(source), execution);
  std::error_code ignored;
  const bool plain = !arguments.has("--map-rules") && !arguments.has("--request");
  if (std::filesystem::is_regular_file(source, ignored) && plain) {
    std::optional<Scene> scene = unmade_maze(file);
    // All of an array's walls can be planned among then.
    const bool fits = scene && is_npy(file.bytes()) && !is_large(*scene->maze);
    if (scene && !fits && is_left_out(*scene->maze)) return std::move(*scene);
  }
  return load_world(file, arguments, execution, seconds, robot);
}

Scene load_world(const InputFile& file, const Arguments& arguments, const Execution& execution, StageTimes* seconds,
                 const std::optional<RobotSpec>& robot) {
  const auto asked = given_choice<MapServerRules>(arguments, "--map-rules");
  const StageTimer timer(execution, "read", seconds != nullptr ? &seconds->read : nullptr);
  MoveItFrames frames;
  if (arguments.has("--request") || format_of(file) == WorldFormat::moveit) frames.robot = files_of(arguments, robot);
  Scene scene = read_scene(file, execution, asked.value_or(MapServerRules::nav2), &frames);
  if (asked && !(scene.map && scene.map->format == MapFormat::ros)) refuse_rules(file.name());
  if (scene.map) check_not_written(arguments, scene.map->image);
  if (const std::uint64_t grey = scene.map ? scene.map->grey_free : 0; grey > 0 && !arguments.has("--quiet")) {
    say_on_standard_error(
        printable(fmt::format("warren: note: {}: {} of grey 205, by which map_saver means unknown, "
                              "{} free by free_thresh; below 0.196 they stay unknown",
                              scene.map->source, counted(grey, "pixel", "pixels"), grey == 1 ? "is" : "are")) +
        "\n");
  }
  if (const auto name = arguments.value("--request")) {
    check_not_written(arguments, *name);
    const ArmFiles before = scene.arm.value_or(ArmFiles{});
    take_moveit_request(scene, InputFile(*name, execution), execution, frames);
    refuse_another_robot(before, scene, arguments);
  }
  check_not_written(arguments, scene.robot, scene.prices);
  return scene;
}

void check_robot_has_use(const InputFile* file, const Arguments& arguments, std::string_view other_use) {
  if (!arguments.has("--robot") || arguments.has("--request")) return;
  if (file != nullptr && format_of(*file) == WorldFormat::moveit) return;
  arguments.refuse({"--robot"},
                   fmt::format("is for {}a scene or request of MoveIt with poses in links' frames", other_use));
}

Scene load_world_alone(const std::string& source, const Arguments& arguments, const Execution& execution,
                       std::string_view other_use) {
  if (!arguments.has("--robot") || arguments.has("--request")) return load_world(source, arguments, execution);
  std::optional<InputFile> file;
  if (!is_made_source(source)) file.emplace(named_world(source), execution);
  check_robot_has_use(file ? &*file : nullptr, arguments, other_use);
  return load_world(*file, arguments, execution);
}

void check_world_file(const std::string& file) {
  const std::string ending = ending_of(file);
  const bool is_world = is_among(ending, ".walls .scene .txt .npy .maze .geojson .wkt");
  const bool device = file == "-" || file.starts_with("/dev/");
  if (is_picture(ending)) check_picture("--output", file);
  if (!device && !is_picture(ending) && !is_world) {
    throw UsageError(
        "--output: a world ends in .walls, .scene, .txt, .npy, .maze, .geojson, .wkt, .svg, .png, .pdf or .html "
        "(found: '" +
        file + "')");
  }
  check_writable(file);
}

std::vector<std::string> write_world(const Scene& scene, const std::string& file, const PictureOptions& options,
                                     const std::string& command_line, const Execution& execution) {
  if (!is_picture(ending_of(file))) {
    write_scene(scene, file, execution);
    return {};
  }
  if (scene.robot && is_arm(*scene.robot)) {
    Picture picture = drawing_of(scene, RecordedAnswer{}, execution, options.heading);
    picture.description = command_line;
    return write_picture(file, picture, options, execution);
  }
  Picture picture{.scene = scene, .start = plane_point(scene.start), .goal = plane_point(scene.goal)};
  picture.title = title_of(scene);
  picture.subtitle = description_of(scene);
  picture.description = command_line;
  if (scene.map) picture.layers = cells_of_map(*scene.map, execution);
  if (options.heading) add_heading_of_world(picture, scene, *options.heading, execution);
  return write_picture(file, picture, options, execution);
}

std::string note_of_left_out(const Scene& scene, const std::string& file, const OccupancyMap* becomes) {
  const std::vector<std::string_view> lost = parts_left_out(scene, file, becomes);
  if (lost.empty()) return {};
  return fmt::format("warren: note: {}: its format has no {}: left out\n", printable(file), fmt::join(lost, ", "));
}

void check_rules_of_maps(const Arguments& arguments) {
  if (arguments.has("--world")) return;
  arguments.refuse({"--map-rules", "--request"}, "is for the world that --world names; a roadmap has its own inside");
}

Roadmap load_roadmap(const Arguments& arguments, const Execution& execution, StageTimes* seconds) {
  const std::string& file = arguments.operand(0);
  if (is_made_source(file)) {
    throw InputError(file, "is a world where a roadmap is expected; make one by `warren build`");
  }
  std::optional<Scene> world;
  if (const auto name = arguments.value("--world")) world = load_world(*name, arguments, execution, seconds);
  const StageTimer timer(execution, "read", seconds != nullptr ? &seconds->read : nullptr);
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
  const Roadmap roadmap = load_roadmap(arguments, run.execution());
  std::vector<std::string> notes;
  run.in_stage("draw", nullptr, [&] {
    draw_roadmap(roadmap, arguments.command_line(), options.heading, run.execution(),
                 [&](const Picture& picture) { notes = write_picture(file, picture, options, run.execution()); });
  });
  run.end();
  say_of_picture(arguments, file, notes);
  run.conclude([&] {
    const EdgeCounts edges = count_edges(roadmap, run.execution());
    return fmt::format("{}: {}, {}, edges: {} free, {} blocked, {} unchecked\n", run.palette().strong(file),
                       description_of(roadmap.world.whole(run.execution())),
                       counted(count_states(roadmap), "state", "states"), grouped(edges.free), grouped(edges.blocked),
                       grouped(edges.unchecked));
  });
  return exit_code::success;
}

void read_asked_files(Question& question, const Arguments& arguments, const Execution& execution) {
  check_not_written(arguments, {}, question.prices);
  read_masks(question.prices, execution);
  check_not_written(arguments, {}, question.prices);
  const auto old = arguments.value("--keep-to");
  if (!old) return;
  check_not_written(arguments, *old);
  keep_to(question.route, read_answer(*old, execution));
}

}  // namespace warren::tools
