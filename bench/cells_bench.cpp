// SPDX-License-Identifier: BSD-3-Clause
// Vertical cells and medial axes of many small polygons. Items are corners. The decomposition is checked against the
// formulas (V + k + 1 cells, V + 2 k doors) before it is timed.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/base/rng.hpp"
#include "planners/axis/medial_axis.hpp"
#include "planners/vertical_cells/cell_planner.hpp"

namespace warren::bench {
namespace {

/// About `corners` corners: stars of ten corners each in the squares of a lattice, which is turned a little, so that no
/// two corners have the same x. Lattice polygons on integers instead where `aligned`.
PlaneObstacles stars(std::int64_t corners, bool aligned) {
  const auto side = static_cast<std::int64_t>(std::sqrt(static_cast<double>(corners) / 10.0));
  PlaneObstacles obstacles;
  const double turn = aligned ? 0.0 : 0.3;
  for (std::int64_t i = 0; i < side * side; ++i) {
    const Vec2 square{static_cast<double>(i % side), static_cast<double>(i / side)};
    const Vec2 center{square.x * std::cos(turn) - square.y * std::sin(turn),
                      square.x * std::sin(turn) + square.y * std::cos(turn)};
    std::array<Vec2, 10> outline;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / 10.0;
      const double arm = aligned ? 0.4 : 0.1 + 0.38 * uniform(1, static_cast<std::uint64_t>(i), k);
      outline[k] = center + Vec2{arm * std::cos(angle), arm * std::sin(angle)};
    }
    obstacles.polygons.add(outline);
  }
  Box box;
  for (const Vec2 p : obstacles.polygons.corners) box.include(p);
  obstacles.bounds = box.grown(1.0);
  return obstacles;
}

const PlaneObstacles& stars_of(const benchmark::State& state) {
  static PlaneObstacles built;
  static std::pair<std::int64_t, std::int64_t> key{0, 0};
  if (key != std::pair{state.range(0), state.range(1)}) {
    built = stars(state.range(0), state.range(1) != 0);
    key = {state.range(0), state.range(1)};
  }
  return built;
}

void decomposition(benchmark::State& state) {
  const PlaneObstacles& obstacles = stars_of(state);
  const std::size_t corners = obstacles.polygons.corners.size();
  const CellDecomposition checked = decompose(obstacles, {}, {});
  if (checked.cells.size() != corners + obstacles.polygons.size() + 1) std::abort();
  if (checked.doors.size() != corners + 2 * obstacles.polygons.size()) std::abort();
  for (auto _ : state) benchmark::DoNotOptimize(decompose(obstacles, {}, {}).cells.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(corners));
}
BENCHMARK(decomposition)->ArgsProduct({{10'000, 100'000, 1'000'000}, {0, 1}})->Unit(benchmark::kMillisecond);

void plan_cells(benchmark::State& state) {
  const PlaneObstacles& obstacles = stars_of(state);
  const Box& box = *obstacles.bounds;
  const CellOptions options{.doors = static_cast<DoorKind>(state.range(3)),
                            .search = static_cast<SearchKind>(state.range(2))};
  for (auto _ : state) {
    const Solution<Vec2> s = plan_through_cells(obstacles, box.min, box.max, options, {});
    if (s.outcome != Outcome::solved) std::abort();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(obstacles.polygons.corners.size()));
}
BENCHMARK(plan_cells)
    ->ArgsProduct({{1'000'000},
                   {0},
                   {static_cast<int>(SearchKind::astar), static_cast<int>(SearchKind::dijkstra),
                    static_cast<int>(SearchKind::dfs)},
                   {static_cast<int>(DoorKind::midpoint)}})
    ->ArgsProduct({{100'000, 1'000'000},
                   {0},
                   {static_cast<int>(SearchKind::astar)},
                   {static_cast<int>(DoorKind::funnel)}})  // the shortest path of all; Dijkstra takes minutes
    ->Unit(benchmark::kMillisecond);

void medial_axis(benchmark::State& state) {
  const PlaneObstacles& obstacles = stars_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(MedialAxis(obstacles, {}).edges.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(obstacles.polygons.corners.size()));
}
BENCHMARK(medial_axis)->ArgsProduct({{10'000, 100'000}, {0}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren::bench
