// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/plannable.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "solve/question/question_of_arm.hpp"

namespace warren {
namespace {

/// Is there anything that only bodies of the plane can meet?
bool is_flat(const Scene& scene) {
  return scene.walls.size() > 0 || !scene.polygons.empty() || scene.bounds || scene.map || is_unmade(scene);
}

}  // namespace

void check_plannable(const Scene& scene, const Question& problem) {
  const RobotSpec robot = robot_of(scene, problem);
  const std::string where = problem.robot ? fmt::format("@robot: in {}, ", scene.source) : scene.source + ": ";
  if (is_arm(robot)) {
    if (!is_flat(scene)) return;
    throw UsageError(
        fmt::format("{}an arm plans among spheres and boxes; walls, polygons, bounds and maps have no "
                    "height: they take a point, disc, polygon or car",
                    where));
  }
  if (has_solids(scene)) {
    throw UsageError(
        fmt::format("{}a {} plans among walls, polygons and bounds or on a map; spheres and boxes take an "
                    "arm (puma560, arm)",
                    where, name_of(robot.kind)));
  }
  if (is_unmade(scene) && robot.kind != RobotKind::point && robot.kind != RobotKind::disc) {
    throw UsageError(fmt::format("{}where walls are made tile by tile a point or disc plans; a {} takes a smaller maze",
                                 where, name_of(robot.kind)));
  }
  if (is_flat(scene)) return;
  throw UsageError(fmt::format("{}nothing confines the {}: the world needs bounds, walls, polygons or a map", where,
                               name_of(robot.kind)));
}

}  // namespace warren
