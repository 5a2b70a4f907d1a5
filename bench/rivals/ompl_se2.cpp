// SPDX-License-Identifier: BSD-3-Clause
// warren beside OMPL for bodies in the plane that turn.
//   trees    rrt_connect and OMPL's RRTConnect (its defaults) on the same scenes, one thread each, the same certified
//            checks of states and motions behind both, the same number of runs; every path's motions are checked again
//            outside of the clock. Scenes: files given as operands whose robot is a polygon, and `slits`, an L that
//            must turn through three slits. CPU milliseconds of the process, medians.
//   lengths  Dubins and Reeds-Shepp distances on random pairs, seed by seed the same: how many agree to 1e-9, where
//   ours
//            or theirs is shorter and by how much, the first such pairs, and nanoseconds a pair.
// OMPL's random numbers have one seed a process, so its runs follow each other; warren's have the seeds 1, 2, ...
#include <fmt/core.h>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bench/rivals/stopwatch.hpp"
#include "core/rng.hpp"
#include "planners/rrt_connect.hpp"
#include "worlds/dubins_curve.hpp"
#include "worlds/reeds_shepp_curve.hpp"
#include "worlds/se2_world.hpp"
#include "worlds/world_io.hpp"

namespace warren {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

struct Options {
  std::vector<std::string> scenes;
  std::uint64_t runs = 20;
  double limit_s = 20.0;
  std::uint64_t pairs = 100'000;
};

struct Course {
  std::string name;
  Scene scene;
  std::vector<Vec2> outline;
  Se2 start;
  Se2 goal;
};

struct Run {
  std::vector<Se2> path;  ///< empty: not solved
  double cpu_s = 0.0;
};

/// Arms 1.8 long and 0.3 wide.
Course slits(double width) {
  Course course;
  course.name = fmt::format("slits, {} wide", width);
  course.scene.bounds = Box{{0, 0}, {12, 8}};
  const auto block = [&](double x, double low, double high) {
    course.scene.polygons.push_back({{{x, low}, {x + 0.3, low}, {x + 0.3, high}, {x, high}}});
  };
  const double gaps[] = {5.6, 1.2, 5.6};
  for (int i = 0; i < 3; ++i) {
    block(3.0 * (i + 1), 0.01, gaps[i]);
    block(3.0 * (i + 1), gaps[i] + width, 7.99);
  }
  course.outline = {{-0.15, -0.15}, {1.65, -0.15}, {1.65, 0.15}, {0.15, 0.15}, {0.15, 1.65}, {-0.15, 1.65}};
  course.start = {0.5, 0.5, 0};
  course.goal = {10.3, 6, 0};
  return course;
}

Course course_of(const std::string& file) {
  Course course;
  course.name = file.substr(file.find_last_of('/') + 1);
  course.scene = read_scene(InputFile(file, {}), {});
  if (!course.scene.robot || course.scene.robot->kind != RobotKind::polygon || course.scene.goal.size() != 3) {
    throw std::runtime_error(file + ": expected a polygon robot, start and goal with headings");
  }
  course.outline = course.scene.robot->outline;
  course.start = {course.scene.start[0], course.scene.start[1], course.scene.start[2]};
  course.goal = {course.scene.goal[0], course.scene.goal[1], course.scene.goal[2]};
  return course;
}

Execution one_thread() {
  Execution execution;
  execution.threads = 1;
  return execution;
}

Run run_warren(const Course& course, const Se2World& world, std::uint64_t seed) {
  RrtOptions options;
  options.seed = seed;
  const Stopwatch stopwatch;
  auto solution = rrt_connect(world, course.start, std::span(&course.goal, 1), options, one_thread());
  return {std::move(solution.path), stopwatch.read().cpu_s};
}

Se2 pose_of(const ob::State* state) {
  const auto* pose = state->as<ob::SE2StateSpace::StateType>();
  return {pose->getX(), pose->getY(), pose->getYaw()};
}

class StateChecker : public ob::StateValidityChecker {
 public:
  StateChecker(const ob::SpaceInformationPtr& space, const Se2World& world)
      : ob::StateValidityChecker(space), world_(world), query_(world.make_query()) {}
  bool isValid(const ob::State* state) const override { return world_.is_free(pose_of(state), query_); }

