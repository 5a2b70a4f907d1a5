// SPDX-License-Identifier: BSD-3-Clause
// Kept roadmaps of sampled milestones: 110,000 samples in a maze of 110 x 110 cells with 10 % loops, without an index
// (0) and with one (1): built, opened from a file with a first question, asked, asked in a batch, and updated where one
// wall has gone. bench/rivals/ompl_kept_roadmap.cpp has the rivals.
#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/kept/ask_batch_io.hpp"
#include "solve/kept/roadmap_file_io.hpp"

namespace warren::bench {
namespace {

constexpr std::uint32_t kept_side = 110;
constexpr std::uint64_t kept_samples = 110'000;
constexpr std::size_t kept_questions = 256;

Scene kept_maze() {
  MazeOptions maze{kept_side, kept_side, 1};
  maze.loops = 0.1;
  return maze_scene(maze, false, {});
}

Roadmap kept_roadmap(bool index) {
  SolveOptions options{.planner = PlannerKind::prm, .sampler = SamplerKind::uniform};
  options.roadmap.samples = kept_samples;
  return build(kept_maze(), {}, options, {}, index ? IndexChoice::where_it_pays : IndexChoice::none);
}

const Roadmap& shared_roadmap(bool index) {
  static std::array<std::optional<Roadmap>, 2> built;
  auto& roadmap = built[index ? 1 : 0];
  if (!roadmap) roadmap = kept_roadmap(index);
  return *roadmap;
}

/// Free places: milestones, and a little beside them.
std::array<std::vector<double>, 2> kept_question(const Roadmap& roadmap, SequentialRng& rng) {
  std::array<std::vector<double>, 2> ends;
  for (auto& end : ends) {
    const auto state = roadmap.arrays.parts().state(static_cast<VertexId>(rng.below(count_states(roadmap))));
    end.assign(state.begin(), state.end());
  }
  return ends;
}

std::string beside_temporary(const char* name) { return (std::filesystem::temp_directory_path() / name).string(); }

void bm_kept_build(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(kept_roadmap(state.range(0) == 1).samples);
  report(state, kept_samples, 0);
}

void bm_kept_open(benchmark::State& state) {
  const std::string file = beside_temporary("warren_bench_kept.roadmap");
  write_roadmap(shared_roadmap(state.range(0) == 1), file);
  for (auto _ : state) {
    const Roadmap roadmap = read_roadmap(file);
    QuestionScratch scratch;
    const Execution execution;
    const RoadmapQuery query(roadmap, execution, Questions::one);
    benchmark::DoNotOptimize(query.ask_within({}, {}, {}, execution, scratch).length);
  }
  report(state, kept_samples, std::filesystem::file_size(file));
  std::filesystem::remove(file);
}

void bm_kept_query(benchmark::State& state) {
  const Roadmap& roadmap = shared_roadmap(true);
  const RoadmapQuery query(roadmap);
  const RoadmapSearchFields by_search{.search = SearchMethod::astar};
  const RoadmapSearchFields how = state.range(0) == 1 ? RoadmapSearchFields{} : by_search;
  QuestionScratch scratch;
  SequentialRng rng(7);
  if (should_check(state)) {
    for (int i = 0; i < 20; ++i) {
      const auto [start, goal] = kept_question(roadmap, rng);
      check(query.ask_within(start, goal, {}, one_thread, scratch).path ==
                query.ask_within(start, goal, by_search, one_thread, scratch).path,
            "path of a kept roadmap");
    }
  }
  for (auto _ : state) {
    const auto [start, goal] = kept_question(roadmap, rng);
    benchmark::DoNotOptimize(query.ask_within(start, goal, how, one_thread, scratch).length);
  }
  report(state, 1, 0);
}

void bm_kept_batch(benchmark::State& state) {
  const Roadmap& roadmap = shared_roadmap(state.range(0) == 1);
  const std::string file = beside_temporary("warren_bench_kept.csv");
  std::string text = "start_x,start_y,goal_x,goal_y\n";
  SequentialRng rng(7);
  for (std::size_t i = 0; i < kept_questions; ++i) {
    const auto [start, goal] = kept_question(roadmap, rng);
    text += fmt::format("{},{},{},{}\n", start[0], start[1], goal[0], goal[1]);
  }
  write_file(file, text, {});
  const RoadmapQuery query(roadmap);
  const InputFile questions(file, {});
  for (auto _ : state) {
    std::size_t bytes = 0;
    ask_batch(query, questions, {}, {}, [&](std::string_view lines) { bytes += lines.size(); });
    benchmark::DoNotOptimize(bytes);
  }
  report(state, kept_questions, 0);
  std::filesystem::remove(file);
}

void bm_kept_update(benchmark::State& state) {
  const Roadmap& roadmap = shared_roadmap(state.range(0) == 1);
  Scene now = kept_maze();
  std::vector<Segment> walls;
  for (std::size_t i = 1; i < now.walls.size(); ++i) walls.push_back(now.walls.segment(i));
  now.walls = WallSet::narrowest(walls);
  for (auto _ : state) benchmark::DoNotOptimize(update(roadmap, now, {}).samples);
  report(state, kept_samples, 0);
}

BENCHMARK(bm_kept_build)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_kept_open)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_kept_query)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(bm_kept_batch)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_kept_update)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace warren::bench
