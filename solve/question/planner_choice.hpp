// SPDX-License-Identifier: BSD-3-Clause
// How the planners that build roadmaps of samples are told what to do: the options of prm and lazy-prm resolved against
// the world.
#pragma once

#include "core/run/execution.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/grid/grid_search.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// What the planners that build roadmaps take of every body; some bodies take more.
inline constexpr OptionSet prm_takes{Option::sampler, Option::samples, Option::neighbours, Option::radius,
                                     Option::search,  Option::queue,   Option::optimise,   Option::bound};
inline constexpr OptionSet lazy_prm_takes = prm_takes | OptionSet{Option::lazy};
/// What both take of a point or disc, and among walls and polygons.
inline constexpr OptionSet point_takes{Option::heuristic, Option::neighbour_index};
inline constexpr OptionSet plane_takes = lazy_prm_takes | point_takes | OptionSet{Option::pipeline};

/// How any graph is searched.
struct SearchChoice {
  SearchKind search = SearchKind::astar;
  QueueKind queue = QueueKind::heap;
};
/// Throws UsageError for jump points, which need a grid, and for a queue that the search has no use for.
SearchChoice search_choice(const SolveOptions& options);

struct PlannerOptions {
  PlannerKind planner = PlannerKind::prm;
  RoadmapOptions roadmap;
  PipelineKind pipeline = PipelineKind::plain;  ///< only for prm
};

/// Checks contradictions that need no world; throws UsageError, also for planners that build no roadmap of samples.
void check_planner_options(const SolveOptions& options);
/// prm where the sampler is the lattice, else lazy-prm.
PlannerKind usual_roadmap_planner(const SolveOptions& options, const Scene& scene);
/// Fills in the defaults that depend on the world; throws UsageError.
PlannerOptions planner_options(const SolveOptions& options, const Scene& scene, const WallProblem& problem);

// What the grid planner is told: the options that maps and lattices of scenes share.

/// Throws UsageError for dfs; `usual` where nothing is said.
GridMethod grid_method(const SolveOptions& options, GridMethod usual);

/// Throws UsageError where the world has more cells of that size than any grid or map may have, and Stopped.
void check_cell(double cell, const Scene& scene, const Execution& execution = {});

/// The raster of a scene: cell and angles of the options, else the file's grid line, else a four-hundredth of the
/// longer side of the bounds (or of the obstacles' box) and 72 headings. A map's cells are its own. Throws UsageError
/// for a world without extent and for values out of range.
GridSpec grid_spec(const GridFields& options, const Scene& scene);

// How rrt and rrt-connect are told what to do, whatever the body.

/// What each planner of trees takes.
inline constexpr OptionSet rrt_connect_options{Option::sampler, Option::step,     Option::nodes,
                                               Option::trees,   Option::optimise, Option::bound};
inline constexpr OptionSet rrt_options = rrt_connect_options | OptionSet{Option::goal_bias};

// How planners that get better are told what to do.

/// What each takes.
inline constexpr OptionSet anytime_options{Option::iterations, Option::gap, Option::parts, Option::bound};
inline constexpr OptionSet rrt_star_options{Option::iterations, Option::gap,      Option::step, Option::goal_bias,
                                            Option::nodes,      Option::optimise, Option::bound};

/// Throws UsageError for samplers that trees have no use for.
RrtOptions tree_options(const SolveOptions& options);

}  // namespace warren
