// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"

namespace warren {
std::size_t Hierarchy::arc_to(VertexId low, VertexId high) const {
  constexpr std::size_t short_row = 16;  // counted without a branch an arc
  const std::span<const HierarchyArc> arcs_up = row(low);
  std::size_t before = 0;
  if (arcs_up.size() <= short_row) {
    for (const HierarchyArc& arc : arcs_up) before += static_cast<std::size_t>(arc.to < high);
  } else {
    const auto leads_below = [](const HierarchyArc& arc, VertexId other) { return arc.to < other; };
    const auto found = std::lower_bound(arcs_up.begin(), arcs_up.end(), high, leads_below);
    before = static_cast<std::size_t>(found - arcs_up.begin());
  }
  return before < arcs_up.size() && arcs_up[before].to == high ? first[low] + before : arcs.size();
}

void check_hierarchy(const Hierarchy& hierarchy, std::size_t vertex_count, const std::string& where,
                     const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const RawVector<EdgeEnd>& first = hierarchy.first;
  const auto require = [&](bool holds, std::string_view array) {
    if (!holds) throw InputError(where, "its index contradicts itself; build it anew", array);
  };
  const auto has = [&](VertexId low, VertexId high) { return hierarchy.arc_to(low, high) < hierarchy.arcs.size(); };
  require(first.size() == vertex_count + 1 && first[0] == 0, "up.first");
  require(first.back() == hierarchy.arcs.size() && std::is_sorted(first.begin(), first.end()), "up.first");
  for_each_index<VertexId>(vertex_count, grain, execution, [&](VertexId v) {
    VertexId least = 0;
    for (const HierarchyArc& arc : hierarchy.row(v)) {
      require(arc.to != v && arc.to >= least && arc.to < vertex_count, "up.to");
      require(std::isfinite(arc.length) && !std::signbit(arc.length), "up.length");
      least = arc.to + 1;
    }
  });
  for_each_index<VertexId>(vertex_count, grain, execution, [&](VertexId v) {  // after all heads
    for (const HierarchyArc& arc : hierarchy.row(v)) {
      if (arc.middle == no_vertex) continue;
      require(arc.middle < vertex_count && has(arc.middle, v) && has(arc.middle, arc.to), "up.middle");
    }
  });
}

namespace {

const HierarchyEnd* end_at(const std::vector<HierarchyEnd>& ends, VertexId vertex) {
  const auto found = std::find_if(ends.begin(), ends.end(), [&](const HierarchyEnd& e) { return e.vertex == vertex; });
  return found == ends.end() ? nullptr : &*found;
}

/// Where an end stands on a vertex, is the next one joined to it, too? Then a search goes there at once.
bool is_detour(const std::vector<HierarchyEnd>& ends, VertexId vertex, VertexId next) {
  const HierarchyEnd* first = end_at(ends, vertex);
  return first != nullptr && first->length == 0.0 && end_at(ends, next) != nullptr;
}

}  // namespace

void HierarchyClimb::begin(std::span<const HierarchyEnd> ends) {
  if (slots_.empty()) slots_.resize(std::size_t{1} << first_bits);
  for (const std::uint32_t slot : used_) slots_[slot] = {};
  used_.clear();
  queue_.clear();
  for (const HierarchyEnd& end : ends) reach(end.vertex, end.length, no_vertex);
}

void HierarchyClimb::grow() {
  const std::vector<Slot> before = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
  --shift_;
  for (std::uint32_t& slot : used_) {
    const std::size_t next = slot_of(before[slot].vertex);
    slots_[next] = before[slot];
    slot = static_cast<std::uint32_t>(next);
  }
}

void HierarchyClimb::reach(VertexId v, double length, VertexId parent) {
  std::size_t slot = slot_of(v);
  if (length >= slots_[slot].length) return;
  if (slots_[slot].vertex == no_vertex) {
    if (2 * used_.size() >= slots_.size()) {
      grow();
      slot = slot_of(v);
    }
    used_.push_back(static_cast<std::uint32_t>(slot));
  }
  slots_[slot] = {v, parent, length};
  queue_.push(v, length);
}

QueueEntry HierarchyClimb::pop() {
  const QueueEntry next = queue_.pop();
  while (!queue_.empty() && queue_.top().key > length(queue_.top().vertex)) queue_.pop();
  return next;
}

RawVector<VertexId> HierarchyClimb::back_from(VertexId v) const {
  RawVector<VertexId> way;
  for (; v != no_vertex; v = slots_[slot_of(v)].parent) way.push_back(v);
  return way;
}

bool HierarchyQuery::search(std::span<const HierarchyEnd> start, std::span<const HierarchyEnd> goal, double limit) {
  scratch_.sides[0].begin(start);
  scratch_.sides[1].begin(goal);
  best_ = limit;
  meeting_ = no_vertex;
  settled_ = 0;
  looks_ = 0;
  for (;;) {
    const auto& [forward, backward] = scratch_.sides;
    const bool first = goes_on(forward);
    const bool second = goes_on(backward);
    if (!first && !second) return meeting_ != no_vertex;
    settle(first && (!second || !(backward.top() < forward.top())) ? 0 : 1);
    if (settled_ % expansions_per_poll == 0) execution_.check();
  }
}

void HierarchyQuery::settle(std::size_t side) {
  HierarchyClimb& climb = scratch_.sides[side];
  const QueueEntry next = climb.pop();
  const VertexId v = next.vertex;
  ++settled_;
  const double whole = next.key + scratch_.sides[1 - side].length(v);
  if (whole < best_) {
    best_ = whole;
    meeting_ = v;
  }
  const std::span<const HierarchyArc> row = hierarchy_.row(v);
  looks_ += row.size();
  const auto is_shorter = [&](const HierarchyArc& arc) { return climb.length(arc.to) + arc.length < next.key; };
  if (std::any_of(row.begin(), row.end(), is_shorter)) return;  // a way from above
  for (const HierarchyArc& arc : row) climb.reach(arc.to, next.key + arc.length, v);
  if (!climb.empty()) fetch_row(climb.top().vertex);
}

/// Asks the memory for what is settled after the other end's turn.
void HierarchyQuery::fetch_row(VertexId v) const {
  const auto row = hierarchy_.row(v);
  constexpr std::size_t arcs_a_line = 64 / sizeof(HierarchyArc);
  for (std::size_t i = 0; i < std::min<std::size_t>(row.size(), 8 * arcs_a_line); i += arcs_a_line) {
    __builtin_prefetch(row.data() + i);
  }
}

/// An arc of the row of `low`.
void HierarchyQuery::add_part(VertexId from, VertexId to, VertexId low, VertexId high) {
  scratch_.parts.push_back({from, to, hierarchy_.arcs[hierarchy_.arc_to(low, high)].middle, 0});
}

/// All parts down to edges, those of one depth after each other: the memory is asked for all their rows before the
/// first is read.
void HierarchyQuery::take_apart() {
  std::vector<PartOfWay>& parts = scratch_.parts;
  // A shortest way passes no vertex twice.
  const std::size_t most = std::min<std::size_t>(2 * hierarchy_.vertex_count() + parts.size(), no_vertex);
  std::size_t first = 0;
  for (std::size_t last = parts.size(); first < last; first = std::exchange(last, parts.size())) {
    for (std::size_t i = first; i < last; ++i) {
      if (parts[i].middle != no_vertex) __builtin_prefetch(hierarchy_.first.data() + parts[i].middle);
    }
    for (std::size_t i = first; i < last; ++i) {
      if (parts[i].middle != no_vertex) __builtin_prefetch(hierarchy_.row(parts[i].middle).data());
    }
    for (std::size_t i = first; i < last; ++i) {
      const auto [from, to, middle, none] = parts[i];
      if (middle == no_vertex) continue;
      parts[i].first = static_cast<std::uint32_t>(parts.size());
      add_part(from, middle, middle, from);
      add_part(middle, to, middle, to);
      if (parts.size() % expansions_per_poll == 0) execution_.check();
      if (parts.size() > most) throw InputError("roadmap", "the shortcuts of its index have no end; build it anew");
    }
  }
}

/// Their ends, the first one left out.
void HierarchyQuery::append_edges(std::uint32_t part, RawVector<VertexId>& way) {
  todo_.assign(1, part);
  while (!todo_.empty()) {
    const PartOfWay& next = scratch_.parts[todo_.back()];
    todo_.pop_back();
    if (next.middle == no_vertex) {
      way.push_back(next.to);
    } else {
      todo_.push_back(next.first + 1);
      todo_.push_back(next.first);
    }
  }
}

RawVector<VertexId> HierarchyQuery::path() {
  const RawVector<VertexId> climb = scratch_.sides[0].back_from(meeting_);
  const RawVector<VertexId> descent = scratch_.sides[1].back_from(meeting_);
  scratch_.parts.clear();
  for (std::size_t i = climb.size(); i-- > 1;) add_part(climb[i], climb[i - 1], climb[i], climb[i - 1]);
  for (std::size_t i = 1; i < descent.size(); ++i) add_part(descent[i - 1], descent[i], descent[i], descent[i - 1]);
  const auto arcs = static_cast<std::uint32_t>(scratch_.parts.size());
  take_apart();
  RawVector<VertexId> way;
  way.push_back(climb.back());
  for (std::uint32_t arc = 0; arc < arcs; ++arc) append_edges(arc, way);
  return way;
}

SearchResult route_by_hierarchy(const Hierarchy& hierarchy, std::span<const Edge> ends, std::span<const double> lengths,
                                HierarchyScratch& scratch, const Execution& execution) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  const auto start = static_cast<VertexId>(hierarchy.vertex_count());
  std::array<std::vector<HierarchyEnd>, 2> joined;
  double direct = nowhere;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].from == start) {
      direct = lengths[i];
    } else {
      joined[ends[i].to - start].push_back({ends[i].from, lengths[i]});
    }
  }
  HierarchyQuery query(hierarchy, scratch, execution);
  SearchResult found;
  if (query.search(joined[0], joined[1], direct)) {
    const RawVector<VertexId> way = query.path();
    std::size_t first = 0;
    std::size_t last = way.size() - 1;
    if (first < last && is_detour(joined[0], way[first], way[first + 1])) ++first;
    if (first < last && is_detour(joined[1], way[last], way[last - 1])) --last;
    found.path.reserve(way.size() + 2);
    found.path.push_back(start);
    found.path.insert(found.path.end(), way.begin() + static_cast<std::ptrdiff_t>(first),
                      way.begin() + static_cast<std::ptrdiff_t>(last + 1));
    found.path.push_back(start + 1);
  } else if (direct < nowhere) {
    found.path = {start, start + 1};
  }
  found.status = found.path.empty() ? SearchStatus::exhausted : SearchStatus::found;
  found.expanded = query.settled();
  return found;
}

}  // namespace warren
