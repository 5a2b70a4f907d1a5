// SPDX-License-Identifier: BSD-3-Clause
// prm and lazy-prm among walls, held (solve_walls.cpp) or left out of the scene (is_unmade), for those who have a
// problem and options already.
#pragma once

#include "core/base/packed_values.hpp"
#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "solve/streamed/streamed_walls.hpp"

namespace warren {

/// Solves from walls in memory to path verified; the seconds are solve_s. Never throws Stopped. A path that fails its
/// verification is a bug and throws std::logic_error. `keep` receives the roadmap for pictures; nullptr: not wanted.
/// `asked`: a roadmap that is there already. Fills in what belongs to the work; world and threads are the caller's.
Answer solve_walls(const Scene& scene, const WallProblem& problem, const PlannerOptions& options,
                   const Execution& execution, PlannedRoadmap<Vec2>* keep, const RoadmapAsked& asked = {});

/// What a streamed solve may be given beside the question; none of it changes the answer.
struct StreamedHelp {
  PathTaker* taker = nullptr;    ///< receives the path piece by piece, before it is verified; see Answer::handed
  KeptParts* kept = nullptr;     ///< has finished parts of an earlier run, and takes those of this one
  StreamedTeam* team = nullptr;  ///< shares the work
};

/// Makes the walls, plans, verifies; all of it is in solve_s. Throws UsageError for what can't be asked; a stop is an
/// answer. Fills in all of Answer but threads and peak memory.
Answer solve_streamed(const Scene& scene, const WallProblem& problem, const PlannerOptions& options,
                      const Execution& execution, const StreamedHelp& help = {});

/// The same from question and options, as solve_within(): for whoever has help. Throws UsageError where the walls are
/// held.
Answer solve_streamed_within(const Scene& scene, const Question& question, const SolveOptions& options,
                             const Execution& execution, const StreamedHelp& help);

}  // namespace warren