 private:
  const Se2World& world_;
  mutable Se2World::Query query_;
};

class MotionChecker : public ob::MotionValidator {
 public:
  MotionChecker(const ob::SpaceInformationPtr& space, const Se2World& world)
      : ob::MotionValidator(space), world_(world), query_(world.make_query()) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return world_.is_free(pose_of(to), query_) && world_.is_free_motion(pose_of(from), pose_of(to), query_);
  }
  bool checkMotion(const ob::State* from, const ob::State* to, std::pair<ob::State*, double>& last) const override {
    last.second = 0.0;
    return checkMotion(from, to);
  }

 private:
  const Se2World& world_;
  mutable Se2World::Query query_;
};

Run run_ompl(const Course& course, const Se2World& world, double limit_s) {
  auto poses = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds bounds(2);
  const Box& box = world.box();
  bounds.low = {box.min.x, box.min.y};
  bounds.high = {box.max.x, box.max.y};
  poses->setBounds(bounds);
  auto space = std::make_shared<ob::SpaceInformation>(poses);
  space->setStateValidityChecker(std::make_shared<StateChecker>(space, world));
  space->setMotionValidator(std::make_shared<MotionChecker>(space, world));
  space->setup();
  const auto state_at = [&](const Se2& pose) {
    ob::ScopedState<ob::SE2StateSpace> state(poses);
    state->setXY(pose.x, pose.y);
    state->setYaw(pose.theta);
    return state;
  };
  auto problem = std::make_shared<ob::ProblemDefinition>(space);
  problem->setStartAndGoalStates(state_at(course.start), state_at(course.goal));
  og::RRTConnect planner(space);
  planner.setProblemDefinition(problem);
  planner.setup();
  const Stopwatch stopwatch;
  const ob::PlannerStatus status = planner.solve(ob::timedPlannerTerminationCondition(limit_s));
  Run run;
  run.cpu_s = stopwatch.read().cpu_s;
  if (status != ob::PlannerStatus::EXACT_SOLUTION) return run;
  auto* path = problem->getSolutionPath()->as<og::PathGeometric>();
  for (const ob::State* state : path->getStates()) run.path.push_back(pose_of(state));
  return run;
}

