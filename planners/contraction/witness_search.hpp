// SPDX-License-Identifier: BSD-3-Clause
// Which shortcuts taking out a vertex needs: for each two of its neighbours one of the length of the way over it,
// unless another way that is no longer is found by a search that looks at a few dozen vertices (a witness). Fewer looks
// than would find all witnesses leave some shortcuts too many, which cost and harm nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/search/indexed_heap.hpp"
#include "planners/contraction/shrinking_graph.hpp"

namespace warren {

/// Scratch of one thread. Refers to all that it is given.
class WitnessSearch {
 public:
  /// taken: what leaves the graph in the same round, no two of them neighbours; no witness leads over them.
  WitnessSearch(const ShrinkingGraph& graph, std::span<const std::uint8_t> taken, const Execution& execution)
      : graph_(graph), taken_(taken), execution_(execution) {}

  /// Appends the shortcuts that v needs. Throws Stopped.
  void append_shortcuts(VertexId v, RawVector<Shortcut>& shortcuts);

 private:
  static constexpr std::size_t most_reached = 1024;
  static constexpr std::size_t most_settled = 120;

  /// A vertex that the search has reached, or that it looks for.
  struct Slot {
    std::uint32_t search = 0;
    VertexId vertex = 0;
    double length = 0.0;  // of the way to it
    double wanted = 0.0;  // a way of at most this length is a witness; none is looked for: less than any
  };
  Slot& slot_of(VertexId v);
  void begin(std::span<const ShrinkingArc> targets, double before);
  void search(VertexId from, double longest);
  void reach(VertexId v, double length);

  const ShrinkingGraph& graph_;
  std::span<const std::uint8_t> taken_;
  const Execution& execution_;
  std::vector<Slot> slots_;  // open addressing, at most half full
  std::vector<QueueEntry> queue_;
  std::uint32_t search_ = 0;
  std::size_t used_ = 0;     // slots
  std::size_t missing_ = 0;  // targets without a witness
};

}  // namespace warren
