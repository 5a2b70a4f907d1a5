// SPDX-License-Identifier: BSD-3-Clause
// prm in a maze whose walls are left out (is_unmade), for those who have a problem and options already.
#pragma once

#include "core/base/path_taker.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// Makes the walls, plans, verifies; all of it is in solve_s. Throws UsageError for what can't be asked; a stop is an
/// answer. Fills in all of Answer but threads and peak memory. `taker`, where given, receives the path piece by piece,
/// before it is verified; the answer then has `handed` instead.
Answer solve_streamed(const Scene& scene, const WallProblem& problem, const PlannerOptions& options,
                      const Execution& execution, PathTaker* taker = nullptr);

}  // namespace warren
