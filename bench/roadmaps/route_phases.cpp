// SPDX-License-Identifier: BSD-3-Clause
// The route index stage by stage: seconds and CPU seconds (all threads together), from walls in memory to the index;
// then bytes a cell, and how long random pairs take to answer.
//   route_phases [SIZE] [ALGORITHM] [LOOPS] [THREADS] [QUESTIONS]
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

#include "core/base/page_pool.hpp"
#include "core/base/rng.hpp"
#include "planners/lengths/core_graph.hpp"
#include "planners/lengths/route_index.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace {

using namespace warren;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Of this thread, whoever else uses the cores.
double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

class Phases {
 public:
  void end(const char* name) {
    std::printf("%-10s %7.2f s %7.2f s of CPU\n", name, seconds_now() - wall_, cpu_seconds() - cpu_);
    std::fflush(stdout);
    wall_ = seconds_now();
    cpu_ = cpu_seconds();
  }

 private:
  double wall_ = seconds_now();
  double cpu_ = cpu_seconds();
};

void print_stages(const LatticePassages& passages, const Execution& execution) {
  const double cells = static_cast<double>(passages.cell_count());
  const LatticePlaces places(passages.size());
  Phases phases;
  RawVector<std::uint8_t> peeled = peel(passages, places, execution);
  phases.end("peel");
  CoreGraph graph = core_graph(peeled, places, execution);
  phases.end("core");
  reduce_core(graph, places, peeled, execution);
  phases.end("reduce");
  const RawVector<std::uint64_t> marks = mark_words(peeled, places, execution);
  phases.end("marks");
  const PieceArrays pieces = build_pieces(places, CellMarks(marks.data()), execution);
  phases.end("pieces");
  const Dissection dissection = dissect(graph, 32, execution);
  phases.end("dissect");
  const FrontArrays fronts = build_fronts(graph, dissection, execution);
  phases.end("fronts");
  std::uint32_t largest = 0;
  for (const Front& front : fronts.fronts.span()) largest = std::max(largest, front.gates);
  std::printf("of the cells: core %.4f, junctions %.4f, gates %.4f; largest cut %u gates\n",
              static_cast<double>(graph.core_cells) / cells, static_cast<double>(graph.size()) / cells,
              static_cast<double>(fronts.gate_place.size()) / cells, largest);
}

/// Lengths by themselves first: a path of millions of cells empties the caches.
void print_answers(const RouteIndex& index, std::size_t questions) {
  RouteQuery query(index);
  SequentialRng rng(5);
  const auto cell = [&] { return static_cast<CellId>(rng.below(index.passages().cell_count())); };
  std::vector<double> seconds(questions);
  for (double& second : seconds) {
    const CellId start = cell();
    const CellId goal = cell();
    const double begin = seconds_now();
    query.length(start, goal);
    second = seconds_now() - begin;
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("length: median %.1f us, 99 %% %.1f us\n", seconds[questions / 2] * 1e6,
              seconds[questions * 99 / 100] * 1e6);
  double more = 0;
  double cells = 0;
  for (std::size_t i = 0; i < questions / 10; ++i) {
    const CellId start = cell();
    const CellId goal = cell();
    const double begin = thread_seconds();
    const auto length = query.length(start, goal);
    const double asked = thread_seconds();
    const std::size_t size = query.path(start, goal).size();
    more += thread_seconds() - asked - (asked - begin);
    cells += static_cast<double>(size);
    if (size != (length ? *length + 1U : 0U)) std::printf("WRONG: %u to %u\n", start, goal);
  }
  std::printf("path: %.1f ns of CPU a cell more, %.0f cells\n", more / cells * 1e9,
              10 * cells / static_cast<double>(questions));
}

}  // namespace

int main(int argc, char** argv) {
  const PagePool pages;  // as solve's Limits have it
  const auto word = [&](int i, const char* otherwise) { return argc > i ? argv[i] : otherwise; };
  MazeOptions maze;
  maze.rows = maze.cols = static_cast<std::uint32_t>(std::atoi(word(1, "2000")));
  maze.algorithm = maze_algorithm_named(word(2, "backtracker"));
  maze.loops = std::atof(word(3, "0"));
  const Execution execution{.threads = static_cast<unsigned>(std::atoi(word(4, "0")))};
  std::optional<LatticePassages> passages;
  {
    const Scene scene = maze_scene(maze, false, execution);
    Phases phases;
    passages.emplace(wall_passages({scene.walls, {}, scene.bounds, 0.1, {maze.rows, maze.cols}}, execution));
    phases.end("passages");
  }
  print_stages(*passages, execution);
  Phases phases;
  const RouteIndex index(std::move(*passages), {}, execution);
  phases.end("whole");
  const double cells = static_cast<double>(index.passages().cell_count());
  std::size_t bytes = 0;
  for (const RouteSection& s : route_sections(index)) bytes += s.bytes.size();
  std::printf("%.3f bytes a cell:\n", static_cast<double>(bytes) / cells);
  for (const RouteSection& s : route_sections(index)) {
    std::printf("  %-15.*s %.4f\n", static_cast<int>(s.name.size()), s.name.data(),
                static_cast<double>(s.bytes.size()) / cells);
  }
  print_answers(index, static_cast<std::size_t>(std::atoi(word(5, "1000"))));
}
