// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/contraction_rounds.hpp"

#include <algorithm>
#include <utility>

#include "parallel/chunks.hpp"
#include "planners/contraction/witness_search.hpp"

namespace warren {
namespace {

constexpr std::size_t key_grain = std::size_t{1} << 13;
constexpr std::size_t witness_grain = 1024;  // each chunk makes its scratch

/// Neighbours of one degree go in any order but that of their numbers, which would take out one after the other.
std::uint32_t scattered(VertexId v) { return static_cast<std::uint32_t>(v * std::uint64_t{0x9e3779b97f4a7c15U} >> 32); }

}  // namespace

ContractionRounds::ContractionRounds(const Graph& graph, const Execution& execution)
    : execution_(execution), left_(shrinking_graph(graph, execution)) {
  execution.reserve(graph.vertex_count() * sizeof(level_[0]));
  level_.resize(graph.vertex_count());
  std::fill(level_.begin(), level_.end(), 0);
}

double ContractionRounds::density() const {
  return left_.size() == 0 ? 0.0 : static_cast<double>(left_.arc.size()) / static_cast<double>(left_.size());
}

/// No two are the same, for the scattered numbers aren't.
RawVector<std::uint64_t> ContractionRounds::keys() const {
  RawVector<std::uint64_t> key(left_.size());
  for_chunks(left_.size(), key_grain, execution_, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) {
      const VertexId whole = left_.vertex[v];
      key[v] = std::uint64_t{left_.first[v + 1] - left_.first[v] + level_[whole]} << 32 | scattered(whole);
    }
  });
  return key;
}

RawVector<std::uint8_t> ContractionRounds::choose() const {
  execution_.reserve(left_.size() * (sizeof(std::uint64_t) + 1));
  const RawVector<std::uint64_t> key = keys();
  RawVector<std::uint8_t> taken(left_.size());
  for_chunks(left_.size(), key_grain, execution_, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) {
      const auto row = left_.row(static_cast<VertexId>(v));
      const auto is_later = [&](const ShrinkingArc& arc) { return key[v] < key[arc.to]; };
      taken[v] = std::all_of(row.begin(), row.end(), is_later) ? 1 : 0;
    }
  });
  return taken;
}

void ContractionRounds::next_round() {
  const RawVector<std::uint8_t> taken = choose();
  const std::size_t chunks = chunk_count(left_.size(), witness_grain);
  std::vector<RawVector<Shortcut>> shortcuts(chunks);
  std::vector<TakenOut> gone(chunks);
  for_chunks(left_.size(), witness_grain, execution_, [&](Range r) {
    WitnessSearch witness(left_, taken, execution_);
    TakenOut& out = gone[r.first / witness_grain];
    for (std::size_t i = r.first; i < r.last; ++i) {
      if (taken[i] == 0) continue;
      const auto v = static_cast<VertexId>(i);
      out.vertex.push_back(left_.vertex[v]);
      out.arcs.push_back(static_cast<EdgeEnd>(left_.row(v).size()));
      for (const ShrinkingArc& a : left_.row(v)) out.arc.push_back({left_.vertex[a.to], a.middle, a.length});
      witness.append_shortcuts(v, shortcuts[r.first / witness_grain]);
    }
  });
  raise_levels(gone);
  left_ = shrunk(std::move(left_), taken, shortcuts, execution_);
  for (TakenOut& part : gone) {
    if (part.vertex.empty()) continue;
    execution_.reserve(part.arc.size() * sizeof(ShrinkingArc));
    gone_.push_back(std::move(part));
  }
}

void ContractionRounds::raise_levels(const std::vector<TakenOut>& gone) {
  for (const TakenOut& part : gone) {
    auto arc = part.arc.begin();
    for (std::size_t i = 0; i < part.vertex.size(); ++i) {
      const std::uint32_t next = level_[part.vertex[i]] + 1;
      for (const auto end = arc + part.arcs[i]; arc != end; ++arc) level_[arc->to] = std::max(level_[arc->to], next);
    }
  }
}

void ContractionRounds::write_rows(const TakenOut& gone, Hierarchy& all) {
  auto arc = gone.arc.begin();
  for (std::size_t i = 0; i < gone.vertex.size(); ++i) {
    std::size_t at = all.first[gone.vertex[i]];
    for (const auto end = arc + gone.arcs[i]; arc != end; ++arc) {
      all.arcs[at++] = {arc->to, arc->middle, arc->length};
    }
  }
}

Hierarchy ContractionRounds::hierarchy() {
  Hierarchy all;
  execution_.reserve((level_.size() + 1) * sizeof(EdgeEnd));
  all.first.resize(level_.size() + 1);
  all.first.back() = 0;
  for_chunks(gone_.size(), 64, execution_, [&](Range r) {
    for (std::size_t part = r.first; part < r.last; ++part) {
      const TakenOut& gone = gone_[part];
      for (std::size_t i = 0; i < gone.vertex.size(); ++i) all.first[gone.vertex[i]] = gone.arcs[i];
    }
  });
  const std::size_t arcs = scan_rows(all.first, execution_);
  execution_.reserve(arcs * sizeof(HierarchyArc));
  all.arcs.resize(arcs);
  for_chunks(gone_.size(), 64, execution_, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) write_rows(gone_[i], all);
  });
  return all;
}

}  // namespace warren
