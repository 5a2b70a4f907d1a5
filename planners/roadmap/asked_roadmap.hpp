// SPDX-License-Identifier: BSD-3-Clause
// A roadmap that was built without a question (build_roadmap.hpp), ready for any number of them: with the index that
// attaches start and goal, and with what is known of its edges, which questions add to.
#pragma once

#include <span>
#include <utility>

#include "core/base/world.hpp"
#include "parallel/components.hpp"
#include "parallel/shared_edge_states.hpp"
#include "planners/contraction/hierarchy.hpp"
#include "planners/roadmap/build_roadmap.hpp"
#include "planners/roadmap/roadmap_search.hpp"

namespace warren {

/// A roadmap ready to be asked. Refers to the world, and to the hierarchy where it has one.
template <World W>
class AskedRoadmap {
 public:
  using State = typename W::State;

  /// lazy: the roadmap is lazy_prm's, whose searches run so. Throws Stopped.
  AskedRoadmap(const W& world, RawVector<State> states, Graph candidates, std::span<const std::uint64_t> edge_states,
               const ConnectionRule& rule, bool lazy, const Execution& execution, const Hierarchy* hierarchy = nullptr)
      : world_(world),
        states_(std::move(states)),
        candidates_(std::move(candidates)),
        known_(edge_states),
        rule_(rule),
        lazy_(lazy),
        hierarchy_(hierarchy),
        index_(index_of_states(world, std::span<const State>(states_), execution)) {
    if (lazy_) return;
    const Graph free = free_part(candidates_, edge_states, execution);
    if constexpr (edge_directions<W>() == EdgeDirections::one) {
      free_edges_ = free.targets().size();
    } else {
      free_edges_ = free.edge_count();
      stringy_ = warren::is_stringy(free, execution);
      components_ = components(free, execution);
    }
  }

  std::span<const State> states() const { return states_; }
  const Graph& candidates() const { return candidates_; }
  /// All that was learnt so far; while nobody asks.
  std::span<const std::uint64_t> edge_states() const { return known_.words(); }
  bool is_lazy() const { return lazy_; }
  /// Of the free edges; not known where lazy or where edges lead one way, nor are components.
  bool is_stringy() const { return stringy_; }
  std::uint64_t free_edges() const { return free_edges_; }
  const Components& component_labels() const { return components_; }
  /// Of the free edges; nullptr: there is none.
  const Hierarchy* hierarchy() const { return hierarchy_; }
  const W& world() const { return world_; }
  const StateIndex<W>& index() const { return index_; }
  const ConnectionRule& rule() const { return rule_; }
  const SharedEdgeStates& known() const { return known_; }

 private:
  const W& world_;
  RawVector<State> states_;
  Graph candidates_;
  SharedEdgeStates known_;
  ConnectionRule rule_;
  bool lazy_;
  const Hierarchy* hierarchy_;
  StateIndex<W> index_;
  bool stringy_ = false;
  std::uint64_t free_edges_ = 0;
  Components components_;  // by free edges
};

}  // namespace warren
