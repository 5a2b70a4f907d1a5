// SPDX-License-Identifier: BSD-3-Clause
// How the planners that build roadmaps of samples are told what to do: the options of prm and lazy-prm resolved against
// the world.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "planners/graph/roadmap_options.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/figure.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// What the planners that build roadmaps take of every body; some bodies take more.
inline constexpr OptionSet prm_takes{Option::sampler, Option::samples, Option::neighbours, Option::radius,
                                     Option::search,  Option::queue,   Option::optimise};
inline constexpr OptionSet lazy_prm_takes = prm_takes | OptionSet{Option::lazy};

/// How any graph is searched.
struct SearchChoice {
  SearchKind search = SearchKind::astar;
  QueueKind queue = QueueKind::heap;
  std::uint64_t seed = 1;
};
/// Throws UsageError for jump points, which need a grid, and for a queue that the search has no use for.
SearchChoice search_choice(const SolveOptions& options);

struct PlannerOptions {
  PlannerKind planner = PlannerKind::prm;
  RoadmapOptions roadmap;
  PipelineKind pipeline = PipelineKind::plain;  ///< only for prm
  bool fused = false;                           ///< may be tiled or streamed: a lattice with the usual rules
  bool optimise = false;                        ///< pull the path taut after the search
  std::vector<NamedFigure> given;               ///< what was asked for beyond planner, sampler, search and seed
};

/// Checks contradictions that need no world; throws UsageError, also for planners that build no roadmap of samples.
void check_planner_options(const SolveOptions& options);
/// prm where the sampler is the lattice, else lazy-prm.
PlannerKind usual_roadmap_planner(const SolveOptions& options, const Scene& scene);
/// Fills in the defaults that depend on the world; throws UsageError.
PlannerOptions planner_options(const SolveOptions& options, const Scene& scene, const WallProblem& problem);

}  // namespace warren
