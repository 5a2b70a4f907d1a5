// SPDX-License-Identifier: BSD-3-Clause
// What a car's steering costs: the shortest Dubins and Reeds-Shepp word of a random pair of poses, a pose on a curve,
// a motion certified.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "bench/bodies.hpp"

namespace {

using namespace warren;
using namespace warren::bench;

constexpr double radius = 0.5;

Se2 random_pose(std::uint64_t index) {
  return {10.0 * uniform(1, index, 0), 10.0 * uniform(1, index, 1), 2.0 * std::numbers::pi * uniform(1, index, 2)};
}

template <class Curve>
void bm_shortest(benchmark::State& state) {
  std::vector<Se2> poses;
  for (std::uint64_t i = 0; i < 4096; ++i) poses.push_back(random_pose(i));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(Curve::shortest(poses[i % 4096], poses[(i + 1) % 4096], 1.0).length);
    ++i;
  }
}
BENCHMARK(bm_shortest<DubinsCurve>);
BENCHMARK(bm_shortest<ReedsSheppCurve>);

void bm_pose_on_a_curve(benchmark::State& state) {
  std::vector<SteeringCurve> curves;
  for (std::uint64_t i = 0; i < 256; ++i) {
    const Se2 a = random_pose(2 * i);
    const Se2 b = random_pose(2 * i + 1);
    curves.emplace_back(a, b, ReedsSheppCurve::shortest(a, b, 1.0), 1.0);
  }
  std::uint64_t i = 0;
  for (auto _ : state) {
    const SteeringCurve& curve = curves[i % 256];
    benchmark::DoNotOptimize(curve.at(curve.length() * uniform(2, i++ % 4096, 0)));
  }
}
BENCHMARK(bm_pose_on_a_curve);

template <class Curve>
void bm_certified_car_motion(benchmark::State& state) {
  const CarWorld<Curve> world(car_hexagons(), {.radius = radius});
  auto query = world.make_query();
  std::vector<PoseMotion> motions;
  for (std::uint64_t i = 0; i < 1000; ++i) motions.push_back(car_motion(world, i, query));
  std::size_t i = 0;
  for (auto _ : state) {
    const PoseMotion& m = motions[i++ % motions.size()];
    benchmark::DoNotOptimize(world.is_free_motion(m.a, m.b, query));
  }
}
BENCHMARK(bm_certified_car_motion<DubinsCurve>);
BENCHMARK(bm_certified_car_motion<ReedsSheppCurve>);

}  // namespace
