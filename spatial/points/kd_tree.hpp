// SPDX-License-Identifier: BSD-3-Clause
// Neighbours in D dimensions, for any distribution of points: a forest of k-d trees. A small top tree, cut at medians
// of a sample of the points, deals them to subtrees of about 16,384 points, which nanoflann builds in parallel; points
// are then stored in the order of the leaves. Everything is a function of the points alone, whatever the threads. Build
// O(n log n); a query O(log n + k) for points in general position. Memory 8 D + 12 bytes a point and the nodes. Many
// equal points are the one weak spot: all points that tie with the k-th are looked at, since ties break by id.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/function_ref.hpp"
#include "parallel/chunks.hpp"
#include "spatial/points/neighbour.hpp"

namespace warren {

/// Immutable after construction; any number of threads may query. All answers are exact: the same neighbours, distances
/// and order as brute force. Instantiated for D = 2, 3, 4 and 16.
template <int D>
class KdTree : public NeighboursByVisits<KdTree<D>, D> {
 public:
  using Point = PointOf<D>;

  KdTree() = default;  ///< no points
  /// Copies the points. Coordinates finite; below 2^32 points. Throws Stopped.
  KdTree(std::span<const Point> points, const Execution& execution);

  std::size_t size() const;
  /// Point `id`, as it came.
  const Point& point(VertexId id) const;

  /// The k points nearest to p (fewer if there are not so many) but `except`, ascending by (distance, id).
  void nearest(const Point& p, std::size_t k, VertexId except, std::vector<Neighbour>& out) const;
  /// Calls visit(id, distance) for all points at a distance <= radius from p, in an order that depends on the points.
  void for_each_within(const Point& p, const SearchRadius& radius, FunctionRef<void(VertexId, double)> visit) const;

 private:
  struct Forest;
  struct Fell {
    void operator()(const Forest* forest) const noexcept;
  };
  std::unique_ptr<const Forest, Fell> forest_;
};

extern template class KdTree<2>;
extern template class KdTree<3>;
extern template class KdTree<4>;
extern template class KdTree<16>;

/// Nearest neighbours among points that keep coming: what a tree that grows asks at every step. Logarithmic rebuilding
/// (Bentley, Saxe, J. Algorithms 1, 1980): the newest up to 127 points are looked at one by one; when there are 128
/// they become a k-d tree, and two trees of one size become one of the double size, so that n points lie in at most
/// log2(n / 128) trees. An insertion costs O(log^2 n) on average, a query O(log^2 n) and 128 distances at most, and of
/// k neighbours k log k. Where D > 4 a tree spares few distances: it takes 2048 points, of which eight at once are
/// looked at in floats; only those that may be near enough by these are looked at themselves. The answers are those of
/// brute force, ties by id. Measured in bench/certified_motion_bench.cpp. Points are numbered as they come. For one
/// thread. D = 2, 3, 4 and 16.
template <int D>
class GrowingTree {
 public:
  using Point = PointOf<D>;

  /// Its number is size() before. Finite coordinates; below 2^32 points.
  void insert(const Point& p);
  std::size_t size() const { return points_.size(); }
  const Point& point(VertexId id) const { return points_[id]; }
  /// The nearest point, the first of them; size() >= 1.
  Neighbour nearest(const Point& p);
  /// The k points nearest to p (fewer if there are not so many), ascending by (distance, id).
  void nearest(const Point& p, std::size_t k, std::vector<Neighbour>& out);

 private:
  /// Points first .. first + tree.size() - 1, in the order of their numbers.
  struct Level {
    std::size_t first;
    KdTree<D> tree;
  };
  static constexpr bool is_wide = D > 4;
  static constexpr std::size_t smallest_tree = is_wide ? 2048 : 128;
  void rebuild();
  /// take(id, distance) for each of the newest points that is not farther than `most`, where only the nearest counts
  /// for those that may be it; for some others, too.
  template <class Take>
  void look_at_newest(const Point& p, double most, bool only_nearest, const Take& take);

  /// Eight points in floats, by axis; where there is none, the first one's is infinite.
  using Eight = std::array<std::array<float, 8>, D>;

  std::vector<Point> points_;
  std::vector<Level> levels_;     // large ones first, sizes halve or more
  std::size_t filed_ = 0;         // points in levels
  std::vector<Eight> newest_;     // where D is wide
  std::size_t axes_ = 0;          // of these, all others are 0
  double largest_ = 0.0;          // coordinate of these, in size
  std::vector<float> squares_;    // scratch
  std::vector<float> leasts_;     // scratch: of eight times eight of these
  std::vector<Neighbour> found_;  // scratch
};

extern template class GrowingTree<2>;
extern template class GrowingTree<3>;
extern template class GrowingTree<4>;
extern template class GrowingTree<16>;

}  // namespace warren
