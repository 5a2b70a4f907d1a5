// SPDX-License-Identifier: BSD-3-Clause
// The rival: the PRM of OMPL (Open Motion Planning Library, packaged 1.5.2) on a MazeWorld, in two ways:
//   ompl_default_prm   og::PRM as its users call it: all defaults (10 nearest neighbours, uniform valid samples,
//                      roadmap grown until start and goal connect)
//   ompl_cell_prm      one milestone a cell, handed to og::PRM::addMilestone, then one A* of its own
// Both get our continuous motion check instead of OMPL's default, which samples a motion at 1 % of the box's diagonal
// and walks through walls at these sizes. So rival and warren ask the same question of the same code, and what is
// compared is the roadmap: sampling, neighbours, graph, search. og::PRM::solve starts a second thread that polls for a
// solution every millisecond; process CPU time counts both.
#pragma once

#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "bench/rivals/ompl_worlds.hpp"
#include "bench/rivals/stopwatch.hpp"
#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {

/// One run of one contestant.
struct RivalRun {
  Path<Vec2> path;  ///< start to goal; empty: not solved
  CpuWall seconds;  ///< from walls indexed to path found
  std::uint64_t milestones = 0;
  std::uint64_t edges = 0;
};

namespace ompl_prm {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// Milestones are free before motions between them are asked about.
inline ob::SpaceInformationPtr make_space(const MazeWorld& world) {
  auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
  ompl_side::bound(*plane, world.box());
  return ompl_side::checked(plane, world, ompl_side::PointStates(), ompl_side::Ends::free);
}

inline ob::State* make_state(const ob::SpaceInformationPtr& space, Vec2 point) {
  return ompl_side::new_state(space, ompl_side::PointStates(), point);
}

inline ob::ProblemDefinitionPtr make_problem(const ob::SpaceInformationPtr& space, Vec2 start, Vec2 goal) {
  return ompl_side::problem_between(space, ompl_side::PointStates(), start, goal);
}

inline Path<Vec2> points_of(const ob::PathPtr& path) { return ompl_side::path_of(path, ompl_side::PointStates()); }

/// Opens og::PRM's protected addMilestone and constructSolution: a roadmap of given milestones.
class CellPrm : public og::PRM {
 public:
  using og::PRM::PRM;
  Vertex add(ob::State* state) { return addMilestone(state); }
  ob::PathPtr path_between(Vertex start, Vertex goal) {
    return sameComponent(start, goal) ? constructSolution(start, goal) : nullptr;
  }
};

}  // namespace ompl_prm

/// og::PRM with all its defaults, until it connects start and goal or limit_s of wall-clock time end.
inline RivalRun ompl_default_prm(const MazeWorld& world, Vec2 start, Vec2 goal, double limit_s) {
  const Stopwatch stopwatch;
  const auto space = ompl_prm::make_space(world);
  const auto problem = ompl_prm::make_problem(space, start, goal);
  ompl::geometric::PRM planner(space);
  planner.setProblemDefinition(problem);
  planner.setup();
  RivalRun run;
  const auto status = planner.solve(ompl::base::timedPlannerTerminationCondition(limit_s));
  if (status == ompl::base::PlannerStatus::EXACT_SOLUTION) run.path = ompl_prm::points_of(problem->getSolutionPath());
  run.seconds = stopwatch.read();
  run.milestones = planner.milestoneCount();
  run.edges = planner.edgeCount();
  return run;
}

/// The cells 0 .. rows * cols - 1 in random order.
inline std::vector<std::uint32_t> shuffled_cells(LatticeSize size, std::uint64_t seed) {
  std::vector<std::uint32_t> cells(std::size_t{size.rows} * size.cols);
  std::iota(cells.begin(), cells.end(), 0U);
  SequentialRng rng(seed);
  for (std::size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[rng.below(i)]);
  return cells;
}

/// og::PRM with one milestone a cell, moved from the cell's centre by up to `jitter` in x and y.
inline RivalRun ompl_cell_prm(const MazeWorld& world, Vec2 start, Vec2 goal, LatticeSize size, double jitter,
                              std::uint64_t seed) {
  const Stopwatch stopwatch;
  const auto space = ompl_prm::make_space(world);
  ompl_prm::CellPrm planner(space);
  planner.setProblemDefinition(ompl_prm::make_problem(space, start, goal));
  planner.setup();
  for (const std::uint32_t cell : shuffled_cells(size, seed)) {
    const Vec2 centre{1.0 + cell % size.cols, 1.0 + cell / size.cols};
    const Vec2 moved{jitter * (2.0 * uniform(seed, cell, 0) - 1.0), jitter * (2.0 * uniform(seed, cell, 1) - 1.0)};
    planner.add(ompl_prm::make_state(space, centre + moved));
  }
  const auto from = planner.add(ompl_prm::make_state(space, start));
  const auto to = planner.add(ompl_prm::make_state(space, goal));
  RivalRun run;
  run.path = ompl_prm::points_of(planner.path_between(from, to));
  run.seconds = stopwatch.read();
  run.milestones = planner.milestoneCount();
  run.edges = planner.edgeCount();
  return run;
}

}  // namespace warren
