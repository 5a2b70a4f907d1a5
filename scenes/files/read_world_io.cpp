// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/read_world_io.hpp"

#include <fmt/format.h>

#include <limits>
#include <set>

#include "core/base/error.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

constexpr std::string_view maze_prefix = "maze:";
constexpr std::string_view empty_prefix = "empty:";
constexpr std::uint64_t most_cells = std::numeric_limits<std::uint32_t>::max();
constexpr std::string_view maze_usage = "maze:ROWSxCOLS[,seed=N][,algorithm=NAME][,loops=F]";

/// As a .roadmap file begins, which is no world though one may be inside (solve/kept/roadmap_file.hpp).
constexpr std::string_view roadmap_begin = "\x89WRRMAP\n";

/// Cuts `text` at the first `mark`; the rest is empty if there is none.
std::string_view cut(std::string_view& text, char mark) {
  const std::size_t at = text.find(mark);
  const std::string_view front = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + 1);
  return front;
}

/// A scene that is a map, with the map's start and goal.
Scene scene_of(OccupancyMap map) {
  Scene scene;
  scene.source = map.source;
  if (map.start) scene.start = {map.start->x, map.start->y};
  if (map.goal) scene.goal = {map.goal->x, map.goal->y};
  scene.map = std::move(map);
  return scene;
}

/// Bounds from 0, 0 and nothing in them.
Scene empty_world(std::string_view source) {
  std::string_view height = source.substr(empty_prefix.size());
  const std::string_view width = cut(height, 'x');
  const auto side = [&](std::string_view text) {
    const auto value = scene_text::number_in_full<double>(text);
    if (value && *value >= 1e-6 && *value <= 1e9) return *value;
    throw UsageError(fmt::format("{}: expected empty:WIDTHxHEIGHT, each from 1e-6 to 1e9", source));
  };
  Scene scene;
  scene.bounds = Box{{0.0, 0.0}, {side(width), side(height)}};
  return scene;
}

Scene read_unchecked(const InputFile& file, const Execution& execution, MapServerRules rules, MoveItFrames* frames) {
  const WorldFormat format = format_of(file);
  if (format == WorldFormat::npy) return read_npy(file, execution);
  if (format == WorldFormat::maze) return read_maze_file(file, execution);
  if (format == WorldFormat::micromouse) return read_micromouse(file, execution);
  if (format == WorldFormat::geojson) return read_geojson(file, execution);
  if (format == WorldFormat::wkt) return read_wkt(file, execution);
  if (format == WorldFormat::ring_list) return read_ring_list(file, execution);
  if (format == WorldFormat::moving_ai) return scene_of(read_moving_ai_map(file, execution));
  if (format == WorldFormat::ros_map) return scene_of(read_ros_map(file, execution, rules));
  if (format == WorldFormat::image) return scene_of(read_maze_image(file, execution));
  return format == WorldFormat::moveit ? read_moveit_scene(file, execution, frames) : read_scene_text(file, execution);
}

}  // namespace

WorldFormat format_of(const InputFile& file) {
  const std::string_view bytes = file.bytes();
  const std::string_view head = bytes.substr(0, 4096);
  const std::string_view name = file.name();
  const bool is_yaml = name.ends_with(".yaml") || name.ends_with(".yml");
  if (is_npy(bytes)) return WorldFormat::npy;
  if (is_maze_file(bytes)) return WorldFormat::maze;
  if (is_image(bytes)) return WorldFormat::image;
  if (bytes.starts_with("type ")) return WorldFormat::moving_ai;
  if (head.starts_with("image:") || head.find("\nimage:") != head.npos) return WorldFormat::ros_map;
  if (is_micromouse(bytes)) return WorldFormat::micromouse;
  if (is_geojson(bytes)) return is_yaml ? WorldFormat::ros_map : WorldFormat::geojson;  // YAML may be in braces
  if (is_wkt(bytes)) return WorldFormat::wkt;
  if (is_ring_list(bytes)) return WorldFormat::ring_list;
  if (is_moveit_scene(file.name(), bytes)) return WorldFormat::moveit;
  if (name.ends_with(".npy")) return WorldFormat::npy;
  if (name.ends_with(".maze")) return WorldFormat::maze;
  if (name.ends_with(".png") || name.ends_with(".pgm") || name.ends_with(".bmp")) return WorldFormat::image;
  if (name.ends_with(".num")) return WorldFormat::micromouse;
  if (name.ends_with(".geojson") || name.ends_with(".json")) return WorldFormat::geojson;
  if (name.ends_with(".wkt")) return WorldFormat::wkt;
  if (name.ends_with(".poly") || name.ends_with(".environment")) return WorldFormat::ring_list;
  if (name.ends_with(".map")) return WorldFormat::moving_ai;
  if (is_yaml) return WorldFormat::ros_map;
  return WorldFormat::scene;
}

bool is_maze_source(std::string_view source) { return source.starts_with(maze_prefix); }

bool is_made_source(std::string_view source) { return is_maze_source(source) || source.starts_with(empty_prefix); }

