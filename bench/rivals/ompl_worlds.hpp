// SPDX-License-Identifier: BSD-3-Clause
// warren's worlds as OMPL (Open Motion Planning Library, packaged 1.5.2) sees them: its states, spaces with their
// bounds, checkers of states and motions, problems and paths. Both sides then ask the same questions of the same code.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/poses/car_world.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren::ompl_side {

namespace ob = ompl::base;
namespace og = ompl::geometric;

inline Execution one_thread() {
  Execution execution;
  execution.threads = 1;
  return execution;
}

// How a world's states stand in OMPL's: read() and write().

struct PointStates {
  using State = Vec2;
  static Vec2 read(const ob::State* from) {
    const double* values = from->as<ob::RealVectorStateSpace::StateType>()->values;
    return {values[0], values[1]};
  }
  static void write(Vec2 point, ob::State* to) {
    double* values = to->as<ob::RealVectorStateSpace::StateType>()->values;
    values[0] = point.x;
    values[1] = point.y;
  }
};

struct PoseStates {
  using State = Se2;
  static Se2 read(const ob::State* from) {
    const auto* pose = from->as<ob::SE2StateSpace::StateType>();
    return {pose->getX(), pose->getY(), pose->getYaw()};
  }
  static void write(const Se2& pose, ob::State* to) {
    auto* state = to->as<ob::SE2StateSpace::StateType>();
    state->setXY(pose.x, pose.y);
    state->setYaw(pose.theta);
  }
};

/// OMPL's vectors hold the joints that move anything; the others stay as they are at rest.
class JointStates {
 public:
  using State = JointState;
  JointStates(const ArmWorld& world, const JointState& rest) : rest_(rest) {
    for (std::size_t j = 0; j < world.unit_dimension(); ++j) {
      if (world.kinematics().moves(j)) joints_.push_back(j);
    }
  }
  std::span<const std::size_t> joints() const { return joints_; }
  JointState read(const ob::State* from) const {
    const double* values = from->as<ob::RealVectorStateSpace::StateType>()->values;
    JointState q = rest_;
    for (std::size_t i = 0; i < joints_.size(); ++i) q[joints_[i]] = values[i];
    return q;
  }
  void write(const JointState& q, ob::State* to) const {
    double* values = to->as<ob::RealVectorStateSpace::StateType>()->values;
    for (std::size_t i = 0; i < joints_.size(); ++i) values[i] = q[joints_[i]];
  }

 private:
  JointState rest_;
  std::vector<std::size_t> joints_;
};

/// Of the motions that are asked about: where they end, is that free for sure, or is it asked as well?
enum class Ends { free, asked };

/// What is free, for any number of threads. Refers to the world.
template <class World, class States>
class Checks {
 public:
  Checks(const World& world, States states, Ends ends)
      : world_(world), states_(std::move(states)), ends_(ends), number_(++made()) {}

  bool is_free(const ob::State* state) const { return world_.is_free(states_.read(state), query()); }
  bool is_free_motion(const ob::State* from, const ob::State* to) const {
    const auto end = states_.read(to);
    if (ends_ == Ends::asked && !world_.is_free(end, query())) return false;
    return world_.is_free_motion(states_.read(from), end, query());
  }

 private:
  static std::uint64_t& made() {
    static std::uint64_t count = 0;
    return count;
  }
  /// The thread's own, made anew where it last asked of others than these.
  typename World::Query& query() const {
    thread_local std::optional<typename World::Query> mine;
    thread_local std::uint64_t whose = 0;
    if (whose != number_) mine.emplace(world_.make_query());
    whose = number_;
    return *mine;
  }

  const World& world_;
  const States states_;
  const Ends ends_;
  const std::uint64_t number_;
};

/// Shared, as OMPL has its own: what refers to them outlives whoever made them.
template <class World, class States>
using ChecksPtr = std::shared_ptr<const Checks<World, States>>;

template <class World, class States>
class StateChecker : public ob::StateValidityChecker {
 public:
  StateChecker(const ob::SpaceInformationPtr& space, ChecksPtr<World, States> checks)
      : ob::StateValidityChecker(space), checks_(std::move(checks)) {}
  bool isValid(const ob::State* state) const override { return checks_->is_free(state); }

 private:
  ChecksPtr<World, States> checks_;
};

template <class World, class States>
class MotionChecker : public ob::MotionValidator {
 public:
  MotionChecker(const ob::SpaceInformationPtr& space, ChecksPtr<World, States> checks)
      : ob::MotionValidator(space), checks_(std::move(checks)) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const bool is_free = checks_->is_free_motion(from, to);
    ++(is_free ? valid_ : invalid_);
    return is_free;
  }
  /// The last valid state by bisection, to 2^-12 of the motion: the random walks of expandRoadmap use it.
  bool checkMotion(const ob::State* from, const ob::State* to, std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    const ob::StateSpacePtr& space = si_->getStateSpace();
    ob::State* at = space->allocState();
    double reached = 0.0;
    for (double step = 0.5; step > 0x1p-13; step *= 0.5) {
      space->interpolate(from, to, reached + step, at);
      if (checks_->is_free_motion(from, at)) reached += step;
    }
    last.second = reached;
    if (last.first != nullptr) space->interpolate(from, to, reached, last.first);
    space->freeState(at);
    return false;
  }

 private:
  ChecksPtr<World, States> checks_;
};

