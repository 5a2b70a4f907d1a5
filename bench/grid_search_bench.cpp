// SPDX-License-Identifier: BSD-3-Clause
// Searches of one map, thousands of queries a map as scenario files ask: A*, Dijkstra, breadth first and jump points,
// on open ground with blocks and in corridors. Each length is compared with A*'s once.
#include <benchmark/benchmark.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "planners/grid/grid_search.hpp"

namespace warren {
namespace {

constexpr std::uint32_t map_side = 1024;

Bitmap blocks() {
  Bitmap map(map_side, map_side);
  for (std::uint64_t i = 0; i < 1500; ++i) {
    const auto x = static_cast<std::uint32_t>(random_bits(1, i, 0) % (map_side - 24));
    const auto y = static_cast<std::uint32_t>(random_bits(1, i, 1) % (map_side - 24));
    const auto height = static_cast<std::uint32_t>(2 + random_bits(1, i, 2) % 20);
    for (std::uint32_t v = y; v < y + height; ++v) map.set_run(v, x, x + 24 - height / 2);
  }
  return map;
}

/// Rooms of 16 cells with a door in each side.
Bitmap rooms() {
  Bitmap map(map_side, map_side);
  for (std::uint32_t at = 15; at < map_side; at += 16) {
    map.set_run(at, 0, map_side);
    for (std::uint32_t y = 0; y < map_side; ++y) map.set(at, y);
  }
  for (std::uint32_t y = 0; y < map_side; y += 16) {
    for (std::uint32_t x = 0; x < map_side; x += 16) {
      if (y + 15 < map_side) map.clear(x + static_cast<std::uint32_t>(random_bits(2, x, y) % 15), y + 15);
      if (x + 15 < map_side) map.clear(x + 15, y + static_cast<std::uint32_t>(random_bits(3, x, y) % 15));
    }
  }
  return map;
}

struct Query {
  Cell start;
  Cell goal;
};

std::vector<Query> queries_of(const Bitmap& map) {
  std::vector<Query> queries;
  for (std::uint64_t i = 0; queries.size() < 20; ++i) {
    const auto cell = [&](std::uint64_t axis) {
      return Cell{static_cast<std::uint32_t>(random_bits(4, i, axis) % map_side),
                  static_cast<std::uint32_t>(random_bits(4, i, axis + 1) % map_side)};
    };
    const Query query{cell(0), cell(2)};
    if (!map.test(query.start.x, query.start.y) && !map.test(query.goal.x, query.goal.y)) queries.push_back(query);
  }
  return queries;
}

/// range(0): 0 blocks, 1 rooms; range(1): the method.
void grid_search(benchmark::State& state) {
  const Bitmap map = state.range(0) == 0 ? blocks() : rooms();
  const std::vector<Query> queries = queries_of(map);
  const GridSearchOptions options{Diagonal::sqrt2, static_cast<GridMethod>(state.range(1))};
  GridSearch search(map);
  std::uint64_t expanded = 0;
  for (const Query& q : queries) {
    const double length = search.find(q.start, q.goal, {}, {}).cost;
    const GridPath path = search.find(q.start, q.goal, options, {});
    expanded += path.expanded;
    if (options.method != GridMethod::bfs && std::abs(path.cost - length) > 1e-6)
      throw std::logic_error("lengths differ");
  }
  for (auto _ : state) {
    for (const Query& q : queries) benchmark::DoNotOptimize(search.find(q.start, q.goal, options, {}));
  }
  state.counters["expanded"] = static_cast<double>(expanded) / static_cast<double>(queries.size());
  state.counters["a_query"] = benchmark::Counter(
      static_cast<double>(queries.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  const char* methods[] = {"astar", "dijkstra", "bfs", "jump points"};
  state.SetLabel(std::string{state.range(0) == 0 ? "blocks, " : "rooms, "} + methods[state.range(1)]);
}
BENCHMARK(grid_search)->ArgsProduct({{0, 1}, {0, 1, 2, 3}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren
