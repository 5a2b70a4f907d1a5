// SPDX-License-Identifier: BSD-3-Clause
// A static tree of boxes: which obstacles are near a body. Binary, cut at the median of the centres on the wider axis,
// up to four boxes a leaf; items are numbered anew in the order of the leaves, so that a leaf is one run of memory.
// Build O(n log n), a function of the boxes alone; a search visits the nearer child first and skips what is farther
// than the best answer so far, so distance queries cost O(log n) where obstacles are scattered. Memory: 32 D / 2 bytes
// an item, as much for the nodes, 4 more while it is built. bench/certified_motion_bench.cpp: beside a plain loop.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/run/execution.hpp"

namespace warren {

/// A closed box of D dimensions.
template <int D>
struct BoxOf {
  std::array<double, D> low;
  std::array<double, D> high;
};

/// Square of the distance between two boxes; 0 where they meet.
template <int D>
double gap_square(const BoxOf<D>& a, const BoxOf<D>& b) noexcept {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double gap = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
    sum += gap * gap;
  }
  return sum;
}

/// Immutable after construction; any number of threads may search. Instantiated for D = 2 and 3.
template <int D>
class BoxTree {
 public:
  BoxTree() = default;  ///< no boxes
  /// Copies the boxes: finite, low <= high, below 2^31. Throws Stopped.
  explicit BoxTree(std::span<const BoxOf<D>> boxes, const Execution& execution = {});

  std::size_t size() const { return boxes_.size(); }
  /// Which box, of those given, stands at each place.
  std::span<const std::uint32_t> order() const { return order_; }

  /// Calls visit(place) for boxes whose distance from `from` is at most `within`, nearer subtrees first. What visit
  /// returns is the new `within`, not larger than the last one; a negative number ends the search. Distances are exact
  /// to a unit in the last place.
  template <class Visit>
  void search(const BoxOf<D>& from, double within, const Visit& visit) const {
    if (nodes_.empty() || !(within >= 0.0)) return;
    double limit = square(within);
    std::array<Entry, deepest> stack;
    std::size_t top = 0;
    stack[top++] = {0, gap_square(nodes_[0].box, from)};
    while (top > 0) {
      Entry at = stack[--top];
      while (!(at.gap > limit) && nodes_[at.node].count == 0) {
        Entry far{nodes_[at.node].first, gap_square(nodes_[nodes_[at.node].first].box, from)};
        at = {at.node + 1, gap_square(nodes_[at.node + 1].box, from)};
        if (far.gap < at.gap) std::swap(at, far);
        if (far.gap <= limit) stack[top++] = far;
      }
      if (at.gap > limit) continue;
      const Node& node = nodes_[at.node];
      for (std::uint32_t place = node.first; place < node.first + node.count; ++place) {
        if (gap_square(boxes_[place], from) > limit) continue;
        within = visit(place);
        if (within < 0.0) return;
        limit = square(within);
      }
    }
  }

 private:
  static constexpr std::size_t deepest = 64;

  /// An inner node has count 0, its left child behind it and its right child at `first`; a leaf has its places.
  struct Node {
    BoxOf<D> box;
    std::uint32_t first;
    std::uint32_t count;
  };
  struct Entry {
    std::uint32_t node;
    double gap;
  };

  static double square(double distance) { return distance * distance; }

  struct Building;
  void build(std::uint32_t first, std::uint32_t last, Building& building);

  std::vector<Node> nodes_;
  std::vector<BoxOf<D>> boxes_;       // by place
  std::vector<std::uint32_t> order_;  // by place
};

extern template class BoxTree<2>;
extern template class BoxTree<3>;

}  // namespace warren
