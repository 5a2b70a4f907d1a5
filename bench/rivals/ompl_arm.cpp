// SPDX-License-Identifier: BSD-3-Clause
// warren beside OMPL (1.5.2 as packaged) on arms: time to a first path, one thread each, the same certified motion
// check (worlds/arms/arm_world) behind both, so that what is compared is the planning. Contestants: rrt-connect and prm
// of warren with the program's defaults, og::RRTConnect and og::PRM with theirs. OMPL plans in the joints that move
// anything, as warren does. Worlds: scene files that the command line names, or pumas with a tool among spheres from
// seeds.
//
// Each is timed from obstacles in memory to path found, the index included; every path is verified outside of the
// clock. They take turns, seed by seed. CPU seconds of the process; ratios are of medians. og::PRM::solve starts a
// second thread that polls every millisecond, so its wall-clock time is coarse.
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

#include "bench/rivals/ompl_worlds.hpp"
#include "bench/rivals/stopwatch.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "scenes/files/read_world_io.hpp"
#include "verify/judges/verify_arm.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/chain_model.hpp"
#include "worlds/arms/puma560.hpp"

namespace warren {
namespace {

using namespace ompl_side;

struct Question {
  std::string name;
  Scene scene;
  DhTable table;
  double radius = 0.05;
  JointState start{};
  JointState goal{};
};

struct ArmRun {
  Path<JointState> path;
  CpuWall seconds;
};

ArmWorld world_of(const Question& q) { return {q.scene, model_of(q.table, q.radius, false), {}}; }

ArmRun run_rrt_connect(const Question& q, std::uint64_t seed) {
  const Stopwatch stopwatch;
  const ArmWorld world = world_of(q);
  RrtOptions options;
  options.seed = seed;
  Solution<JointState> found = rrt_connect(WorldView(world), q.start, std::span(&q.goal, 1), options, one_thread());
  return {std::move(found.path), stopwatch.read()};
}

ArmRun run_prm(const Question& q, std::uint64_t seed) {
  const Stopwatch stopwatch;
  const ArmWorld world = world_of(q);
  RoadmapOptions options;
  options.seed = seed;
  options.attach = GrowingAttach{};
  Solution<JointState> found = prm(WorldView(world), q.start, q.goal, options, one_thread());
  return {std::move(found.path), stopwatch.read()};
}

ob::SpaceInformationPtr make_space(const ArmWorld& world, const JointStates& states) {
  auto vectors = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(states.joints().size()));
  bound(*vectors, world, states);
  return checked(vectors, world, states, Ends::free);
}

/// A planner of OMPL with all its defaults, until it finds a path or limit_s of wall-clock time end.
template <class Planner>
ArmRun run_ompl(const Question& q, std::uint64_t seed, double limit_s) {
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed));
  const Stopwatch stopwatch;
  const ArmWorld world = world_of(q);
  const JointStates states(world, q.start);
  const auto space = make_space(world, states);
  const auto problem = problem_between(space, states, q.start, q.goal);
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
  std::function<ArmRun(const Question&, std::uint64_t seed)> run;
  std::vector<double> cpu_s = {};
  std::vector<double> lengths = {};  ///< of the solved runs
};

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Throws unless it is a path: then the table would compare something else than planners.
double verified_length(const Question& q, const ArmRun& run, const std::string& name) {
  ArmVerifyOptions options;
  options.start = q.start;
  options.goal = q.goal;
  const Verification found = verify_arm(q.scene, model_of(q.table, q.radius, false), run.path, options, one_thread());
  if (!found.verified) throw std::runtime_error(name + ": the path is not verified");
  return found.length;
}

JointState state_of(const std::vector<double>& numbers, const std::string& where) {
  if (numbers.size() != most_chain_joints)
    throw std::runtime_error(where + ": start and goal must be six joint angles");
  JointState q{};
  std::copy(numbers.begin(), numbers.end(), q.begin());
  return q;
}

Question question_of(const std::string& file) {
  Question q;
  q.name = file.substr(file.rfind('/') + 1);
  q.scene = read_world(file, one_thread());
  const RobotSpec robot = q.scene.robot.value_or(RobotSpec{});
  if (robot.kind != RobotKind::puma560) throw std::runtime_error(file + ": the robot is no puma560");
  q.table = puma560_table(robot.tool);
  q.radius = robot.radius;
  q.start = state_of(q.scene.start, file);
  q.goal = state_of(q.scene.goal, file);
  return q;
}

