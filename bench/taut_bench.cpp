// SPDX-License-Identifier: BSD-3-Clause
// Pulling maze paths taut: time a door (a step of the raw path from cell to cell), and what random shortcutting reaches
// in 64 sweeps (a sweep: one try a point of the path; two random places on the path, joined where that is free). Items
// are doors. Every path is verified.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "planners/shorten/taut_path.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "verify/judges/verify_point.hpp"

namespace {

using namespace warren;

constexpr double clearance = 0.1;
constexpr double planning_clearance = clearance * (1.0 + 1e-9);

/// Cell to cell from start to goal, breadth first.
Path<Vec2> cell_path(const MazeCells& maze) {
  const std::uint32_t cols = maze.cols();
  const std::uint32_t last = maze.rows() * cols - 1;
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> parent(last + std::size_t{1}, none);
  std::vector<std::uint32_t> queue{last};
  parent[last] = last;
  for (std::size_t i = 0; i < queue.size() && parent[0] == none; ++i) {
    const std::uint32_t id = queue[i];
    const std::uint32_t c = id % cols;
    const std::uint32_t r = id / cols;
    const auto reach = [&](bool open, std::uint32_t next) {
      if (!open || parent[next] != none) return;
      parent[next] = id;
      queue.push_back(next);
    };
    if (c + 1 < cols) reach(!maze.wall_right(c, r), id + 1);
    if (r + 1 < maze.rows()) reach(!maze.wall_above(c, r), id + cols);
    if (c > 0) reach(!maze.wall_right(c - 1, r), id - 1);
    if (r > 0) reach(!maze.wall_above(c, r - 1), id - cols);
  }
  Path<Vec2> path{{0.5, 1.0}};
  for (std::uint32_t id = 0;; id = parent[id]) {
    path.push_back({1.0 + id % cols, 1.0 + id / cols});
    if (id == last) break;
  }
  path.push_back({cols + 0.5, static_cast<double>(maze.rows())});
  return path;
}

double length_of(const Path<Vec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

struct TautCase {
  explicit TautCase(std::uint32_t size) {
    MazeOptions options;
    options.rows = options.cols = size;
    scene = maze_scene(options, false, {});
    raw = cell_path(generate_maze(options, {}));
  }
  Scene scene;
  Path<Vec2> raw;
};

void report_path(benchmark::State& state, const TautCase& c, const Path<Vec2>& path) {
  VerifyOptions options;
  options.clearance = clearance;
  if (!verify_path(c.scene, path, options, {}).verified) state.SkipWithError("the path is not free");
  bench::report(state, c.raw.size(), (c.raw.size() + path.size()) * sizeof(Vec2));
  state.counters["doors"] = static_cast<double>(c.raw.size());
  state.counters["length"] = length_of(path);
  state.counters["of_raw"] = length_of(path) / length_of(c.raw);
  state.counters["per_door"] = benchmark::Counter(
      static_cast<double>(c.raw.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void bm_taut_path(benchmark::State& state) {
  const TautCase c(static_cast<std::uint32_t>(state.range(0)));
  const WallIndex index(c.scene.walls, {});
  Execution execution;
  execution.threads = 1;
  Path<Vec2> path;
  for (auto _ : state) path = taut_path(index, c.raw, planning_clearance, execution);
  report_path(state, c, path);
}
BENCHMARK(bm_taut_path)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);

/// One sweep: as many tries as the path has points; places at most 30 points apart, since farther ones never see
/// each other in a maze.
void shortcut_sweep(const WallIndex& index, Path<Vec2>& path, SequentialRng& rng) {
  const auto unit = [&] { return static_cast<double>(rng.below(1U << 30)) * 0x1p-30; };
  for (std::size_t tries = path.size(); tries-- > 0;) {
    const std::size_t i = rng.below(path.size() - 1);
    const std::size_t j = std::min(i + 1 + rng.below(30), path.size() - 2);
    if (j <= i) continue;
    const Vec2 p = path[i] + unit() * (path[i + 1] - path[i]);
    const Vec2 q = path[j] + unit() * (path[j + 1] - path[j]);
    if (!index.keeps_clearance(p, q, planning_clearance)) continue;
    path[i + 1] = p;
    if (j == i + 1) {
      path.insert(path.begin() + static_cast<std::ptrdiff_t>(j) + 1, q);
    } else {
      path[i + 2] = q;
      path.erase(path.begin() + static_cast<std::ptrdiff_t>(i) + 3, path.begin() + static_cast<std::ptrdiff_t>(j) + 1);
    }
  }
}

void bm_random_shortcuts(benchmark::State& state) {
  const TautCase c(static_cast<std::uint32_t>(state.range(0)));
  const WallIndex index(c.scene.walls, {});
  Path<Vec2> path;
  for (auto _ : state) {
    path = c.raw;
    SequentialRng rng(1);
    for (int sweep = 0; sweep < 64; ++sweep) shortcut_sweep(index, path, rng);
  }
  report_path(state, c, path);
}
BENCHMARK(bm_random_shortcuts)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace
