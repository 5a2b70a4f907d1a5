// SPDX-License-Identifier: BSD-3-Clause
// Visibility graphs: the sweep beside checking every pair against every side, linking start and goal, the search alone,
// and a lazy query. Worlds of disjoint polygons from a seed; range(0): polygons (7.5 corners each). The search alone in
// the dense world of tests/data too, whose figures are known.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/plane/geometry.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/scene/polygon_generator.hpp"

namespace warren::bench {
namespace {

struct World {
  explicit World(std::int64_t polygons) {
    PolygonOptions options;
    options.count = static_cast<std::uint64_t>(polygons);
    take(polygon_scene(options, {}));
  }
  explicit World(const Scene& scene) { take(scene); }
  void take(const Scene& scene) {
    obstacles = plane_obstacles(scene, {});
    start = {scene.start[0], scene.start[1]};
    goal = {scene.goal[0], scene.goal[1]};
  }
  PlaneObstacles obstacles;
  Vec2 start, goal;
};

/// Every pair of corners against every side; the world is in general position but for the polygons' own corners, so a
/// pair is joined if it crosses no side and its middle lies in no polygon.
std::uint64_t edges_by_brute_force(const PlaneObstacles& obstacles) {
  std::vector<Segment> sides;
  for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
    const auto ring = obstacles.polygons[p];
    for (std::size_t i = 0; i < ring.size(); ++i) sides.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
  const auto is_free = [&](const Segment& s) {
    const Vec2 middle = 0.5 * (s.a + s.b);
    bool inside = false;
    for (const Segment& side : sides) {
      if (segments_cross(s, side)) return false;
      if ((side.a.y <= middle.y) == (side.b.y <= middle.y)) continue;
      if ((orient2d(side.a, side.b, middle) > 0) == (side.a.y <= middle.y)) inside = !inside;
    }
    return !inside;
  };
  std::uint64_t edges = 0;
  const auto& corners = obstacles.polygons.corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) edges += is_free({corners[i], corners[j]}) ? 1 : 0;
  }
  return edges;
}

void bm_brute_force(benchmark::State& state) {
  const World world(state.range(0));
  std::uint64_t edges = 0;
  for (auto _ : state) benchmark::DoNotOptimize(edges = edges_by_brute_force(world.obstacles));
  state.counters["edges"] = static_cast<double>(edges);
}

void bm_build(benchmark::State& state) {
  const World world(state.range(0));
  const auto which = state.range(1) == 0 ? VisibilityEdges::reduced : VisibilityEdges::full;
  Execution execution;
  execution.threads = 1;
  std::size_t edges = 0;
  for (auto _ : state) {
    const VisibleCorners corners(world.obstacles, execution);
    edges = VisibilityGraph(corners, which, execution).graph().edge_count();
  }
  state.counters["edges"] = static_cast<double>(edges);
}

void bm_link(benchmark::State& state) {
  const World world(state.range(0));
  const VisibleCorners corners(world.obstacles, {});
  const VisibilityGraph visibility(corners, VisibilityEdges::reduced, {});
  for (auto _ : state) benchmark::DoNotOptimize(visibility.link(world.start, world.goal, {}));
}

void time_search(benchmark::State& state, const World& world, VisibilityEdges edges, bool informed) {
  const VisibleCorners corners(world.obstacles, {});
  const VisibilityGraph visibility(corners, edges, {});
  const VisibilityLinks links = visibility.link(world.start, world.goal, {});
  SearchState search;
  std::uint64_t settled = 0;
  const SearchKind kind = informed ? SearchKind::astar : SearchKind::dijkstra;
  for (auto _ : state) settled = visibility.search(links, kind, QueueKind::heap, search, {}).expanded;
  state.counters["settled"] = static_cast<double>(settled);
}

void bm_search(benchmark::State& state) {
  time_search(state, World(state.range(0)), state.range(1) == 0 ? VisibilityEdges::reduced : VisibilityEdges::full,
              true);
}

/// range(0): 0 Dijkstra, 1 A*.
void bm_search_dense(benchmark::State& state) {
  const std::string path = WARREN_SOURCE_DIR "/tests/data/dense.scene";
  time_search(state, World(read_scene_text(InputFile(path, {}), {})), VisibilityEdges::full, state.range(0) == 1);
}

void bm_lazy(benchmark::State& state) {
  const World world(state.range(0));
  for (auto _ : state) {
    const VisibleCorners corners(world.obstacles, {});
    Counters counters;
    benchmark::DoNotOptimize(lazy_visibility_search(corners, world.start, world.goal, {}, counters));
  }
}

BENCHMARK(bm_brute_force)->Arg(7)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_build)->ArgsProduct({{7, 100, 1300}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(bm_link)->Arg(7)->Arg(1300)->Unit(benchmark::kMicrosecond);
BENCHMARK(bm_search)->ArgsProduct({{7, 1300}, {0, 1}})->Unit(benchmark::kMicrosecond);
BENCHMARK(bm_search_dense)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(bm_lazy)->Arg(1300)->Arg(13000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren::bench
