// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/core_reduction.hpp"

#include <array>
#include <bit>

#include "parallel/chunks.hpp"
#include "planners/route_trees/peeling.hpp"

namespace warren {
namespace {

class CoreReduction {
 public:
  CoreReduction(CoreGraph& graph, const LatticePlaces& places, RawVector<std::uint8_t>& peeled,
                const Execution& execution)
      : graph_(graph), places_(places), peeled_(peeled), execution_(execution) {}

  void run() {
    execution_.reserve(graph_.size() * 8);
    gone_.assign(graph_.size(), 0);
    for (JunctionId v = 0; v < graph_.size(); ++v) {
      if (v % (1U << 16) == 0) execution_.check();
      todo_.push_back(v);
      while (!todo_.empty()) {
        const JunctionId next = todo_.back();
        todo_.pop_back();
        visit(next);
      }
    }
    renumber();
    for_chunks(graph_.size(), 4096, execution_, [&](Range r) {
      for (std::size_t v = r.first; v < r.last; ++v) mark_chains(static_cast<JunctionId>(v));
    });
  }

 private:
  void visit(JunctionId v);
  void join(HalfEdge a, HalfEdge b, std::uint32_t length);
  void drop(HalfEdge h);
  void renumber();
  void mark_chains(JunctionId v);

  CoreGraph& graph_;
  const LatticePlaces& places_;
  RawVector<std::uint8_t>& peeled_;
  const Execution& execution_;
  RawVector<std::uint8_t> gone_;
  RawVector<JunctionId> todo_;  // whoever has lost a chain
};

/// Of at most two chains: takes the junction out.
void CoreReduction::visit(JunctionId v) {
  if (gone_[v] != 0 || is_post(graph_.place[v])) return;
  std::array<HalfEdge, 2> chain{};
  std::size_t count = 0;
  for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
    if (graph_.twin[h] == no_half_edge) continue;
    if (count == 2) return;
    chain[count++] = h;
  }
  gone_[v] = 1;
  if (count == 1) drop(chain[0]);
  if (count < 2) return;
  std::uint8_t& byte = peeled_[graph_.place[v]];
  byte = static_cast<std::uint8_t>((byte & ~peel_bit::edges) | 1U << chain[0] % 4 | 1U << chain[1] % 4);
  const HalfEdge a = graph_.twin[chain[0]];
  const HalfEdge b = graph_.twin[chain[1]];
  const std::uint32_t length = graph_.length[chain[0]] + graph_.length[chain[1]];
  graph_.twin[chain[0]] = graph_.twin[chain[1]] = no_half_edge;
  join(a, b, length);
}

/// A chain between two slots, unless it leads back to its junction or is no shorter than one that is there.
void CoreReduction::join(HalfEdge a, HalfEdge b, std::uint32_t length) {
  graph_.twin[a] = b;
  graph_.twin[b] = a;
  graph_.length[a] = graph_.length[b] = length;
  if (a / 4 == b / 4) return drop(a);
  for (HalfEdge h = a & ~HalfEdge{3}; h < (a & ~HalfEdge{3}) + 4; ++h) {
    if (h == a || graph_.twin[h] == no_half_edge || graph_.twin[h] / 4 != b / 4) continue;
    return drop(graph_.length[h] <= length ? a : h);
  }
}

void CoreReduction::drop(HalfEdge h) {
  const HalfEdge twin = graph_.twin[h];
  graph_.twin[h] = graph_.twin[twin] = no_half_edge;
  todo_.push_back(h / 4);
  todo_.push_back(twin / 4);
}

void CoreReduction::renumber() {
  RawVector<JunctionId> number(graph_.size());
  JunctionId next = 0;
  for (JunctionId v = 0; v < graph_.size(); ++v) {
    number[v] = next;
    next += gone_[v] == 0 ? 1 : 0;
  }
  for (JunctionId v = 0; v < graph_.size(); ++v) {
    if (v % (1U << 16) == 0) execution_.check();
    if (gone_[v] != 0) continue;
    graph_.place[number[v]] = graph_.place[v];
    for (HalfEdge slot = 0; slot < 4; ++slot) {
      const HalfEdge twin = graph_.twin[4 * v + slot];
      graph_.twin[4 * number[v] + slot] = twin == no_half_edge ? no_half_edge : 4 * number[twin / 4] + twin % 4;
      graph_.length[4 * number[v] + slot] = graph_.length[4 * v + slot];
    }
  }
  graph_.place.resize(next);
  graph_.twin.resize(4 * std::size_t{next});
  graph_.length.resize(4 * std::size_t{next});
}

/// A junction, and the cells of its chains to junctions with larger numbers: each cell is written to once.
void CoreReduction::mark_chains(JunctionId v) {
  constexpr unsigned right_and_up = 3;
  const auto mark = [&](LatticePlace p, unsigned edges) {
    peeled_[p] = static_cast<std::uint8_t>(peeled_[p] | (edges & right_and_up) << peel_bit::direction_shift);
  };
  mark(graph_.place[v], slots_of(graph_, v));
  for (unsigned slot = 0; slot < 4; ++slot) {
    const HalfEdge twin = graph_.twin[4 * v + slot];
    if (twin == no_half_edge || twin / 4 < v) continue;
    unsigned direction = slot;
    LatticePlace at = graph_.place[v];
    for (std::uint32_t left = graph_.length[4 * v + slot]; left > 1; --left) {
      at = places_.step(at, direction);
      const unsigned edges = peeled_[at] & peel_bit::edges;
      mark(at, edges);
      direction = static_cast<unsigned>(std::countr_zero(edges & ~(1U << (direction ^ 2U))));
    }
  }
}

}  // namespace

void reduce_core(CoreGraph& graph, const LatticePlaces& places, RawVector<std::uint8_t>& peeled,
                 const Execution& execution) {
  CoreReduction(graph, places, peeled, execution).run();
}

}  // namespace warren
