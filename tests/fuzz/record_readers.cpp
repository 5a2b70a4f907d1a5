// SPDX-License-Identifier: BSD-3-Clause
// What is no world: arms' tables and files, meshes, answers, bodies, names of mazes.
#include <array>
#include <cmath>

#include "core/base/types.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/scene/convex_hull.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/question/question.hpp"
#include "tests/fuzz/fuzz_reader.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace warren::fuzz {
namespace {

void read_dh_tables(std::string_view bytes) {
  const auto table =
      read_or_refuse([&] { return read_dh_table(InputFile::of_bytes("fuzzed", bytes), fuzz_execution()); });
  if (!table) return;
  demand(!table->joints.empty() && table->joints.size() <= most_chain_joints, "one to six joints");
  for (const DhJoint& joint : table->joints) {
    demand(joint.low_rad <= joint.high_rad, "limits in order");
    for (const double number : {joint.alpha_rad, joint.low_rad, joint.high_rad, joint.offset_rad})
      demand(std::isfinite(number), "finite numbers");
  }
}

void read_urdfs(std::string_view bytes) {
  const ArmFiles files{write_scratch("fuzzed.urdf", bytes)};
  const auto model = read_or_refuse([&] { return read_urdf(files, fuzz_execution()); });
  if (!model) return;
  demand(!model->variables.empty() && model->variables.size() <= most_joints, "one to fourteen variables");
  for (const ArmVariable& variable : model->variables)
    demand(std::isfinite(variable.low) && variable.low <= variable.high, "limits in order");
  for (std::size_t j = 0; j < model->joints.size(); ++j)
    demand(model->joints[j].parent < static_cast<int>(j) && model->joints[j].variable < model->variables.size(),
           "parents first");
  for (const auto& [a, b] : model->pairs) demand(a < b && b < model->links.size(), "pairs of links");
}

/// A mesh whose file ends so, and its hull.
void read_mesh_as(const char* name, std::string_view bytes) {
  const auto mesh = read_or_refuse([&] { return read_mesh(InputFile::of_bytes(name, bytes), fuzz_execution()); });
  if (!mesh) return;
  for (const auto& triangle : mesh->triangles)
    for (const std::uint32_t corner : triangle) demand(corner < mesh->points.size(), "triangles of points");
  const auto hull = read_or_refuse([&] { return convex_hull(mesh->points, name, fuzz_execution()); });
  if (hull) demand(!hull->corners.empty(), "a hull has corners");
}
void read_objs(std::string_view bytes) { read_mesh_as("fuzzed.obj", bytes); }
void read_stls(std::string_view bytes) { read_mesh_as("fuzzed.stl", bytes); }
void read_daes(std::string_view bytes) { read_mesh_as("fuzzed.dae", bytes); }

/// Its path is one that a judge can walk: as many states as points, of one width, all finite.
void read_answers(std::string_view bytes) {
  const auto answer =
      read_or_refuse([&] { return read_answer(InputFile::of_bytes("fuzzed", bytes), fuzz_execution()); });
  if (!answer) return;
  demand(!answer->path.empty(), "a path has points");
  const std::size_t width = answer->state_width();
  demand(width >= 2 && width <= most_joints, "two to fourteen numbers a state");
  demand(width == 2 || answer->states.size() == answer->path.size(), "a state a point");
  for (const Vec2 p : answer->path)
    demand(std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate, "finite points");
  if (answer->problem.clearance) demand(*answer->problem.clearance >= 0.0, "a clearance is not negative");
}

/// A body in words, and again from the words that the program writes for it.
void read_bodies(std::string_view bytes) {
  const auto robot = read_or_refuse([&] { return robot_value("fuzzed", bytes); });
  if (robot) demand_same_robot(*robot, robot_value("again", robot_text(*robot)));
}

void read_maze_names(std::string_view bytes) {
  const std::string name = "maze:" + std::string{bytes};
  const auto maze = read_or_refuse([&] { return parse_maze_source(name); });
  if (!maze) return;
  demand(maze->rows >= 1 && maze->cols >= 1 && std::uint64_t{maze->rows} * maze->cols < std::uint64_t{1} << 32,
         "a maze of less than 2^32 cells");
  demand(maze->loops >= 0.0 && maze->loops <= 1.0, "a fraction");
  constexpr std::uint64_t small = 256;
  if (std::uint64_t{maze->rows} * maze->cols > small) return;
  const Scene scene = maze_scene(*maze, false, fuzz_execution());
  demand(scene.maze == MazeHint{maze->rows, maze->cols}, "a maze of that size");
  demand(!first_wall_off_grid(scene.walls, *scene.maze, fuzz_execution()), "walls on the grid");
}

constexpr std::array record_table{
    FuzzReader{"dh_table", read_dh_tables}, FuzzReader{"urdf", read_urdfs},
    FuzzReader{"mesh_obj", read_objs},      FuzzReader{"mesh_stl", read_stls},
    FuzzReader{"mesh_dae", read_daes},      FuzzReader{"answer", read_answers},
    FuzzReader{"body", read_bodies},        FuzzReader{"maze_name", read_maze_names},
};

}  // namespace

std::span<const FuzzReader> record_readers() { return record_table; }

}  // namespace warren::fuzz
