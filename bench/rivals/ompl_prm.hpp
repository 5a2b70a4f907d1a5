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

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

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
using PlaneState = ob::RealVectorStateSpace::StateType;

inline Vec2 point_of(const ob::State* state) {
  const auto* plane = state->as<PlaneState>();
  return {plane->values[0], plane->values[1]};
}

class MazeStateChecker : public ob::StateValidityChecker {
 public:
  MazeStateChecker(const ob::SpaceInformationPtr& space, const MazeWorld& world)
      : ob::StateValidityChecker(space), world_(world) {}
  bool isValid(const ob::State* state) const override {
    MazeWorld::Query query = world_.make_query();
    return world_.is_free(point_of(state), query);
  }

 private:
  const MazeWorld& world_;
};

class MazeMotionValidator : public ob::MotionValidator {
 public:
  MazeMotionValidator(const ob::SpaceInformationPtr& space, const MazeWorld& world)
      : ob::MotionValidator(space), world_(world) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const bool is_free = is_free_motion(point_of(from), point_of(to));
    ++(is_free ? valid_ : invalid_);
    return is_free;
  }
  /// The last valid state by bisection, to 2^-16 of the motion: the random walks of expandRoadmap use it.
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    if (checkMotion(from, to)) return true;
    const Vec2 a = point_of(from);
    const Vec2 leg = point_of(to) - a;
    double reached = 0.0;
    for (double step = 0.5; step > 0x1p-17; step *= 0.5) {
      if (is_free_motion(a, a + (reached + step) * leg)) reached += step;
    }
    last_valid.second = reached;
    if (last_valid.first != nullptr) si_->getStateSpace()->interpolate(from, to, reached, last_valid.first);
    return false;
  }

 private:
  bool is_free_motion(Vec2 a, Vec2 b) const {
    MazeWorld::Query query = world_.make_query();
    return world_.is_free_motion(a, b, query);
  }

  const MazeWorld& world_;
};

inline ob::SpaceInformationPtr make_space(const MazeWorld& world) {
  auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0, world.box().min.x);
  bounds.setLow(1, world.box().min.y);
  bounds.setHigh(0, world.box().max.x);
  bounds.setHigh(1, world.box().max.y);
  plane->setBounds(bounds);
  auto space = std::make_shared<ob::SpaceInformation>(plane);
  space->setStateValidityChecker(std::make_shared<MazeStateChecker>(space, world));
  space->setMotionValidator(std::make_shared<MazeMotionValidator>(space, world));
  space->setup();
  return space;
}

inline ob::State* make_state(const ob::SpaceInformationPtr& space, Vec2 point) {
  ob::State* state = space->allocState();
  state->as<PlaneState>()->values[0] = point.x;
  state->as<PlaneState>()->values[1] = point.y;
  return state;
}

inline ob::ProblemDefinitionPtr make_problem(const ob::SpaceInformationPtr& space, Vec2 start, Vec2 goal) {
  auto problem = std::make_shared<ob::ProblemDefinition>(space);
  ob::State* from = make_state(space, start);
  ob::State* to = make_state(space, goal);
  problem->setStartAndGoalStates(from, to);
  space->freeState(from);
  space->freeState(to);
  return problem;
}

inline Path<Vec2> points_of(const ob::PathPtr& path) {
  Path<Vec2> points;
  if (!path) return points;
  for (const ob::State* state : path->as<og::PathGeometric>()->getStates()) points.push_back(point_of(state));
  return points;
}

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
