// SPDX-License-Identifier: BSD-3-Clause
// Contenders dealt out: from planners, options that all of them shall have, and lists of which each value makes a
// contender of its own, to one SolveOptions a contender.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// An empty list leaves to each planner what is usual with it.
struct PlannerDeal {
  std::vector<PlannerKind> planners = {};
  Question question = {};    ///< asked of all
  SolveOptions common = {};  ///< each planner gets of it what it takes; without planner
  std::vector<SearchMethod> searches = {};
  std::vector<QueueKind> queues = {};
  std::vector<SamplerKind> samplers = {};
  std::vector<std::optional<std::uint64_t>> samples = {};  ///< none: as many as it takes
};

/// All contenders, planner by planner. Each gets of the options and of the lists' values those that it takes; what none
/// of the planners takes is refused with UsageError. A queue goes only to searches that have one.
std::vector<SolveOptions> deal_planners(const PlannerDeal& deal);

}  // namespace warren
