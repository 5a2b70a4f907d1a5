// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/hierarchy.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "parallel/sort.hpp"

namespace warren {
std::size_t Hierarchy::arc_to(VertexId low, VertexId high) const {
  const std::span<const HierarchyArc> up = row(low);
  const auto found = std::ranges::lower_bound(up, high, {}, &HierarchyArc::to);
  if (found == up.end() || found->to != high) return arcs.size();
  return first[low] + static_cast<std::size_t>(found - up.begin());
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

/// Where an end stands on a vertex, is the next one joined to it, too? Then a search goes there at once.
bool is_detour(const std::vector<HierarchyEnd>& ends, VertexId vertex, VertexId next) {
  const auto end_at = [&](VertexId v) { return std::ranges::find(ends, v, &HierarchyEnd::vertex); };
  const auto first = end_at(vertex);
  return first != ends.end() && first->length == 0.0 && end_at(next) != ends.end();
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

bool HierarchyQuery::search(std::span<const HierarchyEnd> start, std::span<const HierarchyEnd> goal, double limit) {
  scratch_[0].begin(start);
  scratch_[1].begin(goal);
  best_ = limit;
  meeting_ = no_vertex;
  settled_ = 0;
  looks_ = 0;
  for (;;) {
    const auto& [forward, backward] = scratch_;
    const bool first = goes_on(forward);
    const bool second = goes_on(backward);
    if (!first && !second) return meeting_ != no_vertex;
    settle(first && (!second || !(backward.top() < forward.top())) ? 0 : 1);
    if (settled_ % expansions_per_poll == 0) execution_.check();
  }
}

void HierarchyQuery::settle(std::size_t side) {
  HierarchyClimb& climb = scratch_[side];
  const QueueEntry next = climb.pop();
  const VertexId v = next.vertex;
  ++settled_;
  const double whole = next.key + scratch_[1 - side].length(v);
  if (whole < best_) {
    best_ = whole;
    meeting_ = v;
  }
  const std::span<const HierarchyArc> row = hierarchy_.row(v);
  looks_ += row.size();
  const auto is_shorter = [&](const HierarchyArc& arc) { return climb.length(arc.to) + arc.length < next.key; };
  if (std::any_of(row.begin(), row.end(), is_shorter)) return;  // a way from above
  for (const HierarchyArc& arc : row) climb.reach(arc.to, next.key + arc.length, v);
  if (climb.empty()) return;
  const auto ahead = hierarchy_.row(climb.top().vertex);  // is settled after the other end's turn
  constexpr std::size_t arcs_a_line = 64 / sizeof(HierarchyArc);
  for (std::size_t i = 0; i < std::min<std::size_t>(ahead.size(), 8 * arcs_a_line); i += arcs_a_line) {
    __builtin_prefetch(ahead.data() + i);
  }
}

RawVector<VertexId> HierarchyQuery::path() {
  struct Part {
    VertexId from;
    VertexId to;
    bool is_of_from;  // does the arc stand in the row of `from`?
  };
  const RawVector<VertexId> climb = scratch_[0].back_from(meeting_);
  const RawVector<VertexId> descent = scratch_[1].back_from(meeting_);
  std::vector<Part> todo;  // the next one last
  for (std::size_t i = descent.size(); i-- > 1;) todo.push_back({descent[i - 1], descent[i], false});
  for (std::size_t i = 1; i < climb.size(); ++i) todo.push_back({climb[i], climb[i - 1], true});
  const std::size_t most = hierarchy_.vertex_count();  // a shortest way passes no vertex twice
  RawVector<VertexId> way;
  way.push_back(climb.back());
  for (std::size_t opened = 0; !todo.empty();) {
    const auto [from, to, is_of_from] = todo.back();
    todo.pop_back();
    const std::size_t arc = is_of_from ? hierarchy_.arc_to(from, to) : hierarchy_.arc_to(to, from);
    const VertexId middle = hierarchy_.arcs[arc].middle;
    if (middle == no_vertex) {
      way.push_back(to);
      continue;
    }
    todo.push_back({middle, to, true});
    todo.push_back({from, middle, false});
    if (++opened % expansions_per_poll == 0) execution_.check();
    if (opened > most) throw InputError("roadmap", "the shortcuts of its index have no end; build it anew");
  }
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

namespace {

/// An edge that stands for the way over a vertex that is taken out.
struct Shortcut {
  VertexId from;    ///< of the graph that is left
  VertexId to;      ///< likewise
  VertexId middle;  ///< of the whole graph
  double length;
};

constexpr std::size_t shrinking_grain = std::size_t{1} << 12;

/// Turns how many arcs each row has, and a zero behind the last, into where the rows begin; returns their sum. Throws
/// Stopped, and InputError for 2^32 arcs or more.
std::size_t scan_rows(RawVector<EdgeEnd>& counts, const Execution& execution) {
  const std::uint64_t total = exclusive_scan(counts, execution);
  if (total > std::numeric_limits<EdgeEnd>::max()) {
    throw InputError("contraction", "needs 2^32 arcs or more", std::to_string(total));
  }
  return total;
}

/// The graph, which has lengths, before the first round. Throws Stopped.
ShrinkingGraph shrinking_graph(const Graph& graph, const Execution& execution) {
  const std::size_t n = graph.vertex_count();
  execution.reserve(graph.targets().size() * sizeof(HierarchyArc) + n * (sizeof(VertexId) + sizeof(EdgeEnd)));
  ShrinkingGraph whole;
  whole.vertex.resize(n);
  whole.first.assign(graph.offsets().begin(), graph.offsets().end());
  whole.arc.resize(graph.targets().size());
  for_each_index<VertexId>(n, shrinking_grain, execution, [&](VertexId v) {
    whole.vertex[v] = v;
    const auto row = graph.neighbours(v);
    const auto lengths = graph.lengths(v);
    HierarchyArc* next = whole.arc.data() + whole.first[v];
    for (std::size_t k = 0; k < row.size(); ++k) *next++ = {row[k], no_vertex, lengths[k]};
  });
  return whole;
}

/// Without the vertices v that have taken[v] != 0, and with the shortcuts, each both ways; of two arcs between the same
/// vertices the shorter one stays. Nothing of `before` is left. Throws Stopped, and InputError for 2^32 arcs or more.
ShrinkingGraph shrunk(ShrinkingGraph before, std::span<const std::uint8_t> taken, std::span<const Shortcut> added,
                      const Execution& execution) {
  const std::size_t n = before.size();
  const ItemsByKey by_row = counting_sort(added.size(), n, execution, [&](std::size_t i) { return added[i].from; });
  execution.reserve(n * 3 * sizeof(VertexId));
  RawVector<VertexId> number(n);  // in the graph after
  for_each_index(n, shrinking_grain, execution, [&](std::size_t v) { number[v] = taken[v] == 0 ? 1 : 0; });
  execution.reserve((before.arc.size() + added.size()) * 2 * sizeof(HierarchyArc));
  ShrinkingGraph after;
  after.vertex.resize(exclusive_scan(number, execution));
  after.first.resize(after.size() + 1);
  after.first.back() = 0;
  std::vector<RawVector<HierarchyArc>> rows(chunk_count(n, shrinking_grain));
  const auto by_length = [](const HierarchyArc& arc) { return std::pair(arc.to, arc.length); };
  for_chunks(n, shrinking_grain, execution, [&](Range r) {
    std::vector<HierarchyArc> old;
    std::vector<HierarchyArc> fresh;
    RawVector<HierarchyArc>& arcs = rows[r.first / shrinking_grain];
    for (auto v = static_cast<VertexId>(r.first); v < r.last; ++v) {
      if (taken[v] != 0) continue;
      old.clear();
      fresh.clear();
      std::ranges::copy_if(before.row(v), std::back_inserter(old), [&](const auto& arc) { return taken[arc.to] == 0; });
      for (const std::uint32_t i : by_row.of(v)) fresh.push_back({added[i].to, added[i].middle, added[i].length});
      std::ranges::sort(fresh, {}, [](const HierarchyArc& a) { return std::tuple(a.to, a.length, a.middle); });
      const std::size_t first = arcs.size();
      std::ranges::merge(old, fresh, std::back_inserter(arcs), {}, by_length, by_length);  // as long: the older first
      const auto row = arcs.begin() + static_cast<std::ptrdiff_t>(first);
      arcs.erase(std::unique(row, arcs.end(), [](const auto& a, const auto& b) { return a.to == b.to; }), arcs.end());
      after.vertex[number[v]] = before.vertex[v];
      after.first[number[v]] = static_cast<EdgeEnd>(arcs.size() - first);
    }
    for (HierarchyArc& arc : arcs) arc.to = number[arc.to];
  });
  before = {};
  after.arc.resize(scan_rows(after.first, execution));
  for_chunks(n, shrinking_grain, execution, [&](Range r) {
    const RawVector<HierarchyArc>& arcs = rows[r.first / shrinking_grain];
    if (!arcs.empty()) std::copy(arcs.begin(), arcs.end(), after.arc.begin() + after.first[number[r.first]]);
  });
  return after;
}

/// Which shortcuts taking out a vertex needs: for each two of its neighbours one of the length of the way over it,
/// unless another way that is no longer is found by a search that looks at a few dozen vertices (a witness). Fewer
/// looks than would find all witnesses leave some shortcuts too many, which cost and harm nothing. Scratch of one
/// thread. Refers to all that it is given.
class WitnessSearch {
 public:
  /// taken: what leaves the graph in the same round, no two of them neighbours; no witness leads over them.
  WitnessSearch(const ShrinkingGraph& graph, std::span<const std::uint8_t> taken, const Execution& execution)
      : graph_(graph), taken_(taken), execution_(execution) {}

  /// Appends the shortcuts that v needs, each both ways. Throws Stopped.
  void append_shortcuts(VertexId v, RawVector<Shortcut>& shortcuts) {
    const auto row = graph_.row(v);
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      const auto others = row.subspan(i + 1);
      if (i % 16 == 0) execution_.check();
      begin(others, row[i].length);
      double longest = 0.0;
      for (const HierarchyArc& arc : others) longest = std::max(longest, row[i].length + arc.length);
      search(row[i].to, longest);
      for (const HierarchyArc& arc : others) {
        const double length = slot_of(arc.to).wanted;
        if (length == unwanted) continue;
        push_asked(shortcuts, {row[i].to, arc.to, graph_.vertex[v], length}, execution_);
        push_asked(shortcuts, {arc.to, row[i].to, graph_.vertex[v], length}, execution_);
      }
    }
  }

 private:
  static constexpr std::size_t most_reached = 1024;
  static constexpr std::size_t most_settled = 120;
  static constexpr double nowhere = std::numeric_limits<double>::infinity();
  static constexpr double unwanted = -1.0;

  /// A vertex that the search has reached, or that it looks for.
  struct Slot {
    std::uint32_t search = 0;
    VertexId vertex = 0;
    double length = 0.0;  // of the way to it
    double wanted = 0.0;  // a way of at most this length is a witness; none is looked for: less than any
  };
  /// Where v stands; an empty slot where it doesn't.
  Slot& slot_of(VertexId v) {
    std::size_t slot = v * std::uint64_t{0x9e3779b97f4a7c15U} >> 32 & (slots_.size() - 1);
    while (slots_[slot].search == search_ && slots_[slot].vertex != v) slot = (slot + 1) & (slots_.size() - 1);
    return slots_[slot];
  }
  /// A new search for the targets, over what is `before` them.
  void begin(std::span<const HierarchyArc> targets, double before) {
    const std::size_t size = std::bit_ceil(2 * (targets.size() + most_reached + 1));
    if (slots_.size() < size || ++search_ == 0) {
      slots_.assign(std::max(size, slots_.size()), {});
      search_ = 1;
    }
    queue_.clear();
    for (const HierarchyArc& target : targets)
      slot_of(target.to) = {search_, target.to, nowhere, before + target.length};
    used_ = targets.size();
    missing_ = targets.size();
  }
  /// Until all targets have their witnesses.
  void search(VertexId from, double longest) {
    reach(from, 0.0);
    for (std::size_t settled = 0; missing_ > 0 && !queue_.empty() && settled < most_settled;) {
      const QueueEntry next = queue_.pop();
      if (next.key > slot_of(next.vertex).length) continue;
      ++settled;
      for (const HierarchyArc& arc : graph_.row(next.vertex)) {
        const double length = next.key + arc.length;
        if (length <= longest && taken_[arc.to] == 0) reach(arc.to, length);
      }
    }
  }
  void reach(VertexId v, double length) {
    Slot& slot = slot_of(v);
    if (slot.search != search_) {
      if (used_ == slots_.size() / 2) return;
      ++used_;
      slot = {search_, v, nowhere, unwanted};
    }
    if (slot.length <= length) return;
    slot.length = length;
    if (length <= slot.wanted) {
      slot.wanted = unwanted;
      --missing_;
    }
    queue_.push(v, length);
  }

  const ShrinkingGraph& graph_;
  std::span<const std::uint8_t> taken_;
  const Execution& execution_;
  std::vector<Slot> slots_;  // open addressing, at most half full
  LazyHeap queue_;
  std::uint32_t search_ = 0;
  std::size_t used_ = 0;     // slots
  std::size_t missing_ = 0;  // targets without a witness
};

constexpr std::size_t key_grain = std::size_t{1} << 13;
constexpr std::size_t witness_grain = 1024;  // each chunk makes its scratch

/// Neighbours of one degree go in any order but that of their numbers, which would take out one after the other.
std::uint32_t scattered(VertexId v) { return static_cast<std::uint32_t>(v * std::uint64_t{0x9e3779b97f4a7c15U} >> 32); }

// What is left may become somewhat denser than the graph was while it is large, and as dense as a few hundred vertices
// can be in the end; a question may look at so many arcs, a fifth of a millisecond.
constexpr double most_growth = 1.25;
constexpr double most_density = 256.0;
constexpr std::size_t small_rest = std::size_t{1} << 13;
constexpr std::uint64_t most_looks = 40'000;

/// Four pieces of vertices that follow each other, which lie together in the plane, and the edges within them.
Graph sample_of(const Graph& graph) {
  constexpr std::size_t pieces = 4;
  const std::size_t n = graph.vertex_count();
  const std::size_t piece = std::min<std::size_t>(n / pieces, 2048);
  RawVector<EdgeEnd> offsets;
  RawVector<VertexId> targets;
  RawVector<double> lengths;
  offsets.push_back(0);
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::size_t begin = i * n / pieces;
    for (std::size_t v = begin; v < begin + piece; ++v) {
      const auto row = graph.neighbours(static_cast<VertexId>(v));
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (row[k] < begin || row[k] >= begin + piece) continue;
        targets.push_back(static_cast<VertexId>(row[k] - begin + i * piece));
        lengths.push_back(graph.lengths(static_cast<VertexId>(v))[k]);
      }
      offsets.push_back(static_cast<EdgeEnd>(targets.size()));
    }
  }
  return {std::move(offsets), std::move(targets), std::move(lengths)};
}

/// Does what is left of a sample grow denser while it shrinks to a quarter?
bool grows_denser(const Graph& graph, const Execution& execution) {
  ContractionRounds rounds(sample_of(graph), execution);
  const double before = rounds.density();
  const std::size_t last = rounds.left().size() / 4;
  while (rounds.left().size() > last) rounds.next_round();
  return rounds.density() > most_growth * before + 1.0;
}

/// Arcs that a question looks at, of some.
std::uint64_t looks_of_questions(const Hierarchy& hierarchy, const Execution& execution) {
  constexpr std::uint64_t questions = 64;
  HierarchyScratch scratch;
  HierarchyQuery query(hierarchy, scratch, execution);
  SequentialRng rng(1);
  const auto any = [&] { return HierarchyEnd{static_cast<VertexId>(rng.below(hierarchy.vertex_count())), 0.0}; };
  std::uint64_t looks = 0;
  for (std::uint64_t i = 0; i < questions; ++i) {
    const HierarchyEnd start = any();
    const HierarchyEnd goal = any();
    query.search({&start, 1}, {&goal, 1}, std::numeric_limits<double>::infinity());
    looks += query.looks();
  }
  return looks / questions;
}

}  // namespace

ContractionRounds::ContractionRounds(const Graph& graph, const Execution& execution)
    : execution_(execution), left_(shrinking_graph(graph, execution)) {
  execution.reserve(graph.vertex_count() * sizeof(level_[0]));
  level_.assign(graph.vertex_count(), 0);
}

double ContractionRounds::density() const {
  return left_.size() == 0 ? 0.0 : static_cast<double>(left_.arc.size()) / static_cast<double>(left_.size());
}

RawVector<std::uint8_t> ContractionRounds::choose() const {
  execution_.reserve(left_.size() * (sizeof(std::uint64_t) + 1));
  RawVector<std::uint64_t> key(left_.size());  // no two are the same, for the scattered numbers aren't
  for_each_index(left_.size(), key_grain, execution_, [&](std::size_t v) {
    const VertexId whole = left_.vertex[v];
    key[v] = std::uint64_t{left_.first[v + 1] - left_.first[v] + level_[whole]} << 32 | scattered(whole);
  });
  RawVector<std::uint8_t> taken(left_.size());
  for_each_index<VertexId>(left_.size(), key_grain, execution_, [&](VertexId v) {
    const auto row = left_.row(v);
    const auto is_later = [&](const HierarchyArc& arc) { return key[v] < key[arc.to]; };
    taken[v] = std::all_of(row.begin(), row.end(), is_later) ? 1 : 0;
  });
  return taken;
}

void ContractionRounds::next_round() {
  const RawVector<std::uint8_t> taken = choose();
  const std::size_t chunks = chunk_count(left_.size(), witness_grain);
  std::vector<RawVector<Shortcut>> shortcuts(chunks);
  std::vector<ShrinkingGraph> gone(chunks);
  for_chunks(left_.size(), witness_grain, execution_, [&](Range r) {
    WitnessSearch witness(left_, taken, execution_);
    ShrinkingGraph& out = gone[r.first / witness_grain];
    out.first.push_back(0);
    for (std::size_t i = r.first; i < r.last; ++i) {
      if (taken[i] == 0) continue;
      const auto v = static_cast<VertexId>(i);
      out.vertex.push_back(left_.vertex[v]);
      for (const HierarchyArc& a : left_.row(v))
        push_asked(out.arc, {left_.vertex[a.to], a.middle, a.length}, execution_);
      out.first.push_back(static_cast<EdgeEnd>(out.arc.size()));
      witness.append_shortcuts(v, shortcuts[r.first / witness_grain]);
    }
  });
  for (const ShrinkingGraph& part : gone) {
    for (VertexId v = 0; v < part.size(); ++v) {
      const std::uint32_t next = level_[part.vertex[v]] + 1;
      for (const HierarchyArc& arc : part.row(v)) level_[arc.to] = std::max(level_[arc.to], next);
    }
  }
  const RawVector<Shortcut> added = joined_parts(shortcuts, execution_);
  shortcuts.clear();
  left_ = shrunk(std::move(left_), taken, added, execution_);
  for (ShrinkingGraph& part : gone) {
    if (part.size() > 0) gone_.push_back(std::move(part));
  }
}

Hierarchy ContractionRounds::hierarchy() {
  Hierarchy all;
  execution_.reserve((level_.size() + 1) * sizeof(EdgeEnd));
  all.first.resize(level_.size() + 1);
  all.first.back() = 0;
  for_each_index(gone_.size(), 64, execution_, [&](std::size_t i) {
    const ShrinkingGraph& part = gone_[i];
    for (VertexId v = 0; v < part.size(); ++v) all.first[part.vertex[v]] = part.first[v + 1] - part.first[v];
  });
  const std::size_t arcs = scan_rows(all.first, execution_);
  execution_.reserve(arcs * sizeof(HierarchyArc));
  all.arcs.resize(arcs);
  for_each_index(gone_.size(), 64, execution_, [&](std::size_t i) {
    const ShrinkingGraph& part = gone_[i];
    for (VertexId v = 0; v < part.size(); ++v) {
      std::ranges::copy(part.row(v), all.arcs.begin() + all.first[part.vertex[v]]);
    }
  });
  return all;
}

std::optional<Hierarchy> contract(const Graph& graph, const Execution& execution) {
  if (grows_denser(graph, execution)) return std::nullopt;
  ContractionRounds rounds(graph, execution);
  const double densest = 2.0 * rounds.density() + 8.0;
  while (rounds.left().size() > 0) {
    rounds.next_round();
    const double limit = rounds.left().size() > small_rest ? densest : most_density;
    if (rounds.density() > limit) return std::nullopt;
  }
  Hierarchy hierarchy = rounds.hierarchy();
  if (looks_of_questions(hierarchy, execution) > most_looks) return std::nullopt;
  return hierarchy;
}

}  // namespace warren
