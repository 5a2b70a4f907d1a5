// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/roadmap_file_io.hpp"

#include <fmt/format.h>

#include <charconv>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "roadmaps/file/checksum.hpp"
#include "roadmaps/file/write_roadmap_file.hpp"
#include "solve/question/plannable.hpp"
#include "solve/roadmaps/hierarchy_sections.hpp"
#include "solve/roadmaps/lattice_sections.hpp"
#include "solve/roadmaps/roadmap_meta_io.hpp"
#include "solve/roadmaps/world_sections.hpp"
#include "solve/steps/kind_of_problem.hpp"

namespace warren {
namespace {

constexpr std::array graph_section_names{std::string_view("meta"),       std::string_view("states"),
                                         std::string_view("edge.first"), std::string_view("edge.to"),
                                         std::string_view("edge.state"), std::string_view("component"),
                                         std::string_view("up.first"),   std::string_view("up.to"),
                                         std::string_view("up.middle"),  std::string_view("up.length")};
constexpr std::size_t longest_meta = std::size_t{1} << 20;

std::uint64_t hash_number(std::string_view digits) {
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  return number;
}

std::uint64_t hash_of(std::string_view text) { return checksum(std::as_bytes(std::span(text))); }

void refuse_unknown_sections(const RoadmapFile& file) {
  std::vector<std::string_view> known(graph_section_names.begin(), graph_section_names.end());
  known.insert(known.end(), world_section_names.begin(), world_section_names.end());
  for (const SectionPlace& place : file.sections()) {
    if (is_lattice_section(place.name)) known.push_back(place.name);
  }
  file.refuse_unknown(known);
}

template <class T>
RawVector<T> copied(std::span<const T> numbers, const Execution& execution) {
  execution.reserve(numbers.size_bytes());
  return {numbers.begin(), numbers.end()};
}

/// The file's arrays where they are, checked.
RoadmapParts checked_parts(const RoadmapFile& file, const Roadmap& roadmap, const Execution& execution) {
  const RoadmapParts parts{.dimension = roadmap.arrays.dimension,
                           .directed = roadmap.arrays.directed,
                           .states = file.section<double>("states", execution),
                           .first = file.section<EdgeEnd>("edge.first", execution),
                           .to = file.section<VertexId>("edge.to", execution),
                           .edge_states = file.section<std::uint64_t>("edge.state", execution),
                           .component = file.section<VertexId>("component", execution)};
  check_parts(parts, file.name(), execution);
  return parts;
}

RoadmapArrays read_arrays(const RoadmapFile& file, const Roadmap& roadmap, const Execution& execution) {
  const RoadmapParts parts = checked_parts(file, roadmap, execution);
  RoadmapArrays arrays;
  arrays.dimension = parts.dimension;
  arrays.directed = parts.directed;
  arrays.states = copied(parts.states, execution);
  arrays.candidates = Graph(copied(parts.first, execution), copied(parts.to, execution));
  arrays.edge_states = copied(parts.edge_states, execution);
  arrays.component = copied(parts.component, execution);
  arrays.hierarchy = read_hierarchy(file, parts.vertex_count(), execution);
  return arrays;
}

KeptWorld given_world(const RoadmapFile& file, Scene given, const std::string& hash, const Execution& execution) {
  const std::string found = scene_hash(given, execution);
  if (found == hash) return KeptWorld(std::move(given));
  throw InputError(file.name(), fmt::format("was built for the world {}, and {} is another one", hash, given.source),
                   found);
}

/// The body can be in the world, and has such a roadmap there.
void check_world_of(const Scene& scene, const SolveOptions& options, const Question& question,
                    const std::string& name) {
  try {
    check_plannable(scene, question);
    if (choose_solver(options, scene, question).kind->open == nullptr) {
      throw InputError(name, "its planner keeps no roadmap of its body");
    }
  } catch (const UsageError& error) {
    throw InputError(name, error.what());
  }
}

/// The world inside. A lattice's walls are made when they are needed: what of it refers to the file and the lattice
/// lives as long as they do.
KeptWorld world_inside(const RoadmapFile& file, const Roadmap& roadmap, const Execution& execution) {
  if (!has_world(file)) {
    throw InputError(file.name(), "has no world inside; name the world that it was built for");
  }
  Scene outline = read_world_outline(file, execution);
  outline.source = roadmap.world.outline().source;
  const LatticePassages* lattice = roadmap.lattice != nullptr ? &roadmap.lattice->passages() : nullptr;
  auto make = [&file, lattice, outline, options = roadmap.options, question = roadmap.question(),
               hash = roadmap.world_hash](const Execution& on) {
    Scene scene = outline;
    scene.walls = read_world_walls(file, outline, lattice, on);
    const std::string found = scene_hash(scene, on);
    if (found != hash) throw InputError(file.name(), fmt::format("the world inside is not its own, {}", hash), found);
    check_world_of(scene, options, question, file.name());
    return scene;
  };
  if (lattice == nullptr) return KeptWorld(make(execution));
  KeptWorld::LookUp look_up;
  if (walls_are_passages(file, outline)) {
    look_up = [&file, maze = *outline.maze, hash = roadmap.world_hash](const Execution& on) {
      return cells_of_file(file, maze, hash, on);
    };
  }
  return {std::move(outline), std::move(make), std::move(look_up)};
}

void append_graph(const RoadmapParts& parts, std::vector<RoadmapSection>& sections) {
  sections.push_back(roadmap_section("states", parts.states));
  sections.push_back(roadmap_section("edge.first", parts.first));
  sections.push_back(roadmap_section("edge.to", parts.to));
  sections.push_back(roadmap_section("edge.state", parts.edge_states));
  sections.push_back(roadmap_section("component", parts.component));
}

LatticeSize lattice_of(const RoadmapFile& file, const Execution& execution) {
  return lattice_in_meta(fmt::format("{}: section meta", file.name()), roadmap_meta(file, execution));
}

/// All that meta says.
Roadmap described(const RoadmapFile& file, const Execution& execution) {
  refuse_unknown_sections(file);
  Roadmap roadmap;
  read_meta(fmt::format("{}: section meta", file.name()), roadmap_meta(file, execution), roadmap, execution);
  if (hash_number(roadmap.world_hash) == file.header().world_hash) return roadmap;
  throw InputError(file.name(), "header and meta name different worlds");
}

/// The lattice is that of the maze, of prm, and of a body that plans on it.
void check_lattice_of(const Roadmap& roadmap, const std::string& name) {
  const auto& maze = roadmap.world.outline().maze;
  const LatticeSize size = roadmap.lattice->passages().size();
  const bool is_round = roadmap.robot.kind == RobotKind::point || roadmap.robot.kind == RobotKind::disc;
  const bool is_its = maze && maze->rows == size.rows && maze->cols == size.cols;
  if (is_round && is_its && roadmap.options.planner == PlannerKind::prm) return;
  throw InputError(name, "its lattice is none of its world and body");
}

}  // namespace

bool is_roadmap_file(std::string_view first_bytes) { return first_bytes.starts_with(roadmap_magic); }

std::string roadmap_meta(const RoadmapFile& file, const Execution& execution) {
  const SectionPlace* place = file.find("meta");
  if (place != nullptr && place->elements > longest_meta) {
    throw InputError(fmt::format("{}: section meta", file.name()), "expected at most 1 MiB");
  }
  const auto bytes = file.section<std::byte>("meta", execution);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write_roadmap(const Roadmap& roadmap, const std::string& path, const Execution& execution, bool with_world) {
  OutputFile file(path, execution);  // first: a place that can't be written is known before the work
  write_roadmap(roadmap, file, path, execution, with_world);
  file.commit();
}

void write_roadmap(const Roadmap& roadmap, OutputFile& file, const std::string& path, const Execution& execution,
                   bool with_world) {
  if (roadmap.file != nullptr) roadmap.file->check_all(execution);  // nothing is copied that nobody looked at
  const std::string meta = meta_json(roadmap, execution);
  const RoadmapParts parts = roadmap.arrays.parts();
  const LatticePassages* lattice = roadmap.lattice != nullptr ? &roadmap.lattice->passages() : nullptr;
  std::optional<WorldSections> world;
  if (with_world) world.emplace(roadmap.world.whole(execution), lattice, execution);
  std::vector<RoadmapSection> sections{roadmap_section("meta", std::span<const char>(meta))};
  if (world) world->append_to(sections);
  roadmap.lattice != nullptr ? append_lattice_sections(*roadmap.lattice, sections) : append_graph(parts, sections);
  const HierarchySections index(roadmap.arrays.hierarchy, execution);
  index.append_to(sections);
  const RoadmapFileHeader header{.world_hash = hash_number(roadmap.world_hash),
                                 .recipe_hash = hash_of(recipe_json(roadmap, execution)),
                                 .writer = "warren " WARREN_VERSION};
  write_roadmap_file(file, path, header, sections, execution);
}

void check_roadmap(const RoadmapFile& file, const Execution& execution) {
  const Roadmap roadmap = described(file, execution);
  if (has_lattice(file)) {
    check_lattice(file, *read_lattice(file, lattice_of(file, execution), execution), execution);
  } else {
    read_hierarchy(file, checked_parts(file, roadmap, execution).vertex_count(), execution);
  }
}

Roadmap read_roadmap(const std::string& path, const Execution& execution, std::optional<Scene> world) {
  return read_roadmap(std::make_unique<RoadmapFile>(path, execution), execution, std::move(world));
}

Roadmap read_roadmap(std::unique_ptr<RoadmapFile> opened, const Execution& execution, std::optional<Scene> world) {
  const RoadmapFile& file = *opened;
  Roadmap roadmap = described(file, execution);
  if (has_lattice(file)) roadmap.lattice = read_lattice(file, lattice_of(file, execution), execution);
  roadmap.world = world ? given_world(file, std::move(*world), roadmap.world_hash, execution)
                        : world_inside(file, roadmap, execution);
  if (file.header().recipe_hash != hash_of(recipe_json(roadmap, execution))) {
    throw InputError(file.name(), "header and meta name different bodies or options");
  }
  if (roadmap.lattice == nullptr) {
    check_world_of(roadmap.world.outline(), roadmap.options, roadmap.question(), file.name());
    roadmap.arrays = read_arrays(file, roadmap, execution);
  } else {
    check_lattice_of(roadmap, file.name());
    roadmap.file = std::move(opened);
  }
  return roadmap;
}

}  // namespace warren
