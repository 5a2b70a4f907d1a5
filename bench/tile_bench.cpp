// SPDX-License-Identifier: BSD-3-Clause
// The tiled lattice: filing walls by tile, clearing what they block, peeling and contracting a tile, and the whole plan
// beside the plain pipeline. Items are walls (partition) or cells. Marks are compared with the wall index, edge by
// edge; the whole plan with the plain one. Phases of one large run: tiled_phases.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "planners/roadmap/prm.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "verify/judges/verify_point.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren::bench {
namespace {

enum WallsOf : int { backtracker, kruskal, kruskal_loops, merged, shuffled };
constexpr double clearance = 0.1;
constexpr double halo = 1.11;  // an edge and its clearance

WallSet mixed(const WallSet& walls) {
  std::vector<Segment> segments;
  walls.visit([&](auto given) {
    for (const auto& w : given) segments.push_back(w.segment());
  });
  SequentialRng rng(7);
  for (std::size_t i = segments.size(); i > 1; --i) std::swap(segments[i - 1], segments[rng.below(i)]);
  return WallSet::narrowest(segments);
}

/// The maze that was asked for last.
const Scene& scene_of(std::int64_t kind, std::int64_t side) {
  static Scene scene;
  static std::pair<std::int64_t, std::int64_t> built{-1, -1};
  if (built == std::pair{kind, side}) return scene;
  MazeOptions maze;
  maze.rows = maze.cols = static_cast<std::uint32_t>(side);
  maze.algorithm = kind == kruskal || kind == kruskal_loops ? MazeAlgorithm::kruskal : MazeAlgorithm::backtracker;
  maze.loops = kind == kruskal_loops ? 0.1 : 0.0;
  scene = maze_scene(maze, kind == merged, {});
  if (kind == shuffled) scene.walls = mixed(scene.walls);
  built = {kind, side};
  return scene;
}

LatticeSize lattice_of(const Scene& scene) { return {scene.maze->rows, scene.maze->cols}; }
std::size_t cells_of(const Scene& scene) { return std::size_t{scene.maze->rows} * scene.maze->cols; }

void bm_partition(benchmark::State& state) {
  const Scene& scene = scene_of(state.range(0), 2000);
  const TileGrid grid = TileGrid::of(lattice_of(scene));
  const Execution execution{.threads = static_cast<unsigned>(state.range(1))};
  const WallPartition filed(scene.walls, {}, grid, halo, execution);
  std::size_t bytes = 0;
  std::size_t entries = 0;
  for (std::size_t tile = 0; tile < grid.count(); ++tile) {
    const TileWalls walls = filed.of(tile);
    bytes += walls.narrow.size_bytes() + walls.wide.size_bytes();
    entries += walls.narrow.size() + walls.wide.size();
  }
  check(entries >= scene.walls.size(), "WallPartition: walls are missing");
  for (auto _ : state) {
    const WallPartition partition(scene.walls, {}, grid, halo, execution);
    benchmark::DoNotOptimize(partition.of(0).narrow.data());
  }
  report(state, scene.walls.size(), bytes);
}

/// A tile in the middle of the maze, with its walls.
struct TileCase {
  explicit TileCase(const Scene& of)
      : scene(of),
        grid(TileGrid::of(lattice_of(of))),
        box(obstacle_box(of)),
        tile(grid.count() / 2 + grid.tile_cols / 2),
        partition(of.walls, {}, grid, halo, one_thread),
        marker(clearance * (1.0 + 1e-9)),
        plane(grid, marker.margin()) {}

  void reset() { plane.reset(tile, box); }
  void mark() { marker.mark(partition.of(tile), plane); }
  std::size_t cells() const { return std::size_t{grid.width(tile)} * grid.height(tile); }

