// SPDX-License-Identifier: BSD-3-Clause
// Keeps a robot to its route: the rest of an older path, where that is still free and a new one is not much cheaper.
// Both costs are of the world as it is now. If all prices have changed by factors of at most 1 + n since the older path
// was the cheapest, and by 1 - n at least, none changes it where a change takes a gain of 1 - (1 - n) / (1 + n).
#pragma once

#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// What is left of a route for a robot that stands at `start`: from there to the route's place nearest to it, then on.
/// Of places that are as near but for `slack` the first counts, so that nobody jumps to where the route comes by again.
/// is_cut: may the route begin within one of its motions? else it begins with the state after. States are numbers of
/// one count; of bodies of the plane the first two are their place, of arms all are joints. Empty: the route is.
std::vector<std::vector<double>> rest_of_route(const std::vector<std::vector<double>>& route,
                                               const std::vector<double>& start, double slack, bool is_cut,
                                               bool of_arm = false);

/// Decides, where the question asks, and tells in the answer. Throws UsageError for routes of another body or to
/// another goal, and where costs can't be compared; Stopped.
void keep_to_route(Answer& answer, const Scene& scene, const Question& question, const SolveOptions& options,
                   const Execution& execution);

}  // namespace warren
