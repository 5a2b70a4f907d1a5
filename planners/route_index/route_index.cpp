// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/route_index.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/page_pool.hpp"
#include "parallel/chunks.hpp"
#include "parallel/scan.hpp"
#include "planners/route_cuts/core_graph.hpp"
#include "planners/route_cuts/core_reduction.hpp"
#include "planners/route_cuts/dissection.hpp"
#include "planners/route_index/route_sections.hpp"
#include "planners/route_trees/peeling.hpp"

namespace warren {

namespace {

/// About 200 cells: a search of them takes a few microseconds, and larger leaves save little memory.
std::size_t leaf_size(const CoreGraph& graph) {
  const std::uint64_t junctions = 200 * graph.size() / std::max<std::uint64_t>(1, graph.core_cells);
  return std::clamp<std::uint64_t>(junctions, 4, 32);
}

}  // namespace

void RouteIndexOptions::validate() const {
  if (leaf <= most_leaf_junctions) return;
  throw InputError("leaf", "must be at most " + std::to_string(most_leaf_junctions), std::to_string(leaf));
}

bool route_index_pays(std::uint64_t junctions, std::uint64_t cells) { return junctions * 10 <= cells * 3; }

RouteIndex::RouteIndex(LatticePassages passages, const RouteIndexOptions& options, const Execution& execution)
    : passages_(std::move(passages)), places_(passages_.size()) {
  options.validate();
  const PagePool pages;  // what one stage leaves is warm for the next
  RawVector<std::uint8_t> peeled = peel(passages_, places_, execution);
  CoreGraph graph = core_graph(peeled, places_, execution);
  reduce_core(graph, execution);
  if (!options.open_space && !route_index_pays(graph.size(), passages_.cell_count())) {
    throw InputError(
        "route index",
        "doesn't pay in open space, where more than 3 of 10 cells are junctions with a choice: search the grid",
        std::to_string(graph.size()) + " of " + std::to_string(passages_.cell_count()));
  }
  RawVector<std::uint64_t> marks = mark_words(peeled, places_, execution);
  peeled = {};
  arrays_.pieces = build_pieces(places_, CellMarks(marks.data()), execution);
  arrays_.fronts =
      build_fronts(graph, dissect(graph, options.leaf == 0 ? leaf_size(graph) : options.leaf, execution), execution);
  mark_gates(marks, execution);
  arrays_.marks = ArrayOrView<std::uint64_t>(std::move(marks));
  sound_ = LastingMarks(arrays_.fronts.fronts.size());
}

RouteIndex::RouteIndex(LatticePassages passages, RouteArrays arrays)
    : passages_(std::move(passages)),
      places_(passages_.size()),
      arrays_(std::move(arrays)),
      sound_(arrays_.fronts.fronts.size()) {
  check_route_sizes(places_, arrays_);
}

GateRank RouteIndex::gate_at(LatticePlace p) const {
  const std::size_t at = std::size_t{arrays_.gates_before[p / 64]} + marks().gates_before(p);
  const std::size_t gates = arrays_.gate_rank.size();
  if (at < gates && arrays_.gate_rank[at] < gates) return arrays_.gate_rank[at];
  throw InputError("route index", "its gates contradict each other: build it again");
}

LatticePlace RouteIndex::gate_place(GateRank rank) const {
  const LatticePlace p = arrays_.fronts.gate_place[rank];
  if (p < places_.place_count()) return p;
  throw InputError("route index", "a gate of it stands nowhere: build it again");
}

void RouteIndex::check_front(FrontId number) const {
  check_front_arrays(arrays_.fronts, arrays_.fronts.fronts[number]);
  sound_.set(number);
}

void RouteIndex::mark_gates(RawVector<std::uint64_t>& marks, const Execution& execution) {
  const ArrayOrView<LatticePlace>& gate_place = arrays_.fronts.gate_place;
  if (gate_place.empty()) return;
  const std::size_t rows = places_.place_count() / 64;
  execution.reserve((rows + gate_place.size()) * sizeof(std::uint32_t));
  for (std::size_t rank = 0; rank < gate_place.size(); ++rank) {
    if (rank % (1U << 16) == 0) execution.check();
    const LatticePlace p = gate_place[rank];
    marks[std::size_t{p / 64} * mark_word::count + mark_word::low] |= std::uint64_t{1} << p % 64;
  }
  RawVector<std::uint32_t> before(rows);
  for_chunks(rows, 4096, execution, [&](Range r) {
    for (std::size_t row = r.first; row < r.last; ++row) {
      const std::uint64_t* const words = marks.data() + row * mark_word::count;
      before[row] = static_cast<std::uint32_t>(std::popcount(words[mark_word::low] & words[mark_word::core]));
    }
  });
  exclusive_scan(before, execution);
  RawVector<GateRank> ranks(gate_place.size());
  const CellMarks all(marks.data());
  for (std::size_t rank = 0; rank < gate_place.size(); ++rank) {
    if (rank % (1U << 16) == 0) execution.check();
    const LatticePlace p = gate_place[rank];
    ranks[before[p / 64] + all.gates_before(p)] = static_cast<GateRank>(rank);
  }
  arrays_.gates_before = ArrayOrView<std::uint32_t>(std::move(before));
  arrays_.gate_rank = ArrayOrView<GateRank>(std::move(ranks));
}

std::size_t RouteIndex::bytes() const {
  std::size_t sum = 0;
  for (const RouteSection& section : route_sections(*this)) sum += section.bytes.size();
  return sum;
}

}  // namespace warren
