// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/shrinking_graph.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "parallel/scan.hpp"
#include "parallel/sort.hpp"

namespace warren {
namespace {

constexpr std::size_t shrinking_grain = std::size_t{1} << 12;

/// The arcs of each row that shortcuts bring, by their ends; each shortcut twice.
struct NewArcs {
  RawVector<Shortcut> arc;  // from, to: of the graph before
  KeyOrder by_row;
};

NewArcs both_ways(std::size_t vertex_count, const std::vector<RawVector<Shortcut>>& shortcuts,
                  const Execution& execution) {
  std::vector<std::size_t> begin{0};
  for (const auto& part : shortcuts) begin.push_back(begin.back() + 2 * part.size());
  NewArcs all;
  execution.reserve(begin.back() * sizeof(Shortcut));
  all.arc.resize(begin.back());
  for_chunks(shortcuts.size(), 1, execution, [&](Range r) {
    std::size_t next = begin[r.first];
    for (const Shortcut& s : shortcuts[r.first]) {
      all.arc[next++] = s;
      all.arc[next++] = {s.to, s.from, s.middle, s.length};
    }
  });
  all.by_row = counting_sort(all.arc.size(), vertex_count, execution, [&](std::size_t i) { return all.arc[i].from; });
  return all;
}

/// Writes the rows of one thread's vertices.
class RowMaker {
 public:
  RowMaker(const ShrinkingGraph& before, std::span<const std::uint8_t> taken, const NewArcs& added)
      : before_(before), taken_(taken), added_(added) {}

  /// Arcs to vertices of the graph before, ascending, one a vertex.
  std::span<const ShrinkingArc> row(VertexId v) {
    fresh_.clear();
    for (std::size_t i = added_.by_row.first[v]; i < added_.by_row.first[v + 1]; ++i) {
      const Shortcut& s = added_.arc[added_.by_row.item[i]];
      fresh_.push_back({s.to, s.middle, s.length});
    }
    std::sort(fresh_.begin(), fresh_.end(), [](const ShrinkingArc& a, const ShrinkingArc& b) {
      return std::tie(a.to, a.length, a.middle) < std::tie(b.to, b.length, b.middle);
    });
    row_.clear();
    auto next = fresh_.cbegin();
    for (const ShrinkingArc& old : before_.row(v)) {
      if (taken_[old.to] != 0) continue;
      while (next != fresh_.cend() && next->to < old.to) add(*next++);
      add(old);
    }
    while (next != fresh_.cend()) add(*next++);
    return row_;
  }

 private:
  void add(const ShrinkingArc& arc) {
    if (row_.empty() || row_.back().to != arc.to) {
      row_.push_back(arc);
    } else if (arc.length < row_.back().length) {
      row_.back() = arc;
    }
  }
  const ShrinkingGraph& before_;
  std::span<const std::uint8_t> taken_;
  const NewArcs& added_;
  std::vector<ShrinkingArc> fresh_;
  std::vector<ShrinkingArc> row_;
};

}  // namespace

std::size_t scan_rows(RawVector<EdgeEnd>& counts, const Execution& execution) {
  const std::uint64_t total = exclusive_scan(counts, execution);
  if (total > std::numeric_limits<EdgeEnd>::max()) {
    throw InputError("contraction", "needs 2^32 arcs or more", std::to_string(total));
  }
  return total;
}

ShrinkingGraph shrinking_graph(const Graph& graph, const Execution& execution) {
  const std::size_t n = graph.vertex_count();
  execution.reserve(graph.targets().size() * sizeof(ShrinkingArc) + n * (sizeof(VertexId) + sizeof(EdgeEnd)));
  ShrinkingGraph whole;
  whole.vertex.resize(n);
  whole.first.assign(graph.offsets().begin(), graph.offsets().end());
  whole.arc.resize(graph.targets().size());
  for_chunks(n, shrinking_grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto v = static_cast<VertexId>(i);
      whole.vertex[v] = v;
      const auto row = graph.neighbours(v);
      const auto lengths = graph.lengths(v);
      ShrinkingArc* next = whole.arc.data() + whole.first[v];
      for (std::size_t k = 0; k < row.size(); ++k) *next++ = {row[k], no_vertex, lengths[k]};
    }
  });
  return whole;
}

ShrinkingGraph shrunk(ShrinkingGraph before, std::span<const std::uint8_t> taken,
                      const std::vector<RawVector<Shortcut>>& shortcuts, const Execution& execution) {
  const std::size_t n = before.size();
  const NewArcs added = both_ways(n, shortcuts, execution);
  execution.reserve(n * 3 * sizeof(VertexId));
  RawVector<VertexId> number(n);  // in the graph after
  for_chunks(n, shrinking_grain, execution, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) number[v] = taken[v] == 0 ? 1 : 0;
  });
  execution.reserve((before.arc.size() + added.arc.size()) * 2 * sizeof(ShrinkingArc));
  ShrinkingGraph after;
  after.vertex.resize(exclusive_scan(number, execution));
  after.first.resize(after.size() + 1);
  after.first.back() = 0;
  std::vector<RawVector<ShrinkingArc>> rows(chunk_count(n, shrinking_grain));
  for_chunks(n, shrinking_grain, execution, [&](Range r) {
    RowMaker maker(before, taken, added);
    RawVector<ShrinkingArc>& arcs = rows[r.first / shrinking_grain];
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto v = static_cast<VertexId>(i);
      if (taken[v] != 0) continue;
      after.vertex[number[v]] = before.vertex[v];
      const auto row = maker.row(v);
      after.first[number[v]] = static_cast<EdgeEnd>(row.size());
      for (const ShrinkingArc& arc : row) arcs.push_back({number[arc.to], arc.middle, arc.length});
    }
  });
  before = {};
  after.arc.resize(scan_rows(after.first, execution));
  for_chunks(n, shrinking_grain, execution, [&](Range r) {
    const RawVector<ShrinkingArc>& arcs = rows[r.first / shrinking_grain];
    if (!arcs.empty()) std::copy(arcs.begin(), arcs.end(), after.arc.begin() + after.first[number[r.first]]);
  });
  return after;
}

}  // namespace warren
