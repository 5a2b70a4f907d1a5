// SPDX-License-Identifier: BSD-3-Clause
// What a car's steering costs: the shortest Dubins and Reeds-Shepp word of a random pair of poses, a pose on a curve,
// a motion certified. bm_car_certificates is no timing but a count, once: 1000 accepted motions at 100,000 places each,
// by plain distances; and of 20,000 motions those that are free by a hundredth of the body's radius (at 1000 places),
// and how many of these were refused.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/polygon_distance.hpp"
#include "core/rng.hpp"
#include "worlds/car_world.hpp"

namespace {

using namespace warren;

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

/// Hexagons as dense as the obstacles of the study's scene for cars.
Scene hexagons() {
  Scene scene;
  scene.bounds = Box{{0, 0}, {18, 12}};
  for (std::uint64_t i = 0; i < 20; ++i) {
    ScenePolygon polygon;
    const Vec2 centre{18.0 * uniform(3, i, 0), 12.0 * uniform(3, i, 1)};
    for (int k = 0; k < 6; ++k) {
      const double angle = k * std::numbers::pi / 3.0;
      polygon.corners.push_back(centre + 0.5 * Vec2{std::cos(angle), std::sin(angle)});
    }
    scene.polygons.push_back(polygon);
  }
  return scene;
}

struct Motion {
  Se2 a;
  Se2 b;
};

/// Both ends free, up to four turning radii of way.
template <class World>
Motion motion(const World& world, std::uint64_t index, typename World::Query& query) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    const Se2 a = uniform_state(world, index, 2 * attempt);
    const Se2 far = uniform_state(world, index, 2 * attempt + 1);
    const Se2 b = world.interpolate(a, far, std::min(1.0, 4.0 / world.distance(a, far)));
    if (world.is_free(a, query) && world.is_free(b, query)) return {a, b};
  }
}

template <class Curve>
void bm_certified_car_motion(benchmark::State& state) {
  const CarWorld<Curve> world(hexagons(), {.radius = radius});
  auto query = world.make_query();
  std::vector<Motion> motions;
  for (std::uint64_t i = 0; i < 1000; ++i) motions.push_back(motion(world, i, query));
  std::size_t i = 0;
  for (auto _ : state) {
    const Motion& m = motions[i++ % motions.size()];
    benchmark::DoNotOptimize(world.is_free_motion(m.a, m.b, query));
  }
}
BENCHMARK(bm_certified_car_motion<DubinsCurve>);
BENCHMARK(bm_certified_car_motion<ReedsSheppCurve>);

/// Least distance of a place on the curve to polygons and bounds, less the radius; only polygons near the curve count.
double sampled_room(const Scene& scene, const SteeringCurve& curve, int places) {
  const Box near = curve.box().grown(2.0 * radius);
  std::vector<const ScenePolygon*> polygons;
  for (const ScenePolygon& polygon : scene.polygons) {
    Box box;
    for (const Vec2 p : polygon.corners) box.include(p);
    if (box.meets(near)) polygons.push_back(&polygon);
  }
  double least = 1e9;
  for (int i = 0; i <= places; ++i) {
    const Vec2 p = curve.at(curve.length() * i / places).position();
    const Box& b = *scene.bounds;
    least = std::min({least, p.x - b.min.x, b.max.x - p.x, p.y - b.min.y, b.max.y - p.y});
    for (const ScenePolygon* polygon : polygons) least = std::min(least, distance(polygon->corners, Segment{p, p}));
  }
  return least - radius;
}

template <class Curve>
void bm_car_certificates(benchmark::State& state) {
  const Scene scene = hexagons();
  const CarWorld<Curve> world(scene, {.radius = radius});
  auto query = world.make_query();
  int accepted = 0;
  int colliding = 0;
  int roomy = 0;
  int refused = 0;
  for (auto _ : state) {
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      const Motion m = motion(world, i, query);
      const SteeringCurve curve = world.curve(m.a, m.b);
      const bool is_free = world.is_free_motion(m.a, m.b, query);
      if (sampled_room(scene, curve, 1000) > 0.01 * radius) {
        ++roomy;
        refused += is_free ? 0 : 1;
      }
      if (!is_free || accepted == 1000) continue;
      ++accepted;
      colliding += sampled_room(scene, curve, 100'000) <= 0.0 ? 1 : 0;
    }
  }
  state.counters["accepted"] = accepted;
  state.counters["colliding"] = colliding;
  state.counters["free_by_1_percent"] = roomy;
  state.counters["refused_of_these"] = refused;
}
BENCHMARK(bm_car_certificates<DubinsCurve>)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(bm_car_certificates<ReedsSheppCurve>)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
