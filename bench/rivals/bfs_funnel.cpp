// SPDX-License-Identifier: BSD-3-Clause
// warren beside what somebody writes who knows that the walls are a maze: cells read back from the walls, breadth-first
// search, funnel (apps/studies/largest_maze.hpp). The same walls for both, from memory to path; the contestants
// take turns, the least of each counts. In a perfect maze there is one corridor, so warren's lattice path, pulled taut
// with next to no clearance, must be as long as the funnel's: that is compared, to the millionth part. warren's own
// path is timed with and without that, and verified outside of the clock.
//   rival_bfs_funnel [SIDE [REPEATS [THREADS]]]
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/studies/largest_maze.hpp"
#include "bench/rivals/stopwatch.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "planners/shorten/taut_path.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "spatial/obstacles/wall_index.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

constexpr double clearance = 0.1;

struct RivalTimes {
  CpuWall best{1e300, 1e300};
  void take(const CpuWall& now) { best = {std::min(best.cpu_s, now.cpu_s), std::min(best.wall_s, now.wall_s)}; }
};

double length_of(const Path<Vec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

Path<Vec2> plan(const Scene& scene, double kept, const Execution& execution) {
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = {scene.maze->rows, scene.maze->cols};
  const TiledProblem problem{scene.walls,
                             {},
                             obstacle_box(scene, execution),
                             kept,
                             {scene.start[0], scene.start[1]},
                             {scene.goal[0], scene.goal[1]}};
  return tiled_prm(problem, options, execution).path;
}

/// The lattice path pulled taut with next to no clearance: the string that the funnel gives.
Path<Vec2> plan_taut(const Scene& scene, const Execution& execution) {
  const Path<Vec2> path = plan(scene, 0.0, execution);
  const WallIndex index(scene.walls, execution);
  return taut_path(index, path, 0.0, execution);
}

void check_verified(const Scene& scene, const Path<Vec2>& path, double kept) {
  VerifyOptions options;
  options.clearance = kept;
  if (path.empty() || !verify_path(scene, path, options, {}).verified)
    throw std::runtime_error("warren's path is not verified");
}

void check_same(double length, double funnel) {
  if (!(std::abs(length - funnel) <= 1e-6 * funnel)) throw std::runtime_error("the taut lengths differ");
}

void print(const char* name, const RivalTimes& times, double cells, double length, const RivalTimes& bar) {
  std::printf("%-38s %10.3f %10.3f %8.1f %12.2f %8.2f\n", name, 1e3 * times.best.cpu_s, 1e3 * times.best.wall_s,
              1e9 * times.best.cpu_s / cells, length, times.best.cpu_s / bar.best.cpu_s);
}

void compare(std::uint32_t side, MazeAlgorithm algorithm, int repeats, const Execution& execution) {
  const Scene scene = maze_scene({side, side, 1, algorithm, 0.0}, false, execution);
  RivalTimes funnel_times, plan_times, taut_times;
  double funnel_length = 0.0, plan_length = 0.0, taut_length = 0.0;
  for (int i = 0; i < repeats; ++i) {
    const auto timed = [&](RivalTimes& times, const auto& run) {
      const Stopwatch watch;
      Path<Vec2> path = run();
      times.take(watch.read());
      return path;
    };
    funnel_length = length_of(timed(funnel_times, [&] { return studies::bfs_funnel(scene, execution); }));
    const auto planned = timed(plan_times, [&] { return plan(scene, clearance, execution); });
    const auto taut = timed(taut_times, [&] { return plan_taut(scene, execution); });
    plan_length = length_of(planned);
    taut_length = length_of(taut);
    check_same(taut_length, funnel_length);
    check_verified(scene, planned, clearance);
    check_verified(scene, taut, 0.0);
  }
  const double cells = static_cast<double>(side) * side;
  std::printf("%s, %u x %u\n", std::string(name_of(algorithm)).c_str(), side, side);
  print("  BFS + funnel, knows the grid", funnel_times, cells, funnel_length, funnel_times);
  print("  warren prm, lattice, clearance 0.1", plan_times, cells, plan_length, funnel_times);
  print("  warren prm, lattice, pulled taut", taut_times, cells, taut_length, funnel_times);
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  using namespace warren;
  const auto number = [&](int i, unsigned long usual) { return argc > i ? std::strtoul(argv[i], nullptr, 10) : usual; };
  const unsigned long side = number(1, 1000);
  const unsigned long repeats = number(2, 5);
  if (side < 2 || side > 30'000 || repeats < 1 || repeats > 1000) {
    std::fprintf(stderr, "usage: rival_bfs_funnel [SIDE [REPEATS [THREADS]]], sides 2 to 30000\n");
    return 2;
  }
  const Execution execution{.threads = static_cast<unsigned>(number(3, 1))};
  std::printf("%-38s %10s %10s %8s %12s %8s\n", "contestant", "cpu ms", "wall ms", "ns/cell", "length", "ratio");
  try {
    for (const MazeAlgorithm algorithm : {MazeAlgorithm::backtracker, MazeAlgorithm::kruskal}) {
      compare(static_cast<std::uint32_t>(side), algorithm, static_cast<int>(repeats), execution);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rival_bfs_funnel: %s\n", error.what());
    return 1;
  }
  return 0;
}
