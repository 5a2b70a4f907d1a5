// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/solid_rays.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace warren {
namespace {

constexpr double no_hit = std::numeric_limits<double>::infinity();

/// Where a ray enters a ball that goes from a to b; no_hit where it passes by.
double enter_ball(const Vec3& eye, const Vec3& ray, const Vec3& centre, double radius) {
  const Vec3 off = eye - centre;
  const double b = off.dot(ray);
  const double root = b * b - off.squaredNorm() + radius * radius;
  return root < 0.0 ? no_hit : -b - std::sqrt(root);
}
double enter_swept_ball(const Vec3& eye, const Vec3& ray, const Solid& s) {
  const Vec3 along = s.b - s.a;
  const Vec3 off = eye - s.a;
  const double along_sq = along.squaredNorm();
  if (along_sq <= 0.0) return enter_ball(eye, ray, s.a, s.radius);
  const double along_ray = along.dot(ray);
  const double along_off = along.dot(off);
  const double a = along_sq - along_ray * along_ray;
  const double b = along_sq * ray.dot(off) - along_off * along_ray;
  const double c = along_sq * (off.squaredNorm() - s.radius * s.radius) - along_off * along_off;
  const double root = b * b - a * c;
  if (a > 0.0 && root >= 0.0) {
    const double t = (-b - std::sqrt(root)) / a;
    const double place = along_off + t * along_ray;
    if (place > 0.0 && place < along_sq) return t;
  }
  return std::min(enter_ball(eye, ray, s.a, s.radius), enter_ball(eye, ray, s.b, s.radius));
}
double enter_box(const Vec3& eye, const Vec3& ray, const Solid& s) {
  double from = -no_hit;
  double to = no_hit;
  for (int k = 0; k < 3; ++k) {
    if (ray[k] == 0.0) {
      if (eye[k] < s.a[k] || eye[k] > s.b[k]) return no_hit;
      continue;
    }
    const double one = (s.a[k] - eye[k]) / ray[k];
    const double two = (s.b[k] - eye[k]) / ray[k];
    from = std::max(from, std::min(one, two));
    to = std::min(to, std::max(one, two));
  }
  return from <= to ? from : no_hit;
}
}  // namespace

double enter_solid(const Vec3& eye, const Vec3& ray, const Solid& s) {
  return s.radius < 0.0 ? enter_box(eye, ray, s) : enter_swept_ball(eye, ray, s);
}

Vec3 normal_at(const Vec3& p, const Solid& s) {
  if (s.radius < 0.0) {
    const Vec3 half = 0.5 * (s.b - s.a);
    const Vec3 off = p - 0.5 * (s.a + s.b);
    int face = 0;
    double best = -1.0;
    for (int k = 0; k < 3; ++k) {
      const double share = half[k] > 0.0 ? std::abs(off[k]) / half[k] : 1.0;
      if (share > best) {
        best = share;
        face = k;
      }
    }
    Vec3 normal = Vec3::Zero();
    normal[face] = off[face] < 0.0 ? -1.0 : 1.0;
    return normal;
  }
  const Vec3 along = s.b - s.a;
  const double along_sq = along.squaredNorm();
  const double place = along_sq > 0.0 ? std::clamp(along.dot(p - s.a) / along_sq, 0.0, 1.0) : 0.0;
  return (p - s.a - place * along) / s.radius;
}

}  // namespace warren
