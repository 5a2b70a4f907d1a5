// SPDX-License-Identifier: BSD-3-Clause
// Point sets that neighbour indices must get right, and the plain answers that they are held against.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "spatial/points/neighbour.hpp"

namespace warren::test {

inline double axis_value(Vec2 p, int axis) { return axis == 0 ? p.x : p.y; }
template <std::size_t D>
double axis_value(const std::array<double, D>& p, int axis) {
  return p[static_cast<std::size_t>(axis)];
}

template <int D>
PointOf<D> make_point(const std::array<double, 16>& values) {
  if constexpr (D == 2) {
    return {values[0], values[1]};
  } else {
    PointOf<D> p;
    std::copy_n(values.begin(), D, p.begin());
    return p;
  }
}

template <int D>
double plain_distance(const PointOf<D>& a, const PointOf<D>& b) {
  double sum = 0.0;
  for (int axis = 0; axis < D; ++axis) {
    const double d = axis_value(a, axis) - axis_value(b, axis);
    sum += d * d;
  }
  return std::sqrt(sum);
}

/// All points but `except`, ascending by (distance, id): the plain answer to every query is a part of it.
template <int D>
std::vector<Neighbour> all_by_distance(const std::vector<PointOf<D>>& points, const PointOf<D>& p, VertexId except) {
  std::vector<Neighbour> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i != except) all.push_back({static_cast<VertexId>(i), plain_distance<D>(points[i], p)});
  }
  std::sort(all.begin(), all.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
  });
  return all;
}

template <int D>
struct PointSet {
  std::string name;
  std::vector<PointOf<D>> points;
};

/// Even, clustered, equal, collinear, lattice (plain and turned), tiny, huge, far off and mixed sets of about n points.
template <int D>
std::vector<PointSet<D>> point_sets(std::uint64_t seed, std::size_t n) {
  using Values = std::array<double, 16>;
  const auto u = [&](std::uint64_t i, std::uint64_t axis) { return uniform(seed, i, axis); };
  const auto make = [&](std::string name, std::size_t count, auto value) {
    PointSet<D> set{std::move(name), {}};
    for (std::size_t i = 0; i < count; ++i) {
      Values v{};
      for (std::uint64_t axis = 0; axis < 8; ++axis) v[axis] = value(i, axis);
      set.points.push_back(make_point<D>(v));
    }
    return set;
  };
  const auto lattice = [&](std::size_t i, std::uint64_t axis) {
    return static_cast<double>(axis == 0 ? i % 17 : axis == 1 ? i / 17 : 0);
  };
  return {
      make("none", 0, u),
      make("one", 1, u),
      make("two", 2, u),
      make("even", n, [&](auto i, auto axis) { return 40.0 * u(i, axis) - 7.0; }),
      make("equal", n / 4, [&](auto, auto) { return 3.25; }),
      make("pairs", n, [&](auto i, auto axis) { return u(i / 2, axis); }),
      make("collinear", n, [&](auto i, auto axis) { return axis == 0 ? u(i, 0) : 0.0; }),
      make("diagonal", n, [&](auto i, auto axis) { return u(i, 0) * static_cast<double>(1 + axis); }),
      make("lattice", n, lattice),
      make("turned lattice", n,
           [&](auto i, auto axis) {
             const double c = std::sqrt(3.0) / 2.0;
             const double x = lattice(i, 0);
             const double y = lattice(i, 1);
             return axis == 0 ? c * x - 0.5 * y : axis == 1 ? 0.5 * x + c * y : 0.0;
           }),
      make("tiny", n, [&](auto i, auto axis) { return 1e-3 * u(i, axis); }),
      make("large", n, [&](auto i, auto axis) { return 1e3 * u(i, axis); }),
      make("far off", n, [&](auto i, auto axis) { return 1e6 + u(i, axis); }),
      make("at the limit of doubles", n, [&](auto i, auto axis) { return 1e6 + 1e-9 * u(i, axis); }),
      make("vast", n, [&](auto i, auto axis) { return 1e60 * (u(i, axis) - 0.5); }),
      make("clustered", n,
           [&](auto i, auto axis) {
             return std::floor(3.0 * u(i % 5, axis)) + std::pow(10.0, -6.0 * u(i, 7)) * u(i, axis);
           }),
      make("one far away", n, [&](auto i, auto axis) { return i == 3 ? 1e9 : u(i, axis); }),
  };
}

}  // namespace warren::test