/// A puma with a tool among twenty spheres whose straight way is blocked.
Question question_of(std::uint64_t seed) {
  Question q;
  q.name = fmt::format("spheres {}", seed);
  q.table = puma560_table(0.1);
  for (std::uint64_t i = 0; q.scene.spheres.size() < 20; ++i) {
    const auto at = [&](std::uint64_t axis) { return 2.0 * uniform(seed, i, axis) - 1.0; };
    const Sphere s{at(0), at(1), at(2), 0.1 + 0.1 * uniform(seed, i, 3)};
    if (std::hypot(s.x, s.y, s.z) > s.radius + 0.3) q.scene.spheres.push_back(s);
  }
  const ArmWorld world = world_of(q);
  auto query = world.make_query();
  for (std::uint64_t i = 0;; ++i) {
    q.start = uniform_state(world, seed + 1000, 2 * i);
    q.goal = uniform_state(world, seed + 1000, 2 * i + 1);
    if (world.is_free(q.start, query) && world.is_free(q.goal, query) &&
        !world.is_free_motion(q.start, q.goal, query)) {
      return q;
    }
  }
}

nlohmann::ordered_json compare(const std::vector<Question>& questions, const std::string& name, std::uint64_t seeds,
                               double limit_s) {
  std::vector<Contestant> contestants{
      {"warren rrt-connect", run_rrt_connect},
      {"OMPL RRTConnect",
       [=](const Question& q, std::uint64_t seed) { return run_ompl<og::RRTConnect>(q, seed, limit_s); }},
      {"warren prm", run_prm},
      {"OMPL PRM", [=](const Question& q, std::uint64_t seed) { return run_ompl<og::PRM>(q, seed, limit_s); }}};
  for (const Question& q : questions) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      for (Contestant& contestant : contestants) {
        const ArmRun run = contestant.run(q, seed);
        contestant.cpu_s.push_back(run.seconds.cpu_s);
        if (!run.path.empty()) contestant.lengths.push_back(verified_length(q, run, contestant.name));
      }
    }
  }
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const Contestant& c = contestants[i];
    const double faster = median(contestants[i | 1U].cpu_s) / median(c.cpu_s);  // the rival stands behind
    fmt::print("{:<16} {:<20} {:>4}/{:<4} {:>10.3f} {:>10.3f} {:>8.1f} {:>8.3f}\n", name, c.name, c.lengths.size(),
               c.cpu_s.size(), 1e3 * *std::min_element(c.cpu_s.begin(), c.cpu_s.end()), 1e3 * median(c.cpu_s), faster,
               median(c.lengths));
    rows.push_back({{"name", c.name},
                    {"runs", c.cpu_s.size()},
                    {"solved", c.lengths.size()},
                    {"cpu_s", {{"median", median(c.cpu_s)}}},
                    {"times_faster", faster},
                    {"median_length", median(c.lengths)}});
  }
  return {{"world", name}, {"contestants", rows}};
}

int run_bench(int argc, char** argv) {
  std::vector<std::string> files;
  std::uint64_t seeds = 50;
  std::uint64_t worlds = 20;
  double limit_s = 20.0;
  std::string json;
  CLI::App app("warren beside OMPL on arms");
  app.add_option("SCENE", files, "scene files with a puma560; none: worlds from seeds");
  app.add_option("--seeds", seeds, "runs of each contestant on each world")->check(CLI::Range(1, 10000));
  app.add_option("--worlds", worlds, "worlds from seeds")->check(CLI::Range(1, 1000));
  app.add_option("--limit", limit_s, "wall-clock seconds for OMPL's solve");
  app.add_option("--json", json, "write the figures here as well");
  CLI11_PARSE(app, argc, argv);
  ompl::msg::noOutputHandler();
  fmt::print("{:<16} {:<20} {:>9} {:>10} {:>10} {:>8} {:>8}\n", "world", "planner", "solved", "min cpu ms",
             "med cpu ms", "faster", "length");
  nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
  for (const std::string& file : files)
    pairs.push_back(compare({question_of(file)}, question_of(file).name, seeds, limit_s));
  if (files.empty()) {
    std::vector<Question> questions;
    for (std::uint64_t seed = 1; seed <= worlds; ++seed) questions.push_back(question_of(seed));
    pairs.push_back(compare(questions, "spheres", seeds, limit_s));
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
