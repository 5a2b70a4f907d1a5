// SPDX-License-Identifier: BSD-3-Clause
// What certificates accept and refuse: a count, not a timing. In each space 20,000 random motions are certified; the
// first 1000 accepted ones are looked at in 100,000 places each, by plain loops over the obstacles; and of those that
// keep a hundredth of the body's radius in 1000 places it is counted how many were refused. Two and a half minutes on
// one core.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/bodies.hpp"
#include "parallel/chunks.hpp"

namespace {

using namespace warren;
using namespace warren::bench;

constexpr std::size_t motions = 20'000;
constexpr std::size_t looked_at = 1000;
constexpr double car_radius = 0.5;

struct Verdict {
  bool is_free = false;
  bool is_roomy = false;
};

/// is_free(i): the certificate of motion i; keeps(i, places, margin): is its clearance above the margin there?
template <class IsFree, class Keeps>
void count(const char* space, double radius, const IsFree& is_free, const Keeps& keeps) {
  std::vector<Verdict> verdicts(motions);
  for_chunks(motions, 64, {}, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) verdicts[i] = {is_free(i), keeps(i, 1000, 0.01 * radius)};
  });
  std::vector<std::size_t> accepted;
  std::size_t roomy = 0;
  std::size_t refused = 0;
  for (std::size_t i = 0; i < motions; ++i) {
    if (verdicts[i].is_free && accepted.size() < looked_at) accepted.push_back(i);
    roomy += verdicts[i].is_roomy ? 1 : 0;
    refused += verdicts[i].is_roomy && !verdicts[i].is_free ? 1 : 0;
  }
  std::vector<std::uint8_t> collides(accepted.size(), 0);
  for_chunks(accepted.size(), 1, {}, [&](Range r) { collides[r.first] = !keeps(accepted[r.first], 100'000, 0.0); });
  const auto colliding = std::count(collides.begin(), collides.end(), 1);
  fmt::print("{}: {} accepted, {} of them collide; {} free by 1 %, {} of them refused\n", space, accepted.size(),
             colliding, roomy, refused);
}

/// Is every one of the values room(0), room(1 / places), ... above the margin?
template <class Room>
bool all_above(int places, double margin, const Room& room) {
  for (int i = 0; i <= places; ++i) {
    if (!(room(static_cast<double>(i) / places) > margin)) return false;
  }
  return true;
}

/// The scene with only the polygons whose boxes meet `around`.
Scene near_part(const Scene& scene, const Box& around) {
  Scene part;
  part.bounds = scene.bounds;
  for (const ScenePolygon& polygon : scene.polygons) {
    Box box;
    for (const Vec2 p : polygon.corners) box.include(p);
    if (box.meets(around)) part.polygons.push_back(polygon);
  }
  return part;
}

void count_turning() {
  const Scene scene = hexagons(30);
  const Se2World world(scene, kite, {});
  const auto motion = [&](std::size_t i) {
    auto query = world.make_query();
    for (std::uint64_t attempt = 0;; ++attempt) {  // both ends free, about the step of a tree
      const Se2 a = uniform_state(world, i, 2 * attempt);
      const Se2 far = uniform_state(world, i, 2 * attempt + 1);
      const Se2 b = world.interpolate(a, far, std::min(1.0, 1.0 / world.distance(a, far)));
      if (world.is_free(a, query) && world.is_free(b, query)) return PoseMotion{a, b};
    }
  };
  const auto is_free = [&](std::size_t i) {
    auto query = world.make_query();
    const PoseMotion m = motion(i);
    return world.is_free_motion(m.a, m.b, query);
  };
  const auto keeps = [&](std::size_t i, int places, double margin) {
    const PoseMotion m = motion(i);
    Box way;
    way.include(m.a.position());
    way.include(m.b.position());
    const Scene near = near_part(scene, way.grown(1.1 * world.radius()));
    return all_above(places, margin, [&](double t) { return plain_clearance(near, world.interpolate(m.a, m.b, t)); });
  };
  count("a kite that turns among 30 hexagons", world.radius(), is_free, keeps);
}

template <class Curve>
void count_cars(const char* space) {
  const Scene scene = car_hexagons();
  const CarWorld<Curve> world(scene, {.radius = car_radius});
  const auto is_free = [&](std::size_t i) {
    auto query = world.make_query();
    const PoseMotion m = car_motion(world, i, query);
    return world.is_free_motion(m.a, m.b, query);
  };
  const auto keeps = [&](std::size_t i, int places, double margin) {
    auto query = world.make_query();
    const PoseMotion m = car_motion(world, i, query);
    const SteeringCurve curve = world.curve(m.a, m.b);
    const Scene near = near_part(scene, curve.box().grown(2.0 * car_radius));
    const auto room = [&](double t) {
      const Vec2 p = curve.at(curve.length() * t).position();
      const Box& b = *scene.bounds;
      double least = std::min({p.x - b.min.x, b.max.x - p.x, p.y - b.min.y, b.max.y - p.y});
      for (const ScenePolygon& polygon : near.polygons) {
        least = std::min(least, distance(polygon.corners, Segment{p, p}));
      }
      return least - car_radius;
    };
    return all_above(places, margin, room);
  };
  count(space, car_radius, is_free, keeps);
}

void count_arms() {
  const Scene scene = spheres(9);
  const ArmWorld world = world_of(9, 0.1);
  const SerialChain chain(puma560_table(0.1));
  const auto ends = [&](std::size_t i) {
    const JointState a = uniform_state(world, 5, 2 * i);
    const JointState far = uniform_state(world, 5, 2 * i + 1);
    return std::pair{a, world.interpolate(a, far, std::min(1.0, 1.5 / world.distance(a, far)))};
  };
  const auto is_free = [&](std::size_t i) {
    auto query = world.make_query();
    const auto [a, b] = ends(i);
    return world.is_free_motion(a, b, query);
  };
  const auto keeps = [&](std::size_t i, int places, double margin) {
    const std::pair<JointState, JointState> m = ends(i);
    return all_above(places, margin,
                     [&](double t) { return plain_clearance(chain, scene, world.interpolate(m.first, m.second, t)); });
  };
  count("a Puma 560 with a tool of 0.1 among 9 spheres", puma_radius, is_free, keeps);
}

}  // namespace

int main() {
  count_turning();
  count_cars<DubinsCurve>("a car on Dubins curves among 20 hexagons");
  count_cars<ReedsSheppCurve>("a car on Reeds-Shepp curves among 20 hexagons");
  count_arms();
}
