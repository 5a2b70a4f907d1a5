// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <warren/warren.hpp>

int main() {
  const warren::Scene maze = warren::read_world("maze:21x31,seed=7");  // or a file of any format
  const warren::Answer answer = warren::solve(maze, {.clearance = 0.2}, {.optimise = true}, {.threads = 2});
  const warren::Verdict verdict = warren::verify(maze, answer);  // solve() has done it; anybody may again
  std::cout << answer.planner << ": length " << verdict.length << ", off the walls " << verdict.min_clearance << '\n';
  warren::write_picture("maze.svg", maze, answer);
  return verdict.verified ? 0 : 1;
}
