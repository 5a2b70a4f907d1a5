// SPDX-License-Identifier: BSD-3-Clause
// The wall index: build, blocks, clearance, capsules, over walls of a maze as they come, shuffled and merged, short
// walls in the open at two densities, and long ones. Queries are unit edges between neighbouring lattice points, in
// blocks of rows or at random places. Items are walls (build) or queries; each kind of query is answered first as all
// walls one by one answer it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren::bench {
namespace {

enum Kind : int { maze, shuffled_maze, merged_maze, sparse, dense, long_walls };
constexpr double capsule = 0.1;
constexpr std::uint32_t maze_side = 1000;  // of the mazes

std::vector<Segment> segments_of(const WallSet& walls) {
  std::vector<Segment> segments;
  walls.visit([&](auto given) {
    for (const auto& w : given) segments.push_back(w.segment());
  });
  return segments;
}

/// `count` walls of one length, anywhere in a square of this width, in any direction.
WallSet scattered(std::size_t count, double length, double width) {
  std::vector<Segment> walls(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 at{width * uniform(1, i, 0), width * uniform(1, i, 1)};
    const double angle = 2.0 * std::numbers::pi * uniform(1, i, 2);
    walls[i] = {at, at + length * Vec2{std::cos(angle), std::sin(angle)}};
  }
  return WallSet::narrowest(walls);
}

WallSet walls_of(std::int64_t kind) {
  constexpr std::size_t cells = std::size_t{maze_side} * maze_side;
  const double width = maze_side;
  if (kind == sparse) return scattered(cells / 10, 1.0, width);
  if (kind == dense) return scattered(cells, 1.0, width);
  if (kind == long_walls) return scattered(maze_side, 0.3 * width, width);
  const WallSet walls = maze_scene({maze_side, maze_side, 1}, kind == merged_maze, {}).walls;
  if (kind != shuffled_maze) return walls;
  std::vector<Segment> mixed = segments_of(walls);
  SequentialRng rng(7);
  for (std::size_t i = mixed.size(); i > 1; --i) std::swap(mixed[i - 1], mixed[rng.below(i)]);
  return WallSet::narrowest(mixed);
}

/// Walls and their index, kept until another kind is asked for.
struct WallCase {
  WallSet walls;
  WallIndex index;
};
const WallCase& case_of(std::int64_t kind) {
  static std::int64_t built = -1;
  static WallCase kept{WallSet(), WallIndex(WallSet(), one_thread)};
  if (built != kind) {
    kept.walls = walls_of(kind);
    kept.index = WallIndex(kept.walls, {});
    built = kind;
  }
  return kept;
}

/// Edges between lattice points: row by row in a square block in the middle, or anywhere.
std::vector<Segment> edges_of(bool random_places) {
  constexpr std::uint32_t block = 180;
  std::vector<Segment> edges;
  for (std::uint32_t i = 0; i < block * block; ++i) {
    const double col = random_places ? std::floor((maze_side - 2) * uniform(2, i, 0)) : maze_side / 2.0 + i % block;
    const double row = random_places ? std::floor((maze_side - 2) * uniform(2, i, 1)) : maze_side / 2.0 + i / block;
    const Vec2 at{1.0 + col, 1.0 + row};
    edges.push_back({at, at + Vec2{1.0, 0.0}});
    edges.push_back({at, at + Vec2{0.0, 1.0}});
  }
  return edges;
}

/// The plain answers to an edge.
struct PlainAnswer {
  bool blocks = false;
  bool keeps = true;
  double clearance = std::numeric_limits<double>::infinity();
};
PlainAnswer plain_answer(const WallSet& walls, const Segment& edge) {
  PlainAnswer answer;
  walls.visit([&](auto given) {
    for (const auto& w : given) {
      const Segment wall = w.segment();
      answer.blocks = answer.blocks || segments_touch(wall, edge);
      answer.keeps = answer.keeps && segments_keep_distance(wall, edge, capsule);
      answer.clearance = std::min(answer.clearance, distance(edge.a, wall));
    }
  });
  return answer;
}

void check_queries(const WallCase& c, const std::vector<Segment>& edges) {
  constexpr std::size_t checked = 12;
  for (std::size_t i = 0; i < edges.size(); i += edges.size() / checked) {
    const Segment& edge = edges[i];
    const PlainAnswer plain = plain_answer(c.walls, edge);
    check(c.index.blocks(edge.a, edge.b) == plain.blocks, "WallIndex::blocks");
    check(c.index.keeps_clearance(edge.a, edge.b, capsule) == plain.keeps, "WallIndex::keeps_clearance");
    check(c.index.clearance(edge.a) == plain.clearance, "WallIndex::clearance");
  }
}

/// Times query(index, edge) -> number; the mean of the numbers is reported, so that none goes uncounted.
template <class Query>
void run_queries(benchmark::State& state, const char* mean_name, const Query& query) {
  const WallCase& c = case_of(state.range(0));
  const std::vector<Segment> edges = edges_of(state.range(1) != 0);
  if (should_check(state)) check_queries(c, edges);
  double sum = 0.0;
  for (auto _ : state) {
    sum = 0.0;
    for (const Segment& edge : edges) sum += query(c.index, edge);
    benchmark::DoNotOptimize(sum);
  }
  report(state, edges.size(), 0);
  state.counters["bytes/item"] = static_cast<double>(c.index.bytes()) / static_cast<double>(c.walls.size());
  state.counters[mean_name] = sum / static_cast<double>(edges.size());
}

void bm_wall_index_build(benchmark::State& state) {
  const WallCase& c = case_of(state.range(0));
  const Execution execution{.threads = static_cast<unsigned>(state.range(1))};
  if (should_check(state)) check_queries(c, edges_of(true));
  for (auto _ : state) benchmark::DoNotOptimize(WallIndex(c.walls, execution).wall_count());
  report(state, c.walls.size(), c.index.bytes());
}
void bm_wall_index_blocks(benchmark::State& state) {
  run_queries(state, "blocked",
              [](const WallIndex& index, const Segment& e) { return index.blocks(e.a, e.b) ? 1.0 : 0.0; });
}
void bm_wall_index_capsule(benchmark::State& state) {
  run_queries(state, "free", [](const WallIndex& index, const Segment& e) {
    return index.keeps_clearance(e.a, e.b, capsule) ? 1.0 : 0.0;
  });
}
void bm_wall_index_clearance(benchmark::State& state) {
  run_queries(state, "clearance", [](const WallIndex& index, const Segment& e) { return index.clearance(e.a); });
}

void query_cases(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"walls", "random"})->Unit(benchmark::kMillisecond);
  for (const int kind : {maze, shuffled_maze, merged_maze, sparse, dense, long_walls}) bench->Args({kind, 0});
  bench->Args({maze, 1})->Args({dense, 1});
}

BENCHMARK(bm_wall_index_build)
    ->ArgNames({"walls", "threads"})
    ->ArgsProduct({{maze, shuffled_maze, merged_maze, sparse, dense, long_walls}, {1}})
    ->Args({maze, 2})
    ->Args({shuffled_maze, 2})
    ->Apply(over_threads);
BENCHMARK(bm_wall_index_blocks)->Apply(query_cases);
BENCHMARK(bm_wall_index_capsule)->Apply(query_cases);
BENCHMARK(bm_wall_index_clearance)->Apply(query_cases);

}  // namespace
}  // namespace warren::bench
