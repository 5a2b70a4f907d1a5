// SPDX-License-Identifier: BSD-3-Clause
// What a turning body costs: its clearance among n obstacles with the box tree and by a plain loop, motions certified,
// and motions sampled as the study's programs did (ten places, by a plain loop), which miss collisions. Labels say how
// many motions of each kind were accepted and how many of these collide at one of 1000 places.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/polygon_distance.hpp"
#include "core/rng.hpp"
#include "spatial/growing_tree.hpp"
#include "worlds/se2_world.hpp"

namespace {

using namespace warren;

const std::vector<Vec2> kite = {{0.10, 0.63}, {0.22, 0.41}, {0.49, 0.20}, {0.48, 0.82}};

/// n hexagons in a square that grows with them: their density stays.
Scene hexagons(std::size_t n) {
  Scene scene;
  const double side = 2.2 * std::sqrt(static_cast<double>(n));
  scene.bounds = Box{{0, 0}, {side, side}};
  for (std::size_t i = 0; i < n; ++i) {
    ScenePolygon polygon;
    const Vec2 centre{side * uniform(1, i, 0), side * uniform(1, i, 1)};
    for (int k = 0; k < 6; ++k) {
      const double angle = k * std::numbers::pi / 3.0;
      polygon.corners.push_back(centre + Vec2{0.5 * std::cos(angle), 0.5 * std::sin(angle)});
    }
    scene.polygons.push_back(polygon);
  }
  return scene;
}

std::vector<Vec2> body_at(const Se2& pose) {
  std::vector<Vec2> corners;
  for (const Vec2 p : kite) corners.push_back(placed(pose, p));
  return corners;
}

double plain_clearance(const Scene& scene, const Se2& pose) {
  const std::vector<Vec2> body = body_at(pose);
  double least = 1e9;
  for (const Vec2 p : body) {
    least = std::min({least, p.x - scene.bounds->min.x, scene.bounds->max.x - p.x, p.y - scene.bounds->min.y,
                      scene.bounds->max.y - p.y});
  }
  for (const ScenePolygon& polygon : scene.polygons) least = std::min(least, distance(body, polygon.corners));
  return least;
}

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

struct Motion {
  Se2 a;
  Se2 b;
};

/// Motions of about the step of a tree, both ends free.
std::vector<Motion> motions_in(const Se2World& world) {
  auto query = world.make_query();
  std::vector<Motion> motions;
  for (std::uint64_t i = 0; motions.size() < 2000; ++i) {
    const Se2 a = uniform_state(world, 1, 2 * i);
    const Se2 far = uniform_state(world, 1, 2 * i + 1);
    const Se2 b = world.interpolate(a, far, std::min(1.0, 1.0 / world.distance(a, far)));
    if (world.is_free(a, query) && world.is_free(b, query)) motions.push_back({a, b});
  }
  return motions;
}

bool sampled_free(const Se2World& world, const Motion& m, int places, Se2World::Query& query) {
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
  const std::vector<Motion> motions = motions_in(world);
  int accepted = 0;
  int wrong = 0;
  int truly_free = 0;
  for (const Motion& m : motions) {
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
  run_motions(state, [](const Se2World& world, const Motion& m, Se2World::Query& query) {
    return world.is_free_motion(m.a, m.b, query);
  });
}
BENCHMARK(bm_certified_motion);

void bm_ten_samples(benchmark::State& state) {
  run_motions(state, [](const Se2World& world, const Motion& m, Se2World::Query& query) {
    return sampled_free(world, m, 9, query);
  });
}
BENCHMARK(bm_ten_samples);

/// 1000 accepted motions at 10,000 places each, by a plain loop; how many of those are refused that have 1 % of the
/// radius to spare?
void bm_turning_certificates(benchmark::State& state) {
  const Scene scene = hexagons(30);
  const Se2World world(scene, kite, {});
  auto query = world.make_query();
  const auto keeps = [&](const Motion& m, int places, double margin) {
    for (int i = 0; i <= places; ++i) {
      if (plain_clearance(scene, world.interpolate(m.a, m.b, static_cast<double>(i) / places)) <= margin) return false;
    }
    return true;
  };
  int accepted = 0;
  int colliding = 0;
  int roomy = 0;
  int refused = 0;
  for (auto _ : state) {
    for (const Motion& m : motions_in(world)) {
      const bool is_free = world.is_free_motion(m.a, m.b, query);
      if (keeps(m, 1000, 0.01 * world.radius())) {
        ++roomy;
        refused += is_free ? 0 : 1;
      }
      if (!is_free || accepted == 1000) continue;
      ++accepted;
      colliding += keeps(m, 10'000, 0.0) ? 0 : 1;
    }
  }
  state.counters["accepted"] = accepted;
  state.counters["colliding"] = colliding;
  state.counters["free_by_1_percent"] = roomy;
  state.counters["refused_of_these"] = refused;
}
BENCHMARK(bm_turning_certificates)->Iterations(1)->Unit(benchmark::kSecond);

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
