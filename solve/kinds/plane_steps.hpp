// SPDX-License-Identifier: BSD-3-Clause
// What the planners for a point or disc in the plane share. Among polygons and walls (solve_plane.cpp): the
// question, and how their answers tell it. On an occupancy map (solve_map.cpp): the question, paths over cells, and the
// verification against closed cells.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/solution.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kinds/kind_of_problem.hpp"

namespace warren {

/// The planner voronoi, as SolveKind::solve.
Answer solve_on_medial_axis(const SolveRequest& request);

/// The problem of a planner that plans for a point which may touch obstacles, of visibility also for what keeps a
/// distance. Throws UsageError for bodies and clearances that it can't keep, and where contact is to be blocked.
WallProblem touching_problem(const SolveRequest& request);

/// Corners of polygons and ends of walls, as the file has them.
std::size_t corner_count(const Scene& scene);

/// Problem, planner, search and seed, as the answer repeats them.
void describe_plane_planner(Answer& answer, const SolveRequest& request, const WallProblem& problem,
                            const SearchChoice& search);

/// Of a goal that is the start, which stands free: solved without a move, whatever the planner found. Figures of its
/// path are dropped.
void stay(Answer& answer, const WallProblem& problem);

/// How cells are passed.
CellOptions cell_options(const SolveOptions& options, const SearchChoice& search);
/// The doors, which are the borders between cells; floors and ceilings are obstacles anyway. Throws Stopped.
NamedLines doors_of(const CellDecomposition& cells, const Execution& execution);

/// Runs `plan`, and says it with the file's lines where obstacles clash
/// (planners/vertical_cells/cell_decomposition.hpp).
void without_clashes(const SolveRequest& request, const std::function<void()>& plan);

/// The problem of voronoi, and the clearance that it plans with: a hair more, so that rounding can't fail the
/// verification.
WallProblem voronoi_problem(const Scene& scene, const Question& question);
double axis_clearance(const WallProblem& problem);
/// A box without area has no middle: throws InputError with the file's name. Throws Stopped.
void check_axis_box(const Scene& scene, const Execution& execution);

/// The planner voronoi on a map.
Answer solve_on_skeleton(const SolveRequest& request);

/// Throws UsageError where contact is to be allowed, and as wall_problem does.
WallProblem map_problem(const Scene& scene, const Question& options);

/// The cells that the robot may not enter, among them the water if it starts on land.
Bitmap closed_cells(const OccupancyMap& map, Vec2 start);

/// Does the robot fit there as an end, as the verification sees it?
bool stands_free_on_map(const OccupancyMap& map, const WallProblem& problem, Vec2 p, const Execution& execution);
/// Then its goal may lie there, too.
bool starts_on_water(const OccupancyMap& map, Vec2 start);

/// Is it proved that no path leads from start to goal? A point between closed cells goes where cells with a common side
/// are free. A disc's middle is nowhere where the middle of the cell is nearer than the radius less half a diagonal;
/// all other cells are given it, corners too. O(cells).
bool provably_apart(const OccupancyMap& map, const Bitmap& closed, const WallProblem& problem,
                    const Execution& execution);

/// The same for a body that turns: a car that is a disc by its disc, an outline by its first corner, a point: no motion
/// takes it from where one pose has it to where the other has it.
bool provably_apart(const OccupancyMap& map, const RobotSpec& robot, const Se2& start, const Se2& goal,
                    const Execution& execution);

/// Does a body that keeps `reach` get from a point to the middle of a cell in a straight line?
bool is_joined(const OccupancyMap& map, double reach, Vec2 p, Cell cell, const Execution& execution);

/// The cells by whose middles a path may begin or end at p, the nearest first, one of those that steps join nearby: a
/// point's own; a disc may fit where it stands and not at the middle of its cell, but at one of those around it. wide:
/// where its middle may not be. None where p lies outside.
std::vector<Cell> cells_joined_to(const OccupancyMap& map, const Bitmap& wide, double reach, Vec2 p,
                                  const Execution& execution);

/// From the start over the middles of the cells where the path turns to the goal; each cell is a neighbour of the one
/// before.
Path<Vec2> path_over_cells(const OccupancyMap& map, Vec2 start, std::span<const Cell> cells, Vec2 goal);

}  // namespace warren
