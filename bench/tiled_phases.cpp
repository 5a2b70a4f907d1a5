// SPDX-License-Identifier: BSD-3-Clause
// The tiled roadmap phase by phase: CPU nanoseconds a cell (both threads together) and wall seconds, from walls in
// memory to a verified path.
//   tiled_phases [SIZE] [THREADS] [ALGORITHM] [LOOPS] [REPEATS] [natural|shuffled|merged]
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/base/page_pool.hpp"
#include "core/base/rng.hpp"
#include "planners/mazes/overlay.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "verify/judges/verify_point.hpp"

namespace {

using namespace warren;

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

WallSet shuffled(const WallSet& walls) {
  return walls.visit([]<class Wall>(std::span<const Wall> given) {
    RawVector<Wall> mixed(given.begin(), given.end());
    SequentialRng rng(7);
    for (std::size_t i = mixed.size(); i > 1; --i) std::swap(mixed[i - 1], mixed[rng.below(i)]);
    return WallSet(std::move(mixed));
  });
}

/// The parts of a tile, one thread, by process CPU time.
void print_tile_parts(const Scene& scene, LatticeSize lattice) {
  constexpr double clearance = 0.1 * (1 + 1e-9);
  const double cells = static_cast<double>(lattice.rows) * lattice.cols;
  Execution one;
  one.threads = 1;
  const TileGrid grid = TileGrid::of(lattice);
  const double begin = cpu_seconds();
  const WallPartition partition(scene.walls, {}, grid, 1.11, one);
  const double filed = cpu_seconds();
  WallMarker marker(clearance);
  TilePlane plane(grid, marker.margin());
  TileReduction reduction(plane);
  const Box box = obstacle_box(scene);
  double reset_s = 0, mark_s = 0, reduce_s = 0;
  std::size_t keys = 0, chains = 0, steps = 0, bytes = 0;
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  for (std::size_t tile = 0; tile < grid.count(); ++tile) {
    const auto t0 = now();
    plane.reset(tile, box);
    const auto t1 = now();
    marker.mark(partition.of(tile), plane);
    const auto t2 = now();
    const TileSummary summary = reduction.reduce(plane);
    const auto t3 = now();
    reset_s += t1 - t0;
    mark_s += t2 - t1;
    reduce_s += t3 - t2;
    keys += summary.keys.size();
    chains += summary.chains.size();
    steps += summary.steps.size();
    bytes += summary.bytes();
  }
  const double scale = 1e9 / cells;
  std::printf(
      "one thread, CPU ns/cell: partition %.2f, reset %.2f, mark %.2f, reduce %.2f; per 1000 cells %.1f keys %.1f "
      "chains %.1f steps %.1f bytes\n",
      (filed - begin) * 1e9 / cells, reset_s * scale, mark_s * scale, reduce_s * scale, 1e3 * keys / cells,
      1e3 * chains / cells, 1e3 * steps / cells, 1e3 * bytes / cells);
}

}  // namespace

int main(int argc, char** argv) {
  const PagePool pool;  // from the second repeat on, memory has been touched
  const auto argument = [&](int i, const char* otherwise) { return std::string(i < argc ? argv[i] : otherwise); };
  MazeOptions maze;
  maze.rows = maze.cols = static_cast<std::uint32_t>(std::stoul(argument(1, "1000")));
  Execution execution;
  execution.threads = static_cast<unsigned>(std::stoul(argument(2, "1")));
  maze.algorithm = maze_algorithm_named(argument(3, "backtracker"));
  maze.loops = std::stod(argument(4, "0"));
  const int repeats = std::stoi(argument(5, "3"));
  const std::string order = argument(6, "natural");
  Scene scene = maze_scene(maze, order == "merged", execution);
  if (order == "shuffled") scene.walls = shuffled(scene.walls);
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = {maze.rows, maze.cols};
  const double cells = static_cast<double>(maze.rows) * maze.cols;
  print_tile_parts(scene, options.lattice);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double cpu = cpu_seconds();
    const double begin = wall_seconds();
    const Vec2 start{scene.start[0], scene.start[1]};
    const Vec2 goal{scene.goal[0], scene.goal[1]};
    const TiledProblem problem{scene.walls, {}, obstacle_box(scene), 0.1, start, goal};
    const double boxed = wall_seconds();
    const double boxed_cpu = cpu_seconds();
    const Solution<Vec2> solution = tiled_prm(problem, options, execution);
    const double solved = wall_seconds();
    const double solved_cpu = cpu_seconds();
    const Verification verification = verify_path(scene, solution.path, {.clearance = 0.1}, execution);
    const double end = wall_seconds();
    const double end_cpu = cpu_seconds();
    const auto& s = solution.seconds;
    const auto ns = [&](double seconds) { return seconds * 1e9 / cells; };
    std::printf("%s %s: length %.1f, %llu expanded, %llu components, peak %.2f GiB\n",
                std::string(name_of(solution.outcome)).c_str(), verification.verified ? "verified" : "NOT VERIFIED",
                verification.length, static_cast<unsigned long long>(solution.counters.expanded),
                static_cast<unsigned long long>(solution.roadmap.components),
                static_cast<double>(peak_resident_bytes()) / (1 << 30));
    std::printf("  wall s %.4f: box %.4f index %.4f tiles %.4f overlay %.4f peel %.4f search %.4f verify %.4f\n",
                end - begin, boxed - begin, s.index, s.connect, s.graph, s.reduce, s.search, end - solved);
    std::printf("  wall ns/cell %.2f: box %.2f index %.2f tiles %.2f overlay %.2f peel %.2f search %.2f verify %.2f\n",
                ns(end - begin), ns(boxed - begin), ns(s.index), ns(s.connect), ns(s.graph), ns(s.reduce), ns(s.search),
                ns(end - solved));
    std::printf("  CPU ns/cell %.2f: box %.2f plan %.2f verify %.2f\n", ns(end_cpu - cpu), ns(boxed_cpu - cpu),
                ns(solved_cpu - boxed_cpu), ns(end_cpu - solved_cpu));
  }
}
