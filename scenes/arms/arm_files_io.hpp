// SPDX-License-Identifier: BSD-3-Clause
// What files say of an arm: Denavit-Hartenberg tables, URDF with its SRDF and meshes, MoveIt's scenes and requests,
// solids. What is taken of each is said where it is read: dh_table_io.cpp, urdf_io.cpp, mesh_io.cpp, moveit_io.cpp,
// solid_text.cpp. All that read throw InputError naming file and, of text, line, and Stopped.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

DhTable read_dh_table(const InputFile& file, const Execution& execution);

/// Reads a robot. Variables are the group's joints in depth-first order, children by their joints' names. Pairs are all
/// pairs of links with solids but those that the SRDF disables, those of ArmFiles::allowed, those with no moving joint
/// between, and neighbours (links joined by one joint, through links without solids, too); a carried body is no
/// neighbour. A held joint that the group moves, or that follows another one, is not held: the group or that one says
/// where it is. Throws ReadError, InputError naming file and line, Stopped.
ArmModel read_urdf(const ArmFiles& files, const Execution& execution);
/// The same of a URDF that is open already.
ArmModel read_urdf(const ArmFiles& files, const InputFile& urdf, const Execution& execution);

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

// Solids as lines of a scene say them: a word and numbers. The same words in scenes, behind `attach`, in Python; what
// other formats say of solids becomes these numbers first, so that it is written and read again without a change.

/// What a line of a solid begins with.
struct SolidWord {
  std::string_view name;
  std::string_view usage;
  std::size_t numbers;  ///< behind it; 0: any number of threes
};

inline constexpr std::array<SolidWord, 6> solid_words = {{
    {"sphere", "sphere X Y Z R", 4},
    {"box", "box X1 Y1 Z1 X2 Y2 Z2", 6},
    {"obox", "obox X Y Z QX QY QZ QW HX HY HZ", 10},
    {"cylinder", "cylinder X1 Y1 Z1 X2 Y2 Z2 R", 7},
    {"capsule", "capsule X1 Y1 Z1 X2 Y2 Z2 R", 7},
    {"hull", "hull X Y Z X Y Z ...", 0},
}};

/// nullptr: no such word.
const SolidWord* solid_word_named(std::string_view name);

/// The solid of these numbers, whose count is right. Throws InputError naming the place: a negative size, a cylinder
/// without length, a quaternion of zeros, a hull as convex_hull() says. Throws Stopped.
Solid solid_of_numbers(const SolidWord& word, std::span<const double> numbers, const scene_text::Place& place,
                       const Execution& execution);

/// Reads the numbers behind the word, to the line's end or, where it may have a name, to an `as`. Throws InputError,
/// Stopped.
Solid read_solid(const SolidWord& word, scene_text::Fields& fields, const Execution& execution,
                 bool may_have_name = false);

/// Its line, which reads back as the same solid where it was read; else to the last digits.
std::string solid_text(const Solid& solid);

/// Of seven numbers: x, y, z, and a quaternion that is not zero; it need not be of length 1.
Eigen::Isometry3d pose_of_numbers(std::span<const double> numbers);
/// x, y, z, w of a turn.
std::array<double, 4> quaternion_of_turn(const Eigen::Matrix3d& turn);

}  // namespace warren
