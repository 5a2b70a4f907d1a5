// SPDX-License-Identifier: BSD-3-Clause
// What is no world: arms' tables, answers, bodies, names of mazes.
#include <array>
#include <cmath>

#include "core/base/types.hpp"
#include "scenes/files/dh_table_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/question/question.hpp"
#include "tests/fuzz/fuzz_reader.hpp"
#include "tests/fuzz/properties.hpp"

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
    FuzzReader{"dh_table", read_dh_tables},
    FuzzReader{"answer", read_answers},
    FuzzReader{"body", read_bodies},
    FuzzReader{"maze_name", read_maze_names},
};

}  // namespace

std::span<const FuzzReader> record_readers() { return record_table; }

}  // namespace warren::fuzz
