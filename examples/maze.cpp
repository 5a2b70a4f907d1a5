// SPDX-License-Identifier: BSD-3-Clause
// A maze of 41 x 41 cells, solved with room to spare on both sides, and its picture.
#include <iostream>
#include <warren/warren.hpp>

int main() {
  const warren::Scene maze = warren::read_world("maze:41x41,seed=1");
  warren::ByProducts made;  // the roadmap, for the picture
  const warren::Answer answer = warren::solve(maze, {}, {.optimise = true}, {}, &made);
  std::cout << name_of(answer.outcome) << ", length " << answer.length << '\n';
  warren::write_picture("maze.svg", maze, answer, std::move(made));
  return answer.verified ? 0 : 1;
}
