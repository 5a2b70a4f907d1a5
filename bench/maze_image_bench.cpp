// SPDX-License-Identifier: BSD-3-Clause
// Images of mazes, (2 R + 1) pixels a side for R cells: reading them, and the shortest path by the grid planner, by a
// plain breadth-first search on the same bits, along the skeleton, and by roadmaps, which is what they cost where a
// search of the cells would do. All in one program, so that the times stand beside each other; lengths are compared
// with the plain search's before any clock.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/report.hpp"
#include "planners/grid/grid_search.hpp"
#include "planners/grid/skeleton_planner.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "worlds/plane/grid_world.hpp"

namespace warren::bench {
namespace {

/// A maze as an image has it: walls are lines of pixels, cells stand at odd coordinates.
OccupancyMap maze_image(std::uint32_t side) {
  const std::uint32_t cells = (side - 1) / 2;
  const Scene maze = maze_scene({.rows = cells, .cols = cells, .seed = 3}, true, {});
  OccupancyMap map;
  map.blocked = Bitmap(side, side);
  const auto pixel = [](double at) { return static_cast<std::uint32_t>(std::llround(2.0 * (at - 0.5))); };
  for (std::size_t i = 0; i < maze.walls.size(); ++i) {
    const Segment s = maze.walls.segment(i);
    const std::uint32_t x = pixel(std::min(s.a.x, s.b.x));
    const std::uint32_t last_x = pixel(std::max(s.a.x, s.b.x));
    for (std::uint32_t y = pixel(std::min(s.a.y, s.b.y)); y <= pixel(std::max(s.a.y, s.b.y)); ++y) {
      map.blocked.set_run(y, x, last_x + 1);
    }
  }
  map.occupied = map.blocked.count();
  map.free = map.blocked.size() - map.occupied;
  return map;
}

/// The maze of a side, made once.
const OccupancyMap& maze_of(std::uint32_t side) {
  static std::map<std::uint32_t, std::unique_ptr<OccupancyMap>> kept;
  auto& map = kept[side];
  if (!map) map = std::make_unique<OccupancyMap>(maze_image(side));
  return *map;
}

struct Ends {
  Cell start;
  Cell goal;
};
Ends ends_of(const OccupancyMap& map) { return {{1, map.height() - 2}, {map.width() - 2, 1}}; }

/// What anybody would write: a queue of cells, a parent's direction a cell.
std::size_t plain_bfs(const Bitmap& blocked, Cell start, Cell goal) {
  const std::uint32_t width = blocked.width();
  std::vector<std::uint8_t> from(blocked.size(), 0);
  std::vector<std::uint32_t> open;
  const auto number = [&](Cell c) { return c.y * width + c.x; };
  const std::uint32_t steps[] = {1, width, static_cast<std::uint32_t>(-1), static_cast<std::uint32_t>(0) - width};
  open.push_back(number(start));
  from[number(start)] = 5;
  for (std::size_t next = 0; next < open.size() && open[next] != number(goal); ++next) {
    const std::uint32_t at = open[next];
    for (std::uint8_t s = 0; s < 4; ++s) {
      const std::uint32_t to = at + steps[s];  // the border is blocked, so no step leaves the map
      if (from[to] != 0 || blocked.test(to % width, to / width)) continue;
      from[to] = s + 1;
      open.push_back(to);
    }
  }
  std::size_t length = 0;
  for (std::uint32_t at = number(goal); at != number(start); ++length) at -= steps[from[at] - 1];
  return length;
}

void bm_maze_plain_bfs(benchmark::State& state) {
  const OccupancyMap& map = maze_of(static_cast<std::uint32_t>(state.range(0)));
  const Ends ends = ends_of(map);
  for (auto _ : state) benchmark::DoNotOptimize(plain_bfs(map.blocked, ends.start, ends.goal));
  report(state, map.blocked.size(), map.blocked.bytes());
}

/// As `warren solve` does: the map made ready for searches, then breadth first.
void bm_maze_grid(benchmark::State& state) {
  const OccupancyMap& map = maze_of(static_cast<std::uint32_t>(state.range(0)));
  const Ends ends = ends_of(map);
  const GridSearchOptions options{Diagonal::sqrt2, GridMethod::bfs};
  const auto find = [&] { return GridSearch(map.blocked).find(ends.start, ends.goal, options, {}); };
  if (should_check(state)) {
    check(find().cells.size() == plain_bfs(map.blocked, ends.start, ends.goal) + 1, "the length by the grid planner");
  }
  for (auto _ : state) benchmark::DoNotOptimize(find().cost);
  report(state, map.blocked.size(), map.blocked.bytes());
}

void bm_maze_skeleton(benchmark::State& state) {
  const OccupancyMap& map = maze_of(static_cast<std::uint32_t>(state.range(0)));
  const Ends ends = ends_of(map);
  const auto find = [&] { return plan_on_skeleton({map.blocked, 0.0, {}}, ends.start, ends.goal, {}, {}); };
  if (should_check(state)) {
    check(find().path.size() == plain_bfs(map.blocked, ends.start, ends.goal) + 1,
          "the only way of a maze by its skeleton");
  }
  for (auto _ : state) benchmark::DoNotOptimize(find().clearance);
  report(state, map.blocked.size(), map.blocked.bytes());
}

/// range(1): the sampler; a roadmap that grows until it joins the ends, from the map in memory on.
void bm_maze_roadmap(benchmark::State& state) {
  const OccupancyMap& map = maze_of(static_cast<std::uint32_t>(state.range(0)));
  const Ends ends = ends_of(map);
  const auto sampler = static_cast<SamplerKind>(state.range(1));
  const RoadmapOptions options{.sampler = sampler};
  std::uint64_t milestones = 0;
  for (auto _ : state) {
    const GridWorld world(map, 0.0, {},
                          sampler == SamplerKind::corridor       ? MapMilestones::corridors
                          : sampler == SamplerKind::cell_centres ? MapMilestones::cell_centres
                                                                 : MapMilestones::anywhere);
    const auto solution =
        lazy_prm(WorldView(world), cell_centre(map, ends.start), cell_centre(map, ends.goal), options, {});
    milestones = solution.roadmap.milestones;
    if (solution.outcome != Outcome::solved) state.SkipWithError("the roadmap does not join the ends");
  }
  state.counters["milestones"] = static_cast<double>(milestones);
  report(state, map.blocked.size(), map.blocked.bytes());
}

void sides(benchmark::internal::Benchmark* bench) {
  bench->Arg(2001)->Arg(4001)->Arg(6001)->Unit(benchmark::kMillisecond);
}
BENCHMARK(bm_maze_plain_bfs)->Apply(sides);
BENCHMARK(bm_maze_grid)->Apply(sides);
BENCHMARK(bm_maze_skeleton)->Apply(sides)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(bm_maze_roadmap)
    ->ArgsProduct({{201, 1001, 2001, 4001, 6001}, {static_cast<int>(SamplerKind::cell_centres)}})
    ->ArgsProduct({{201, 1001, 2001},
                   {static_cast<int>(SamplerKind::corridor), static_cast<int>(SamplerKind::uniform)}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// A PGM of the maze, in a file of its own that goes with the program.
class MazeFile : NotCopied {
 public:
  explicit MazeFile(const OccupancyMap& map) : path_("/tmp/warren_bench_maze_" + std::to_string(map.width()) + ".pgm") {
    write_map_pgm(map, path_, UnknownCells::black, {});
  }
  ~MazeFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void bm_maze_read(benchmark::State& state) {
  const OccupancyMap& map = maze_of(static_cast<std::uint32_t>(state.range(0)));
  const MazeFile file(map);
  const auto read = [&] { return read_maze_image(InputFile(file.path(), {}), {}); };
  if (should_check(state)) check(read().blocked == map.blocked, "an image read back");
  for (auto _ : state) benchmark::DoNotOptimize(read().free);
  report(state, map.blocked.size(), map.blocked.size());
}
BENCHMARK(bm_maze_read)->Apply(sides);

}  // namespace
}  // namespace warren::bench
