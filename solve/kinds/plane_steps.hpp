// SPDX-License-Identifier: BSD-3-Clause
// What the planners for a point or disc among polygons and walls share (solve_plane.cpp, solve_visibility.cpp): the
// question, and how their answers tell it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>

#include "core/base/solution.hpp"
#include "core/plane/polygon.hpp"
#include "planners/axis/medial_axis_planner.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kinds/kind_of_problem.hpp"

namespace warren {

/// The planners visibility and voronoi, as SolveKind::solve.
Answer solve_by_visibility(const SolveRequest& request);
Answer solve_on_medial_axis(const SolveRequest& request);

/// The problem of a planner that plans for a point which may touch obstacles, of visibility also for what keeps a
/// distance. Throws UsageError for bodies and clearances that it can't keep, and where contact is to be blocked.
WallProblem touching_problem(const SolveRequest& request);

/// Corners of polygons and ends of walls, as the file has them.
std::size_t corner_count(const Scene& scene);

/// Does start or goal stand on a seam, strictly inside of a polygon that was cut there? Says so in the answer.
bool stand_on_seams(const SolveRequest& request, const WallProblem& problem, Answer& answer);

/// Problem, planner, search and seed, as the answer repeats them.
void describe_plane_planner(Answer& answer, const SolveRequest& request, const WallProblem& problem,
                            const SearchChoice& search);

/// Of a goal that is the start, which stands free: solved without a move, whatever the planner found. Figures of its
/// path are dropped.
void stay(Answer& answer, const WallProblem& problem);

/// The scene's obstacles for planners; the time is that of the stage `index`.
PlaneObstacles indexed_obstacles(const SolveRequest& request, Answer& answer);

/// How cells are passed, and how an answer repeats it.
CellOptions cell_options(const SolveOptions& options, const SearchChoice& search);
NamedFigure doors_option(const CellOptions& options);
/// The doors, which are the borders between cells; floors and ceilings are obstacles anyway.
NamedLines doors_of(const CellDecomposition& cells);

/// Runs `plan`, and says it with the file's lines where obstacles clash
/// (planners/vertical_cells/cell_decomposition.hpp).
void without_clashes(const SolveRequest& request, const std::function<void()>& plan);

/// The problem of voronoi, and the clearance that it plans with: a hair more, so that rounding can't fail the
/// verification.
WallProblem voronoi_problem(const Scene& scene, const Question& question);
double axis_clearance(const WallProblem& problem);
/// A box without area has no middle: throws InputError with the file's name.
void check_axis_box(const Scene& scene);

}  // namespace warren
