// SPDX-License-Identifier: BSD-3-Clause
// What an estimate that was asked for costs in length: the same question is answered once more by A* with the straight
// line, which finds the shortest path of the same roadmap.
#pragma once

#include <functional>
#include <optional>

#include "solve/answer/answer.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// Adds to the path's figures `searched_length` (before shortening), `shortest_length` and `shortest_expanded` of the
/// straight line, where another estimate was asked for and a path was found. `ask` answers with the estimate that it is
/// given, without shortening. What stops meanwhile adds nothing.
void price_heuristic(Answer& answer, std::optional<HeuristicKind> asked,
                     const std::function<Answer(HeuristicKind)>& ask);

}  // namespace warren
