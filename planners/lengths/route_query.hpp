// SPDX-License-Identifier: BSD-3-Clause
// Questions to a route index: the shortest length between two cells, and a path of that length. Both cells climb to the
// core; cells of one tree meet in it. In the core both look around up to the gates of their leaf, and the fronts join
// these, if the other cell wasn't nearer. Exact: the length is that of a breadth-first search of the whole lattice.
// Cost: microseconds in trees, then the rows of the fronts above both; see bench/roadmaps/route_index_bench.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "planners/lengths/route_index.hpp"

namespace warren {

/// Scratch of one thread: 8 bytes a gate. Refers to the index, which must outlive it.
class RouteQuery {
 public:
  explicit RouteQuery(const RouteIndex& index);
  ~RouteQuery();
  RouteQuery(RouteQuery&&) noexcept;

  /// In steps; none where no path joins the cells. Throws InputError for a cell outside the lattice.
  std::optional<std::uint32_t> length(CellId start, CellId goal);
  /// The cells of a shortest path, both ends included; empty where there is none. Throws Stopped.
  RawVector<CellId> path(CellId start, CellId goal, const Execution& execution = {.threads = 1});

 private:
  class Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace warren
