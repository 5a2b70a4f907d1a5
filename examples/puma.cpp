// SPDX-License-Identifier: BSD-3-Clause
// A Puma 560 among spheres, its world made by hand: two poses of six joint angles, and the arm's way between them.
#include <iostream>
#include <warren/warren.hpp>

int main() {
  warren::Scene scene;
  scene.source = "three spheres";
  scene.robot = warren::RobotSpec{.kind = warren::RobotKind::puma560, .radius = 0.05};
  scene.spheres = {{0.8, 0.4, 0.75, 0.3}, {-0.25, -0.4, 0.0, 0.15}, {0.8, 0.2, -0.75, 0.25}};
  const warren::Question question{.start = {0, 0, 0, 0, 0, 0}, .goal = {0.3048, -0.1646, -2.8118, 0, 0, 0}};
  const warren::Answer answer = warren::solve(scene, question, {.planner = warren::PlannerKind::rrt_connect});
  std::cout << name_of(answer.outcome) << ", " << answer.length << " rad in " << answer.states.size() << " states\n";
  warren::write_picture("puma.svg", scene, answer);
  return answer.verified ? 0 : 1;
}
