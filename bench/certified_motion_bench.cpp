// SPDX-License-Identifier: BSD-3-Clause
// What a turning body costs: its clearance among n obstacles with the box tree and by a plain loop, motions certified,
// and motions sampled as the study's programs did (ten places, by a plain loop), which miss collisions. Labels say how
// many motions of each kind were accepted and how many of these collide at one of 1000 places.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "bench/bodies.hpp"
#include "spatial/points/kd_tree.hpp"

namespace {

using namespace warren;
using namespace warren::bench;

void bm_clearance(benchmark::State& state) {
  const Scene scene = hexagons(static_cast<std::size_t>(state.range(0)));
  const Se2World world(scene, kite, {});
  auto query = world.make_query();
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Se2 pose = uniform_state(world, 1, i);
    const double plain = plain_clearance(scene, pose);
    if (std::abs(std::max(plain, 0.0) - std::max(world.clearance(pose, 1e9, query), 0.0)) > 1e-10) {
      state.SkipWithError("tree and loop disagree");
    }
  }
  std::uint64_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(world.clearance(uniform_state(world, 1, i++ % 4096), 1e9, query));
}
BENCHMARK(bm_clearance)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000);

void bm_plain_clearance(benchmark::State& state) {
  const Scene scene = hexagons(static_cast<std::size_t>(state.range(0)));
  const Se2World world(scene, kite, {});
  std::uint64_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(plain_clearance(scene, uniform_state(world, 1, i++ % 4096)));
}
BENCHMARK(bm_plain_clearance)->Arg(10)->Arg(100)->Arg(1000);

/// Motions of about the step of a tree, both ends free.
std::vector<PoseMotion> motions_in(const Se2World& world) {
  auto query = world.make_query();
  std::vector<PoseMotion> motions;
  for (std::uint64_t i = 0; motions.size() < 2000; ++i) {
    const Se2 a = uniform_state(world, 1, 2 * i);
    const Se2 far = uniform_state(world, 1, 2 * i + 1);
    const Se2 b = world.interpolate(a, far, std::min(1.0, 1.0 / world.distance(a, far)));
    if (world.is_free(a, query) && world.is_free(b, query)) motions.push_back({a, b});
  }
  return motions;
}

bool sampled_free(const Se2World& world, const PoseMotion& m, int places, Se2World::Query& query) {
  for (int i = 0; i <= places; ++i) {
    if (!world.is_free(world.interpolate(m.a, m.b, static_cast<double>(i) / places), query)) return false;
  }
  return true;
}

/// Runs `check` over the motions and counts those accepted that collide.
template <class Check>
void run_motions(benchmark::State& state, const Check& check) {
  const Se2World world(hexagons(100), kite, {});
  auto query = world.make_query();
  const std::vector<PoseMotion> motions = motions_in(world);
  int accepted = 0;
  int wrong = 0;
  int truly_free = 0;
  for (const PoseMotion& m : motions) {
    const bool is_free = sampled_free(world, m, 1000, query);
    truly_free += is_free ? 1 : 0;
    if (!check(world, m, query)) continue;
    ++accepted;
    wrong += is_free ? 0 : 1;
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(check(world, motions[i++ % motions.size()], query));
  state.counters["accepted"] = accepted;
  state.counters["colliding"] = wrong;
  state.counters["free"] = truly_free;
}

void bm_certified_motion(benchmark::State& state) {
  run_motions(state, [](const Se2World& world, const PoseMotion& m, Se2World::Query& query) {
    return world.is_free_motion(m.a, m.b, query);
  });
}
BENCHMARK(bm_certified_motion);

void bm_ten_samples(benchmark::State& state) {
  run_motions(state, [](const Se2World& world, const PoseMotion& m, Se2World::Query& query) {
    return sampled_free(world, m, 9, query);
  });
}
BENCHMARK(bm_ten_samples);

/// Insertions and as many queries, as a tree of motions makes them; a plain loop beside it.
void bm_growing_tree(benchmark::State& state) {
  const auto n = static_cast<std::uint64_t>(state.range(0));
  const auto point = [](std::uint64_t i) {
    return std::array{uniform(1, i, 0), uniform(1, i, 1), uniform(1, i, 2), uniform(1, i, 3)};
  };
  for (auto _ : state) {
    GrowingTree<4> tree;
    for (std::uint64_t i = 0; i < n; ++i) {
      tree.insert(point(i));
      benchmark::DoNotOptimize(tree.nearest(point(n + i)));
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(n) * state.iterations());
}
BENCHMARK(bm_growing_tree)->Arg(100)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMicrosecond);

void bm_plain_nearest(benchmark::State& state) {
  const auto n = static_cast<std::uint64_t>(state.range(0));
  const auto point = [](std::uint64_t i) {
    return std::array{uniform(1, i, 0), uniform(1, i, 1), uniform(1, i, 2), uniform(1, i, 3)};
  };
  for (auto _ : state) {
    std::vector<std::array<double, 4>> points;
    for (std::uint64_t i = 0; i < n; ++i) {
      points.push_back(point(i));
      const auto q = point(n + i);
      double best = 1e9;
      for (const auto& p : points) {
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 4; ++axis) sum += (p[axis] - q[axis]) * (p[axis] - q[axis]);
        best = std::min(best, sum);
      }
      benchmark::DoNotOptimize(best);
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(n) * state.iterations());
}
BENCHMARK(bm_plain_nearest)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond);

}  // namespace
