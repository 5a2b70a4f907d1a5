// SPDX-License-Identifier: BSD-3-Clause
// Questions to a route index: the shortest length between two cells, and a path of that length. Both cells climb to the
// core; cells of one tree meet in it. In the core both look around up to the gates of their leaf, and the fronts join
// these, if the other cell wasn't nearer. Exact: the length is that of a breadth-first search of the whole lattice.
// Cost: microseconds in trees, then the rows of the fronts above both; see bench/roadmaps/route_index_bench.cpp.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/raw_vector.hpp"
#include "planners/lengths/front_routes.hpp"
#include "planners/lengths/route_index.hpp"
#include "planners/lengths/tree_routes.hpp"

namespace warren {

/// Scratch of one thread: 8 bytes a gate. Refers to the index, which must outlive it.
class RouteQuery {
 public:
  explicit RouteQuery(const RouteIndex& index)
      : index_(index), trees_(index), near_start_(index), near_goal_(index), fronts_(index), unpacking_(index) {}

  /// In steps; none where no path joins the cells. Throws InputError for a cell outside the lattice.
  std::optional<std::uint32_t> length(CellId start, CellId goal);
  /// The cells of a shortest path, both ends included; empty where there is none. Throws Stopped.
  RawVector<CellId> path(CellId start, CellId goal, const Execution& execution = {.threads = 1});

 private:
  LatticePlace checked(CellId cell) const;
  std::uint32_t core_length(LatticePlace start, LatticePlace goal);
  std::uint32_t direct_length(LatticePlace goal) const;
  FrontQuery::Way core_way(LatticePlace start, LatticePlace goal);
  void write_core_way(const FrontQuery::Way& way, LatticePlace goal, CellId* cells, const Execution& execution);

  const RouteIndex& index_;
  TreeRoutes trees_;
  CoreSearch near_start_;
  CoreSearch near_goal_;
  FrontQuery fronts_;
  FrontUnpacking unpacking_;
};

}  // namespace warren
