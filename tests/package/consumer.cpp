// SPDX-License-Identifier: BSD-3-Clause
// Plans around a wall through the installed package: from one side of it to the other, seen by both planners and the
// judge.
#include <vector>

#include <warren/planners/roadmap/lazy_prm.hpp>
#include <warren/planners/roadmap/prm.hpp>
#include <warren/verify/judges/verify_point.hpp>
#include <warren/worlds/plane/maze_world.hpp>

namespace {

bool is_a_way_round(const warren::Scene& scene, const warren::Solution<warren::Vec2>& answer) {
  return answer.path.size() > 2 && warren::verify_path(scene, answer.path, {.clearance = 0.1}, {}).verified;
}

}  // namespace

int main() {
  const std::vector<warren::Segment> walls = {{{5.0, 1.0}, {5.0, 9.0}}};
  warren::Scene scene;
  scene.walls = warren::WallSet::narrowest(walls);
  scene.bounds = warren::Box{{0.0, 0.0}, {10.0, 10.0}};
  const warren::MazeWorld world(scene, 0.1, {});
  const warren::Vec2 start{2.0, 5.0};
  const warren::Vec2 goal{8.0, 5.0};
  const warren::RoadmapOptions options{.samples = 500};
  const bool good = is_a_way_round(scene, warren::prm(world, start, goal, options, {})) &&
                    is_a_way_round(scene, warren::lazy_prm(world, start, goal, options, {}));
  return good ? 0 : 1;
}
