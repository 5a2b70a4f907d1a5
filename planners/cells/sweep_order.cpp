// SPDX-License-Identifier: BSD-3-Clause
#include "planners/cells/sweep_order.hpp"

#include <cassert>

namespace warren {
namespace {

/// Mixes the bits of a number (the finaliser of MurmurHash3).
std::uint32_t mixed(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x85ebca6bU;
  h ^= h >> 13;
  h *= 0xc2b2ae35U;
  return h ^ h >> 16;
}

}  // namespace

SweepOrder::Node SweepOrder::make_node(const SweepEntry& entry) {
  Node n;
  if (unused_.empty()) {
    n = static_cast<Node>(nodes_.size());
    nodes_.emplace_back();
  } else {
    n = unused_.back();
    unused_.pop_back();
  }
  nodes_[n] = {entry, none, none, none, none, none, mixed(n + 1)};
  return n;
}

SweepOrder::Node& SweepOrder::link_from_parent(Node n) {
  const Node parent = nodes_[n].parent;
  if (parent == none) return root_;
  return nodes_[parent].left == n ? nodes_[parent].left : nodes_[parent].right;
}

void SweepOrder::rotate_up(Node n) {
  const Node parent = nodes_[n].parent;
  link_from_parent(parent) = n;
  nodes_[n].parent = nodes_[parent].parent;
  nodes_[parent].parent = n;
  const bool was_left = nodes_[parent].left == n;
  Node& outer = was_left ? nodes_[parent].left : nodes_[parent].right;
  Node& inner = was_left ? nodes_[n].right : nodes_[n].left;
  outer = inner;
  if (inner != none) nodes_[inner].parent = parent;
  inner = parent;
}

SweepOrder::Node SweepOrder::insert_above(Node place, const SweepEntry& entry) {
  const Node n = make_node(entry);
  const Node next = nodes_[place].above;
  nodes_[n].below = place;
  nodes_[n].above = next;
  nodes_[place].above = n;
  (next == none ? highest_ : nodes_[next].below) = n;
  if (nodes_[place].right == none) {
    nodes_[place].right = n;
    nodes_[n].parent = place;
  } else {  // the next one is the leftmost of that subtree, so it has no left child
    nodes_[next].left = n;
    nodes_[n].parent = next;
  }
  while (nodes_[n].parent != none && nodes_[nodes_[n].parent].priority < nodes_[n].priority) rotate_up(n);
  return n;
}

void SweepOrder::erase(Node n) {
  assert(n != lowest());
  while (nodes_[n].left != none || nodes_[n].right != none) {
    const Node left = nodes_[n].left;
    const Node right = nodes_[n].right;
    const bool left_up = right == none || (left != none && nodes_[left].priority > nodes_[right].priority);
    rotate_up(left_up ? left : right);
  }
  link_from_parent(n) = none;
  const Node below = nodes_[n].below;
  const Node above = nodes_[n].above;
  nodes_[below].above = above;
  (above == none ? highest_ : nodes_[above].below) = below;
  unused_.push_back(n);
}

}  // namespace warren
