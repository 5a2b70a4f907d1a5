// SPDX-License-Identifier: BSD-3-Clause
// Meshes: Wavefront OBJ, STL (binary or text), COLLADA. Only where their surface is counts: normals, colours and the
// like are passed over.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Triangles and their corners, each point once, in the order of their coordinates; those of no triangle are left out,
/// but where there are no triangles at all.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// In metres along each axis: beyond, doubles leave planner and judge too few digits to agree.
inline constexpr double farthest_mesh_point = 1e5;

/// By the ending of the file's name, .obj, .stl or .dae. COLLADA: all that its scene shows, in metres by its <unit>;
/// its <up_axis> turns nothing, as in RViz and MoveIt. Throws InputError naming file and, of text, line, at a point
/// that is farther than farthest_mesh_point, scaled, too; Stopped.
Mesh read_mesh(const InputFile& file, const Execution& execution, const Vec3& scale = Vec3::Ones());

/// Where the mesh that a URDF calls `name` may be, in this order.
std::vector<std::string> mesh_places(const std::string& name, const ArmFiles& files);

/// What the mesh's hull has more than the mesh: "1.32 times its volume", where the mesh is closed.
std::string hull_excess(const Mesh& mesh, const Solid& hull, const Execution& execution);

}  // namespace warren
