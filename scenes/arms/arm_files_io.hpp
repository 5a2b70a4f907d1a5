// SPDX-License-Identifier: BSD-3-Clause
// What files say of an arm: Denavit-Hartenberg tables, URDF with its SRDF and meshes, MoveIt's scenes and requests.
// What is taken of each is said where it is read: dh_table_io.cpp, urdf_io.cpp, mesh_io.cpp, moveit_io.cpp. All that
// read throw InputError naming file and, of text, line, and Stopped.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

DhTable read_dh_table(const InputFile& file, const Execution& execution);

/// Reads a robot. Variables are the group's joints in depth-first order, children by their joints' names. Pairs are all
/// pairs of links with solids but those that the SRDF disables, those of ArmFiles::allowed, those with no moving joint
/// between, and neighbours (links joined by one joint, through links without solids, too); a carried body is no
/// neighbour. A held joint that the group moves, or that follows another one, is not held: the group or that one says
/// where it is. Throws ReadError, InputError naming file and line, Stopped.
ArmModel read_urdf(const ArmFiles& files, const Execution& execution);

/// Where the frame of a link is in that of the world.
struct LinkFrame {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< where `open` is empty
  std::string moves_with = {};                             ///< the last joint above it that can move; empty: none
  std::string open = {};                                   ///< a joint that moves it and that nobody holds; empty: none
};

struct RobotFrames {
  std::map<std::string, LinkFrame> links;  ///< by their names; the world, too, as the SRDF's virtual joint calls it
  std::string base_joint = {};             ///< the virtual joint, between the world and the root; empty: there is none
  std::string base_kind = {};              ///< its type: fixed, planar, floating
};

/// The root is where `base_pose` says, joints where `held` says, and those that mimic one where it takes them. Throws
/// ReadError, InputError naming file and line, Stopped.
RobotFrames read_robot_frames(const ArmFiles& files, const Execution& execution);

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

/// Does it look like a scene? By keys at the begin of lines, in a file that ends in .yaml or .yml anywhere.
bool is_moveit_scene(std::string_view name, std::string_view bytes);

/// A frame that stands in the world, or where a link has it that carries what the frame is of.
struct NamedFrame {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  std::string link = {};  ///< empty: none
};

/// Frames that poses in MoveIt's files stand in, beside that of the world.
struct MoveItFrames {
  std::optional<ArmFiles> robot = {};            ///< whose links have frames; none: these are refused
  std::map<std::string, NamedFrame> named = {};  ///< that a scene names: for its request, too
};

/// What joints are at is held, and the start until a request says another. Frames that it names join *frames. Throws
/// InputError naming file and line, ReadError for the robot's files, Stopped.
Scene read_moveit_scene(const InputFile& file, const Execution& execution, MoveItFrames* frames = nullptr);

/// Start and goal of the scene become those of the request, and so do group, tool and held joints, in the world's line
/// of the robot, too; the group only where that has an SRDF. What the request attaches takes the place of what had its
/// id. Without a robot in `frames` that of the world's line counts. Throws as above.
void take_moveit_request(Scene& scene, const InputFile& file, const Execution& execution, MoveItFrames frames = {});

}  // namespace warren
