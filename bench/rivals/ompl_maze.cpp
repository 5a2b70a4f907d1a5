// SPDX-License-Identifier: BSD-3-Clause
// warren beside OMPL's PRM on the same mazes, one thread each, 0.1 clearance all along the edges, the same collision
// check behind both (bench/rivals/ompl_prm.hpp). Two pairs:
//   uniform   random milestones until start and goal connect: prm and lazy_prm with auto options, og::PRM with defaults
//   lattice   one milestone a cell: prm on cell centres, tile by tile as `warren solve` does and in plain stages;
//             og::PRM with cells handed over in random order (its neighbour tree is 2 to 5 times slower in row order),
//             exact centres and jittered ones
// The contestants take turns, maze by maze and repeat by repeat. Each is timed from walls in memory to path found, the
// wall index included; every path is verified outside of the clock. CPU seconds of the process; ratios are of medians.
#include <fmt/core.h>
#include <ompl/util/Console.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "bench/rivals/ompl_prm.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/shorten/taut_path.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

constexpr double clearance = 0.1;

struct BenchOptions {
  std::vector<std::uint32_t> uniform_sizes = {45};
  std::vector<std::uint32_t> lattice_sizes = {45, 101, 301, 1001};
  std::uint64_t mazes = 15;   ///< seeds 1 .. mazes; fewer for large mazes, so that no row takes minutes
  std::uint64_t repeats = 3;  ///< runs of each contestant on each maze; 1 for large mazes
  std::string algorithm = "backtracker";
  double limit_s = 60.0;  ///< wall-clock seconds that og::PRM::solve may take
  std::string json;
};

struct Maze {
  Scene scene;
  Vec2 start;
  Vec2 goal;
  LatticeSize size;
  double optimum =
      0.0;  ///< shortest length with the clearance, at most 0.22 % too long (planners/shorten/taut_path.hpp)
};

struct Contestant {
  std::string name;
  std::function<RivalRun(const Maze&, std::uint64_t seed)> run;
  std::vector<RivalRun> runs = {};
  std::vector<double> lengths = {};       ///< of the solved runs
  std::vector<double> over_optimum = {};  ///< the same over the maze's optimum
};

using Planner = Solution<Vec2> (*)(const AnyWorld<Vec2>&, const Vec2&, const Vec2&, const RoadmapOptions&,
                                   const Execution&, PlannedRoadmap<Vec2>*);

Execution one_thread() {
  Execution execution;
  execution.threads = 1;
  return execution;
}

/// A perfect maze has one corridor, so any path pulled taut is the optimum.
double optimum_of(const Maze& maze) {
  const MazeWorld world(maze.scene, clearance, one_thread());
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = maze.size;
  const Solution<Vec2> walk = lazy_prm(WorldView(world), maze.start, maze.goal, options, one_thread());
  const Path<Vec2> taut = taut_path(world.walls(), walk.path, clearance, one_thread());
  return path_length(taut, [](Vec2 a, Vec2 b) { return distance(a, b); });
}

Maze make_maze(std::uint32_t side, std::uint64_t seed, const std::string& algorithm) {
  const MazeOptions options{side, side, seed, maze_algorithm_named(algorithm), 0.0};
  Maze maze;
  maze.scene = maze_scene(options, false, one_thread());
  maze.start = {maze.scene.start[0], maze.scene.start[1]};
  maze.goal = {maze.scene.goal[0], maze.scene.goal[1]};
  maze.size = {side, side};
  maze.optimum = optimum_of(maze);
  return maze;
}

RivalRun run_warren(Planner plan, SamplerKind sampler, const Maze& maze, std::uint64_t seed) {
  const Stopwatch stopwatch;
  const MazeWorld world(maze.scene, clearance, one_thread());
  RoadmapOptions options;
  options.sampler = sampler;
  options.lattice = maze.size;
  options.seed = seed;
  Solution<Vec2> solution = plan(WorldView(world), maze.start, maze.goal, options, one_thread(), nullptr);
  RivalRun run;
  run.seconds = stopwatch.read();
  run.path = std::move(solution.path);
  run.milestones = solution.roadmap.milestones;
  run.edges = solution.roadmap.edges;
  return run;
}

