// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/kept/lattice_roadmap.hpp"

namespace warren {
namespace {

constexpr std::size_t arc_grain = std::size_t{1} << 16;

/// Elements of other widths are bytes.
ElementType type_of(std::size_t bytes) {
  return bytes == 2   ? element_type<std::uint16_t>()
         : bytes == 4 ? element_type<std::uint32_t>()
         : bytes == 8 ? element_type<std::uint64_t>()
                      : element_type<std::byte>();
}

/// What call() gives; its failures name the file.
template <class Call>
auto named_by(const RoadmapFile& file, const Call& call) {
  try {
    return call();
  } catch (const InputError& error) {
    throw InputError(file.name(), error.what());
  }
}

constexpr std::size_t wall_grain = std::size_t{1} << 16;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

void add_point(std::vector<double>& numbers, const std::optional<Vec2>& point) {
  numbers.push_back(point ? point->x : none);
  numbers.push_back(point ? point->y : none);
}

std::optional<Vec2> point_of(double x, double y) { return x == x && y == y ? std::optional(Vec2{x, y}) : std::nullopt; }

template <class Wall, class T>
WallSet walls_as(std::span<const T> numbers, const Execution& execution) {
  execution.reserve(numbers.size() / 4 * sizeof(Wall));
  RawVector<Wall> walls(numbers.size() / 4);
  for_each_index(walls.size(), wall_grain, execution, [&](std::size_t i) {
    const T* const x = &numbers[4 * i];
    if constexpr (std::is_same_v<Wall, PackedWall>) {
      walls[i] = PackedWall::of(x[0], x[1], x[2], x[3]);
    } else {
      walls[i] = {x[0], x[1], x[2], x[3]};
    }
  });
  return WallSet(std::move(walls));
}

template <class T>
bool can_be_packed(std::span<const T> numbers, const Execution& execution) {
  const std::size_t count = numbers.size() / 4;
  return count == first_that(count, wall_grain, execution, [&](std::size_t i) {
           const T* const x = &numbers[4 * i];
           return !PackedWall::fits(x[0], x[1], x[2], x[3]);
         });
}

[[noreturn]] void refuse(const RoadmapFile& file, std::string_view section, std::string_view what) {
  throw InputError(fmt::format("{}: section {}", file.name(), section), what);
}

/// Coordinates as the readers of worlds take them.
template <class T>
void check_walls(const RoadmapFile& file, std::string_view section, std::span<const T> numbers,
                 const Execution& execution) {
  if (numbers.size() % 4 != 0) refuse(file, section, "expected four numbers a wall");
  const auto is_wrong = [&](std::size_t i) { return !is_coordinate(numbers[i]); };
  if (first_that(numbers.size(), wall_grain, execution, is_wrong) == numbers.size()) return;
  refuse(file, section, "expected numbers of at most 1e60");
}

template <class T>
WallSet read_walls(const RoadmapFile& file, const Execution& execution) {
  const auto numbers = file.section<T>("world.walls", execution);
  check_walls(file, "world.walls", numbers, execution);
  return std::is_same_v<T, float> && can_be_packed(numbers, execution) ? walls_as<PackedWall>(numbers, execution)
                                                                       : walls_as<WallOf<T>>(numbers, execution);
}

Bitmap read_bits(const RoadmapFile& file, std::string_view name, std::uint32_t width, std::uint32_t height,
                 const Execution& execution) {
  const auto words = file.optional_section<std::uint64_t>(name, execution);
  if (!words) return {};
  Bitmap bits = cell_bitmap(width, height, execution);
  if (words->size() != bits.words().size()) refuse(file, name, "expected a bit for each cell of the map");
  const std::size_t stride = height == 0 ? 0 : words->size() / height;
  for (std::uint32_t y = 0; y < height; ++y) {
    execution.check();
    std::copy_n(words->begin() + static_cast<std::ptrdiff_t>(y * stride), stride, bits.row(y).begin());
    if (width % Bitmap::word_bits == 0) continue;
    if (bits.row(y).back() >> (width % Bitmap::word_bits) != 0) refuse(file, name, "expected zeros beyond each row");
  }
  return bits;
}

OccupancyMap read_map(const RoadmapFile& file, const Execution& execution) {
  const auto place = file.section<double>("map.place", execution);
  const auto size = file.section<std::uint64_t>("map.size", execution);
  if (place.size() != 8 || size.size() != 7 || size[2] > 2) refuse(file, "map.size", "expected a map's numbers");
  check_map_size(fmt::format("{}: section map.size", file.name()), size[0], size[1]);
  OccupancyMap map;
  map.format = static_cast<MapFormat>(size[2]);
  const auto width = static_cast<std::uint32_t>(size[0]);
  const auto height = static_cast<std::uint32_t>(size[1]);
  map.blocked = read_bits(file, "map.blocked", width, height, execution);
  if (map.blocked.empty()) refuse(file, "map.blocked", "expected a bit for each cell of the map");
  map.unknown = read_bits(file, "map.unknown", width, height, execution);
  map.water = read_bits(file, "map.water", width, height, execution);
  map.free = size[3];
  map.occupied = size[4];
  map.unknown_count = size[5];
  map.between = size[6];
  if (!(place[0] > 0.0) || !std::all_of(place.begin(), place.begin() + 4, is_coordinate)) {
    refuse(file, "map.place", "expected a cell above 0 and numbers of at most 1e60");
  }
  map.cell = place[0];
  map.origin = {place[1], place[2]};
  map.yaw_rad = place[3];
  map.start = point_of(place[4], place[5]);
  map.goal = point_of(place[6], place[7]);
  return map;
}

/// One by one, but for those of a maze.
void append_walls(const Scene& scene, HeldNumbers& held, std::vector<RoadmapSection>& sections,
                  const Execution& execution) {
  if (auto bits = maze_bits(scene, execution)) {
    held.maze = std::move(*bits);
    return sections.push_back(roadmap_section("maze.walls", held.maze));
  }
  const auto append = [&]<class T>(std::span<const WallOf<T>> walls) {
    const T* const numbers = walls.empty() ? nullptr : &walls.front().x1;
    sections.push_back(roadmap_section("world.walls", std::span<const T>(numbers, 4 * walls.size())));
  };
  scene.walls.visit([&](auto walls) {
    if constexpr (std::is_same_v<decltype(walls), std::span<const PackedWall>>) {
      execution.reserve(walls.size() * sizeof(FloatWall));
      held.walls.resize(walls.size());
      for_each_index(walls.size(), wall_grain, execution, [&](std::size_t i) { held.walls[i] = unpacked(walls[i]); });
      append(std::span<const FloatWall>(held.walls));
    } else {
      append(walls);
    }
  });
}

}  // namespace

Hierarchy read_hierarchy(const RoadmapFile& file, std::size_t vertex_count, const Execution& execution) {
  if (file.find("up.first") == nullptr) return {};
  const auto first = file.section<EdgeEnd>("up.first", execution);
  const auto to = file.section<VertexId>("up.to", execution);
  const auto middle = file.section<VertexId>("up.middle", execution);
  const auto length = file.section<double>("up.length", execution);
  if (middle.size() != to.size() || length.size() != to.size()) {
    throw InputError(file.name(), "its index contradicts itself; build it anew", "up.middle, up.length");
  }
  execution.reserve(first.size_bytes() + to.size() * sizeof(HierarchyArc));
  Hierarchy hierarchy{.first = {first.begin(), first.end()}, .arcs = {}};
  hierarchy.arcs.resize(to.size());
  for_each_index(to.size(), arc_grain, execution, [&](std::size_t i) {
    hierarchy.arcs[i] = {to[i], middle[i], length[i]};
  });
  check_hierarchy(hierarchy, vertex_count, file.name(), execution);
  return hierarchy;
}

void append_hierarchy_sections(const Hierarchy& hierarchy, HeldNumbers& held, std::vector<RoadmapSection>& sections,
                               const Execution& execution) {
  if (hierarchy.empty()) return;
  const std::size_t arcs = hierarchy.arcs.size();
  execution.reserve(arcs * sizeof(HierarchyArc));
  held.to.resize(arcs);
  held.middle.resize(arcs);
  held.length.resize(arcs);
  for_each_index(arcs, arc_grain, execution, [&](std::size_t i) {
    held.to[i] = hierarchy.arcs[i].to;
    held.middle[i] = hierarchy.arcs[i].middle;
    held.length[i] = hierarchy.arcs[i].length;
  });
  sections.push_back(roadmap_section("up.first", hierarchy.first, true));
  sections.push_back(roadmap_section("up.to", held.to, true));
  sections.push_back(roadmap_section("up.middle", held.middle, true));
  sections.push_back(roadmap_section("up.length", held.length, true));
}

void append_lattice_sections(const RouteIndex& index, std::vector<RoadmapSection>& sections) {
  for (const RouteSection& s : route_sections(index)) sections.push_back({s.name, type_of(s.element_bytes), s.bytes});
}

std::unique_ptr<RouteIndex> read_lattice(const RoadmapFile& file, LatticeSize size, const Execution& execution) {
  std::vector<RouteSection> sections = route_section_kinds();
  for (RouteSection& section : sections) {
    const SectionPlace* place = file.find(section.name);
    if (place == nullptr || place->type != type_of(section.element_bytes)) {
      throw InputError(file.name(), "a section of its index is missing or of another type", section.name);
    }
    section.bytes = file.unchecked_bytes(*place);
    section.first_look = file.first_look(*place);
    if (!is_read_in_parts(section.name)) file.check_section(*place, execution);
  }
  return named_by(file, [&] {
    LatticePassages::check_size(size);
    auto index = std::make_unique<RouteIndex>(route_index_of(size, sections));
    if (file.is_small()) check_route_arrays(index->places(), index->arrays());
    return index;
  });
}

void check_lattice(const RoadmapFile& file, const RouteIndex& index, const Execution& execution) {
  file.check_all(execution);
  named_by(file, [&] { check_route_arrays(index.places(), index.arrays()); });
}

void append_world_sections(const Scene& scene, const LatticePassages* lattice, HeldNumbers& held,
                           std::vector<RoadmapSection>& sections, const Execution& execution) {
  write_scene_text(
      without_arrays(scene), [&](std::string_view text) { held.text.append(text); }, execution);
  sections.push_back(roadmap_section("world.text", held.text));
  if (lattice == nullptr || !has_walls_of(*lattice, scene, execution)) append_walls(scene, held, sections, execution);
  for (const Segment& s : scene.seams) held.seams.insert(held.seams.end(), {s.a.x, s.a.y, s.b.x, s.b.y});
  sections.push_back(roadmap_section("world.seams", held.seams));
  if (!scene.map) return;
  const OccupancyMap& map = *scene.map;
  held.map_place = {map.cell, map.origin.x, map.origin.y, map.yaw_rad};
  add_point(held.map_place, map.start);
  add_point(held.map_place, map.goal);
  held.map_size = {map.width(),       map.height(), static_cast<std::uint64_t>(map.format), map.free, map.occupied,
                   map.unknown_count, map.between};
  sections.push_back(roadmap_section("map.place", held.map_place));
  sections.push_back(roadmap_section("map.size", held.map_size));
  sections.push_back(roadmap_section("map.blocked", map.blocked.words()));
  if (!map.unknown.empty()) sections.push_back(roadmap_section("map.unknown", map.unknown.words()));
  if (!map.water.empty()) sections.push_back(roadmap_section("map.water", map.water.words()));
}

Scene read_world_outline(const RoadmapFile& file, const Execution& execution) {
  const auto text = file.section<std::byte>("world.text", execution);
  const std::string_view words(reinterpret_cast<const char*>(text.data()), text.size());
  Scene scene;
  if (!words.empty()) {
    scene = read_scene_text(InputFile::of_bytes(file.name() + ": section world.text", words), execution);
  }
  if (scene.walls.size() != 0) refuse(file, "world.text", "expected walls in section world.walls alone");
  if (const auto seams = file.optional_section<double>("world.seams", execution)) {
    check_walls(file, "world.seams", *seams, execution);
    for (std::size_t i = 0; i + 3 < seams->size(); i += 4) {
      scene.seams.push_back({{(*seams)[i], (*seams)[i + 1]}, {(*seams)[i + 2], (*seams)[i + 3]}});
    }
  }
  if (file.find("map.size") != nullptr) scene.map = read_map(file, execution);
  return scene;
}

WallSet read_world_walls(const RoadmapFile& file, const Scene& outline, const LatticePassages* lattice,
                         const Execution& execution) {
  if (outline.maze && file.find("maze.walls") != nullptr) {
    return walls_of_maze_bits(file.name() + ": section maze.walls", *outline.maze,
                              file.section<std::uint64_t>("maze.walls", execution), execution);
  }
  const SectionPlace* walls = file.find("world.walls");
  if (walls == nullptr && outline.maze && lattice != nullptr) return walls_of_lattice(*lattice, execution);
  if (walls == nullptr) refuse(file, "world.walls", "expected the walls of the world");
  return walls->type == element_type<float>() ? read_walls<float>(file, execution)
                                              : read_walls<double>(file, execution);
}

}  // namespace warren
