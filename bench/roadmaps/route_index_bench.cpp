// SPDX-License-Identifier: BSD-3-Clause
// The route index of mazes of 1500 x 1500 cells, without loops, with 1 % and with 10 % of the walls left taken out:
// building it (items are cells), and asking for lengths and paths of random pairs (items are questions, or cells of
// paths). Answers are compared with a breadth-first search of all cells. Larger mazes, stage by stage: route_phases.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <vector>

#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "planners/lengths/core_graph.hpp"
#include "planners/lengths/route_index.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren::bench {
namespace {

constexpr std::uint32_t route_side = 1500;
constexpr LatticeSize route_lattice{route_side, route_side};

/// loops: in thousandths.
LatticePassages route_passages(std::int64_t loops) {
  MazeOptions maze{.rows = route_side, .cols = route_side};
  maze.loops = static_cast<double>(loops) / 1000.0;
  const Scene scene = maze_scene(maze, false, {});
  return wall_passages({scene.walls, {}, scene.bounds, 0.1, route_lattice}, {});
}

const RouteIndex& route_index(std::int64_t loops) {
  static std::map<std::int64_t, std::unique_ptr<RouteIndex>> built;
  auto& index = built[loops];
  if (!index) index = std::make_unique<RouteIndex>(route_passages(loops), RouteIndexOptions{}, Execution{});
  return *index;
}

CellId cell(SequentialRng& rng) { return static_cast<CellId>(rng.below(std::uint64_t{route_side} * route_side)); }

void check_against_flood(const RouteIndex& index) {
  const LatticePassages& passages = index.passages();
  SequentialRng rng(3);
  const CellId start = cell(rng);
  std::vector<std::uint32_t> steps(passages.cell_count(), ~0U);
  std::vector<CellId> queue{start};
  steps[start] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    passages.for_each_neighbour(queue[i], [&](CellId next) {
      if (steps[next] != ~0U) return;
      steps[next] = steps[queue[i]] + 1;
      queue.push_back(next);
    });
  }
  RouteQuery query(index);
  for (int i = 0; i < 1000; ++i) {
    const CellId goal = cell(rng);
    check(query.length(start, goal) == steps[goal], "length");
    if (i < 20) check(query.path(start, goal).size() == steps[goal] + 1U, "path");
  }
}

void bm_route_passages(benchmark::State& state) {
  MazeOptions maze{.rows = route_side, .cols = route_side};
  maze.loops = static_cast<double>(state.range(0)) / 1000.0;
  const Scene scene = maze_scene(maze, false, {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(wall_passages({scene.walls, {}, scene.bounds, 0.1, route_lattice}, {}));
  }
  report(state, std::size_t{route_side} * route_side, std::size_t{route_side} * route_side / 4);
}

void bm_route_build(benchmark::State& state) {
  const RouteIndex& index = route_index(state.range(0));
  if (should_check(state)) check_against_flood(index);
  for (auto _ : state) {
    state.PauseTiming();
    LatticePassages passages(route_lattice, ArrayOrView<std::uint64_t>(index.passages().right_words()),
                             ArrayOrView<std::uint64_t>(index.passages().up_words()));
    state.ResumeTiming();
    benchmark::DoNotOptimize(RouteIndex(std::move(passages), {}, {}));
  }
  std::size_t bytes = 0;
  for (const RouteSection& section : route_sections(index)) bytes += section.bytes.size();
  report(state, index.passages().cell_count(), bytes);
}

void bm_route_length(benchmark::State& state) {
  const RouteIndex& index = route_index(state.range(0));
  RouteQuery query(index);
  SequentialRng rng(7);
  for (auto _ : state) benchmark::DoNotOptimize(query.length(cell(rng), cell(rng)));
  report(state, 1, 0);
}

void bm_route_path(benchmark::State& state) {
  const RouteIndex& index = route_index(state.range(0));
  RouteQuery query(index);
  SequentialRng rng(7);
  std::size_t cells = 0;
  for (auto _ : state) cells += query.path(cell(rng), cell(rng)).size();
  state.SetItemsProcessed(static_cast<std::int64_t>(cells));
}

BENCHMARK(bm_route_passages)->Arg(0)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_route_build)->Arg(0)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_route_length)->Arg(0)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);
BENCHMARK(bm_route_path)->Arg(0)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace warren::bench
