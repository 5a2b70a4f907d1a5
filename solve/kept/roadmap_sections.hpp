// SPDX-License-Identifier: BSD-3-Clause
// The sections of a roadmap's file: written from what the memory has, and read back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "planners/graph/hierarchy.hpp"
#include "planners/lengths/core_graph.hpp"
#include "planners/lengths/route_index.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kept/roadmap_file.hpp"

namespace warren {

/// What has to be put together for sections, which refer to it.
struct HeldNumbers {
  std::string text = {};  ///< of the world
  RawVector<std::uint64_t> maze = {};
  RawVector<FloatWall> walls = {};  ///< where the scene has them packed and they are written one by one
  std::vector<double> seams = {};
  std::vector<double> map_place = {};
  std::vector<std::uint64_t> map_size = {};
  RawVector<VertexId> to = {};  ///< of the index's arcs, 16 bytes each, as the next two
  RawVector<VertexId> middle = {};
  RawVector<double> length = {};
};

// The index of a roadmap of states in its file: an array for each number of an arc, whatever the memory has.

/// Empty where the file has none. Throws InputError where it is not whole, and Stopped.
Hierarchy read_hierarchy(const RoadmapFile& file, std::size_t vertex_count, const Execution& execution);
/// Refers to the hierarchy. Throws Stopped.
void append_hierarchy_sections(const Hierarchy& hierarchy, HeldNumbers& held, std::vector<RoadmapSection>& sections,
                               const Execution& execution);

// A lattice roadmap as sections of its file: its passages, and the arrays of its route index under their own names.

/// They live as long as the index.
void append_lattice_sections(const RouteIndex& index, std::vector<RoadmapSection>& sections);

inline bool has_lattice(const RoadmapFile& file) { return file.find("passages.right") != nullptr; }

/// Looks at the file, which must outlive it. Of a file of up to 64 MiB all is checked; of a larger one questions check
/// what they look at, and throw InputError. Throws InputError, Stopped.
std::unique_ptr<RouteIndex> read_lattice(const RoadmapFile& file, LatticeSize size, const Execution& execution);
/// Checks all of a large file's index, too. Throws InputError, Stopped.
void check_lattice(const RoadmapFile& file, const RouteIndex& index, const Execution& execution);

/// The world of a roadmap as sections of its file (docs/file_formats.md): walls as numbers or as a maze's bits, a map
/// as bits, all else as scene text, so that what is read back has the same hash as what was written. A maze's walls
/// that stand wherever its lattice has no passage are said by the lattice alone. Refers to the scene. `lattice`: of the
/// same file, or nullptr. Throws Stopped.
void append_world_sections(const Scene& scene, const LatticePassages* lattice, HeldNumbers& held,
                           std::vector<RoadmapSection>& sections, const Execution& execution);

inline bool has_world(const RoadmapFile& file) { return file.find("world.text") != nullptr; }
/// The world, but for its source and walls. Throws InputError for sections that contradict each other, Stopped.
Scene read_world_outline(const RoadmapFile& file, const Execution& execution);
/// Its walls. `lattice`: of the file, as large as the outline's maze, or nullptr. Throws as above.
WallSet read_world_walls(const RoadmapFile& file, const Scene& outline, const LatticePassages* lattice,
                         const Execution& execution);

}  // namespace warren
