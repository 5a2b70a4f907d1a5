// SPDX-License-Identifier: BSD-3-Clause
// Arms by plain means, for the tests: 4 x 4 matrices multiplied out, distances by golden sections, motions by dense
// sampling. Shares nothing with worlds/arms/serial_chain and worlds/arms/arm_world but the table.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren::arm_oracle {

using Matrix = std::array<std::array<double, 4>, 4>;
using Point = std::array<double, 3>;

inline Matrix identity() {
  Matrix m{};
  for (std::size_t i = 0; i < 4; ++i) m[i][i] = 1.0;
  return m;
}

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) m[i][j] += a[i][k] * b[k][j];
    }
  }
  return m;
}

inline Matrix turn_x(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {{{1, 0, 0, 0}, {0, c, -s, 0}, {0, s, c, 0}, {0, 0, 0, 1}}};
}
inline Matrix turn_z(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {{{c, -s, 0, 0}, {s, c, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}
inline Matrix shift(double x, double y, double z) { return {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}, {0, 0, 0, 1}}}; }

inline Matrix tool_of(const DhTable& table) {
  Matrix m{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) m[i][j] = table.tool.matrix()(static_cast<int>(i), static_cast<int>(j));
  }
  return m;
}

/// Frames 0 .. n and the tool's.
inline std::vector<Matrix> frames(const DhTable& table, const JointState& q) {
  std::vector<Matrix> all{identity()};
  for (std::size_t i = 0; i < table.joints.size(); ++i) {
    const DhJoint& j = table.joints[i];
    const Matrix turn = turn_z(q[i] + j.offset_rad);
    const Matrix step = table.convention == DhConvention::standard
                            ? turn * shift(0, 0, j.d) * shift(j.a, 0, 0) * turn_x(j.alpha_rad)
                            : turn_x(j.alpha_rad) * shift(j.a, 0, 0) * turn * shift(0, 0, j.d);
    all.push_back(all.back() * step);
  }
  all.push_back(all.back() * tool_of(table));
  return all;
}

inline Point origin(const Matrix& m) { return {m[0][3], m[1][3], m[2][3]}; }

/// Origins of all frames and the tool's.
inline std::vector<Point> points(const DhTable& table, const JointState& q) {
  std::vector<Point> all;
  for (const Matrix& m : frames(table, q)) all.push_back(origin(m));
  return all;
}

inline double apart(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
inline Point between(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// Least value of a convex function on [0, 1], by thirds.
template <class Function>
double least_of_convex(const Function& f, int rounds = 100) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < rounds; ++i) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (f(a) <= f(b) ? high : low) = f(a) <= f(b) ? b : a;
  }
  return std::min({f(0.0), f(1.0), f(0.5 * (low + high))});
}

inline double distance(const Point& p, const Sphere& s) { return std::max(0.0, apart(p, {s.x, s.y, s.z}) - s.radius); }
inline double distance(const Point& p, const SolidBox& box) {
  Point nearest;
  for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] = std::clamp(p[axis], box.low[axis], box.high[axis]);
  return apart(p, nearest);
}

/// From segment a b.
template <class Solid>
double segment_distance(const Point& a, const Point& b, const Solid& solid) {
  return least_of_convex([&](double t) { return distance(between(a, b, t), solid); });
}
inline double segments_apart(const Point& a, const Point& b, const Point& c, const Point& d) {
  constexpr int rounds = 45;  // to a ten-millionth of the length
  const auto from = [&](double t) {
    return least_of_convex([&](double u) { return apart(between(a, b, t), between(c, d, u)); }, rounds);
  };
  return least_of_convex(from, rounds);
}

/// The spines of the arm at q: between consecutive origins that are apart.
inline std::vector<std::array<Point, 2>> spines(const DhTable& table, const JointState& q) {
  std::vector<std::array<Point, 2>> all;
  const std::vector<Point> at = points(table, q);
  Point from = at.front();
  for (const Point& to : at) {
    if (apart(from, to) > 1e-9) all.push_back({from, to});
    from = to;
  }
  return all;
}

/// Distance of the capsules from spheres and boxes.
inline double clearance(const Scene& scene, const DhTable& table, double radius, const JointState& q) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : spines(table, q)) {
    for (const Sphere& s : scene.spheres) least = std::min(least, segment_distance(a, b, s));
    for (const SolidBox& box : scene.boxes) least = std::min(least, segment_distance(a, b, box));
  }
  return least - radius;
}

