// SPDX-License-Identifier: BSD-3-Clause
// The words that all neighbour indices share: a neighbour, the order of neighbours, and a radius that is ready to be
// compared with squares. Distances are plain (never squared) doubles: the rounded root of the rounded sum of the
// rounded squares, axis 0 first, as in core's distance(). Every index gives these very bits and breaks ties by id.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"

namespace warren {

/// A point of D-dimensional space, as the indices take it: Vec2 in the plane, else an array.
template <int D>
using PointOf = std::conditional_t<D == 2, Vec2, std::array<double, as_whole<std::size_t>(D)>>;

/// As the indices compute it: axis 0 first.
template <int D>
double distance_between(const PointOf<D>& a, const PointOf<D>& b) {
  if constexpr (D == 2) {
    return distance(a, b);
  } else {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < D; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return std::sqrt(sum);
  }
}

/// The axis on which at(element, axis) spreads most, the first of such; D axes, one element at least.
template <int D, class Elements, class At>
std::size_t widest_axis(const Elements& elements, const At& at) {
  std::size_t best = 0;
  double widest = -1.0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const auto less = [&](const auto& a, const auto& b) { return at(a, axis) < at(b, axis); };
    const auto [low, high] = std::minmax_element(elements.begin(), elements.end(), less);
    const double width = at(*high, axis) - at(*low, axis);
    if (width > widest) {
      widest = width;
      best = axis;
    }
  }
  return best;
}

struct Neighbour {
  VertexId id;
  double distance;  ///< world units
  friend constexpr bool operator==(const Neighbour&, const Neighbour&) = default;
  /// Nearer first, ties by id.
  friend constexpr bool operator<(const Neighbour& a, const Neighbour& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
  }
};

/// A radius, made once and used for many queries. Converts from a number, so that a single query needs no more.
class SearchRadius {
 public:
  SearchRadius(double radius) noexcept  // NOLINT(google-explicit-constructor): a number is a radius
      : length_(radius), square_(largest_square(radius)), reach_(radius * (1.0 + 1e-15)) {}

  double length() const { return length_; }
  /// sqrt(s) <= length() exactly for s <= square(); negative if no distance is that small.
  double square() const { return square_; }
  /// A little more than length(): no point within length() lies further on any axis, rounding included.
  double reach() const { return reach_; }

 private:
  static double largest_square(double radius) noexcept {
    if (!(radius >= 0.0)) return -1.0;
    double square = radius * radius;
    if (square > std::numeric_limits<double>::max()) return square;
    const auto step = [](double s, std::int64_t by) {
      return std::bit_cast<double>(std::bit_cast<std::int64_t>(s) + by);
    };
    while (square > 0.0 && std::sqrt(square) > radius) square = step(square, -1);
    while (std::sqrt(step(square, 1)) <= radius) square = step(square, 1);
    return square;
  }

  double length_;
  double square_;
  double reach_;
};

/// What an index answers by its for_each_within() and point(). Index: derives from this.
template <class Index, int D>
class NeighboursByVisits {
 public:
  /// All points at a distance <= radius from p but `except`, ascending by (distance, id).
  void within(const PointOf<D>& p, const SearchRadius& radius, VertexId except, std::vector<Neighbour>& out) const {
    out.clear();
    index().for_each_within(p, radius, [&](VertexId id, double distance) {
      if (id != except) out.push_back({id, distance});
    });
    std::sort(out.begin(), out.end());
  }
  /// Calls visit(i, j) for each point i of the range, ascending, and all points j > i at a distance <= radius from it:
  /// over all points, each pair once.
  template <class Visit>
  void for_each_later_pair(Range ids, const SearchRadius& radius, const Visit& visit) const {
    for (std::size_t next = ids.first; next < ids.last; ++next) {
      const auto i = as_whole<VertexId>(next);
      index().for_each_within(index().point(i), radius, [&](VertexId j, double) {
        if (j > i) visit(i, j);
      });
    }
  }

 private:
  const Index& index() const { return static_cast<const Index&>(*this); }
};

}  // namespace warren
