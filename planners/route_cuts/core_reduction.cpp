// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/core_reduction.hpp"

#include <array>

namespace warren {
namespace {

class CoreReduction {
 public:
  CoreReduction(CoreGraph& graph, const Execution& execution) : graph_(graph), execution_(execution) {}

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
  }

 private:
  void visit(JunctionId v);
  void join(HalfEdge a, HalfEdge b, std::uint32_t length);
  void drop(HalfEdge h);
  void renumber();

  CoreGraph& graph_;
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

}  // namespace

void reduce_core(CoreGraph& graph, const Execution& execution) { CoreReduction(graph, execution).run(); }

}  // namespace warren
