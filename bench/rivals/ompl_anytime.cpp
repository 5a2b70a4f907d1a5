// SPDX-License-Identifier: BSD-3-Clause
// OMPL's planners that get better with time (1.5.2 as packaged) on one world of warren's: which cost they had come to
// by which moment, as bench/anytime_table.py reads it. Motions are judged by warren's certified check, and the distance
// of OMPL's space, which its planners make small, is warren's metric; all else is as OMPL has it by default.
//
// How each is watched: most are asked to solve again and again, for a millisecond of CPU time each, later for a 50th of
// what went before; they go on where they stopped. AnytimePathShortening begins anew when it is asked again, so it runs
// through, and its best path is looked at every millisecond. It has two of RRTConnect: the planner that it takes by
// itself aborts in the plane, where a projection takes bytes for numbers. FMT* and BFMT* plan once for a number of
// samples: they run with 125, 250, 500, ... one after the other. RRTConnect ends with its first path. CPU time of the
// process, all threads of it, from the planner's construction on: the world and its index are there before.
//
// Outside of the clock warren's judge sees each path that was the best so far. What it refutes is counted as refuted;
// what costs nothing, or no number, is counted as none. Neither is an improvement. A state that is there twice in a row
// is taken once. Where a planner throws, its run has what it had until then, and what it said is told.
//   rival_ompl_anytime WORLD [--steering WORD] [--planners LIST] [--seed S] [--seeds N] [--budget SECONDS]
#include <fmt/core.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/cforest/CForest.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/rivals/ompl_worlds.hpp"
#include "bench/rivals/stopwatch.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/question/question.hpp"
#include "solve/question/question_of_arm.hpp"
#include "verify/judges/verify_arm.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/plane/polygon_world.hpp"

namespace warren {
namespace {

using namespace ompl_side;
using Json = nlohmann::ordered_json;

struct Asked {
  std::string world;
  std::string steering;
  std::vector<std::string> planners;
  std::uint64_t first_seed = 1;
  std::uint64_t seeds = 1;
  double budget_s = 2.0;
};

/// The space with the world's metric as its distance.
template <class Space, class World, class States>
class MetricSpace : public Space {
 public:
  template <class... Rest>
  MetricSpace(const World& world, const States& states, Rest... rest)
      : Space(rest...), world_(world), states_(states) {}
  double distance(const ob::State* a, const ob::State* b) const override {
    return world_.distance(states_.read(a), states_.read(b));
  }

 private:
  const World& world_;
  const States states_;
};

// One kind of body each: its world, its states, its space, its judge.

struct PlaceTask {
  using World = PolygonWorld;
  using States = PointStates;
  WallProblem problem;
  World world;
  States states;
  Vec2 start;
  std::vector<Vec2> goals;

  explicit PlaceTask(const Scene& scene)
      : problem(wall_problem(scene, {})),
        world(scene, problem.reach(), one_thread()),
        start(problem.start),
        goals{problem.goal} {}
  ob::StateSpacePtr space() const {
    auto plane = std::make_shared<MetricSpace<ob::RealVectorStateSpace, World, States>>(world, states, 2U);
    bound(*plane, world.box());
    return plane;
  }
  Verification judged(const Scene& scene, const Path<Vec2>& path) const {
    VerifyOptions options{.radius = problem.robot.radius, .clearance = problem.clearance};
    options.start = start;
    options.goal = problem.goal;
    return verify_path(scene, path, options, one_thread());
  }
};

template <class Kind>
struct PoseTask {
  using World = typename Kind::World;
  using States = PoseStates;
  PoseProblem problem;
  World world;
  States states;
  Se2 start;
  std::vector<Se2> goals;  // of a goal of any heading 16, as warren has it

  explicit PoseTask(const Scene& scene)
      : problem(pose_problem(scene, {})),
        world(Kind::world(scene, problem.robot)),
        start(problem.start),
        goals(poses_of(problem.goal)) {
    if (problem.clearance > 0.0) throw std::runtime_error("a clearance is none of this bench's");
  }
  ob::StateSpacePtr space() const {
    auto poses = Kind::template space<MetricSpace<typename Kind::Space, World, States>>(problem.robot, world, states);
    bound(*poses, Kind::box(world));
    return poses;
  }
  /// The judge of cars sees legs on which the wheel is still.
  Verification judged(const Scene& scene, const Path<Se2>& path) const {
    const RobotSpec& robot = problem.robot;
    if constexpr (std::is_same_v<Kind, Turning>) {
      return verify_se2(scene, robot.outline, path, verify_options(problem), one_thread());
    } else {
      std::vector<Se2> legs = {path.front()};
      for (std::size_t i = 1; i < path.size(); ++i) append_joints(legs, world.curve(path[i - 1], path[i]));
      return verify_car(scene, robot, legs, verify_options(problem), one_thread());
    }
  }
};

struct ArmTask {
  using World = ArmWorld;
  using States = JointStates;
  ArmProblem problem;
  World world;
  States states;
  JointState start;
  std::vector<JointState> goals;

