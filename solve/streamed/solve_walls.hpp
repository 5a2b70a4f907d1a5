// SPDX-License-Identifier: BSD-3-Clause
// Joins the worlds of walls with the roadmap planners: scene and options in, verified answer out.
#pragma once

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// Solves from walls in memory to path verified; the seconds are solve_s. Never throws Stopped. A path that fails its
/// verification is a bug and throws std::logic_error. `keep` receives the roadmap for pictures; nullptr: not wanted.
/// `asked`: a roadmap that is there already.
/// Fills in what belongs to the work; world and threads are the caller's.
Answer solve_walls(const Scene& scene, const WallProblem& problem, const PlannerOptions& options,
                   const Execution& execution, PlannedRoadmap<Vec2>* keep, const RoadmapAsked& asked = {});

/// The roadmap of the tiled pipeline, for a picture: tiles keep none, so the plain stages build it again, for mazes
/// whose edges can be told apart in a picture.
void draw_roadmap(const Scene& scene, const WallProblem& problem, const PlannerOptions& options,
                  const Execution& execution, PlannedRoadmap<Vec2>& roadmap);

}  // namespace warren
