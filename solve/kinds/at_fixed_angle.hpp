// SPDX-License-Identifier: BSD-3-Clause
// The path of a polygon that does not turn: Minkowski sums of the obstacles with the mirrored body
// (worlds/translation_obstacles), and the visibility graph among them, which gives the shortest one, or vertical cells
// around their union. The body keeps a hair's breadth off the
// obstacles, a ten-billionth of the world's size, so that rounding can't fail the verification; by so little, times the
// corners that it passes, the path may be longer than the shortest.
#pragma once

#include <optional>
#include <span>

#include "core/base/solution.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "parallel/execution.hpp"
#include "pictures/picture.hpp"
#include "planners/cells/cell_planner.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/kind_of_problem.hpp"

namespace warren {

struct FixedAngleProblem {
  std::span<const Vec2> outline;
  Se2 start;
  Vec2 goal;
  double clearance = 0.0;            ///< a disc of this radius is replaced by a polygon of 32 corners around it
  std::optional<CellOptions> cells;  ///< none: the visibility graph
};

/// All poses of the path have the start's angle. `drawing`, where given, receives what blocks the reference point, and
/// the cells. Never throws Stopped. A body that doesn't fit in the bounds at this angle starts blocked.
Solution<Se2> plan_at_fixed_angle(const Scene& scene, const FixedAngleProblem& problem, const Execution& execution,
                                  Drawing* drawing);

/// The planners that don't turn a polygon, in scenes: on maps, whose cells all touch, they have none. Defined in
/// solve/kinds/solve_turning.cpp.
SolveKind fixed_angle_kind();

}  // namespace warren
