// SPDX-License-Identifier: BSD-3-Clause
// warren beside OMPL (1.5.2 as packaged) for bodies in the plane that turn, and cars: time to a first path, one thread
// each, the same checker behind all. Contestants: rrt_connect with the program's defaults; og::RRTConnect with its own,
// twice:
//   certified  the certified motion check as its MotionValidator, so that what is compared is the planning;
//   sampled    its own motion validator of the space at its default resolution (1 % of the space's extent), which asks
//              the checker about states alone. What it finds is a solution only where the certified check confirms it.
// Scenes: files given as operands whose robot is a polygon (ob::SE2StateSpace) or a car (by both curves:
// ob::DubinsStateSpace, ob::ReedsSheppStateSpace); and `slits`, an L that must turn through three slits.
//
// Each is timed from obstacles in memory to path found: "in all" with the world, its index, and OMPL's spaces and
// set-up, "search" without. Every path's motions are checked again outside of the clock. They take turns, seed by seed.
// CPU milliseconds of the process, medians; a ratio is to warren's. OMPL's random numbers have one seed a process, so
// its runs follow each other; warren's have the seeds 1, 2, ...
#include <fmt/core.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "bench/rivals/ompl_worlds.hpp"
#include "bench/rivals/stopwatch.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "scenes/files/read_world_io.hpp"

namespace warren {
namespace {

using namespace ompl_side;

struct Options {
  std::vector<std::string> scenes;
  std::uint64_t runs = 20;
  double limit_s = 20.0;
};

struct Course {
  std::string name;
  Scene scene;
  RobotSpec robot;
  Se2 start;
  Se2 goal;
};

struct Run {
  Path<Se2> path;         ///< empty: not solved
  double cpu_s = 0.0;     ///< in all
  double search_s = 0.0;  ///< the planner's own
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
  course.robot.outline = {{-0.15, -0.15}, {1.65, -0.15}, {1.65, 0.15}, {0.15, 0.15}, {0.15, 1.65}, {-0.15, 1.65}};
  course.start = {0.5, 0.5, 0};
  course.goal = {10.3, 6, 0};
  return course;
}

Course course_of(const std::string& file) {
  Course course;
  course.name = file.substr(file.find_last_of('/') + 1);
  course.scene = read_scene(InputFile(file, {}), {});
  const RobotKind kind = course.scene.robot ? course.scene.robot->kind : RobotKind::point;
  if ((kind != RobotKind::polygon && kind != RobotKind::car) || course.scene.goal.size() != 3) {
    throw std::runtime_error(file + ": expected a polygon robot or a car, start and goal with headings");
  }
  course.robot = *course.scene.robot;
  course.start = {course.scene.start[0], course.scene.start[1], course.scene.start[2]};
  course.goal = {course.scene.goal[0], course.scene.goal[1], course.scene.goal[2]};
  return course;
}

template <class Kind>
Run run_warren(const Course& course, std::uint64_t seed) {
  RrtOptions options;
  options.seed = seed;
  const Stopwatch in_all;
  const typename Kind::World world = Kind::world(course.scene, course.robot);
  const Stopwatch search;
  auto solution = rrt_connect(WorldView(world), course.start, std::span(&course.goal, 1), options, one_thread());
  return {std::move(solution.path), in_all.read().cpu_s, search.read().cpu_s};
}

template <class Kind>
Run run_ompl(const Course& course, Motions motions, double limit_s) {
  const Stopwatch in_all;
  const typename Kind::World world = Kind::world(course.scene, course.robot);
  auto poses = Kind::template space<typename Kind::Space>(course.robot);
  bound(*poses, Kind::box(world));
  const auto space = checked(poses, world, PoseStates(), Ends::asked, motions);
  const auto problem = problem_between(space, PoseStates(), course.start, course.goal);
  og::RRTConnect planner(space);
  planner.setProblemDefinition(problem);
  planner.setup();
  const Stopwatch search;
  const ob::PlannerStatus status = planner.solve(ob::timedPlannerTerminationCondition(limit_s));
  Run run;
  run.cpu_s = in_all.read().cpu_s;
  run.search_s = search.read().cpu_s;
  if (status == ob::PlannerStatus::EXACT_SOLUTION) run.path = path_of(problem->getSolutionPath(), PoseStates());
  return run;
}

template <class World>
bool is_free(const World& world, const Path<Se2>& path) {
  auto query = world.make_query();
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!world.is_free_motion(path[i - 1], path[i], query)) return false;
  }
  return true;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Of the reference point.
double way_between(const Se2World&, const Se2& a, const Se2& b) { return distance(a.position(), b.position()); }
template <class Curve>
double way_between(const CarWorld<Curve>& world, const Se2& a, const Se2& b) {
  return world.distance(a, b);
}

/// What a contestant did in all its runs.
struct Record {
  std::uint64_t solved = 0;
  std::uint64_t collide = 0;  ///< paths that are none
  std::vector<double> cpu_s = {};
  std::vector<double> search_s = {};
  std::vector<double> lengths = {};  ///< of the reference point's ways

