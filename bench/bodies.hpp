// SPDX-License-Identifier: BSD-3-Clause
// Worlds of bodies for benchmarks and for certificates.cpp: a kite that turns among hexagons, a car among hexagons, a
// Puma among spheres; and the plain clearances of the first and the last, by loops over all obstacles.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/polygon.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/serial_chain.hpp"
#include "worlds/poses/car_world.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren::bench {

inline const std::vector<Vec2> kite = {{0.10, 0.63}, {0.22, 0.41}, {0.49, 0.20}, {0.48, 0.82}};

/// n hexagons in a square that grows with them: their density stays.
inline Scene hexagons(std::size_t n) {
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

inline std::vector<Vec2> body_at(const Se2& pose) {
  std::vector<Vec2> corners;
  for (const Vec2 p : kite) corners.push_back(placed(pose, p));
  return corners;
}

inline double plain_clearance(const Scene& scene, const Se2& pose) {
  const std::vector<Vec2> body = body_at(pose);
  double least = 1e9;
  for (const Vec2 p : body) {
    least = std::min({least, p.x - scene.bounds->min.x, scene.bounds->max.x - p.x, p.y - scene.bounds->min.y,
                      scene.bounds->max.y - p.y});
  }
  for (const ScenePolygon& polygon : scene.polygons) least = std::min(least, distance(body, polygon.corners));
  return least;
}

struct PoseMotion {
  Se2 a;
  Se2 b;
};

/// Hexagons as dense as the obstacles of the study's scene for cars.
inline Scene car_hexagons() {
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

/// Both ends free, up to four turning radii of way.
template <class World>
PoseMotion car_motion(const World& world, std::uint64_t index, typename World::Query& query) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    const Se2 a = uniform_state(world, index, 2 * attempt);
    const Se2 far = uniform_state(world, index, 2 * attempt + 1);
    const Se2 b = world.interpolate(a, far, std::min(1.0, 4.0 / world.distance(a, far)));
    if (world.is_free(a, query) && world.is_free(b, query)) return {a, b};
  }
}

/// n spheres around a Puma, none at its base; their size shrinks with their number so that as much stays free.
inline Scene spheres(std::size_t n) {
  Scene scene;
  const double size = 0.55 / std::cbrt(static_cast<double>(n));
  for (std::uint64_t i = 0; scene.spheres.size() < n; ++i) {
    const auto at = [&](std::uint64_t axis) { return 2.0 * uniform(1, i, axis) - 1.0; };
    const Sphere s{at(0), at(1), at(2), size * (0.5 + 0.5 * uniform(1, i, 3))};
    if (std::hypot(s.x, s.y, s.z) > s.radius + 0.2) scene.spheres.push_back(s);
  }
  return scene;
}

inline constexpr double puma_radius = 0.05;

inline ArmWorld world_of(std::size_t n, double tool = 0.0) {
  return {spheres(n), model_of(puma560_table(tool), puma_radius, false), {}};
}

/// Of a Puma with such a tool among spheres, by a plain loop.
inline double plain_clearance(const SerialChain& chain, const Scene& scene, const JointState& q) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i <= chain.joint_count(); ++i) points.push_back(chain.frame(q, i).translation());
  points.push_back(chain.tool_pose(q).translation());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec3 way = points[i] - points[i - 1];
    const double square = way.squaredNorm();
    if (!(square > 0.0)) continue;
    for (const Sphere& s : scene.spheres) {
      const Vec3 to = Vec3(s.x, s.y, s.z) - points[i - 1];
      const double t = std::clamp(to.dot(way) / square, 0.0, 1.0);
      least = std::min(least, (to - t * way).norm() - s.radius);
    }
  }
  return least - puma_radius;
}

}  // namespace warren::bench
