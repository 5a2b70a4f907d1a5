// SPDX-License-Identifier: BSD-3-Clause
// The index of a roadmap of states in its file: an array for each number of an arc, whatever the memory has.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "planners/graph/hierarchy.hpp"
#include "planners/lengths/lattice_passages.hpp"
#include "planners/lengths/route_index.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kept/roadmap_file.hpp"

namespace warren {

/// Empty where the file has none. Throws InputError where it is not whole, and Stopped.
Hierarchy read_hierarchy(const RoadmapFile& file, std::size_t vertex_count, const Execution& execution);

/// Refers to the hierarchy; what is written lives as long as this: 16 bytes an arc.
class HierarchySections {
 public:
  /// Throws Stopped.
  HierarchySections(const Hierarchy& hierarchy, const Execution& execution);
  void append_to(std::vector<RoadmapSection>& sections) const;

 private:
  const Hierarchy& hierarchy_;
  RawVector<VertexId> to_;
  RawVector<VertexId> middle_;
  RawVector<double> length_;
};

// A lattice roadmap as sections of its file: its passages, and the arrays of its route index under their own names.

/// They live as long as the index.
void append_lattice_sections(const RouteIndex& index, std::vector<RoadmapSection>& sections);

inline bool has_lattice(const RoadmapFile& file) { return file.find("passages.right") != nullptr; }
/// Is it one of their names?
bool is_lattice_section(std::string_view name);

/// Looks at the file, which must outlive it. Of a file of up to 64 MiB all is checked; of a larger one questions check
/// what they look at, and throw InputError. Throws InputError, Stopped.
std::unique_ptr<RouteIndex> read_lattice(const RoadmapFile& file, LatticeSize size, const Execution& execution);
/// Checks all of a large file's index, too. Throws InputError, Stopped.
void check_lattice(const RoadmapFile& file, const RouteIndex& index, const Execution& execution);

/// The world of a roadmap as sections of its file (docs/file_formats.md): walls as numbers or as a maze's bits, a map
/// as bits, all else as scene text, so that what is read back has the same hash as what was written. A maze's walls
/// that stand wherever its lattice has no passage are said by the lattice alone. Refers to the scene; holds what has to
/// be put together.
class WorldSections {
 public:
  /// `lattice`: of the same file, or nullptr. Throws Stopped.
  WorldSections(const Scene& scene, const LatticePassages* lattice, const Execution& execution);
  WorldSections(const WorldSections&) = delete;
  WorldSections& operator=(const WorldSections&) = delete;

  void append_to(std::vector<RoadmapSection>& sections) const;

 private:
  void unpack_walls(const Execution& execution);
  void append_walls(std::vector<RoadmapSection>& sections) const;

  const Scene& scene_;
  std::string text_;
  bool in_lattice_ = false;  // the walls are
  std::optional<RawVector<std::uint64_t>> maze_;
  RawVector<FloatWall> unpacked_;  // the walls, where the scene has them packed and they are written one by one
  RawVector<double> seams_;
  std::vector<double> map_place_;
  std::vector<std::uint64_t> map_size_;
};

/// The names that WorldSections gives its sections.
inline constexpr std::array world_section_names{
    std::string_view("world.text"),  std::string_view("maze.walls"),  std::string_view("world.walls"),
    std::string_view("world.seams"), std::string_view("map.place"),   std::string_view("map.size"),
    std::string_view("map.blocked"), std::string_view("map.unknown"), std::string_view("map.water")};

/// Is there a world in the file?
inline bool has_world(const RoadmapFile& file) { return file.find("world.text") != nullptr; }
/// The world, but for its source and walls. Throws InputError for sections that contradict each other, Stopped.
Scene read_world_outline(const RoadmapFile& file, const Execution& execution);
/// Its walls. `lattice`: of the file, as large as the outline's maze, or nullptr. Throws as above.
WallSet read_world_walls(const RoadmapFile& file, const Scene& outline, const LatticePassages* lattice,
                         const Execution& execution);

}  // namespace warren