// Spaces, and what a body that turns is to either side: how its world and OMPL's space are made.

/// Of points, or with x and y of poses.
template <class Space>
void bound(Space& space, const Box& box) {
  ob::RealVectorBounds bounds(2);
  bounds.low = {box.min.x, box.min.y};
  bounds.high = {box.max.x, box.max.y};
  space.setBounds(bounds);
}

inline void bound(ob::RealVectorStateSpace& space, const ArmWorld& world, const JointStates& states) {
  ob::RealVectorBounds bounds(space.getDimension());
  for (std::size_t i = 0; i < states.joints().size(); ++i) {
    bounds.low[i] = world.model().variables[states.joints()[i]].low;
    bounds.high[i] = world.model().variables[states.joints()[i]].high;
  }
  space.setBounds(bounds);
}

struct Turning {
  using World = Se2World;
  using Space = ob::SE2StateSpace;
  static World world(const Scene& scene, const RobotSpec& robot) { return {scene, robot.outline, {}}; }
  static const Box& box(const World& world) { return world.box(); }
  template <class S, class... First>
  static std::shared_ptr<S> space(const RobotSpec&, const First&... first) {
    return std::make_shared<S>(first...);
  }
};

template <class Curve, class CurveSpace>
struct Driving {
  using World = CarWorld<Curve>;
  using Space = CurveSpace;
  static World world(const Scene& scene, const RobotSpec& robot) {
    return {scene, {.turning_radius = robot.turning_radius, .radius = robot.radius, .outline = robot.outline}};
  }
  static const Box& box(const World& world) { return world.body().box(); }
  template <class S, class... First>
  static std::shared_ptr<S> space(const RobotSpec& robot, const First&... first) {
    return std::make_shared<S>(first..., robot.turning_radius);
  }
};
using DrivingForwards = Driving<DubinsCurve, ob::DubinsStateSpace>;
using DrivingBothWays = Driving<ReedsSheppCurve, ob::ReedsSheppStateSpace>;

/// Who decides of motions: the world's certified check, or OMPL, which asks about states along them.
enum class Motions { certified, sampled };

/// Set up, with the world's checks. Refers to the world.
template <class World, class States>
ob::SpaceInformationPtr checked(const ob::StateSpacePtr& states_space, const World& world, const States& states,
                                Ends ends, Motions motions = Motions::certified) {
  auto space = std::make_shared<ob::SpaceInformation>(states_space);
  const auto checks = std::make_shared<const Checks<World, States>>(world, states, ends);
  space->setStateValidityChecker(std::make_shared<StateChecker<World, States>>(space, checks));
  if (motions == Motions::certified) {
    space->setMotionValidator(std::make_shared<MotionChecker<World, States>>(space, checks));
  }
  space->setup();
  return space;
}

/// Whoever asks for it frees it.
template <class States>
ob::State* new_state(const ob::SpaceInformationPtr& space, const States& states, const typename States::State& state) {
  ob::State* made = space->allocState();
  states.write(state, made);
  return made;
}

/// To any of the goals that are free.
template <class States>
ob::ProblemDefinitionPtr problem_to_any(const ob::SpaceInformationPtr& space, const States& states,
                                        const typename States::State& start,
                                        std::span<const typename States::State> goals) {
  auto problem = std::make_shared<ob::ProblemDefinition>(space);
  auto region = std::make_shared<ob::GoalStates>(space);
  ob::State* from = new_state(space, states, start);
  problem->addStartState(from);
  space->freeState(from);
  for (const auto& goal : goals) {
    ob::State* to = new_state(space, states, goal);
    if (goals.size() == 1 || space->isValid(to)) region->addState(to);
    space->freeState(to);
  }
  problem->setGoal(region);
  return problem;
}

template <class States>
ob::ProblemDefinitionPtr problem_between(const ob::SpaceInformationPtr& space, const States& states,
                                         const typename States::State& start, const typename States::State& goal) {
  return problem_to_any(space, states, start, std::span<const typename States::State>(&goal, 1));
}

/// Empty: there is none.
template <class States>
Path<typename States::State> path_of(const ob::PathPtr& found, const States& states) {
  Path<typename States::State> path;
  if (!found) return path;
  for (const ob::State* state : found->as<og::PathGeometric>()->getStates()) path.push_back(states.read(state));
  return path;
}

}  // namespace warren::ompl_side
