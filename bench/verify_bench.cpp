// SPDX-License-Identifier: BSD-3-Clause
// Verification of a shortest path through a lattice maze of unit walls: nanoseconds of CPU a wall, on one thread.
#include "worlds/verify.hpp"

#include <benchmark/benchmark.h>

#include "planners/tiled_prm.hpp"
#include "worlds/maze_generator.hpp"

namespace {

using namespace warren;

void verify_maze(benchmark::State& state) {
  Execution execution;
  execution.threads = 1;
  MazeOptions maze;
  maze.rows = maze.cols = static_cast<std::uint32_t>(state.range(0));
  const Scene scene = maze_scene(maze, false, execution);
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = {maze.rows, maze.cols};
  const Vec2 start{scene.start[0], scene.start[1]};
  const Vec2 goal{scene.goal[0], scene.goal[1]};
  const TiledProblem problem{scene.walls, {}, obstacle_box(scene), 0.1, start, goal};
  const Solution<Vec2> solution = tiled_prm(problem, options, execution);
  const VerifyOptions checks{.clearance = 0.1, .start = start, .goal = goal};
  for (auto _ : state) {
    const Verification verification = verify_path(scene, solution.path, checks, execution);
    if (!verification.verified) state.SkipWithError("the path is not free");
  }
  const auto walls = static_cast<double>(scene.walls.size());
  state.counters["s_a_wall"] = benchmark::Counter(
      walls, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);  // shown as 39n: 39 ns
}
BENCHMARK(verify_maze)->Arg(41)->Arg(1000)->Arg(3000)->Unit(benchmark::kMillisecond);

}  // namespace