  explicit ArmTask(const Scene& scene)
      : problem(arm_problem(scene, {}, one_thread())),
        world(scene, problem.model, {.clearance = problem.clearance}),
        states(world, problem.start),
        start(problem.start),
        goals{problem.goal_state()} {}
  ob::StateSpacePtr space() const {
    const auto joints = static_cast<unsigned>(states.joints().size());
    auto vectors = std::make_shared<MetricSpace<ob::RealVectorStateSpace, World, States>>(world, states, joints);
    bound(*vectors, world, states);
    return vectors;
  }
  Verification judged(const Scene& scene, const Path<JointState>& path) const {
    return verify_arm(scene, problem.model, path, problem.verify_options(), one_thread());
  }
};

/// The best path of a problem, whenever it is another one than before, with the moment.
class Watch {
 public:
  explicit Watch(ob::ProblemDefinitionPtr problem) : problem_(std::move(problem)) {}

  double seconds() const { return clock_.read().cpu_s; }
  void look() {
    if (!problem_->hasExactSolution()) return;
    ob::PathPtr best = problem_->getSolutionPath();
    if (!best || (!seen_.empty() && seen_.back().path == best)) return;
    seen_.push_back({seconds(), std::move(best)});
  }
  struct Seen {
    double at_s;
    ob::PathPtr path;
  };
  const std::vector<Seen>& seen() const { return seen_; }

 private:
  ob::ProblemDefinitionPtr problem_;
  Stopwatch clock_;
  std::vector<Seen> seen_;
};

// How a planner is run until the budget ends; see above.

// OMPL's parts own each other by shared_ptr, and nothing else will do.
template <class Planner>
std::shared_ptr<Planner> ready(std::shared_ptr<Planner> planner, const ob::ProblemDefinitionPtr& problem) {
  planner->setProblemDefinition(problem);
  planner->setup();
  return planner;
}

void solve_until(ob::Planner& planner, Watch& watch, double end_s) {
  planner.solve(ob::PlannerTerminationCondition([&watch, end_s] { return watch.seconds() >= end_s; }));
  watch.look();
}

template <class Planner>
void in_slices(const ob::SpaceInformationPtr& space, const ob::ProblemDefinitionPtr& problem, Watch& watch,
               double budget_s) {
  constexpr double least_s = 1e-3;
  constexpr double share = 0.02;
  const auto planner = ready(std::make_shared<Planner>(space), problem);
  for (double now_s = watch.seconds(); now_s < budget_s; now_s = watch.seconds()) {
    const double end_s = std::min(budget_s, now_s + std::max(least_s, share * now_s));
    solve_until(*planner, watch, end_s);
    if (watch.seconds() < end_s) return;  // it ended by itself
  }
}

template <class Planner>
void by_doubling(const ob::SpaceInformationPtr& space, const ob::ProblemDefinitionPtr& problem, Watch& watch,
                 double budget_s) {
  for (unsigned samples = 125; watch.seconds() < budget_s; samples *= 2) {
    const auto planner = std::make_shared<Planner>(space);
    planner->setNumSamples(samples);
    solve_until(*ready(planner, problem), watch, budget_s);
  }
}

void run_through(const ob::SpaceInformationPtr& space, const ob::ProblemDefinitionPtr& problem, Watch& watch,
                 double budget_s) {
  constexpr double period_s = 1e-3;
  const auto planner = ready(og::AnytimePathShortening::createPlanner<og::RRTConnect, og::RRTConnect>(space), problem);
  const auto look = [&] {
    watch.look();
    return watch.seconds() >= budget_s;
  };
  planner->solve(ob::PlannerTerminationCondition(look, period_s));  // asks on a thread of its own
  watch.look();
}

void until_first(const ob::SpaceInformationPtr& space, const ob::ProblemDefinitionPtr& problem, Watch& watch,
                 double budget_s) {
  solve_until(*ready(std::make_shared<og::RRTConnect>(space), problem), watch, budget_s);
}

struct Contestant {
  const char* name;
  void (*run)(const ob::SpaceInformationPtr&, const ob::ProblemDefinitionPtr&, Watch&, double budget_s);
};

constexpr Contestant contestants[] = {{"RRTConnect", until_first},
                                      {"RRT*", in_slices<og::RRTstar>},
                                      {"InformedRRT*", in_slices<og::InformedRRTstar>},
                                      {"RRT#", in_slices<og::RRTsharp>},
                                      {"RRTX", in_slices<og::RRTXstatic>},
                                      {"BIT*", in_slices<og::BITstar>},
                                      {"ABIT*", in_slices<og::ABITstar>},
                                      {"AIT*", in_slices<og::AITstar>},
                                      {"PRM*", in_slices<og::PRMstar>},
                                      {"LazyPRM*", in_slices<og::LazyPRMstar>},
                                      {"FMT*", by_doubling<og::FMT>},
                                      {"BFMT*", by_doubling<og::BFMT>},
                                      {"CForest", in_slices<og::CForest>},
                                      {"APS", run_through}};

template <class Task>
Path<typename Task::States::State> path_seen(const Task& task, const ob::PathPtr& found) {
  auto path = path_of(found, task.states);
  path.erase(std::unique(path.begin(), path.end()), path.end());
  return path;
}

/// What the judge leaves of the paths that were seen.
template <class Task>
Json account(const Task& task, const Scene& scene, const Watch& watch) {
  Json improvements = Json::array();
  std::uint64_t refuted = 0;
  std::uint64_t none = 0;
  double best = std::numeric_limits<double>::infinity();
  double last = best;  // asked again, a planner tells the path once more
  for (const Watch::Seen& seen : watch.seen()) {
    const auto path = path_seen(task, seen.path);
    const double cost = path_length(path, [&](const auto& a, const auto& b) { return task.world.distance(a, b); });
    const bool is_cost = cost > 0.0 && std::isfinite(cost);
    if (cost == last || (is_cost && cost >= best) || (!is_cost && std::isnan(last))) continue;
    last = is_cost ? cost : std::nan("");
    if (!is_cost) {
      ++none;
    } else if (!task.judged(scene, path).verified) {
      ++refuted;
    } else {
      best = cost;
      improvements.push_back({{"seconds", seen.at_s}, {"cost", cost}});
    }
  }
  return {{"refuted", refuted}, {"none", none}, {"improvements", improvements}};
}

template <class Task>
Json run_once(const Task& task, const Scene& scene, const Contestant& contestant, std::uint64_t seed, double budget_s) {
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed));
  const auto space = checked(task.space(), task.world, task.states, Ends::asked);
  const auto problem = problem_to_any(space, task.states, task.start, task.goals);
  problem->setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(space));
  Watch watch(problem);
  std::string threw;
  try {
    contestant.run(space, problem, watch, budget_s);
  } catch (const std::exception& error) {
    threw = error.what();
  }
  Json run{{"planner", contestant.name}, {"seed", seed}};
  if (!threw.empty()) run["threw"] = threw;
  run.update(account(task, scene, watch));
  return run;
}

