// SPDX-License-Identifier: BSD-3-Clause
// Neighbours<D>: one interface to PointGrid, KdTree<D> and BruteNeighbours<D>, usually by a rule of counts. In the
// plane the grid is built first (it is cheap) and kept unless points crowd in few of its cells; there, and in more
// dimensions, the k-d trees. The answers are the same bits either way. bench/neighbours_bench.cpp has the crossing
// point of the two.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"
#include "spatial/points/kd_tree.hpp"
#include "spatial/points/neighbour.hpp"
#include "spatial/points/point_grid.hpp"

namespace warren {

/// Neighbours by looking at every point: what the indices are measured against. A query costs O(n). As KdTree.
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

/// Crowding (see PointGrid) beyond which the k-d trees answer sooner. Evenly spread points have 3; clusters over two
/// decades have 18 (k = 8: grid 290 ns, trees 500), over three decades 100 (1120 and 520).
inline constexpr double most_crowding = 40.0;

/// by_counts: the rule above. grid: in the plane alone.
enum class NeighbourIndex : std::uint8_t { by_counts, kd_tree, grid, brute };
constexpr auto enum_names(NeighbourIndex) {
  return std::array<std::string_view, 4>{"auto", "kd-tree", "grid", "brute"};
}

/// Immutable after construction; any number of threads may query.
template <int D>
class Neighbours {
 public:
  using Point = PointOf<D>;

  Neighbours() = default;  ///< no points
  /// Copies the points; but in the plane those in tile order, which is best, must outlive the index. Below 2^32 points.
  /// The execution must outlive an index by brute force. Throws Stopped.
  Neighbours(std::span<const Point> points, const Execution& execution, NeighbourIndex kind = NeighbourIndex::by_counts)
      : kind_(kind) {
    if (kind_ == NeighbourIndex::brute) {
      brute_ = BruteNeighbours<D>(points, execution);
      return;
    }
    if constexpr (D == 2) {
      if (kind_ != NeighbourIndex::kd_tree) {
        grid_ = PointGrid(points, execution);
        if (kind_ == NeighbourIndex::grid || grid_.crowding() <= most_crowding) return;
        grid_ = PointGrid();
      }
    }
    tree_ = KdTree<D>(points, execution);
    kind_ = NeighbourIndex::kd_tree;
  }

  bool uses_tree() const { return kind_ == NeighbourIndex::kd_tree; }
  std::size_t size() const {
    return with([](const auto& index) { return index.size(); });
  }
  /// Point `id`, as it came.
  Point point(VertexId id) const {
    return with([&](const auto& index) -> Point { return index.point(id); });
  }

  /// The k points nearest to p (fewer if there are not so many) but `except`, ascending by (distance, id).
  void nearest(const Point& p, std::size_t k, VertexId except, std::vector<Neighbour>& out) const {
    with([&](const auto& index) { index.nearest(p, k, except, out); });
  }
  /// All points at a distance <= radius from p but `except`, ascending by (distance, id).
  void within(const Point& p, const SearchRadius& radius, VertexId except, std::vector<Neighbour>& out) const {
    with([&](const auto& index) { index.within(p, radius, except, out); });
  }
  /// Calls visit(id, distance) for all points at a distance <= radius from p, in an order that depends on the points.
  template <class Visit>
  void for_each_within(const Point& p, const SearchRadius& radius, const Visit& visit) const {
    with([&](const auto& index) { index.for_each_within(p, radius, visit); });
  }
  /// Calls visit(i, j) for each point i of the range, ascending, and all points j > i at a distance <= radius from it:
  /// over all points, each pair once.
  template <class Visit>
  void for_each_later_pair(Range ids, const SearchRadius& radius, const Visit& visit) const {
    with([&](const auto& index) { index.for_each_later_pair(ids, radius, visit); });
  }

 private:
  template <class Use>
  auto with(const Use& use) const {
    if (kind_ == NeighbourIndex::brute) return use(brute_);
    if constexpr (D == 2) {
      if (!uses_tree()) return use(grid_);
    }
    return use(tree_);
  }

  PointGrid grid_;
  KdTree<D> tree_;
  BruteNeighbours<D> brute_;
  NeighbourIndex kind_ = NeighbourIndex::by_counts;
};

}  // namespace warren
