// SPDX-License-Identifier: BSD-3-Clause
// The segments that a vertical sweep line meets, from bottom to top, as a treap (Seidel, Aragon 1996) whose nodes are
// also linked to their neighbours. Whoever inserts names the place, so the order compares nothing by itself; a search
// takes any test that is false below some place and true above it. Expected O(log n) a search, O(1) a step, an
// insertion or a removal at a known place. Priorities are a hash of the node's number: the same for every run.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

/// A segment on the sweep line, a before b, and what lies above it up to the next one.
struct SweepEntry {
  Vec2 a, b;
  std::uint32_t segment;  ///< its number
  std::uint32_t cell;     ///< the open cell above, or none
  std::uint32_t polygon;  ///< the polygon whose inside lies above, or none
};

class SweepOrder {
 public:
  using Node = std::uint32_t;
  static constexpr Node none = 0xffffffffU;

  /// Starts with one entry, the lowest, which stays.
  explicit SweepOrder(const SweepEntry& lowest) { make_node(lowest); }

  static constexpr Node lowest() { return 0; }
  Node highest() const { return highest_; }
  SweepEntry& entry(Node n) { return nodes_[n].entry; }
  const SweepEntry& entry(Node n) const { return nodes_[n].entry; }
  Node above(Node n) const { return nodes_[n].above; }
  Node below(Node n) const { return nodes_[n].below; }

  /// Puts the entry right above `place`.
  Node insert_above(Node place, const SweepEntry& entry);
  void erase(Node n);  ///< not the lowest

  /// The lowest entry for which the test is true (as it then is for all above), or none.
  template <class Test>
  Node first_where(const Test& test) const {
    Node found = none;
    for (Node n = root_; n != none;) {
      const bool here = test(nodes_[n].entry);
      if (here) found = n;
      n = here ? nodes_[n].left : nodes_[n].right;
    }
    return found;
  }

 private:
  struct NodeData {
    SweepEntry entry;
    Node left, right, parent;  // of the tree, which is a heap by priority
    Node below, above;         // neighbours in the order
    std::uint32_t priority;
  };

  Node make_node(const SweepEntry& entry);
  void rotate_up(Node n);
  Node& link_from_parent(Node n);

  std::vector<NodeData> nodes_;
  std::vector<Node> unused_;
  Node root_ = 0;
  Node highest_ = 0;
};

}  // namespace warren
