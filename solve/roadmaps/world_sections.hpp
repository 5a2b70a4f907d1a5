// SPDX-License-Identifier: BSD-3-Clause
// The world of a roadmap as sections of its file (docs/file_formats.md): walls as numbers or as a maze's bits, a map as
// bits, all else as scene text, so that what is read back has the same hash as what was written. A maze's walls that
// stand wherever its lattice has no passage are said by the lattice alone.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "planners/lengths/lattice_passages.hpp"
#include "roadmaps/file/roadmap_file.hpp"
#include "roadmaps/file/write_roadmap_file.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Refers to the scene; holds what has to be put together.
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
bool has_world(const RoadmapFile& file);
/// The world, but for its source and walls. Throws InputError for sections that contradict each other, Stopped.
Scene read_world_outline(const RoadmapFile& file, const Execution& execution);
/// Its walls. `lattice`: of the file, as large as the outline's maze, or nullptr. Throws as above.
WallSet read_world_walls(const RoadmapFile& file, const Scene& outline, const LatticePassages* lattice,
                         const Execution& execution);

}  // namespace warren
