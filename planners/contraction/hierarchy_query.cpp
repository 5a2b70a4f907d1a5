// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/hierarchy_query.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace warren {

void HierarchyQuery::begin(Side& side, std::span<const HierarchyEnd> ends) {
  const auto poll = [this] { execution_.check(); };
  side.state.resize(hierarchy_.vertex_count(), poll);
  side.queue.clear();
  side.queue.resize(hierarchy_.vertex_count(), poll);
  for (const HierarchyEnd& end : ends) {
    if (!side.state.improves(end.vertex, end.length)) continue;
    side.state.reach(end.vertex, end.length, no_vertex);
    side.queue.push(end.vertex, end.length);
  }
}

bool HierarchyQuery::search(std::span<const HierarchyEnd> start, std::span<const HierarchyEnd> goal, double limit) {
  begin(scratch_.sides[0], start);
  begin(scratch_.sides[1], goal);
  best_ = limit;
  meeting_ = no_vertex;
  settled_ = 0;
  looks_ = 0;
  for (;;) {
    const auto& [forward, backward] = scratch_.sides;
    const bool first = goes_on(forward);
    const bool second = goes_on(backward);
    if (!first && !second) return meeting_ != no_vertex;
    settle(first && (!second || !(backward.queue.top() < forward.queue.top())) ? 0 : 1);
    if (settled_ % expansions_per_poll == 0) execution_.check();
  }
}

/// Is there a shorter way to v from above?
bool HierarchyQuery::is_stalled(const SearchState& state, VertexId v, double length) {
  for (const HierarchyArc& arc : hierarchy_.row(v)) {
    if (state.g(arc.to) + arc.length < length) return true;
  }
  return false;
}

void HierarchyQuery::settle(std::size_t side) {
  auto& [state, queue] = scratch_.sides[side];
  const QueueEntry next = queue.pop();
  const VertexId v = next.vertex;
  state.close(v);
  ++settled_;
  const double whole = next.key + scratch_.sides[1 - side].state.g(v);
  if (whole < best_) {
    best_ = whole;
    meeting_ = v;
  }
  looks_ += hierarchy_.first[v + 1] - hierarchy_.first[v];
  if (is_stalled(state, v, next.key)) return;
  for (const HierarchyArc& arc : hierarchy_.row(v)) {
    const double length = next.key + arc.length;
    if (!state.improves(arc.to, length)) continue;
    state.reach(arc.to, length, v);
    queue.push(arc.to, length);
  }
}

/// Of the arc in the row of `low`. Asks the memory for what taking it apart will read.
VertexId HierarchyQuery::middle_of(VertexId low, VertexId high) const {
  const VertexId middle = hierarchy_.arcs[hierarchy_.arc_to(low, high)].middle;
  if (middle == no_vertex) return no_vertex;
  __builtin_prefetch(hierarchy_.arcs.data() + hierarchy_.first[middle]);
  return middle;
}

/// Appends the ends of its edges, the first one left out.
void HierarchyQuery::append_way(const Step& step, RawVector<VertexId>& way) {
  const std::size_t most = hierarchy_.vertex_count();  // a shortest way passes no vertex twice
  todo_.assign(1, step);
  while (!todo_.empty()) {
    const auto [from, to, middle] = todo_.back();
    todo_.pop_back();
    if (middle == no_vertex) {
      way.push_back(to);
    } else {
      todo_.push_back({middle, to, middle_of(middle, to)});
      todo_.push_back({from, middle, middle_of(middle, from)});
    }
    if (way.size() % (std::size_t{1} << 12) == 0) execution_.check();
    if (way.size() > most || todo_.size() > most) {
      throw InputError("roadmap", "the shortcuts of its index have no end; build it anew");
    }
  }
}

RawVector<VertexId> HierarchyQuery::path() {
  const RawVector<VertexId> climb = scratch_.sides[0].state.path_to(meeting_);
  const RawVector<VertexId> descent = scratch_.sides[1].state.path_to(meeting_);
  RawVector<VertexId> way;
  way.push_back(climb.front());
  for (std::size_t i = 0; i + 1 < climb.size(); ++i) {
    append_way({climb[i], climb[i + 1], middle_of(climb[i], climb[i + 1])}, way);
  }
  for (std::size_t i = descent.size(); i-- > 1;) {
    append_way({descent[i], descent[i - 1], middle_of(descent[i - 1], descent[i])}, way);
  }
  return way;
}

}  // namespace warren
