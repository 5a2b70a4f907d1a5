// SPDX-License-Identifier: BSD-3-Clause
// The tiled roadmap phase by phase: CPU nanoseconds a cell (both threads together) and wall seconds, from walls in
// memory to a verified path.
//   tiled_phases [SIZE] [THREADS] [ALGORITHM] [LOOPS] [REPEATS] [natural|shuffled|merged]
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/rng.hpp"
#include "planners/tiled_prm.hpp"
#include "worlds/maze_generator.hpp"
#include "worlds/verify.hpp"

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
  RawVector<FloatWall> mixed;
  walls.visit([&](auto given) {
    for (const auto& w : given) {
      const Segment s = w.segment();
      mixed.push_back(
          {static_cast<float>(s.a.x), static_cast<float>(s.a.y), static_cast<float>(s.b.x), static_cast<float>(s.b.y)});
    }
  });
  SequentialRng rng(7);
  for (std::size_t i = mixed.size(); i > 1; --i) std::swap(mixed[i - 1], mixed[rng.below(i)]);
  return WallSet(std::move(mixed));
}

}  // namespace

int main(int argc, char** argv) {
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
