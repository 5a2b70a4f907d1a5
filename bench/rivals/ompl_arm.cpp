// SPDX-License-Identifier: BSD-3-Clause
// warren beside OMPL (1.5.2 as packaged) on arms: time to a first path, one thread each, with the same check behind
// both (worlds/arms/arm_world), so that what is compared is the planning. OMPL plans in the joints that move anything,
// as warren does; joints without end wrap for warren alone. OMPL's planners have their defaults, warren's the
// program's, which for arms of files were tuned on such sets. Worlds: scene files of a puma560; or with --robot folders
// of MoveIt problems (bench/arm_sets.hpp), all in one table, less those whose start or goal is blocked; or pumas with a
// tool among spheres from seeds.
//
// In the sets OMPL plans twice: with certified motions and with sampled ones, 32 states a radian. How many of the
// sampled paths collide in between is told, they count as solved: the judge says so. Any other path that it refutes
// ends the program.
//
// Each is timed from obstacles and arm in memory to path found or to the limit, the index included; every path is
// judged outside of the clock. They take turns, seed by seed. CPU seconds of the process, of all runs; ratios are of
// medians. og::PRM::solve starts a second thread that polls every millisecond, so its wall-clock time is coarse.
#include <fmt/core.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/arm_sets.hpp"
#include "bench/rivals/ompl_worlds.hpp"
#include "bench/rivals/stopwatch.hpp"
#include "planners/roadmap/prm.hpp"
#include "verify/judges/verify_arm.hpp"

namespace warren {
namespace {

using namespace ompl_side;

struct ArmRun {
  Path<JointState> path;
  CpuWall seconds;
};

template <class World>
World world_of(const SetProblem& q) {
  return World(q.scene, q.arm.model, ArmOptions{});
}

ArmRun run_rrt_connect(const SetProblem& q, std::uint64_t seed, double limit_s) {
  const Stopwatch stopwatch;
  const auto world = world_of<ArmWorld>(q);
  RrtOptions options = q.arm.table ? RrtOptions{} : options_of_sets();
  options.seed = seed;
  const JointState goal = q.arm.goal_state();
  const Deadline deadline(limit_s);
  Execution execution = one_thread();
  execution.deadline = &deadline;
  Solution<JointState> found = rrt_connect(WorldView(world), q.arm.start, std::span(&goal, 1), options, execution);
  return {std::move(found.path), stopwatch.read()};
}

ArmRun run_prm(const SetProblem& q, std::uint64_t seed, double limit_s) {
  const Stopwatch stopwatch;
  const auto world = world_of<ArmWorld>(q);
  RoadmapOptions options;
  options.seed = seed;
  options.attach = GrowingAttach{};
  const Deadline deadline(limit_s);
  Execution execution = one_thread();
  execution.deadline = &deadline;
  Solution<JointState> found = prm(WorldView(world), q.arm.start, q.arm.goal_state(), options, execution);
  return {std::move(found.path), stopwatch.read()};
}

template <class World>
ob::SpaceInformationPtr make_space(const World& world, const JointStates& states) {
  auto vectors = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(states.joints().size()));
  bound(*vectors, world, states);
  return checked(vectors, world, states, Ends::free);
}

/// A planner of OMPL with all its defaults, until it finds a path or limit_s of wall-clock time end.
template <class Planner, class World>
ArmRun run_ompl(const SetProblem& q, std::uint64_t seed, double limit_s) {
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed));
  const Stopwatch stopwatch;
  const auto world = world_of<World>(q);
  const JointStates states(world, q.arm.start);
  const auto space = make_space(world, states);
  const auto problem = problem_between(space, states, q.arm.start, q.arm.goal_state());
  Planner planner(space);
  planner.setProblemDefinition(problem);
  planner.setup();
  ArmRun run;
  const auto status = planner.solve(ob::timedPlannerTerminationCondition(limit_s));
  if (status == ob::PlannerStatus::EXACT_SOLUTION) run.path = path_of(problem->getSolutionPath(), states);
  run.seconds = stopwatch.read();
  return run;
}

