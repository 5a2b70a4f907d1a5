// SPDX-License-Identifier: BSD-3-Clause
// Verification of a shortest path through a lattice maze of unit walls, on one thread and on two. Items are walls; the
// path is verified first, and one that touches a wall must be refused. Of a hundred legs of it, by a pass over all
// walls and by an index of them: items are points.
#include "verify/judges/verify_point.hpp"

#include <benchmark/benchmark.h>

#include "bench/report.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren::bench {
namespace {

struct VerifyCase {
  Scene scene;
  Path<Vec2> path;
  VerifyOptions options;
};

/// The maze that was asked for last, with its path.
const VerifyCase& case_of(std::int64_t algorithm, std::int64_t side) {
  static VerifyCase kept;
  static std::pair<std::int64_t, std::int64_t> built{-1, -1};
  if (built == std::pair{algorithm, side}) return kept;
  built = {algorithm, side};
  const auto extent = static_cast<std::uint32_t>(side);
  kept.scene = maze_scene({extent, extent, 1, static_cast<MazeAlgorithm>(algorithm), 0.0}, false, {});
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = {extent, extent};
  const Vec2 start{kept.scene.start[0], kept.scene.start[1]};
  const Vec2 goal{kept.scene.goal[0], kept.scene.goal[1]};
  const TiledProblem problem{kept.scene.walls, {}, obstacle_box(kept.scene), 0.1, start, goal};
  kept.path = tiled_prm(problem, options, {}).path;
  kept.options = {.clearance = 0.1, .start = start, .goal = goal};
  return kept;
}

/// The path is free; with a point moved to the end of a wall it isn't, and that leg is the first bad one.
void check_verdicts(const VerifyCase& c, const Execution& execution) {
  check(verify_path(c.scene, c.path, c.options, execution).verified, "verify_path");
  Path<Vec2> bent = c.path;
  const std::size_t moved = bent.size() / 2;
  bent[moved] = bent[moved] + Vec2{0.5, 0.5};
  const Verification refused = verify_path(c.scene, bent, c.options, execution);
  check(refused.first_violation && refused.first_violation->leg == moved - 1,
        "verify_path: a path that touches a wall");
}

void bm_verify_path(benchmark::State& state) {
  const VerifyCase& c = case_of(state.range(0), state.range(1));
  const Execution execution{.threads = static_cast<unsigned>(state.range(2))};
  if (should_check(state)) check_verdicts(c, execution);
  for (auto _ : state) benchmark::DoNotOptimize(verify_path(c.scene, c.path, c.options, execution).verified);
  report(state, c.scene.walls.size(), c.scene.walls.bytes() + c.path.size() * sizeof(Vec2));
}

/// A hundred legs of the path: what a roadmap is asked again and again.
struct ShortCase {
  const VerifyCase& maze;
  Path<Vec2> path;
  VerifyOptions options;

  explicit ShortCase(const VerifyCase& whole) : maze(whole), options{.clearance = 0.1} {
    const auto middle = whole.path.begin() + static_cast<std::ptrdiff_t>(whole.path.size() / 2);
    path.assign(middle, middle + 101);
  }
};

void bm_verify_short_path(benchmark::State& state) {
  const ShortCase c(case_of(state.range(0), state.range(1)));
  const Execution execution{.threads = 1};
  for (auto _ : state) benchmark::DoNotOptimize(verify_path(c.maze.scene, c.path, c.options, execution).verified);
  report(state, c.path.size(), c.path.size() * sizeof(Vec2));
}

void bm_verify_short_path_by_index(benchmark::State& state) {
  const ShortCase c(case_of(state.range(0), state.range(1)));
  const Execution execution{.threads = 1};
  const ObstacleIndex index(c.maze.scene, execution);
  const Verification pass = verify_path(c.maze.scene, c.path, c.options, execution);
  const Verification indexed = verify_path(c.maze.scene, c.path, c.options, execution, &index);
  check(indexed.verified && indexed.min_clearance == pass.min_clearance, "verify_path by the index");
  for (auto _ : state)
    benchmark::DoNotOptimize(verify_path(c.maze.scene, c.path, c.options, execution, &index).verified);
  report(state, c.path.size(), c.path.size() * sizeof(Vec2));
}

void bm_index_obstacles(benchmark::State& state) {
  const VerifyCase& c = case_of(state.range(0), state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(ObstacleIndex(c.scene, {.threads = 1}).sides().size());
  report(state, c.scene.walls.size(), c.scene.walls.bytes());
}

constexpr auto backtracker = static_cast<std::int64_t>(MazeAlgorithm::backtracker);
constexpr auto kruskal = static_cast<std::int64_t>(MazeAlgorithm::kruskal);
BENCHMARK(bm_verify_path)
    ->ArgNames({"algorithm", "side", "threads"})
    ->Args({backtracker, 41, 1})
    ->ArgsProduct({{backtracker}, {1000, 2000}, {1, 2}})
    ->Args({kruskal, 1000, 1})
    ->Apply(over_threads);
BENCHMARK(bm_verify_short_path)->ArgNames({"algorithm", "side"})->Args({backtracker, 1000});
BENCHMARK(bm_verify_short_path_by_index)->ArgNames({"algorithm", "side"})->Args({backtracker, 1000});
BENCHMARK(bm_index_obstacles)->ArgNames({"algorithm", "side"})->Args({backtracker, 1000});

}  // namespace
}  // namespace warren::bench
