// SPDX-License-Identifier: BSD-3-Clause
// An arm and a folder of MoveIt problems: sceneNNNN.yaml beside requestNNNN.yaml, as MotionBenchMaker has them, a set a
// folder. For each set, and for all: how many are solved and verified, the time to a first path and to a shortened one
// (rrt-connect, then a few rounds of shortening; CPU time of one thread, the least of the repeats; reading and indexing
// are told apart), what both paths cost, what an edge costs that rrt-connect asks, and how many paths that are free at
// 32 states a radian collide in between, says the judge (not with --proved-alone, for hard sets: others take long
// there).
//   arm_problems "urdf ROBOT.urdf srdf ROBOT.srdf" SET... [--json FILE] [--csv FILE] [--proved-alone]
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/arm_sets.hpp"
#include "core/base/error.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/shorten/shortcut.hpp"
#include "verify/judges/verify_arm.hpp"

namespace warren {
namespace {

namespace fs = std::filesystem;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Execution alone() {
  Execution execution;
  execution.threads = 1;
  return execution;
}

/// Writes down the motions that it is asked for.
struct RecordingWorld : ArmWorld {
  using ArmWorld::ArmWorld;
  std::vector<std::pair<JointState, JointState>>* asked = nullptr;
  bool is_free_motion(const JointState& a, const JointState& b, Query& query) const {
    asked->emplace_back(a, b);
    return ArmWorld::is_free_motion(a, b, query);
  }
  bool is_free_step(const JointState& a, const JointState& b, Query& query) const {
    asked->emplace_back(a, b);
    return ArmWorld::is_free_step(a, b, query);
  }
};

struct Settings {
  std::string robot;
  std::vector<std::string> folders;
  RrtOptions options = options_of_sets();
  std::string sampler = "random";
  double domain = *options.domain;  // 0: none
  double worth = 0.3;
  int repeats = 3;
  bool proved_alone = false;
  std::string json;
  std::string csv;
};

/// One problem.
struct Row {
  std::string set;
  std::string name;
  std::string outcome;
  bool verified = false;
  double read_s = 0.0;
  double index_s = 0.0;
  double plan_s = 0.0;
  double shorten_s = 0.0;
  double first_cost = 0.0;
  double cost = 0.0;
  std::uint64_t edges = 0;
  std::uint64_t free_edges = 0;
  double edges_s = 0.0;       ///< of all of them, one after the other
  double free_edges_s = 0.0;  ///< of the free ones
  bool sampled_solved = false;
  bool sampled_first_refuted = false;
  bool sampled_refuted = false;  ///< the shortened one
};

template <class World>
struct Planned {
  Solution<JointState> solution;
  Path<JointState> shortened;
  double plan_s = 0.0;
  double shorten_s = 0.0;
};

template <class World>
Planned<World> plan(const World& world, const ArmProblem& problem, const Settings& settings) {
  const WorldView view(world);
  const Execution execution = alone();
  const JointState goal = problem.goal_state();
  Planned<World> planned;
  double begun = thread_seconds();
  planned.solution = rrt_connect(view, problem.start, std::span(&goal, 1), settings.options, execution);
  planned.plan_s = thread_seconds() - begun;
  if (planned.solution.outcome != Outcome::solved) return planned;
  begun = thread_seconds();
  const auto length = [&](const JointState& a, const JointState& b) { return world.distance(a, b); };
  Counters counters;
  planned.shortened =
      improve_path(view, planned.solution.path, length,
                   {.seed = settings.options.seed, .worth = settings.worth, .patience = 1}, execution, counters);
  planned.shorten_s = thread_seconds() - begun;
  return planned;
}

bool judged(const Scene& scene, const ArmProblem& problem, const Path<JointState>& path) {
  return verify_arm(scene, problem.model, path, problem.verify_options(), alone()).verified;
}

void time_edges(Row& row, const ArmWorld& world, const std::vector<std::pair<JointState, JointState>>& asked) {
  auto query = world.make_query();
  std::vector<std::pair<JointState, JointState>> free;
  double begun = thread_seconds();
  for (const auto& [a, b] : asked) {
    if (world.is_free_motion(a, b, query)) free.emplace_back(a, b);
  }
  row.edges_s = thread_seconds() - begun;
  begun = thread_seconds();
  for (const auto& [a, b] : free) world.is_free_motion(a, b, query);
  row.free_edges_s = thread_seconds() - begun;
  row.edges = asked.size();
  row.free_edges = free.size();
}

Row run(const std::string& set, const fs::path& scene_file, const RobotSpec& robot, const Settings& settings) {
  Row row;
  row.set = set;
  row.name = number_of(scene_file);
  double begun = thread_seconds();
  const auto [asked, problem] = read_set_problem(scene_file, robot, alone());
  row.read_s = thread_seconds() - begun;
  begun = thread_seconds();
  const ArmOptions options;
  const ArmWorld world(asked, problem.model, options);
  row.index_s = thread_seconds() - begun;
  std::optional<Planned<ArmWorld>> best;
  for (int i = 0; i < settings.repeats; ++i) {
    Planned<ArmWorld> planned = plan(world, problem, settings);
    if (!best || planned.plan_s + planned.shorten_s < best->plan_s + best->shorten_s) best = std::move(planned);
  }
  row.outcome = name_of(best->solution.outcome);
  row.plan_s = best->plan_s;
  row.shorten_s = best->shorten_s;
  const auto length = [&world](const JointState& a, const JointState& b) { return world.distance(a, b); };
  if (best->solution.outcome == Outcome::solved) {
    row.first_cost = path_length(best->solution.path, length);
    row.cost = path_length(best->shortened, length);
    row.verified = judged(asked, problem, best->solution.path) && judged(asked, problem, best->shortened);
  }
  std::vector<std::pair<JointState, JointState>> motions;
  RecordingWorld recording(asked, problem.model, options);
  recording.asked = &motions;
  const JointState goal = problem.goal_state();
  rrt_connect(WorldView(recording), problem.start, std::span(&goal, 1), settings.options, alone());
  time_edges(row, world, motions);
  if (settings.proved_alone) return row;
  const SampledArmWorld sampled(asked, problem.model, options);
  const Planned<SampledArmWorld> seen = plan(sampled, problem, settings);
  row.sampled_solved = seen.solution.outcome == Outcome::solved;
  row.sampled_first_refuted = row.sampled_solved && !judged(asked, problem, seen.solution.path);
  row.sampled_refuted = row.sampled_solved && !judged(asked, problem, seen.shortened);
  return row;
}

nlohmann::ordered_json summary(const std::string& name, const std::vector<const Row*>& rows) {
  std::vector<double> plan;
  std::vector<double> both;
  std::vector<double> first;
  std::vector<double> cost;
  std::uint64_t edges = 0;
  std::uint64_t free_edges = 0;
  double edges_s = 0.0;
  double free_s = 0.0;
  int solved = 0;
  int verified = 0;
  int blocked = 0;
  int sampled = 0;
  int first_refuted = 0;
  int refuted = 0;
  double mean = 0.0;
  for (const Row* row : rows) {
    edges += row->edges;
    free_edges += row->free_edges;
    edges_s += row->edges_s;
    free_s += row->free_edges_s;
    blocked += row->outcome == "start_blocked" || row->outcome == "goal_blocked" ? 1 : 0;
    sampled += row->sampled_solved ? 1 : 0;
    first_refuted += row->sampled_first_refuted ? 1 : 0;
    refuted += row->sampled_refuted ? 1 : 0;
    if (row->outcome != "solved") continue;
    ++solved;
    verified += row->verified ? 1 : 0;
    plan.push_back(1e6 * row->plan_s);
    both.push_back(1e6 * (row->plan_s + row->shorten_s));
    first.push_back(row->first_cost);
    cost.push_back(row->cost);
    mean += 1e6 * row->plan_s;
  }
  const auto per = [](double seconds, std::uint64_t count) {
    return count > 0 ? 1e9 * seconds / static_cast<double>(count) : 0.0;
  };
  return {{"set", name},
          {"problems", rows.size()},
          {"blocked_ends", blocked},
          {"solved", solved},
          {"verified", verified},
          {"plan_us_median", at_share(plan, 0.5)},
          {"plan_us_mean", solved > 0 ? mean / solved : 0.0},
          {"plan_us_p95", at_share(plan, 0.95)},
          {"plan_us_max", at_share(plan, 1.0)},
          {"plan_and_shorten_us_median", at_share(both, 0.5)},
          {"plan_and_shorten_us_p95", at_share(both, 0.95)},
          {"first_cost_median", at_share(first, 0.5)},
          {"cost_median", at_share(cost, 0.5)},
          {"edges", edges},
          {"ns_an_edge", per(edges_s, edges)},
          {"free_edges", free_edges},
          {"ns_a_free_edge", per(free_s, free_edges)},
          {"sampled_solved", sampled},
          {"sampled_first_paths_collide", first_refuted},
          {"sampled_paths_collide", refuted}};
}

void print(const nlohmann::ordered_json& s) {
  fmt::print(
      "{:<42} {:>4} {:>4} {:>4} {:>4} {:>8.1f} {:>9.1f} {:>9.1f} {:>10.1f} {:>8.1f} {:>7.3f} {:>7.3f} {:>8} {:>6.0f} "
      "{:>6.0f} "
      "{:>4}/{:<4} {:>3}\n",
      s["set"].get<std::string>(), s["problems"].get<int>(), s["blocked_ends"].get<int>(), s["solved"].get<int>(),
      s["verified"].get<int>(), s["plan_us_median"].get<double>(), s["plan_us_mean"].get<double>(),
      s["plan_us_p95"].get<double>(), s["plan_us_max"].get<double>(), s["plan_and_shorten_us_median"].get<double>(),
      s["first_cost_median"].get<double>(), s["cost_median"].get<double>(), s["edges"].get<std::uint64_t>(),
      s["ns_an_edge"].get<double>(), s["ns_a_free_edge"].get<double>(), s["sampled_paths_collide"].get<int>(),
      s["sampled_solved"].get<int>(), s["sampled_first_paths_collide"].get<int>());
}

void write_csv(const std::string& file, const std::vector<Row>& rows) {
  std::ofstream out(file);
  out << "set,problem,outcome,verified,read_s,index_s,plan_s,shorten_s,first_cost,cost,edges,free_edges,edges_s,free_"
         "edges_s\n";
  for (const Row& r : rows) {
    out << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.set, r.name, r.outcome, r.verified ? 1 : 0,
                       r.read_s, r.index_s, r.plan_s, r.shorten_s, r.first_cost, r.cost, r.edges, r.free_edges,
                       r.edges_s, r.free_edges_s);
  }
}

int run_all(int argc, char** argv) {
  Settings settings;
  CLI::App app("An arm and folders of MoveIt problems");
  app.add_option("ROBOT", settings.robot, "its words, \"urdf FILE srdf FILE\"")->required();
  app.add_option("SET", settings.folders, "folders of sceneNNNN.yaml and requestNNNN.yaml")->required();
  app.add_option("--step", settings.options.step, "longest motion of a tree (default: the planner's)");
  app.add_option("--domain", settings.domain, "of vertices that failed, in steps; 0: none");
  app.add_option("--moving", settings.options.moving, "joints that a motion moves on average");
  app.add_option("--sampler", settings.sampler, "of the trees (default: the planner's)");
  app.add_option("--worth", settings.worth, "a round of shortening that takes off a smaller share is the last");
  app.add_option("--nodes", settings.options.nodes, "of both trees");
  app.add_option("--seed", settings.options.seed);
  app.add_option("--repeats", settings.repeats, "the least of so many is told");
  app.add_flag("--proved-alone", settings.proved_alone, "no paths by samples");
  app.add_option("--json", settings.json, "write the summaries here");
  app.add_option("--csv", settings.csv, "write a row a problem here");
  CLI11_PARSE(app, argc, argv);
  settings.options.sampler = enum_named<SamplerKind>(settings.sampler);
  settings.options.domain = settings.domain > 0.0 ? std::optional(settings.domain) : std::nullopt;
  const RobotSpec robot = robot_value("ROBOT", settings.robot);
  fmt::print(
      "{:<42} {:>4} {:>4} {:>4} {:>4} {:>8} {:>9} {:>9} {:>10} {:>8} {:>7} {:>7} {:>8} {:>6} {:>6} {:>9} {:>3}\n",
      "set", "of", "bad", "ok", "true", "plan us", "mean", "p95", "max", "+short", "first", "cost", "edges", "ns",
      "free", "collide", "1st");
  std::vector<Row> rows;
  nlohmann::ordered_json told = nlohmann::ordered_json::array();
  const auto tell = [&](const std::string& name, const std::vector<const Row*>& some) {
    told.push_back(summary(name, some));
    print(told.back());
  };
  for (const std::string& folder : settings.folders) {
    const std::string set = fs::path(folder).filename().string();
    const std::size_t first = rows.size();
    for (const fs::path& scene : scenes_of(folder)) rows.push_back(run(set, scene, robot, settings));
    std::vector<const Row*> some;
    for (std::size_t i = first; i < rows.size(); ++i) some.push_back(&rows[i]);
    tell(set, some);
  }
  std::vector<const Row*> all;
  for (const Row& row : rows) all.push_back(&row);
  tell("all", all);
  if (!settings.json.empty()) std::ofstream(settings.json) << told.dump(1) << '\n';
  if (!settings.csv.empty()) write_csv(settings.csv, rows);
  return 0;
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  try {
    return warren::run_all(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "arm_problems: {}\n", error.what());
    return 1;
  }
}