MazeOptions parse_maze_source(std::string_view source) {
  const auto fail = [&](std::string_view what) {
    throw UsageError(fmt::format("{}: {}; expected {}", source, what, maze_usage));
  };
  const auto read = [&]<class T>(std::string_view text, std::string_view name, T& number) {
    const auto value = scene_text::number_in_full<T>(text);
    if (!value) {
      fail(fmt::format("{} must be {} (found: {})", name,
                       std::is_integral_v<T> ? "a whole number that is not negative" : "a number", text));
    }
    number = *value;
  };
  const auto read_side = [&](std::string_view text, std::string_view name, std::uint32_t& side) {
    std::uint64_t value = 0;
    read(text, name, value);
    if (value < 1 || value > most_cells) fail(fmt::format("{} must be at least 1 and below 2^32", name));
    side = static_cast<std::uint32_t>(value);
  };
  std::string_view rest = source.substr(maze_prefix.size());
  std::string_view cols = cut(rest, ',');
  if (cols.find('x') == std::string_view::npos) fail("the size is missing");
  MazeOptions options;
  read_side(cut(cols, 'x'), "ROWS", options.rows);
  read_side(cols, "COLS", options.cols);
  std::set<std::string_view> seen;
  while (!rest.empty()) {
    std::string_view value = cut(rest, ',');
    const std::string_view key = cut(value, '=');
    if (!seen.insert(key).second) fail(fmt::format("`{}` stands twice", key));
    if (key == "seed") {
      read(value, "seed", options.seed);
    } else if (key == "loops") {
      read(value, "loops", options.loops);
      if (!(options.loops >= 0.0 && options.loops <= 1.0)) fail("loops must be from 0 to 1");
    } else if (key == "algorithm") {
      try {
        options.algorithm = maze_algorithm_named(value);
      } catch (const InputError& error) {
        throw UsageError(fmt::format("{}: {}", source, error.what()));
      }
    } else {
      fail(fmt::format("unknown key `{}`", key));
    }
  }
  if (source.ends_with(',')) fail("nothing follows the last comma");
  const bool is_held = options.algorithm != MazeAlgorithm::mst;
  if (is_held && std::uint64_t{options.rows} * options.cols > most_cells)
    fail("ROWS x COLS must be below 2^32 (of the algorithm mst it may be more)");
  return options;
}

Scene read_scene(const InputFile& file, const Execution& execution, MapServerRules rules, MoveItFrames* frames) {
  if (file.bytes().starts_with(roadmap_begin)) {
    throw InputError(file.name(), "is a roadmap where a world is expected; ask it by `warren query`");
  }
  Scene scene = read_unchecked(file, execution, rules, frames);
  check_polygons(scene, execution);
  read_masks(scene.prices, execution);
  return scene;
}

Scene read_world(const std::string& source, const Execution& execution, MapServerRules rules) {
  if (!is_made_source(source)) return read_scene(InputFile(source, execution), execution, rules);
  Scene scene = is_maze_source(source) ? maze_scene(parse_maze_source(source), false, execution) : empty_world(source);
  scene.source = source;
  return scene;
}

std::vector<std::string_view> parts_left_out(const Scene& scene, std::string_view path, const OccupancyMap* becomes) {
  const bool is_geojson = path.ends_with(".geojson");
  const bool is_cells = path.ends_with(".npy") || path.ends_with(".maze");
  const bool is_map = is_map_ending(path) || path.ends_with(".png");
  const bool is_yaml = path.ends_with(".yaml");
  std::vector<std::string_view> lost;
  const auto lose = [&](bool is_there, std::string_view part) {
    if (is_there) lost.push_back(part);
  };
  if (is_geojson || is_cells || is_map || path.ends_with(".wkt")) {
    const bool keeps_ends = is_geojson || (is_cells && scene.maze);
    lose(scene.bounds && path.ends_with(".wkt"), "bounds");
    lose(scene.named_start || (!scene.start.empty() && !keeps_ends), "start");
    lose(!scene.named_goals.empty() || scene.goal_pose || (!scene.goal.empty() && !keeps_ends), "goal");
    lose(scene.robot || scene.arm, "robot");
    lose(scene.clearance.has_value(), "clearance");
    lose(scene.grid.has_value(), "grid");
    lose(!scene.other_goals.empty() && keeps_ends, "other goals");
    lose(!scene.prices.empty(), "prices and areas");
  }
  lose(is_map && has_solids(scene), "solids");
  const OccupancyMap* const map = scene.map ? &*scene.map : becomes;
  if (map == nullptr) return lost;
  lose(is_map && !is_yaml && map->cell != 1.0, "resolution");
  lose(is_map && !is_yaml && !(map->origin == Vec2{}), "origin");
  lose(is_map && !is_yaml && map->yaw_rad != 0.0, "yaw");
  lose(!is_yaml && map->unknown_count > 0, "unknown cells");
  lose(!path.ends_with(".map") && !map->water.empty(), "water");
  return lost;
}

void write_scene(const Scene& scene, const std::string& path, const Execution& execution) {
  const std::string_view name = path;
  if (name.ends_with(".npy")) return write_npy(scene, path, execution);
  if (name.ends_with(".maze")) return write_maze_file(scene, path, execution);
  if (name.ends_with(".geojson")) return write_geojson(scene, path, execution);
  if (name.ends_with(".wkt")) return write_wkt(scene, path, execution);
  if (name != "-" && !name.starts_with("/dev/") && !name.ends_with(".walls") && !name.ends_with(".scene") &&
      !name.ends_with(".txt")) {
    throw UsageError(path + ": the ending must be .walls, .scene, .txt, .npy, .maze, .geojson or .wkt");
  }
  write_scene_text(scene, path, execution);
}

bool is_map_ending(std::string_view path) {
  return path.ends_with(".map") || path.ends_with(".yaml") || path.ends_with(".pgm");
}

void write_map(const OccupancyMap& map, const std::string& path, const Execution& execution) {
  const std::string_view name = path;
  if (name.ends_with(".map")) return write_moving_ai_map(map, path, execution);
  if (name.ends_with(".yaml")) return write_ros_map(map, path, execution);
  if (name.ends_with(".pgm")) return write_map_pgm(map, path, UnknownCells::black, execution);
  if (name.ends_with(".png")) return write_map_png(map, path, execution);
  throw UsageError(path + ": the ending must be .map, .yaml, .pgm or .png");
}

}  // namespace warren
