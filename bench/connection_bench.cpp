// SPDX-License-Identifier: BSD-3-Clause
// How a roadmap comes about in a maze: drawing samples and keeping the free ones, candidate edges with each pair once
// (k nearest and radius rule), and their collision checks. Items are samples, candidates, or edges checked.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "bench/report.hpp"
#include "core/plane/geometry.hpp"
#include "planners/roadmap/connection.hpp"
#include "planners/roadmap/sampler.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren::bench {
namespace {

constexpr std::uint32_t side = 300;  // of the maze
constexpr double kept_clearance = 0.1;
constexpr std::uint64_t draws_a_cell = 7;

const Scene& scene() {
  static const Scene kept = maze_scene({side, side, 1}, false, {});
  return kept;
}
const MazeWorld& asked_maze() {
  static const MazeWorld kept(scene(), kept_clearance, {});
  return kept;
}
const AnyWorld<Vec2>& world() {
  static const WorldView kept(asked_maze());
  return kept;
}

RoadmapOptions options_of(std::int64_t sampler) {
  RoadmapOptions options;
  options.sampler = static_cast<SamplerKind>(sampler);
  options.lattice = {side, side};
  return options;
}
std::uint64_t samples_of(std::int64_t sampler) {
  const std::uint64_t cells = std::uint64_t{side} * side;
  return static_cast<SamplerKind>(sampler) == SamplerKind::lattice ? cells : draws_a_cell * cells;
}
Execution threads_of(std::int64_t threads) { return {.threads = static_cast<unsigned>(threads)}; }

bool is_free_of_all_walls(Vec2 p) {
  bool free = true;
  scene().walls.visit([&](auto walls) {
    for (const auto& w : walls) free = free && distance(p, w.segment()) >= asked_maze().planning_clearance();
  });
  return free;
}

void sort_points(std::vector<Vec2>& points) {
  std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
}

/// By itself: the others of its range are not drawn.
Vec2 sample_of(const RoadmapOptions& options, std::size_t index, std::uint64_t count) {
  Vec2 drawn = lattice_point(options.lattice, index);
  if (options.sampler != SamplerKind::lattice)
    detail::for_each_sample(world(), options, {index, index + 1}, count, [&](Vec2 sample) { drawn = sample; });
  return drawn;
}

/// The milestones are the free ones among the samples drawn one by one; some samples are put to every wall.
void check_milestones(const RoadmapOptions& options, std::uint64_t count, const RawVector<Vec2>& milestones) {
  std::vector<Vec2> plain;
  auto query = world().make_query();
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec2 p = sample_of(options, i, count);
    const bool free = world().is_free(p, query);
    if (i % (count / 16) == 0) check(free == is_free_of_all_walls(p), "MazeWorld::is_free");
    if (free) plain.push_back(p);
  }
  std::vector<Vec2> drawn(milestones.begin(), milestones.end());
  sort_points(plain);
  sort_points(drawn);
  check(plain == drawn, "draw_milestones");
}

void bm_draw_milestones(benchmark::State& state) {
  const RoadmapOptions options = options_of(state.range(0));
  const std::uint64_t count = samples_of(state.range(0));
  const Execution execution = threads_of(state.range(1));
  const RawVector<Vec2> drawn = draw_milestones(world(), options, count, execution);
  if (should_check(state)) check_milestones(options, count, drawn);
  for (auto _ : state) benchmark::DoNotOptimize(draw_milestones(world(), options, count, execution).data());
  report(state, count, drawn.size() * sizeof(Vec2));
  state.counters["free"] = static_cast<double>(drawn.size()) / static_cast<double>(count);
}

/// Drawing alone: no world, no order.
void bm_draw_samples(benchmark::State& state) {
  const RoadmapOptions options = options_of(state.range(0));
  const std::uint64_t count = samples_of(state.range(0));
  if (should_check(state)) {
    std::uint64_t next = 0;
    detail::for_each_sample(world(), options, {0, count}, count,
                            [&](Vec2 p) { check(p == sample_of(options, next++, count), "for_each_sample"); });
  }
  for (auto _ : state) {
    Vec2 sum;
    detail::for_each_sample(world(), options, {0, count}, count, [&](Vec2 p) { sum = sum + p; });
    benchmark::DoNotOptimize(sum);
  }
  report(state, count, count * sizeof(Vec2));
}

/// Milestones of the uniform sampler with their index.
struct Cloud {
  RawVector<Vec2> milestones = draw_milestones(world(), options_of(0), samples_of(0), threads_of(0));
  StateIndex<AnyWorld<Vec2>> index = index_of_states(world(), std::span<const Vec2>(milestones), threads_of(0));
};
const Cloud& cloud() {
  static const Cloud kept;
  return kept;
}