/// Point–sphere distances only, without iteration: for dense sampling.
inline double quick_clearance(const Scene& scene, const DhTable& table, double radius, const JointState& q) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : spines(table, q)) {
    const double square = apart(a, b) * apart(a, b);
    for (const Sphere& s : scene.spheres) {
      const double along = (s.x - a[0]) * (b[0] - a[0]) + (s.y - a[1]) * (b[1] - a[1]) + (s.z - a[2]) * (b[2] - a[2]);
      least = std::min(least, distance(between(a, b, std::clamp(along / square, 0.0, 1.0)), s));
    }
  }
  return least - radius;
}

inline JointState at_share(const JointState& a, const JointState& b, double t) {
  JointState q;
  for (std::size_t j = 0; j < q.size(); ++j) q[j] = a[j] + t * (b[j] - a[j]);
  return q;
}

/// A random state within the limits.
inline JointState random_state(const DhTable& table, std::uint64_t seed, std::uint64_t index) {
  JointState q{};
  for (std::size_t j = 0; j < table.joints.size(); ++j) {
    q[j] = table.joints[j].low_rad + uniform(seed, index, j) * (table.joints[j].high_rad - table.joints[j].low_rad);
  }
  return q;
}

/// But for rounding; joints that the table lacks stay at 0.
inline bool is_within_limits(const DhTable& table, const JointState& q) {
  constexpr double rounding = 1e-12;
  for (std::size_t j = 0; j < q.size(); ++j) {
    const double low = j < table.joints.size() ? table.joints[j].low_rad : 0.0;
    const double high = j < table.joints.size() ? table.joints[j].high_rad : 0.0;
    if (!(q[j] >= low - rounding && q[j] <= high + rounding)) return false;
  }
  return true;
}

/// Spheres around the arm, none at its base.
inline Scene scattered_spheres(std::uint64_t seed, std::size_t count) {
  Scene scene;
  for (std::uint64_t i = 0; scene.spheres.size() < count; ++i) {
    const auto at = [&](std::uint64_t axis) { return 2.0 * uniform(seed, i, axis) - 1.0; };
    const Sphere s{at(0), at(1), at(2), 0.05 + 0.2 * uniform(seed, i, 3)};
    if (std::hypot(s.x, s.y, s.z) > s.radius + 0.2) scene.spheres.push_back(s);
  }
  return scene;
}

inline void add_boxes(Scene& scene, std::uint64_t seed, std::size_t count) {
  for (std::uint64_t i = 0, added = 0; added < count; ++i) {
    SolidBox box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = 2.0 * uniform(seed, i, 10 + axis) - 1.0;
      box.high[axis] = box.low[axis] + 0.3 * uniform(seed, i, 20 + axis);
    }
    if (distance(Point{0, 0, 0}, box) < 0.2) continue;
    scene.boxes.push_back(box);
    ++added;
  }
}

/// The Puma 560 as a modified table with the dimensions of Armstrong, Khatib and Burdick (1986), which differ by
/// millimetres from those of the standard one and have the shoulder's offset in two parts.
inline DhTable modified_puma_table(double tool = 0.0, PumaLimits limits = PumaLimits::classic) {
  constexpr double quarter = std::numbers::pi / 2.0;
  constexpr std::array<std::array<double, 3>, 6> rows{{{0, 0, 0},
                                                       {0.2435, 0, -quarter},
                                                       {-0.0934, 0.4318, 0},
                                                       {0.4331, -0.0203, quarter},
                                                       {0, 0, -quarter},
                                                       {0, 0, quarter}}};
  DhTable table = puma560_table(tool, limits);
  table.convention = DhConvention::modified;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [d, a, alpha] = rows[i];
    table.joints[i] = {d, a, alpha, table.joints[i].low_rad, table.joints[i].high_rad, 0.0};
  }
  return table;
}

/// A table of random lengths and twists.
inline DhTable random_table(std::uint64_t seed, DhConvention convention) {
  DhTable table;
  table.convention = convention;
  const std::size_t joints = 1 + random_bits(seed, 0, 99) % most_chain_joints;
  for (std::size_t i = 0; i < joints; ++i) {
    const auto length = [&](std::uint64_t axis) {
      return uniform(seed, i, axis) < 0.3 ? 0.0 : uniform(seed, i, axis + 10) - 0.5;
    };
    const double quarter = std::numbers::pi / 2.0 * (static_cast<double>(random_bits(seed, i, 5) % 4) - 1.0);
    const double alpha = uniform(seed, i, 6) < 0.7 ? quarter : 3.0 * uniform(seed, i, 7) - 1.5;
    table.joints.push_back({length(0), length(1), alpha, -2.0, 2.5, uniform(seed, i, 8) < 0.5 ? 0.0 : 0.7});
  }
  table.tool.translation() = Vec3(0.0, uniform(seed, 1, 30) < 0.5 ? 0.0 : 0.1, uniform(seed, 1, 31) < 0.5 ? 0.0 : 0.2);
  return table;
}

}  // namespace warren::arm_oracle
