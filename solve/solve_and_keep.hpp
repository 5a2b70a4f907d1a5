// SPDX-License-Identifier: BSD-3-Clause
// A question whose roadmap outlives it: the roadmap that build() makes by the same options, and the answer by it. Where
// the samples are left open, solve() grows them until start and goal connect: then the answer is solve()'s and the
// roadmap has as many samples as its last round. A lazy roadmap keeps what the question has learnt of its edges. Asked
// the question again, it gives the same path.
//
// Cost: one build and one search; where the samples grow, solve() too.
#pragma once

#include "parallel/execution.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kept/roadmap.hpp"

namespace warren {

/// Takes the scene. `roadmap` is whole unless the answer is `stopped`. `keep`: as for solve_explained(). Throws as
/// that and build_within() do, UsageError where the planner makes no roadmap that is kept, Stopped.
Answer solve_and_keep(Scene scene, const Question& question, const SolveOptions& options, const Execution& execution,
                      Roadmap& roadmap, ByProducts* keep = nullptr);

}  // namespace warren
