// SPDX-License-Identifier: BSD-3-Clause
// A* in (x, y, heading) over the layers of a turning body, without an explicit graph. From a state one steps to the
// eight positions around it, or turns to the next heading either way; what may be stepped and turned is said by the
// layers' bits. With face_motion a body steps only at the heading of its direction.
//
// A search may begin and end at several states, each at a cost: what lies off the lattice is joined to states around
// it.
//
// Heuristic: the cheapest way over positions that are free at any heading (one Dijkstra from the goals in the plane),
// plus the turns to the nearest goal's heading. It never grows by more than an edge costs, so it is consistent,
// whatever the costs: every edge either steps or turns. 12 bytes a state and the queue; the plane's search costs a
// little, and states it rules out are never reached.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/plane/heading_layers.hpp"
#include "core/run/execution.hpp"
#include "core/search/search.hpp"
#include "planners/grid/grid_search.hpp"

namespace warren {

struct LayerState {
  std::uint32_t i = 0;
  std::uint32_t j = 0;
  std::uint32_t k = 0;  ///< heading
  friend constexpr bool operator==(const LayerState&, const LayerState&) = default;
};

struct LayerSearchOptions {
  Diagonal diagonal = Diagonal::sqrt2;
  double step_cost = 1.0;  ///< a step to the side; > 0
  double turn_cost = 1.0;  ///< a turn to the next heading; > 0
  bool face_motion = false;
};

/// A state by which a search may begin or end, and what getting there from outside the lattice costs.
struct LayerEnd {
  LayerState state;
  double cost = 0.0;  ///< >= 0
};

struct LayerPath {
  SearchStatus status = SearchStatus::exhausted;  ///< exhausted: no path in these layers; also where an end is blocked
  bool start_free = true;
  bool goal_free = true;
  std::vector<LayerState> states;  ///< start to goal; empty unless found
  double cost = 0.0;               ///< that of both ends included
  std::uint64_t steps = 0;         ///< to another position, diagonal ones included
  std::uint64_t diagonals = 0;     ///< of these
  std::uint64_t turns = 0;
  std::uint64_t expanded = 0;
};

/// A cheapest path from any of the starts to any of the goals; ends that are not free are left out. A state may be
/// there more than once: the cheapest counts. Throws InputError for states outside the layers, costs out of range and
/// more than HeadingLayers::most_states; Stopped.
LayerPath layer_search(const HeadingLayers& layers, std::span<const LayerEnd> starts, std::span<const LayerEnd> goals,
                       const LayerSearchOptions& options, const Execution& execution);

/// Calls visit(state) once for each state that steps and turns lead to from the starts, in an order that is always the
/// same. Throws as layer_search().
void for_each_reached(const HeadingLayers& layers, std::span<const LayerEnd> starts, const LayerSearchOptions& options,
                      const Execution& execution, const std::function<void(const LayerState&)>& visit);

}  // namespace warren
