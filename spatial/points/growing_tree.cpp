// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/growing_tree.hpp"

#include <cmath>
#include <limits>

#include "core/base/whole.hpp"

namespace warren {
namespace {

constexpr std::size_t smallest_tree = 128;

}  // namespace

template <int D>
void GrowingTree<D>::insert(const Point& p) {
  points_.push_back(p);
  if (points_.size() - filed_ == smallest_tree) rebuild();
}

/// The newest points and all trees not larger than what they make together become one tree.
template <int D>
void GrowingTree<D>::rebuild() {
  std::size_t first = filed_;
  while (!levels_.empty() && levels_.back().tree.size() <= points_.size() - first) {
    first = levels_.back().first;
    levels_.pop_back();
  }
  const Execution alone{.threads = 1};
  levels_.push_back({first, KdTree<D>(std::span<const Point>(points_).subspan(first), alone)});
  filed_ = points_.size();
}

template <int D>
Neighbour GrowingTree<D>::nearest(const Point& p) {
  Neighbour best{no_vertex, std::numeric_limits<double>::infinity()};
  for (const Level& level : levels_) {
    const auto consider = [&](VertexId place, double distance) {
      best = std::min(best, Neighbour{as_whole<VertexId>(level.first + place), distance});
    };
    if (best.id != no_vertex) {
      level.tree.for_each_within(p, best.distance, consider);
      continue;
    }
    level.tree.nearest(p, 1, no_vertex, found_);
    consider(found_.front().id, found_.front().distance);
  }
  for (std::size_t i = filed_; i < points_.size(); ++i) {
    best = std::min(best, Neighbour{as_whole<VertexId>(i), distance_between<D>(points_[i], p)});
  }
  return best;
}

template class GrowingTree<2>;
template class GrowingTree<3>;
template class GrowingTree<4>;
template class GrowingTree<6>;

}  // namespace warren
