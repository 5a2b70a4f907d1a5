// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/world_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/base/error.hpp"
#include "pictures/picture.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "studies/measure/human_units.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 2> rules_words{"nav2", "ros1"};

constexpr OptionSpec world_specs[] = {
    {"--map-rules", "NAME",
     "whose rules the pixels of a map_server YAML follow: nav2's or those of ROS 1, strict at the thresholds "
     "(default: nav2)",
     "nav2 ros1"},
};

bool is_picture(std::string_view ending) { return ending == ".svg" || ending == ".png" || ending == ".html"; }

}  // namespace

std::optional<Vec2> plane_point(const std::vector<double>& state) {
  if (state.size() < 2) return std::nullopt;
  return Vec2{state[0], state[1]};
}

std::span<const OptionSpec> world_option_specs() { return world_specs; }

Scene load_world(const std::string& source, const Arguments& arguments, const Execution& execution,
                 StageTimes& seconds) {
  const bool generates = is_maze_source(source);
  const auto asked = arguments.value("--map-rules");
  const auto rules =
      asked ? static_cast<MapServerRules>(choice_value("--map-rules", *asked, rules_words)) : MapServerRules::nav2;
  const StageTimer timer(execution, generates ? "generate" : "read", generates ? seconds.generate : seconds.read);
  Scene scene = read_world(source, execution, rules);
  if (asked && !(scene.map && scene.map->format == MapFormat::ros)) {
    throw UsageError(fmt::format("--map-rules: is for the YAML of map_server, and {} is none", source));
  }
  if (scene.map) check_not_written(arguments, scene.map->image);
  if (scene.robot) check_not_written(arguments, scene.robot->table);
  return scene;
}

void check_world_file(const std::string& file) {
  constexpr std::array<std::string_view, 9> endings{".walls", ".scene", ".txt", ".npy", ".geojson",
                                                    ".wkt",   ".svg",   ".png", ".html"};
  const std::string ending = ending_of(file);
  const bool device = file == "-" || file.starts_with("/dev/");
  if (!device && std::find(endings.begin(), endings.end(), ending) == endings.end()) {
    throw UsageError(
        "--output: a world ends in .walls, .scene, .txt, .npy, .geojson, .wkt, .svg, .png or .html (found: '" + file +
        "')");
  }
  check_writable(file);
}

void write_world(const Scene& scene, const std::string& file, const std::string& command_line,
                 const Execution& execution) {
  if (!is_picture(ending_of(file))) return write_scene(scene, file, execution);
  Picture picture{.scene = scene, .start = plane_point(scene.start), .goal = plane_point(scene.goal)};
  picture.title = description_of(scene);
  picture.description = command_line;
  write_picture(file, picture, execution);
}

WorldAccount account_of(const Scene& scene, const Execution& execution) {
  if (scene.map) return {scene.source, "map", 0, 0, scene_hash(scene, execution), 0, 0};
  const bool plane = scene.walls.size() > 0 || !has_solids(scene);
  const char* kind = scene.maze ? "maze" : !scene.polygons.empty() ? "polygons" : plane ? "walls" : "solids";
  return {scene.source,
          kind,
          scene.walls.size(),
          scene.polygons.size(),
          scene_hash(scene, execution),
          scene.spheres.size(),
          scene.boxes.size()};
}

std::string description_of(const Scene& scene) {
  if (scene.map) {
    return fmt::format("map of {} x {} cells, {} free", scene.map->width(), scene.map->height(),
                       grouped(scene.map->free));
  }
  std::string text = scene.maze ? fmt::format("{} x {} maze, ", scene.maze->rows, scene.maze->cols) : "";
  const auto counted = [](std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", grouped(count), count == 1 ? one : many);
  };
  if (!scene.polygons.empty()) text += counted(scene.polygons.size(), "polygon", "polygons");
  if (!scene.polygons.empty() && scene.walls.size() > 0) text += ", ";
  const bool nothing_else = scene.polygons.empty() && !has_solids(scene);
  if (nothing_else || scene.walls.size() > 0) text += counted(scene.walls.size(), "wall", "walls");
  const auto add_solids = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
  };
  add_solids(scene.spheres.size(), "sphere", "spheres");
  add_solids(scene.boxes.size(), "box", "boxes");
  return text;
}

}  // namespace warren
