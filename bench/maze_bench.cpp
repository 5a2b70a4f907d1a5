// SPDX-License-Identifier: BSD-3-Clause
// Mazes from seed to walls to file and back, on one thread: items are cells for generators and the flood, walls for the
// rest; "bytes/item" is what is held or written for each. Sizes are sides of square mazes. Each result is checked once
// before it is timed.
#include <benchmark/benchmark.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "bench/report.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren::bench {
namespace {

std::uint32_t side_of(const benchmark::State& state) { return static_cast<std::uint32_t>(state.range(0)); }

/// The maze of the last size asked for.
const Scene& scene_of(std::uint32_t side) {
  static Scene scene;
  if (!scene.maze || scene.maze->rows != side) scene = maze_scene({side, side, 1}, false, {});
  return scene;
}

/// A file in a directory of its own that goes with the program.
std::string scratch_file(const std::string& name) {
  struct Directory {
    std::string path = [] {
      std::string pattern = (std::filesystem::temp_directory_path() / "warren-bench-XXXXXX").string();
      check(::mkdtemp(pattern.data()) != nullptr, "a scratch directory");
      return pattern;
    }();
    ~Directory() { std::filesystem::remove_all(path); }
  };
  static const Directory directory;
  return directory.path + "/" + name;
}

template <MazeAlgorithm algorithm>
void bm_generate(benchmark::State& state) {
  const MazeOptions options{side_of(state), side_of(state), 1, algorithm, 0.0};
  const std::size_t cells = std::size_t{options.rows} * options.cols;
  const MazeCells maze = generate_maze(options, one_thread);
  if (should_check(state))
    check(maze_walls(maze, false, {}).size() == 4 + std::uint64_t{options.rows - 1} * (options.cols - 1),
          "generate_maze: walls of a perfect maze");
  for (auto _ : state) benchmark::DoNotOptimize(generate_maze(options, one_thread).bytes().data());
  report(state, cells, maze.bytes().size());
}
BENCHMARK(bm_generate<MazeAlgorithm::backtracker>)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_generate<MazeAlgorithm::kruskal>)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_generate<MazeAlgorithm::prim>)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_generate<MazeAlgorithm::wilson>)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_generate<MazeAlgorithm::course>)->Arg(300)->Unit(benchmark::kMillisecond);

void bm_walls(benchmark::State& state, bool merged) {
  const MazeCells maze = generate_maze({side_of(state), side_of(state), 1}, {});
  const WallSet walls = maze_walls(maze, merged, {});
  const MazeCells back = cells_of_walls(walls, {side_of(state), side_of(state)}, {});
  if (should_check(state))
    check(std::equal(maze.bytes().begin(), maze.bytes().end(), back.bytes().begin()), "maze_walls");
  for (auto _ : state) benchmark::DoNotOptimize(maze_walls(maze, merged, one_thread).size());
  report(state, walls.size(), walls.bytes());
}
void bm_unit_walls(benchmark::State& state) { bm_walls(state, false); }
void bm_merged_walls(benchmark::State& state) { bm_walls(state, true); }
BENCHMARK(bm_unit_walls)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_merged_walls)->Arg(2000)->Unit(benchmark::kMillisecond);

void bm_cells_of_walls(benchmark::State& state) {
  const Scene& scene = scene_of(side_of(state));
  const MazeCells maze = generate_maze({side_of(state), side_of(state), 1}, {});
  const MazeCells back = cells_of_walls(scene.walls, *scene.maze, {});
  if (should_check(state))
    check(std::equal(maze.bytes().begin(), maze.bytes().end(), back.bytes().begin()), "cells_of_walls");
  for (auto _ : state) benchmark::DoNotOptimize(cells_of_walls(scene.walls, *scene.maze, one_thread).bytes().data());
  report(state, scene.walls.size(), back.bytes().size());
}
BENCHMARK(bm_cells_of_walls)->Arg(2000)->Unit(benchmark::kMillisecond);

void bm_flood(benchmark::State& state) {
  const std::uint32_t side = side_of(state);
  const MazeCells maze = generate_maze({side, side, 1}, {});
  if (should_check(state)) check(flood_connects(maze, {0, 0}, {side - 1, side - 1}, {}), "flood_connects");
  for (auto _ : state) benchmark::DoNotOptimize(flood_connects(maze, {0, 0}, {side - 1, side - 1}, one_thread));
  report(state, maze.cell_count(), maze.bytes().size());
}
BENCHMARK(bm_flood)->Arg(2000)->Unit(benchmark::kMillisecond);

void bm_hash(benchmark::State& state) {
  const Scene& scene = scene_of(side_of(state));
  if (should_check(state)) check(scene_hash(scene, one_thread) == scene_hash(scene), "scene_hash on one thread");
  for (auto _ : state) benchmark::DoNotOptimize(scene_hash(scene, one_thread));
  report(state, scene.walls.size(), scene.walls.bytes());
}
BENCHMARK(bm_hash)->Arg(2000)->Unit(benchmark::kMillisecond);

void bm_write(benchmark::State& state, const std::string& name) {
  const Scene& scene = scene_of(side_of(state));
  const std::string path = scratch_file(name);
  for (auto _ : state) write_scene(scene, path, one_thread);
  if (should_check(state)) check(scene_hash(read_world(path, {})) == scene_hash(scene), "a world read back");
  report(state, scene.walls.size(), std::filesystem::file_size(path));
}
void bm_read(benchmark::State& state, const std::string& name) {
  const Scene& scene = scene_of(side_of(state));
  const std::string path = scratch_file(name);
  if (is_first_call(state)) write_scene(scene, path, {});
  if (should_check(state)) check(scene_hash(read_world(path, {})) == scene_hash(scene), "a world read back");
  for (auto _ : state) benchmark::DoNotOptimize(read_world(path, one_thread).walls.size());
  report(state, scene.walls.size(), scene.walls.bytes());
}
void bm_write_text(benchmark::State& state) { bm_write(state, "maze.walls"); }
void bm_read_text(benchmark::State& state) { bm_read(state, "maze.walls"); }
void bm_write_npy(benchmark::State& state) { bm_write(state, "maze.npy"); }
void bm_read_npy(benchmark::State& state) { bm_read(state, "maze.npy"); }
BENCHMARK(bm_write_text)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_read_text)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_write_npy)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_read_npy)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren::bench
