// SPDX-License-Identifier: BSD-3-Clause
// The sweep behind planners/vertical_cells/cell_decomposition.hpp, whose head says what it computes and assumes.
//
// At a corner the sweep takes the segments that touch it off the line (they end there, or pass through it and go on
// from there), sorts what goes on to the right by angle, and puts that in their place. Gaps on the left end their
// cells, gaps on the right begin new ones, and the lines below and above the corner become doors. Segments that lie on
// each other keep no gap between them. Crossings show where two segments become neighbours (Shamos, Hoey 1976),
// overlaps where the line would enter one polygon inside another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/execution.hpp"
#include "planners/vertical_cells/cell_decomposition.hpp"

namespace warren {
// The segments that a vertical sweep line meets, from bottom to top, as a treap (Seidel, Aragon 1996) whose nodes are
// also linked to their neighbours. Whoever inserts names the place, so the order compares nothing by itself; a search
// takes any test that is false below some place and true above it. Expected O(log n) a search, O(1) a step, an
// insertion or a removal at a known place. Priorities are a hash of the node's number: the same for every run.

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

class CellSweep {
 public:
  CellSweep(const PlaneObstacles& obstacles, std::span<const Vec2> points, Overlaps overlaps,
            const Execution& execution);
  void run();
  CellDecomposition take() { return std::move(result_); }

 private:
  using Node = SweepOrder::Node;
  /// A corner, or behind them a point that is asked about.
  struct Event {
    Vec2 at;
    std::uint32_t number;
  };

  void choose_box(std::span<const Vec2> points);
  void add_polygons();
  void add_walls();
  bool stands_inside(std::span<const Vec2> corners, std::size_t obstacle) const;
  void add_points(std::span<const Vec2> points);

  void gather(std::size_t first, std::size_t last);
  void sort_segment(std::uint32_t segment);
  void find_touching();
  void answer_questions(bool passed);
  void pass_corner();
  void close_cells();
  void sort_starting();
  void put_starting();
  void open_cells(std::uint32_t upper_polygon);
  std::uint32_t open_cell(std::uint32_t lower, Node upper_node);
  void add_door(std::uint32_t left, std::uint32_t right, bool above, bool shut);
  void check_neighbours(Node lower, Node upper) const;
  std::uint32_t polygon_beyond(std::uint32_t polygon, std::uint32_t segment) const;
  [[noreturn]] void clash(std::uint32_t segment, std::uint32_t other) const;

  static int side(const SweepEntry& entry, Vec2 p) {
    // The box's lower side is below all: what touches it is asked where that matters.
    return entry.segment == CellDecomposition::floor_segment ? 1 : orient2d(entry.a, entry.b, p);
  }
  bool is_wall(std::uint32_t segment) const { return segment >= polygon_of_.size(); }
  bool inside_is_above(std::uint32_t segment) const { return result_.segments[segment].a == result_.corners[segment]; }
  std::size_t owner(std::uint32_t segment) const;
  bool touches_floor(Vec2 p) const { return p.y == result_.box.min.y || p.x == result_.box.max.x; }
  bool touches_ceiling(Vec2 p) const { return p.y == result_.box.max.y || p.x == result_.box.min.x; }
  std::uint32_t segment_of(Node n) const {
    return n == SweepOrder::none ? CellDecomposition::ceiling_segment : order_.entry(n).segment;
  }

  const PlaneObstacles& obstacles_;
  const Overlaps overlaps_;
  const Execution& execution_;
  CellDecomposition result_;
  std::vector<std::uint32_t> polygon_of_;   // of each side
  std::vector<std::uint32_t> side_before_;  // of each polygon's corner: the side that ends there
  std::vector<Node> node_of_;               // of each segment that is on the line
  std::vector<Event> events_;
  SweepOrder order_;

  // About the corner that is being passed:
  Vec2 at_;
  std::uint32_t corner_ = 0;
  std::vector<std::uint32_t> ending_, starting_, asked_;  // segments; segments; points
  std::vector<Node> touching_;                            // from bottom to top
  std::vector<Node> put_;                                 // where starting_ went
  Node below_ = 0, above_ = 0;                            // the neighbours of all that; above_ may be SweepOrder::none
};

}  // namespace warren
