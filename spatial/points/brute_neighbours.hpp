// SPDX-License-Identifier: BSD-3-Clause
// Neighbours by looking at every point: what the indices are measured against. A query costs O(n).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"
#include "spatial/points/neighbour.hpp"

namespace warren {

/// As KdTree.
template <int D>
class BruteNeighbours : public NeighboursByVisits<BruteNeighbours<D>, D> {
 public:
  using Point = PointOf<D>;

  BruteNeighbours() = default;  ///< no points
  /// Copies the points. The execution, which queries poll, must outlive it. Throws Stopped, as do queries.
  BruteNeighbours(std::span<const Point> points, const Execution& execution) : execution_(&execution) {
    execution.reserve(points.size() * sizeof(Point));
    points_.assign(points.begin(), points.end());
  }

  std::size_t size() const { return points_.size(); }
  std::size_t bytes() const { return points_.size() * sizeof(Point); }
  const Point& point(VertexId id) const { return points_[id]; }

  /// The k points nearest to p (fewer if there are not so many) but `except`, ascending by (distance, id).
  void nearest(const Point& p, std::size_t k, VertexId except, std::vector<Neighbour>& out) const {
    out.clear();
    if (k == 0) return;
    for_each(p, [&](const Neighbour& n) {
      if (n.id == except || (out.size() == k && !(n < out.front()))) return;
      if (out.size() == k) {
        std::pop_heap(out.begin(), out.end());
        out.pop_back();
      }
      out.push_back(n);
      std::push_heap(out.begin(), out.end());
    });
    std::sort_heap(out.begin(), out.end());
  }
  /// Calls visit(id, distance) for all points at a distance <= radius from p, ascending by id.
  template <class Visit>
  void for_each_within(const Point& p, const SearchRadius& radius, const Visit& visit) const {
    for_each(p, [&](const Neighbour& n) {
      if (n.distance <= radius.length()) visit(n.id, n.distance);
    });
  }

 private:
  template <class Visit>
  void for_each(const Point& p, const Visit& visit) const {
    constexpr std::size_t points_per_poll = std::size_t{1} << 14;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i % points_per_poll == 0) execution_->check();
      visit(Neighbour{as_whole<VertexId>(i), distance_between<D>(points_[i], p)});
    }
  }

  RawVector<Point> points_;
  const Execution* execution_ = nullptr;
};

}  // namespace warren
