// SPDX-License-Identifier: BSD-3-Clause
// Nearest neighbours among points that keep coming: what a tree that grows asks at every step. Logarithmic rebuilding
// (Bentley, Saxe, J. Algorithms 1, 1980): the newest up to 127 points are looked at one by one; when there are 128
// they become a k-d tree, and two trees of one size become one of the double size, so that n points lie in at most
// log2(n / 128) trees. An insertion costs O(log^2 n) on average, a query O(log^2 n) and 128 distances at most. The
// answers are those of brute force, ties by id. Measured in bench/certified_motion_bench.cpp.
#pragma once

#include <vector>

#include "spatial/points/kd_tree.hpp"

namespace warren {

/// Points are numbered as they come. For one thread. D = 2, 3, 4 and 6.
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

 private:
  /// Points first .. first + tree.size() - 1, in the order of their numbers.
  struct Level {
    std::size_t first;
    KdTree<D> tree;
  };
  void rebuild();

  std::vector<Point> points_;
  std::vector<Level> levels_;     // large ones first, sizes halve or more
  std::size_t filed_ = 0;         // points in levels
  std::vector<Neighbour> found_;  // scratch
};

extern template class GrowingTree<2>;
extern template class GrowingTree<3>;
extern template class GrowingTree<4>;
extern template class GrowingTree<6>;

}  // namespace warren