struct Contestant {
  std::string name;
  std::function<ArmRun(const SetProblem&, std::uint64_t seed, double limit_s)> run;
  bool is_sampled = false;
  std::vector<double> cpu_s = {};
  std::vector<double> lengths = {};  ///< of the solved runs
  int refuted = 0;
};

/// Throws where it is no path and motions were certified: then the table would compare something else than planners.
void take(Contestant& contestant, const SetProblem& q, const ArmRun& run) {
  contestant.cpu_s.push_back(run.seconds.cpu_s);
  if (run.path.empty()) return;
  const Verification found = verify_arm(q.scene, q.arm.model, run.path, q.arm.verify_options(), one_thread());
  if (!found.verified && !contestant.is_sampled) {
    throw std::runtime_error(contestant.name + ": the path is not verified");
  }
  contestant.refuted += found.verified ? 0 : 1;
  const auto world = world_of<ArmWorld>(q);
  contestant.lengths.push_back(
      path_length(run.path, [&](const JointState& a, const JointState& b) { return world.distance(a, b); }));
}

SetProblem puma_problem(const std::string& file) {
  SetProblem q{read_world(file, one_thread()), {}};
  q.arm = arm_problem(q.scene, {}, one_thread());
  if (q.arm.robot.kind != RobotKind::puma560) throw std::runtime_error(file + ": the robot is no puma560");
  return q;
}

/// A puma with a tool among twenty spheres whose straight way is blocked.
SetProblem puma_problem(std::uint64_t seed) {
  SetProblem q;
  q.scene.robot = RobotSpec{.kind = RobotKind::puma560, .radius = 0.05, .tool = 0.1};
  for (std::uint64_t i = 0; q.scene.spheres.size() < 20; ++i) {
    const auto at = [&](std::uint64_t axis) { return 2.0 * uniform(seed, i, axis) - 1.0; };
    const Sphere s{at(0), at(1), at(2), 0.1 + 0.1 * uniform(seed, i, 3)};
    if (std::hypot(s.x, s.y, s.z) > s.radius + 0.3) q.scene.spheres.push_back(s);
  }
  q.scene.start = q.scene.goal = std::vector<double>(most_chain_joints, 0.0);
  q.arm = arm_problem(q.scene, {}, one_thread());
  const auto world = world_of<ArmWorld>(q);
  auto query = world.make_query();
  for (std::uint64_t i = 0;; ++i) {
    q.arm.start = uniform_state(world, seed + 1000, 2 * i);
    const JointState goal = uniform_state(world, seed + 1000, 2 * i + 1);
    q.arm.goal.assign(goal.begin(), goal.begin() + most_chain_joints);
    if (world.is_free(q.arm.start, query) && world.is_free(goal, query) &&
        !world.is_free_motion(q.arm.start, goal, query)) {
      return q;
    }
  }
}