  template <class World>
  void add(const World& world, const Run& run) {
    cpu_s.push_back(run.cpu_s);
    search_s.push_back(run.search_s);
    if (run.path.empty()) return;
    ++(is_free(world, run.path) ? solved : collide);
    const auto way = [&](const Se2& a, const Se2& b) { return way_between(world, a, b); };
    lengths.push_back(path_length(run.path, way));
  }
};

void print(const std::string& scene, const char* name, const Record& record, const Record& ours) {
  fmt::print("{:<18} {:<18} {:>4} {:>4}/{} {:>9.3f} {:>7.1f} {:>9.3f} {:>7.1f} {:>7.2f}\n", scene, name, record.collide,
             record.solved, record.cpu_s.size(), 1e3 * median(record.cpu_s), median(record.cpu_s) / median(ours.cpu_s),
             1e3 * median(record.search_s), median(record.search_s) / median(ours.search_s), median(record.lengths));
}

template <class Kind>
void compare_trees(const Course& course, const Options& options) {
  const typename Kind::World world = Kind::world(course.scene, course.robot);
  Record ours;
  Record certified;
  Record sampled;
  for (std::uint64_t seed = 1; seed <= options.runs; ++seed) {
    ours.add(world, run_warren<Kind>(course, seed));
    certified.add(world, run_ompl<Kind>(course, Motions::certified, options.limit_s));
    sampled.add(world, run_ompl<Kind>(course, Motions::sampled, options.limit_s));
  }
  if (ours.collide + certified.collide > 0) throw std::runtime_error(course.name + ": a path that is not free");
  print(course.name, "warren", ours, ours);
  print(course.name, "OMPL, certified", certified, ours);
  print(course.name, "OMPL, sampled", sampled, ours);
}

void compare(Course course, const Options& options) {
  if (course.robot.kind != RobotKind::car) {
    compare_trees<Turning>(course, options);
    return;
  }
  const std::string file = course.name;
  course.name = file + " D";
  compare_trees<DrivingForwards>(course, options);
  course.name = file + " RS";
  compare_trees<DrivingBothWays>(course, options);
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("warren beside OMPL for bodies that turn");
  app.add_option("scenes", options.scenes, "scene files whose robot is a polygon or a car");
  app.add_option("--runs", options.runs, "runs of each planner a scene")->check(CLI::PositiveNumber);
  app.add_option("--limit", options.limit_s, "seconds that one run of OMPL may take")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  ompl::RNG::setSeed(1);
  fmt::print("{:<18} {:<18} {:>4} {:>7} {:>9} {:>7} {:>9} {:>7} {:>7}\n", "scene", "planner", "hit", "solved", "in all",
             "ratio", "search", "ratio", "length");
  for (const std::string& file : options.scenes) compare(course_of(file), options);
  for (const double width : {1.2, 0.8}) compare(slits(width), options);
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
