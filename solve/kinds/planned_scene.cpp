// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_scene.hpp"

#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

bool wants_borders(const Scene& scene, const Question& question, PlannerKind planner) {
  if (!scene.map || scene.walls.size() > 0) return false;
  if (planner == PlannerKind::grid || planner == PlannerKind::voronoi) return false;
  const RobotKind body = robot_of(scene, question).kind;
  return body != RobotKind::point && body != RobotKind::disc;
}

}  // namespace

PlannedScene::PlannedScene(const Scene& scene, const Question& question, PlannerKind planner,
                           const Execution& execution)
    : scene_(scene) {
  if (!wants_borders(scene, question, planner)) return;
  copy_ = scene;
  add_map_walls(*copy_, execution);
}

}  // namespace warren
