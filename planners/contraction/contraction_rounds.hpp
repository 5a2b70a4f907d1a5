// SPDX-License-Identifier: BSD-3-Clause
// The rounds of a contraction (contraction.hpp), one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/search/graph.hpp"
#include "parallel/execution.hpp"
#include "planners/contraction/hierarchy.hpp"
#include "planners/contraction/shrinking_graph.hpp"

namespace warren {

/// Refers to the execution.
class ContractionRounds {
 public:
  /// The graph has lengths. Throws Stopped.
  ContractionRounds(const Graph& graph, const Execution& execution);

  const ShrinkingGraph& left() const { return left_; }
  /// Arcs a vertex of what is left.
  double density() const;
  /// Takes out at least one vertex of those left. Throws Stopped.
  void next_round();
  /// When nothing is left. Throws Stopped.
  Hierarchy hierarchy();

 private:
  /// What a chunk of vertices leaves behind: those that went, with their arcs.
  struct TakenOut {
    RawVector<VertexId> vertex;
    RawVector<EdgeEnd> arcs;      // of each
    RawVector<ShrinkingArc> arc;  // to: of the whole graph, ascending in each row
  };
  RawVector<std::uint64_t> keys() const;
  RawVector<std::uint8_t> choose() const;
  void raise_levels(const std::vector<TakenOut>& gone);
  static void write_rows(const TakenOut& gone, Hierarchy& all);

  const Execution& execution_;
  ShrinkingGraph left_;
  RawVector<std::uint32_t> level_;  // of a vertex: 1 more than the highest of those that went beside it
  std::vector<TakenOut> gone_;
};

}  // namespace warren
