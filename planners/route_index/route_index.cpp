// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/route_index.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/let_go.hpp"
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
  reduce_core(graph, places_, peeled, execution);
  if (!options.open_space && !route_index_pays(graph.size(), passages_.cell_count())) {
    throw InputError(
        "route index",
        "doesn't pay in open space, where more than 3 of 10 cells are junctions with a choice: search the grid",
        std::to_string(graph.size()) + " of " + std::to_string(passages_.cell_count()));
  }
  RawVector<std::uint64_t> marks = mark_words(peeled, places_, execution);
  let_go(peeled);
  arrays_.pieces = build_pieces(places_, CellMarks(marks.data()), execution);
  arrays_.fronts =
      build_fronts(graph, dissect(graph, options.leaf == 0 ? leaf_size(graph) : options.leaf, execution), execution);
  arrays_.marks = ArrayOrView<std::uint64_t>(std::move(marks));
  mark_gates(execution);
  find_fronts();
  sound_ = LastingMarks(arrays_.fronts.fronts.size());
}

RouteIndex::RouteIndex(LatticePassages passages, RouteArrays arrays)
    : passages_(std::move(passages)),
      places_(passages_.size()),
      arrays_(std::move(arrays)),
      sound_(arrays_.fronts.fronts.size()) {
  check_route_sizes(places_, arrays_);
  find_fronts();
}

GateRank RouteIndex::gate_at(LatticePlace p) const {
  const std::size_t at = number_of_gate(p);
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

void RouteIndex::find_fronts() {
  const std::span<const Front> fronts = arrays_.fronts.fronts.span();
  front_near_.resize((arrays_.fronts.gate_place.size() + gates_a_look - 1) / gates_a_look);
  FrontId front = 0;
  for (std::size_t i = 0; i < front_near_.size(); ++i) {
    while (front + 1 < fronts.size() && fronts[front + 1].first <= i * gates_a_look) ++front;
    front_near_[i] = front;
  }
}

void RouteIndex::mark_gates(const Execution& execution) {
  const ArrayOrView<LatticePlace>& gate_place = arrays_.fronts.gate_place;
  if (gate_place.empty()) return;
  const std::size_t rows = places_.place_count() / 64;
  execution.reserve(rows * (sizeof(std::uint64_t) + sizeof(std::uint32_t)) + gate_place.size() * sizeof(GateRank));
  RawVector<std::uint64_t> gates;
  assign_polled(gates, rows, std::uint64_t{0}, [&] { execution.check(); });
  for (std::size_t rank = 0; rank < gate_place.size(); ++rank) {
    if (rank % (1U << 16) == 0) execution.check();
    const LatticePlace p = gate_place[rank];
    gates[p / 64] |= std::uint64_t{1} << p % 64;
  }
  RawVector<std::uint32_t> before(rows);
  for_chunks(rows, 4096, execution, [&](Range r) {
    for (std::size_t row = r.first; row < r.last; ++row) {
      before[row] = static_cast<std::uint32_t>(std::popcount(gates[row]));
    }
  });
  exclusive_scan(before, execution);
  RawVector<GateRank> ranks(gate_place.size());
  arrays_.gates = ArrayOrView<std::uint64_t>(std::move(gates));
  arrays_.gates_before = ArrayOrView<std::uint32_t>(std::move(before));
  for (std::size_t rank = 0; rank < gate_place.size(); ++rank) {
    if (rank % (1U << 16) == 0) execution.check();
    ranks[number_of_gate(gate_place[rank])] = static_cast<GateRank>(rank);
  }
  arrays_.gate_rank = ArrayOrView<GateRank>(std::move(ranks));
}

std::size_t RouteIndex::bytes() const {
  std::size_t sum = 0;
  for (const RouteSection& section : route_sections(*this)) sum += section.bytes.size();
  return sum;
}

}  // namespace warren