  const Scene& scene;
  TileGrid grid;
  Box box;
  std::size_t tile;
  WallPartition partition;
  WallMarker marker;
  TilePlane plane;
};

/// Free edges to the right and upwards from this point, as the wall index has them.
std::uint8_t indexed_edges(const TileCase& c, const WallIndex& index, int col, int row) {
  const Vec2 at = TileGrid::point(c.grid.first_col(c.tile) + col, c.grid.first_row(c.tile) + row);
  const double kept = clearance * (1.0 + 1e-9);
  const auto bit = [&](Vec2 step, std::uint8_t name) {
    return index.keeps_clearance(at, at + step, kept) ? name : std::uint8_t{0};
  };
  return bit({1.0, 0.0}, plane_bit::right) | bit({0.0, 1.0}, plane_bit::up);
}

void check_marks(TileCase& c) {
  const WallIndex index(c.scene.walls, {});
  c.reset();
  c.mark();
  for (int row = 0; row + 1 < c.plane.height(); ++row) {
    for (int col = 0; col + 1 < c.plane.width(); ++col) {
      const unsigned marked = *c.plane.at(col, row) & (plane_bit::right | plane_bit::up);
      check(marked == indexed_edges(c, index, col, row), "WallMarker");
    }
  }
}

void bm_mark_tile(benchmark::State& state) {
  TileCase c(scene_of(state.range(0), 2000));
  if (should_check(state)) check_marks(c);
  for (auto _ : state) {
    c.reset();
    c.mark();
    benchmark::DoNotOptimize(c.plane.at(0, 0));
  }
  report(state, c.cells(), c.cells() + c.partition.of(c.tile).narrow.size_bytes());
}

/// Peel and chains. Putting the plane back is not in the time.
void bm_reduce_tile(benchmark::State& state) {
  TileCase c(scene_of(state.range(0), 2000));
  c.reset();
  c.mark();
  const TilePlane marked = c.plane;
  TileReduction reduction(c.plane);
  TileSummary summary = reduction.reduce(c.plane);
  check(summary.milestones == c.cells(), "TileReduction: milestones of a maze");
  for (auto _ : state) {
    state.PauseTiming();
    c.plane = marked;
    state.ResumeTiming();
    summary = reduction.reduce(c.plane);
    benchmark::DoNotOptimize(summary.keys.data());
  }
  report(state, c.cells(), summary.bytes());
  state.counters["keys/item"] = static_cast<double>(summary.keys.size()) / static_cast<double>(c.cells());
}

struct Ends {
  Vec2 start;
  Vec2 goal;
};
Ends ends_of(const Scene& scene) { return {{scene.start[0], scene.start[1]}, {scene.goal[0], scene.goal[1]}}; }

RoadmapOptions lattice_options(const Scene& scene) {
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = lattice_of(scene);
  return options;
}

Solution<Vec2> plan_in_tiles(const Scene& scene, const Execution& execution) {
  const Ends ends = ends_of(scene);
  const TiledProblem problem{scene.walls, {}, obstacle_box(scene, execution), clearance, ends.start, ends.goal};
  return tiled_prm(problem, lattice_options(scene), execution);
}
Solution<Vec2> plan_plainly(const Scene& scene, const Execution& execution) {
  const MazeWorld world(scene, clearance, execution);
  const Ends ends = ends_of(scene);
  return prm(WorldView(world), ends.start, ends.goal, lattice_options(scene), execution);
}

double length_of(const Path<Vec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

void check_plan(const Solution<Vec2>& tiled, const Solution<Vec2>& plain) {
  check(tiled.outcome == Outcome::solved && plain.outcome == Outcome::solved, "tiled_prm: outcome");
  check(std::abs(length_of(tiled.path) - length_of(plain.path)) <= 1e-12 * length_of(plain.path), "tiled_prm: length");
  check(tiled.roadmap.milestones == plain.roadmap.milestones && tiled.roadmap.edges == plain.roadmap.edges &&
            tiled.roadmap.components == plain.roadmap.components,
        "tiled_prm: roadmap");
}

/// From walls in memory to path found. Bytes are those of walls and path.
template <class Plan>
void time_plan(benchmark::State& state, const Scene& scene, const Plan& plan) {
  std::size_t path_bytes = 0;
  for (auto _ : state) path_bytes = plan().path.size() * sizeof(Vec2);
  report(state, cells_of(scene), scene.walls.bytes() + path_bytes);
}
void bm_tiled_plan(benchmark::State& state) {
  const Scene& scene = scene_of(state.range(0), state.range(1));
  const Execution execution{.threads = static_cast<unsigned>(state.range(2))};
  if (should_check(state)) check_plan(plan_in_tiles(scene, execution), plan_plainly(scene, {}));
  time_plan(state, scene, [&] { return plan_in_tiles(scene, execution); });
}
void bm_plain_plan(benchmark::State& state) {
  const Scene& scene = scene_of(state.range(0), state.range(1));
  const Execution execution{.threads = static_cast<unsigned>(state.range(2))};
  if (should_check(state)) check_plan(plan_in_tiles(scene, {}), plan_plainly(scene, execution));
  time_plan(state, scene, [&] { return plan_plainly(scene, execution); });
}

/// From walls in memory to path verified, as `warren solve` does it; the limit is watched by bench/rounds.py.
void bm_walls_to_verified_path(benchmark::State& state) {
  const Scene& scene = scene_of(state.range(0), state.range(1));
  bool is_verified = true;
  for (auto _ : state) {
    const Solution<Vec2> solution = plan_in_tiles(scene, {});
    is_verified = is_verified && verify_path(scene, solution.path, {.clearance = clearance}, {}).verified;
  }
  check(is_verified, "tiled_prm: a path that is not free");
  report(state, cells_of(scene), scene.walls.bytes());
  state.counters["limit_ms"] = 1.0;
}

BENCHMARK(bm_partition)
    ->ArgNames({"walls", "threads"})
    ->ArgsProduct({{backtracker, merged, shuffled}, {1}})
    ->Args({backtracker, 2})
    ->Apply(over_threads);
BENCHMARK(bm_mark_tile)->ArgName("walls")->DenseRange(backtracker, shuffled)->Unit(benchmark::kMicrosecond);
BENCHMARK(bm_reduce_tile)->ArgName("walls")->DenseRange(backtracker, kruskal_loops)->Unit(benchmark::kMicrosecond);
BENCHMARK(bm_tiled_plan)
    ->ArgNames({"walls", "side", "threads"})
    ->Args({backtracker, 41, 2})
    ->ArgsProduct({{backtracker}, {1000}, {1, 2}})
    ->ArgsProduct({{kruskal, kruskal_loops, merged, shuffled}, {1000}, {2}})
    ->Apply(over_threads);
BENCHMARK(bm_walls_to_verified_path)
    ->ArgNames({"walls", "side"})
    ->ArgsProduct({{backtracker, kruskal, kruskal_loops}, {41}})
    ->Apply(over_threads);
BENCHMARK(bm_plain_plan)
    ->ArgNames({"walls", "side", "threads"})
    ->Args({backtracker, 41, 2})
    ->ArgsProduct({{backtracker}, {1000}, {1, 2}})
    ->Apply(over_threads);
}  // namespace
}  // namespace warren::bench