nlohmann::ordered_json compare(const std::vector<SetProblem>& problems, const std::string& name, std::uint64_t seeds,
                               double limit_s) {
  std::vector<Contestant> contestants{{"warren rrt-connect", run_rrt_connect},
                                      {"OMPL RRTConnect", run_ompl<og::RRTConnect, ArmWorld>},
                                      {"warren prm", run_prm},
                                      {"OMPL PRM", run_ompl<og::PRM, ArmWorld>}};
  if (!problems.front().arm.table) {
    contestants.push_back({"RRTConnect, sampled", run_ompl<og::RRTConnect, SampledArmWorld>, true});
    contestants.push_back({"PRM, sampled", run_ompl<og::PRM, SampledArmWorld>, true});
  }
  for (const SetProblem& q : problems) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      for (Contestant& contestant : contestants) take(contestant, q, contestant.run(q, seed, limit_s));
    }
  }
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const Contestant& c = contestants[i];
    const bool is_prm = i == 2 || i == 3 || i == 5;
    const double own = at_share(contestants[is_prm ? 2 : 0].cpu_s, 0.5);
    const double times = at_share(c.cpu_s, 0.5) / own;
    fmt::print("{:<16} {:<20} {:>4}/{:<4} {:>10.3f} {:>10.3f} {:>10.3f} {:>8.1f} {:>8.3f} {:>8}\n", name, c.name,
               c.lengths.size(), c.cpu_s.size(), 1e3 * *std::min_element(c.cpu_s.begin(), c.cpu_s.end()),
               1e3 * at_share(c.cpu_s, 0.5), 1e3 * at_share(c.cpu_s, 0.95), times, at_share(c.lengths, 0.5), c.refuted);
    rows.push_back({{"name", c.name},
                    {"runs", c.cpu_s.size()},
                    {"solved", c.lengths.size()},
                    {"cpu_s", {{"median", at_share(c.cpu_s, 0.5)}, {"p95", at_share(c.cpu_s, 0.95)}}},
                    {"times_of_warren", times},
                    {"median_length", at_share(c.lengths, 0.5)},
                    {"refuted", c.refuted}});
  }
  return {{"world", name}, {"contestants", rows}};
}

int run_bench(int argc, char** argv) {
  std::vector<std::string> places;
  std::string robot;
  std::uint64_t seeds = 50;
  std::uint64_t worlds = 20;
  double limit_s = 20.0;
  std::string json;
  CLI::App app("warren beside OMPL on arms");
  app.add_option("PLACE", places, "scene files with a puma560, or folders of problems; none: worlds from seeds");
  app.add_option("--robot", robot, "of the folders, \"urdf FILE srdf FILE\"");
  app.add_option("--seeds", seeds, "runs of each contestant on each problem")->check(CLI::Range(1, 10000));
  app.add_option("--worlds", worlds, "worlds from seeds")->check(CLI::Range(1, 1000));
  app.add_option("--limit", limit_s, "seconds for a planner");
  app.add_option("--json", json, "write the figures here as well");
  CLI11_PARSE(app, argc, argv);
  ompl::msg::noOutputHandler();
  fmt::print("{:<16} {:<20} {:>9} {:>10} {:>10} {:>10} {:>8} {:>8} {:>8}\n", "world", "planner", "solved", "min cpu ms",
             "median", "95th", "times", "length", "collide");
  nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
  std::vector<SetProblem> problems;
  int blocked = 0;
  const auto tell = [&](const std::string& name) {
    if (!problems.empty()) pairs.push_back(compare(problems, name, seeds, limit_s));
    problems.clear();
  };
  for (const std::string& place : places) {
    if (robot.empty()) {
      problems.push_back(puma_problem(place));
      tell(std::filesystem::path(place).filename().string());
      continue;
    }
    for (const auto& scene : scenes_of(place)) {
      SetProblem problem = read_set_problem(scene, robot_value("--robot", robot), one_thread());
      const auto world = world_of<ArmWorld>(problem);
      auto query = world.make_query();
      const bool is_valid = world.is_free(problem.arm.start, query) && world.is_free(problem.arm.goal_state(), query);
      if (is_valid) problems.push_back(std::move(problem));
      blocked += is_valid ? 0 : 1;
    }
  }
  tell(fmt::format("{} sets", places.size()));
  if (blocked > 0) fmt::print("{} problems with a blocked start or goal are left out\n", blocked);
  if (places.empty()) {
    for (std::uint64_t seed = 1; seed <= worlds; ++seed) problems.push_back(puma_problem(seed));
    tell("spheres");
  }
  const nlohmann::ordered_json figures{
      {"schema", "warren.rival/1"}, {"rival", "OMPL"}, {"verified", true}, {"pairs", pairs}};
  if (!json.empty()) std::ofstream(json) << figures.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  try {
    return warren::run_bench(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rival_ompl_arm: {}\n", error.what());
    return 1;
  }
}