template <class Task>
Json run_all(const Scene& scene, const Asked& asked) {
  const Task task(scene);
  Json runs = Json::array();
  const auto is_asked = [&](const Contestant& c) {
    return asked.planners.empty() ||
           std::find(asked.planners.begin(), asked.planners.end(), c.name) != asked.planners.end();
  };
  for (std::uint64_t i = 0; i < asked.seeds; ++i) {
    for (const Contestant& contestant : contestants) {
      if (is_asked(contestant)) runs.push_back(run_once(task, scene, contestant, asked.first_seed + i, asked.budget_s));
    }
  }
  return runs;
}

Json runs_of(Scene scene, const Asked& asked) {
  RobotSpec& robot = scene.robot ? *scene.robot : scene.robot.emplace();
  if (!asked.steering.empty()) {
    const auto steering = enum_named<SteeringKind>(asked.steering);
    if (!steering) throw std::runtime_error("--steering: dubins or reeds-shepp");
    robot.steering = *steering;
  }
  if (scene.map) throw std::runtime_error(asked.world + ": a map is none of this bench's worlds");
  if (is_arm(robot)) return run_all<ArmTask>(scene, asked);
  if (robot.kind == RobotKind::polygon) return run_all<PoseTask<Turning>>(scene, asked);
  if (robot.kind != RobotKind::car) return run_all<PlaceTask>(scene, asked);
  return robot.steering == SteeringKind::dubins ? run_all<PoseTask<DrivingForwards>>(scene, asked)
                                                : run_all<PoseTask<DrivingBothWays>>(scene, asked);
}

int run_bench(int argc, char** argv) {
  Asked asked;
  CLI::App app("OMPL's planners that get better with time, on a world of warren's; prints JSON");
  app.add_option("WORLD", asked.world, "a file or maze:ROWSxCOLS, with start and goal")->required();
  app.add_option("--steering", asked.steering, "a car's curves: dubins or reeds-shepp (default: the file's)");
  app.add_option("--planners", asked.planners, "some of OMPL's, apart by commas (default: all)")->delimiter(',');
  app.add_option("--seed", asked.first_seed, "the first seed");
  app.add_option("--seeds", asked.seeds, "so many of them")->check(CLI::Range(1, 10000));
  app.add_option("--budget", asked.budget_s, "CPU seconds of each run")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  ompl::msg::noOutputHandler();
  fmt::print("{}\n", runs_of(read_world(asked.world, one_thread()), asked).dump(1));
  return 0;
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  try {
    return warren::run_bench(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rival_ompl_anytime: {}\n", error.what());
    return 1;
  }
}