/// k nearest for k > 0, else the radius that `auto` takes.
ConnectionRule rule_of(std::int64_t k) {
  if (k > 0) return {0.0, static_cast<std::uint32_t>(k)};
  return connection_rule(options_of(0), samples_of(0), world().sampled_volume());
}

std::vector<Edge> flat(const EdgeParts& parts) {
  std::vector<Edge> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Every pair of neighbours, the smaller vertex first, sorted, each once.
std::vector<Edge> plain_candidates(const ConnectionRule& rule) {
  std::vector<Edge> all;
  std::vector<Neighbour> near;
  for (VertexId i = 0; i < cloud().milestones.size(); ++i) {
    if (rule.neighbours > 0) {
      cloud().index.nearest(cloud().milestones[i], rule.neighbours, i, near);
    } else {
      cloud().index.within(cloud().milestones[i], rule.radius, i, near);
    }
    for (const Neighbour& n : near) all.push_back({std::min(i, n.id), std::max(i, n.id)});
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void bm_candidates(benchmark::State& state) {
  const std::span<const Vec2> milestones = cloud().milestones;
  const ConnectionRule rule = rule_of(state.range(0));
  const Execution execution = threads_of(state.range(1));
  Counters counters;
  std::vector<Edge> found = flat(candidate_edges(world(), milestones, cloud().index, rule, execution, counters));
  for (Edge& e : found) e = {std::min(e.from, e.to), std::max(e.from, e.to)};
  std::sort(found.begin(), found.end());
  if (should_check(state)) check(found == plain_candidates(rule), "candidate_edges");
  for (auto _ : state) {
    benchmark::DoNotOptimize(candidate_edges(world(), milestones, cloud().index, rule, execution, counters).data());
  }
  report(state, found.size(), found.size() * sizeof(Edge) + milestones.size() * rule.neighbours * sizeof(VertexId));
  state.counters["edges/vertex"] = static_cast<double>(found.size()) / static_cast<double>(milestones.size());
}

/// The candidates, checked one by one.
std::vector<Edge> plain_free(const std::vector<Edge>& candidates) {
  const std::span<const Vec2> milestones = cloud().milestones;
  std::vector<Edge> free;
  auto query = world().make_query();
  for (const Edge& e : candidates) {
    if (world().is_free_motion(milestones[e.from], milestones[e.to], query)) free.push_back(e);
  }
  return free;
}

void bm_connect_milestones(benchmark::State& state) {
  const std::span<const Vec2> milestones = cloud().milestones;
  const ConnectionRule rule = rule_of(state.range(0));
  const Execution execution = threads_of(state.range(1));
  Counters counters;
  const std::vector<Edge> candidates =
      flat(candidate_edges(world(), milestones, cloud().index, rule, execution, counters));
  const std::vector<Edge> free =
      flat(connect_milestones(world(), milestones, cloud().index, rule, execution, counters));
  if (should_check(state)) check(free == plain_free(candidates), "connect_milestones");
  for (auto _ : state) {
    benchmark::DoNotOptimize(connect_milestones(world(), milestones, cloud().index, rule, execution, counters).data());
  }
  report(state, candidates.size(), free.size() * sizeof(Edge));
  state.counters["free"] = static_cast<double>(free.size()) / static_cast<double>(candidates.size());
}

constexpr auto uniform_sampler = static_cast<std::int64_t>(SamplerKind::uniform);
constexpr auto lattice_sampler = static_cast<std::int64_t>(SamplerKind::lattice);
constexpr auto halton_sampler = static_cast<std::int64_t>(SamplerKind::halton);
constexpr auto random_sampler = static_cast<std::int64_t>(SamplerKind::random);

BENCHMARK(bm_draw_samples)
    ->ArgName("sampler")
    ->Arg(uniform_sampler)
    ->Arg(halton_sampler)
    ->Arg(random_sampler)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(bm_draw_milestones)
    ->ArgNames({"sampler", "threads"})
    ->ArgsProduct({{uniform_sampler, lattice_sampler, halton_sampler, random_sampler}, {1}})
    ->Args({uniform_sampler, 2})
    ->Apply(over_threads);
BENCHMARK(bm_candidates)->ArgNames({"k", "threads"})->ArgsProduct({{0, 8, 20}, {1}})->Args({8, 2})->Apply(over_threads);
BENCHMARK(bm_connect_milestones)
    ->ArgNames({"k", "threads"})
    ->ArgsProduct({{0, 8}, {1}})
    ->Args({0, 2})
    ->Apply(over_threads);

}  // namespace
}  // namespace warren::bench