void confirm(const Course& course, const Se2World& world, const Run& run) {
  auto query = world.make_query();
  for (std::size_t i = 1; i < run.path.size(); ++i) {
    if (world.is_free_motion(run.path[i - 1], run.path[i], query)) continue;
    throw std::runtime_error(course.name + ": a path that is not free");
  }
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

struct Summary {
  std::size_t solved = 0;
  double cpu_s = 0.0;
  double length = 0.0;
};

Summary summary_of(const std::vector<Run>& runs) {
  Summary summary;
  std::vector<double> times;
  std::vector<double> lengths;
  for (const Run& run : runs) {
    times.push_back(run.cpu_s);
    if (run.path.empty()) continue;
    ++summary.solved;
    lengths.push_back(
        path_length(run.path, [](const Se2& a, const Se2& b) { return distance(a.position(), b.position()); }));
  }
  summary.cpu_s = median(times);
  summary.length = median(lengths);
  return summary;
}

void compare_trees(const Course& course, const Options& options) {
  const Se2World world(course.scene, course.outline, {});
  std::vector<Run> ours;
  std::vector<Run> theirs;
  for (std::uint64_t seed = 1; seed <= options.runs; ++seed) {
    ours.push_back(run_warren(course, world, seed));
    theirs.push_back(run_ompl(course, world, options.limit_s));
    confirm(course, world, ours.back());
    confirm(course, world, theirs.back());
  }
  const Summary a = summary_of(ours);
  const Summary b = summary_of(theirs);
  fmt::print(
      "{:<18} warren {:>3}/{} {:>9.3f} ms, length {:>6.2f}   OMPL {:>3}/{} {:>9.3f} ms, length {:>6.2f}   {:.1f} "
      "times\n",
      course.name, a.solved, options.runs, 1e3 * a.cpu_s, a.length, b.solved, options.runs, 1e3 * b.cpu_s, b.length,
      b.cpu_s / a.cpu_s);
}

Se2 random_pose(std::uint64_t index) {
  return {10.0 * uniform(1, index, 0), 10.0 * uniform(1, index, 1), 6.283 * uniform(1, index, 2) - 3.1415};
}

/// Tells where the two disagree, and whether the shorter way is one (ours always is: its end is compared).
template <class Curve, class Space>
void compare_lengths(const char* name, std::uint64_t pairs) {
  Space space(1.0);
  auto* from = space.allocState()->template as<ob::SE2StateSpace::StateType>();
  auto* to = space.allocState()->template as<ob::SE2StateSpace::StateType>();
  const auto theirs = [&](const Se2& a, const Se2& b) {
    from->setXY(a.x, a.y);
    from->setYaw(a.theta);
    to->setXY(b.x, b.y);
    to->setYaw(b.theta);
    return space.distance(from, to);
  };
  std::uint64_t agree = 0;
  std::uint64_t shorter = 0;
  std::uint64_t longer = 0;
  double most_shorter = 0.0;
  double most_longer = 0.0;
  for (std::uint64_t i = 0; i < pairs; ++i) {
    const Se2 a = random_pose(2 * i);
    const Se2 b = random_pose(2 * i + 1);
    const double ours = Curve::shortest(a, b, 1.0).length;
    const double gap = theirs(a, b) - ours;
    if (std::abs(gap) <= 1e-9) {
      ++agree;
      continue;
    }
    ++(gap > 0.0 ? shorter : longer);
    most_shorter = std::max(most_shorter, gap);
    most_longer = std::max(most_longer, -gap);
    if (shorter + longer > 3) continue;
    fmt::print("  {} {} {} -> {} {} {}: ours {:.9f}, theirs {:.9f}\n", a.x, a.y, a.theta, b.x, b.y, b.theta, ours,
               ours + gap);
  }
  double sum = 0.0;
  const Stopwatch our_watch;
  for (std::uint64_t i = 0; i < pairs; ++i)
    sum += Curve::shortest(random_pose(2 * i), random_pose(2 * i + 1), 1.0).length;
  const double our_s = our_watch.read().cpu_s;
  const Stopwatch their_watch;
  for (std::uint64_t i = 0; i < pairs; ++i) sum += theirs(random_pose(2 * i), random_pose(2 * i + 1));
  const double their_s = their_watch.read().cpu_s;
  const double scale = 1e9 / static_cast<double>(pairs);
  fmt::print(
      "{:<12} {} pairs: {} agree to 1e-9; ours shorter {} (by {:.3g} at most), theirs shorter {} (by {:.3g}); {:.0f} "
      "and {:.0f} ns a pair (mean of all lengths {:.3f})\n",
      name, pairs, agree, shorter, most_shorter, longer, most_longer, scale * our_s, scale * their_s,
      sum / (2.0 * static_cast<double>(pairs)));
  space.freeState(from);
  space.freeState(to);
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("warren beside OMPL for bodies that turn");
  app.add_option("scenes", options.scenes, "scene files whose robot is a polygon");
  app.add_option("--runs", options.runs, "runs of each planner a scene")->check(CLI::PositiveNumber);
  app.add_option("--limit", options.limit_s, "seconds that one run of OMPL may take")->check(CLI::PositiveNumber);
  app.add_option("--pairs", options.pairs, "pairs of poses for the curves")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  ompl::RNG::setSeed(1);
  for (const std::string& file : options.scenes) compare_trees(course_of(file), options);
  for (const double width : {1.2, 0.8}) compare_trees(slits(width), options);
  compare_lengths<DubinsCurve, ob::DubinsStateSpace>("Dubins", options.pairs);
  compare_lengths<ReedsSheppCurve, ob::ReedsSheppStateSpace>("Reeds-Shepp", options.pairs);
  return 0;
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  try {
    return warren::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
