// SPDX-License-Identifier: BSD-3-Clause
// Neighbour indices: build, k nearest and radius queries of the grid and of the k-d forest, nanoflann as packaged
// beside them; points in tile order and in random order, on a lattice, uniform and clustered. Each index answers some
// queries as the plain search does before it is timed. Queries come in the order of the points, one thread; builds on
// one thread.
#pragma GCC diagnostic ignored "-Wnull-dereference"  // g++ 12 at -O3 sees one inside nanoflann's vector::resize

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "bench/plain_flann.hpp"
#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "parallel/sort.hpp"
#include "spatial/points/neighbours.hpp"

namespace warren::bench {
namespace {

enum PointsKind : int {
  uniform_random,
  uniform_sorted,
  lattice_sorted,
  clustered,
  crowded
};  // crowding 3, 3, 2, 18, 100

Vec2 point_of(PointsKind kind, std::size_t side, std::size_t i) {
  const double width = static_cast<double>(side);
  const Vec2 u{uniform(1, i, 0), uniform(1, i, 1)};
  if (kind == lattice_sorted) return {static_cast<double>(i % side), static_cast<double>(i / side)};
  if (kind == uniform_random || kind == uniform_sorted) return width * u;
  // Distances from 200 of 256 centres spread evenly over the logarithms of two or three decades.
  const double spread = std::pow(10.0, (kind == clustered ? -2.0 : -3.0) * uniform(1, i, 2));
  const Vec2 centre{std::floor(16.0 * uniform(1, i % 200, 3)) / 16.0, std::floor(16.0 * uniform(1, i % 200, 4)) / 16.0};
  return width * (centre + spread * (u - Vec2{0.5, 0.5}));
}

/// side x side points at a mean density of one.
const std::vector<Vec2>& points_of(std::int64_t kind_number, std::int64_t side_number) {
  static std::vector<Vec2> points;
  static std::pair<std::int64_t, std::int64_t> built{-1, -1};
  if (built == std::pair{kind_number, side_number}) return points;
  built = {kind_number, side_number};
  const auto kind = static_cast<PointsKind>(kind_number);
  const auto side = static_cast<std::size_t>(side_number);
  points.resize(side * side);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = point_of(kind, side, i);
  if (kind == uniform_random) return points;
  const RawVector<std::uint32_t> order = tile_order(points, {});
  std::vector<Vec2> sorted;
  for (const std::uint32_t i : order) sorted.push_back(points[i]);
  points.swap(sorted);
  return points;
}

template <class Index>
Index make_index(const std::vector<Vec2>& points) {
  if constexpr (std::is_same_v<Index, PlainFlann>) {
    return PlainFlann(points);
  } else {
    return Index(points, one_thread);
  }
}

/// Ends the program unless the neighbours are the plain ones; nanoflann may break ties as it likes.
void check_neighbours(const std::vector<Vec2>& points, VertexId i, std::vector<Neighbour> found, std::size_t k,
                      double radius, bool by_id) {
  std::vector<Neighbour> plain;
  for (VertexId j = 0; j < points.size(); ++j) {
    const double d = distance(points[j], points[i]);
    if (j != i && d <= radius) plain.push_back({j, d});
  }
  k = std::min(k, plain.size());
  std::partial_sort(plain.begin(), plain.begin() + static_cast<std::ptrdiff_t>(k), plain.end());
  plain.resize(k);
  if (!by_id) std::sort(found.begin(), found.end());
  const bool same =
      std::equal(plain.begin(), plain.end(), found.begin(), found.end(),
                 [&](const auto& a, const auto& b) { return a.distance == b.distance && (!by_id || a.id == b.id); });
  check(same, "neighbours of a point");
}

/// The index of the points asked for last.
template <class Index>
Index& index_of(std::int64_t kind, std::int64_t side) {
  static std::unique_ptr<Index> index;
  static std::pair<std::int64_t, std::int64_t> built{-1, -1};
  if (built != std::pair{kind, side}) {
    index.reset();
    index.reset(new Index(make_index<Index>(points_of(kind, side))));  // nanoflann's tree can't be moved
    built = {kind, side};
  }
  return *index;
}

/// Items in all iterations together.
void count(benchmark::State& state, std::size_t items) {
  state.SetItemsProcessed(static_cast<std::int64_t>(items));
  state.counters["s/item"] =
      benchmark::Counter(static_cast<double>(items), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <class Index>
void bm_build(benchmark::State& state) {
  const auto& points = points_of(state.range(0), state.range(1));
  for (auto _ : state) {
    Index index = make_index<Index>(points);
    benchmark::DoNotOptimize(&index);
  }
  count(state, static_cast<std::size_t>(state.iterations()) * points.size());
}

template <class Index>
void bm_nearest(benchmark::State& state) {
  const auto& points = points_of(state.range(0), state.range(1));
  const auto k = static_cast<std::size_t>(state.range(2));
  Index& index = index_of<Index>(state.range(0), state.range(1));
  std::vector<Neighbour> found;
  for (VertexId i = 0; should_check(state) && i < points.size(); i += static_cast<VertexId>(points.size() / 5)) {
    index.nearest(points[i], k, i, found);
    check_neighbours(points, i, found, k, INFINITY, !std::is_same_v<Index, PlainFlann>);
  }
  constexpr std::size_t batch = 65'536;
  std::size_t next = 0;
  for (auto _ : state) {
    for (std::size_t end = std::min(next + batch, points.size()); next < end; ++next) {
      index.nearest(points[next], k, static_cast<VertexId>(next), found);
      benchmark::DoNotOptimize(found.data());
    }
    if (next == points.size()) next = 0;
  }
  count(state, static_cast<std::size_t>(state.iterations()) * std::min(batch, points.size()));
}

template <class Index>
void bm_within(benchmark::State& state) {
  const auto& points = points_of(state.range(0), state.range(1));
  const SearchRadius radius(0.01 * static_cast<double>(state.range(2)));
  Index& index = index_of<Index>(state.range(0), state.range(1));
  std::vector<Neighbour> found;
  for (VertexId i = 0; should_check(state) && i < points.size(); i += static_cast<VertexId>(points.size() / 5)) {
    index.within(points[i], radius, i, found);
    check_neighbours(points, i, found, points.size(), radius.length(), !std::is_same_v<Index, PlainFlann>);
  }
  constexpr std::size_t batch = 65'536;
  std::size_t next = 0;
  for (auto _ : state) {
    for (std::size_t end = std::min(next + batch, points.size()); next < end; ++next) {
      index.within(points[next], radius, static_cast<VertexId>(next), found);
      benchmark::DoNotOptimize(found.data());
    }
    if (next == points.size()) next = 0;
  }
  count(state, static_cast<std::size_t>(state.iterations()) * std::min(batch, points.size()));
}

/// What some points have within the radius and with a larger number.
void check_later(const std::vector<Vec2>& points, const PointGrid& index, const SearchRadius& radius) {
  std::vector<Neighbour> near;
  for (VertexId i = 0; i < points.size(); i += static_cast<VertexId>(points.size() / 1000)) {
    std::vector<VertexId> found;
    index.for_each_later_pair({i, std::size_t{i} + 1}, radius, [&](VertexId, VertexId j) { found.push_back(j); });
    std::sort(found.begin(), found.end());
    index.within(points[i], radius, i, near);
    std::vector<VertexId> expected;
    for (const Neighbour& n : near) {
      if (n.id > i) expected.push_back(n.id);
    }
    std::sort(expected.begin(), expected.end());
    check(found == expected, "for_each_later_pair");
  }
}

/// Each pair of points within the radius once: what a radius roadmap asks.
void bm_later_pairs(benchmark::State& state) {
  const auto& points = points_of(state.range(0), state.range(1));
  const SearchRadius radius(0.01 * static_cast<double>(state.range(2)));
  const PointGrid& index = index_of<PointGrid>(state.range(0), state.range(1));
  if (should_check(state)) check_later(points, index, radius);
  constexpr std::size_t batch = 65'536;
  std::vector<VertexId> found;
  std::size_t next = 0;
  for (auto _ : state) {
    const std::size_t end = std::min(next + batch, points.size());
    found.clear();
    index.for_each_later_pair({next, end}, radius, [&](VertexId, VertexId j) { found.push_back(j); });
    benchmark::DoNotOptimize(found.data());
    next = end == points.size() ? 0 : end;
  }
  count(state, static_cast<std::size_t>(state.iterations()) * std::min(batch, points.size()));
}

/// A permutation that a stable sort by the numbers of the cells gives.
void check_tile_order(const std::vector<Vec2>& points, const Execution& execution) {
  const CellFrame frame(bounding_box(points, execution), points.size());
  std::vector<std::uint32_t> plain(points.size());
  std::iota(plain.begin(), plain.end(), 0U);
  std::stable_sort(plain.begin(), plain.end(), [&](std::uint32_t i, std::uint32_t j) {
    return frame.cell_of(points[i]) < frame.cell_of(points[j]);
  });
  const RawVector<std::uint32_t> order = tile_order(points, execution);
  check(std::equal(plain.begin(), plain.end(), order.begin(), order.end()), "tile_order");
}

void bm_tile_order(benchmark::State& state) {
  const auto& points = points_of(state.range(0), state.range(1));
  const Execution execution{.threads = static_cast<unsigned>(state.range(2))};
  if (should_check(state)) check_tile_order(points, execution);
  for (auto _ : state) benchmark::DoNotOptimize(tile_order(points, execution));
  count(state, static_cast<std::size_t>(state.iterations()) * points.size());
}

/// A stable sort by key gives the same order.
void check_counting_sort(const std::vector<std::uint32_t>& key, std::size_t keys, const Execution& execution) {
  std::vector<std::uint32_t> plain(key.size());
  std::iota(plain.begin(), plain.end(), 0U);
  std::stable_sort(plain.begin(), plain.end(), [&](std::uint32_t i, std::uint32_t j) { return key[i] < key[j]; });
  const ItemsByKey order = counting_sort(key.size(), keys, execution, [&](std::size_t i) { return key[i]; });
  check(std::equal(plain.begin(), plain.end(), order.items.begin(), order.items.end()), "counting_sort");
}

void bm_counting_sort(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto keys = static_cast<std::size_t>(state.range(1));
  std::vector<std::uint32_t> key(n);
  for (std::size_t i = 0; i < n; ++i) key[i] = static_cast<std::uint32_t>(random_bits(1, i) % keys);
  const Execution execution{.threads = static_cast<unsigned>(state.range(2))};
  if (should_check(state)) check_counting_sort(key, keys, execution);
  for (auto _ : state)
    benchmark::DoNotOptimize(counting_sort(n, keys, execution, [&](std::size_t i) { return key[i]; }));
  count(state, static_cast<std::size_t>(state.iterations()) * n);
}

BENCHMARK(bm_counting_sort)
    ->ArgNames({"n", "keys", "threads"})
    ->ArgsProduct({{1 << 20, 1 << 22}, {1 << 9, 1 << 20}, {1, 2}});
BENCHMARK(bm_tile_order)->ArgNames({"kind", "side", "threads"})->ArgsProduct({{uniform_random}, {1000, 2000}, {1, 2}});

void build_cases(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"kind", "side"})->ArgsProduct({{uniform_random, uniform_sorted}, {1000}});
}
BENCHMARK(bm_build<PointGrid>)
    ->ArgNames({"kind", "side"})
    ->ArgsProduct({{uniform_random, uniform_sorted}, {1000, 2000}});
BENCHMARK(bm_build<KdTree<2>>)->Apply(build_cases);
BENCHMARK(bm_build<PlainFlann>)->Apply(build_cases);

void nearest_cases(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"kind", "side", "k"});
  bench->ArgsProduct({{uniform_sorted}, {1000}, {8, 16, 24, 32}});
  bench->Args({lattice_sorted, 1000, 4})->Args({uniform_random, 1000, 8})->Args({clustered, 316, 8});
  bench->Args({clustered, 316, 24})->Args({crowded, 316, 8})->Args({crowded, 316, 24});
}
BENCHMARK(bm_nearest<PointGrid>)->Apply(nearest_cases)->Args({uniform_sorted, 2000, 8});
BENCHMARK(bm_nearest<KdTree<2>>)->Apply(nearest_cases);
BENCHMARK(bm_nearest<PlainFlann>)->Apply(nearest_cases);

void within_cases(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"kind", "side", "percent"});
  bench->Args({lattice_sorted, 1000, 100})->Args({uniform_sorted, 1000, 160});
}
BENCHMARK(bm_later_pairs)->Apply(within_cases)->Args({lattice_sorted, 2000, 100});
BENCHMARK(bm_within<PointGrid>)->Apply(within_cases);
BENCHMARK(bm_within<KdTree<2>>)->Apply(within_cases);
BENCHMARK(bm_within<PlainFlann>)->Apply(within_cases);

}  // namespace
}  // namespace warren::bench