Contestant warren_contestant(std::string name, Planner plan, SamplerKind sampler) {
  return {std::move(name), [=](const Maze& maze, std::uint64_t seed) { return run_warren(plan, sampler, maze, seed); }};
}

/// What `warren solve` does with a maze: the same roadmap, tile by tile.
RivalRun run_tiles(const Maze& maze) {
  const Stopwatch stopwatch;
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = maze.size;
  const TiledProblem problem{maze.scene.walls, {},         obstacle_box(maze.scene, one_thread()),
                             clearance,        maze.start, maze.goal};
  Solution<Vec2> solution = tiled_prm(problem, options, one_thread());
  RivalRun run;
  run.seconds = stopwatch.read();
  run.path = std::move(solution.path);
  run.milestones = solution.roadmap.milestones;
  run.edges = solution.roadmap.edges;
  return run;
}

/// Adds the time of the wall index, which OMPL's side needs as much as ours.
template <class Run>
RivalRun run_ompl(const Maze& maze, const Run& run_in) {
  const Stopwatch stopwatch;
  const MazeWorld world(maze.scene, clearance, one_thread());
  const CpuWall index = stopwatch.read();
  RivalRun run = run_in(world);
  run.seconds = {run.seconds.cpu_s + index.cpu_s, run.seconds.wall_s + index.wall_s};
  return run;
}

Contestant ompl_default_contestant(double limit_s) {
  return {"OMPL PRM, defaults", [=](const Maze& maze, std::uint64_t) {
            return run_ompl(
                maze, [&](const MazeWorld& world) { return ompl_default_prm(world, maze.start, maze.goal, limit_s); });
          }};
}

Contestant ompl_cell_contestant(std::string name, double jitter) {
  return {std::move(name), [=](const Maze& maze, std::uint64_t seed) {
            return run_ompl(maze, [&](const MazeWorld& world) {
              return ompl_cell_prm(world, maze.start, maze.goal, maze.size, jitter, seed);
            });
          }};
}

/// Length of a verified path. Throws if it isn't one: then the table would compare something else than planners.
double verified_length(const Maze& maze, const RivalRun& run, const std::string& name) {
  VerifyOptions options;
  options.clearance = clearance;
  const Verification found = verify_path(maze.scene, run.path, options, one_thread());
  const bool joins = run.path.front() == maze.start && run.path.back() == maze.goal;
  if (!found.verified || !joins) throw std::runtime_error(name + ": the path is not verified");
  return found.length;
}

void run_in_turns(std::vector<Contestant>& contestants, const Maze& maze, std::uint64_t repeats, std::uint64_t seed) {
  for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
    for (Contestant& contestant : contestants) {
      RivalRun run = contestant.run(maze, seed * 1000 + repeat);
      if (!run.path.empty()) {
        contestant.lengths.push_back(verified_length(maze, run, contestant.name));
        contestant.over_optimum.push_back(contestant.lengths.back() / maze.optimum);
      }
      run.path.clear();
      contestant.runs.push_back(std::move(run));
    }
  }
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

template <class Value>
std::vector<double> each(const std::vector<RivalRun>& runs, const Value& value) {
  std::vector<double> values;
  for (const RivalRun& run : runs) values.push_back(value(run));
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

nlohmann::ordered_json row_of(const Contestant& contestant) {
  const std::vector<double> cpu = each(contestant.runs, [](const RivalRun& run) { return run.seconds.cpu_s; });
  return {{"name", contestant.name},
          {"runs", contestant.runs.size()},
          {"solved", contestant.lengths.size()},
          {"cpu_s", {{"min", *std::min_element(cpu.begin(), cpu.end())}, {"median", median(cpu)}}},
          {"wall_s", median(each(contestant.runs, [](const RivalRun& run) { return run.seconds.wall_s; }))},
          {"mean_length", mean(contestant.lengths)},
          {"mean_length_over_optimum", mean(contestant.over_optimum)},
          {"milestones", median(each(contestant.runs, [](const RivalRun& run) { return 1.0 * run.milestones; }))},
          {"edges", median(each(contestant.runs, [](const RivalRun& run) { return 1.0 * run.edges; }))}};
}

/// Prints a pair and returns it; the last contestant is the rival that the ratios refer to.
nlohmann::ordered_json report(const std::string& pair, std::uint32_t side, const std::vector<Contestant>& contestants) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Contestant& contestant : contestants) rows.push_back(row_of(contestant));
  const double rival_s = rows.back()["cpu_s"]["median"];
  for (auto& row : rows) {
    const double median_s = row["cpu_s"]["median"];
    row["times_faster"] = rival_s / median_s;
    fmt::print("{:<8} {:>4}x{:<4} {:<26} {:>3}/{:<3} {:>11.3f} {:>11.3f} {:>8.1f} {:>10.1f} {:>7.3f} {:>9}\n", pair,
               side, side, row["name"].get<std::string>(), row["solved"].get<int>(), row["runs"].get<int>(),
               1e3 * row["cpu_s"]["min"].get<double>(), 1e3 * median_s, row["times_faster"].get<double>(),
               row["mean_length"].get<double>(), row["mean_length_over_optimum"].get<double>(),
               row["milestones"].get<double>());
  }
  std::fflush(stdout);
  return {{"pair", pair}, {"rows", side}, {"cols", side}, {"contestants", rows}};
}

nlohmann::ordered_json compare(const std::string& pair, std::uint32_t side, std::vector<Contestant> contestants,
                               const BenchOptions& options) {
  const std::uint64_t mazes = side > 500 ? 1 : side > 200 ? std::min<std::uint64_t>(3, options.mazes) : options.mazes;
  const std::uint64_t repeats = side > 500 ? 1 : options.repeats;
  for (std::uint64_t seed = 1; seed <= mazes; ++seed) {
    run_in_turns(contestants, make_maze(side, seed, options.algorithm), repeats, seed);
  }
  return report(pair, side, contestants);
}

nlohmann::ordered_json compare_all(const BenchOptions& options) {
  fmt::print("{:<8} {:^9} {:<26} {:>7} {:>11} {:>11} {:>8} {:>10} {:>7} {:>9}\n", "pair", "maze", "planner", "solved",
             "min cpu ms", "med cpu ms", "faster", "length", "/opt", "milestones");
  nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
  for (const std::uint32_t side : options.uniform_sizes) {
    pairs.push_back(compare("uniform", side,
                            {warren_contestant("warren lazy-prm, auto", lazy_prm<Vec2>, SamplerKind::uniform),
                             warren_contestant("warren prm, auto", prm<Vec2>, SamplerKind::uniform),
                             ompl_default_contestant(options.limit_s)},
                            options));
  }
  for (const std::uint32_t side : options.lattice_sizes) {
    pairs.push_back(compare("lattice", side,
                            {{"warren prm", [](const Maze& maze, std::uint64_t) { return run_tiles(maze); }},
                             warren_contestant("warren prm, plain stages", prm<Vec2>, SamplerKind::lattice),
                             warren_contestant("warren lazy-prm", lazy_prm<Vec2>, SamplerKind::lattice),
                             ompl_cell_contestant("OMPL PRM, cell centres", 0.0),
                             ompl_cell_contestant("OMPL PRM, jittered cells", 0.2)},
                            options));
  }
  return {{"schema", "warren.rival/1"}, {"rival", "OMPL PRM"}, {"algorithm", options.algorithm},
          {"clearance", clearance},     {"verified", true},    {"pairs", pairs}};
}

int run_bench(int argc, char** argv) {
  BenchOptions options;
  CLI::App app("warren beside OMPL's PRM on mazes");
  app.add_option("--uniform", options.uniform_sizes, "sides of the mazes with random milestones")->delimiter(',');
  app.add_option("--lattice", options.lattice_sizes, "sides of the mazes with a milestone a cell")->delimiter(',');
  app.add_option("--mazes", options.mazes, "mazes a row")->check(CLI::Range(1, 1000));
  app.add_option("--repeats", options.repeats, "runs on each maze")->check(CLI::Range(1, 1000));
  app.add_option("--algorithm", options.algorithm, "maze generator");
  app.add_option("--limit", options.limit_s, "wall-clock seconds for OMPL's solve");
  app.add_option("--json", options.json, "write the figures here as well");
  CLI11_PARSE(app, argc, argv);
  ompl::msg::noOutputHandler();
  const nlohmann::ordered_json figures = compare_all(options);
  if (!options.json.empty()) std::ofstream(options.json) << figures.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  try {
    return warren::run_bench(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rival_ompl_maze: {}\n", error.what());
    return 1;
  }
}
