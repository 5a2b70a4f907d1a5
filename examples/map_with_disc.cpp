// SPDX-License-Identifier: BSD-3-Clause
// A robot 40 cm wide on a map of three rooms, as map_server has it: from room to room, 5 cm off all that is blocked.
#include <iostream>
#include <warren/warren.hpp>

int main(int argc, char** argv) {
  const warren::Scene flat = warren::read_world(argc > 1 ? argv[1] : "flat.yaml");
  const warren::RobotSpec robot{.kind = warren::RobotKind::disc, .radius = 0.2};
  const warren::Question question{.robot = robot, .start = {0.5, 0.5}, .goal = {4.3, 0.5}, .clearance = 0.05};
  const warren::Answer answer = warren::solve(flat, question, {.optimise = true});
  for (const warren::Vec2 p : answer.path) std::cout << p.x << ' ' << p.y << '\n';
  warren::write_picture("map_with_disc.svg", flat, answer);
  return answer.verified ? 0 : 1;
}
