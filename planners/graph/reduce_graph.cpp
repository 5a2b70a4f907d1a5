// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/reduce_graph.hpp"

#include <atomic>
#include <string>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"

namespace warren {

KeyCoverView::KeyCoverView(const Graph& graph, std::span<const VertexId> keep, Peeling peeling,
                           const Execution& execution)
    : graph_(&graph) {
  const std::size_t n = graph.vertex_count();
  execution.reserve(n + n / 5);
  left_.resize(n);
  keys_.resize(chunk_count(n, 64));
  rank_.resize(chunk_count(n, 64) + 1);
  const Execution quiet = execution.quiet();
  for_chunks(n, detail::reduce_grain, quiet,
             [&](Range r) { std::fill(left_.data() + r.first, left_.data() + r.last, std::uint8_t{1}); });
  for (const VertexId v : keep) {
    if (v >= n) throw InputError("reduce_graph", "a vertex to keep is not in the graph", std::to_string(v));
    left_[v] = 2;
  }
  const std::vector<Peeled> peeled =
      parts_of_chunks(n, detail::reduce_grain, quiet, [&](Range r) { return peel_block(r); });
  for (const Peeled& block : peeled) peeled_trees_ += block.trees;
  for_chunks(peeling == Peeling::everywhere ? peeled.size() : 0, 1, quiet, [&](Range r) {
    for (const VertexId v : peeled[r.first].seeds) peel_across(v, execution);
  });
  for_chunks(n, detail::reduce_grain, quiet, [&](Range r) { mark_keys(r, peeling); });
  rank_.back() = 0;
  exclusive_scan(rank_, quiet);
}

/// Neighbours outside the block count as left, so a vertex that is peeled here has none of them, and no other thread
/// reads or writes what decides. The seeds are where peel_across has to begin.
KeyCoverView::Peeled KeyCoverView::peel_block(Range block) {
  const auto first = static_cast<VertexId>(block.first);
  const auto size = static_cast<VertexId>(block.size());
  std::vector<std::uint32_t> degree(size);
  for (VertexId i = 0; i < size; ++i) degree[i] = static_cast<std::uint32_t>(graph_->degree(first + i));
  Peeled peeled;
  for (VertexId scan = 0; scan < size; ++scan) {
    for (VertexId i = scan; i <= scan && degree[i] <= 1 && left_[first + i] == 1;) {  // a larger one comes later
      VertexId last = no_vertex;
      for (const VertexId w : graph_->neighbours(first + i)) last = w - first >= size || left_[w] != 0 ? w : last;
      if (last != no_vertex && last - first >= size) {
        peeled.seeds.push_back(first + i);
        break;
      }
      left_[first + i] = 0;
      if (last == no_vertex) {
        ++peeled.trees;
        break;
      }
      i = last - first;
      --degree[i];
    }
  }
  return peeled;
}

/// Follows dead ends wherever they lead. Whoever peels a vertex looks at its last neighbour afterwards; sequentially
/// consistent order makes the last of several peelers see all the others' work, so no vertex is forgotten.
void KeyCoverView::peel_across(VertexId seed, const Execution& execution) {
  std::size_t steps = 0;
  for (VertexId v = seed; v != no_vertex && std::atomic_ref(left_[v]).load() == 1;) {
    unsigned left = 0;
    VertexId last = no_vertex;
    for (const VertexId w : graph_->neighbours(v)) {
      if (std::atomic_ref(left_[w]).load() == 0) continue;
      last = w;
      if (++left > 1) return;
    }
    if (std::atomic_ref(left_[v]).exchange(0) == 0) return;
    v = last;
    if (++steps % detail::steps_per_poll == 0) execution.check();
  }
}

void KeyCoverView::mark_keys(Range block, Peeling peeling) {
  const auto first = static_cast<VertexId>(block.first);
  const auto size = static_cast<VertexId>(block.size());
  const bool within = peeling == Peeling::within_blocks;
  for (std::size_t word = block.first / 64; word * 64 < block.last; ++word) {
    std::uint64_t bits = 0;
    const auto end = static_cast<VertexId>(std::min(block.last, word * 64 + 64));
    for (auto v = static_cast<VertexId>(word * 64); v < end; ++v) {
      if (left_[v] == 0) continue;
      unsigned left = 0;
      bool is_key = left_[v] == 2;
      for (const VertexId w : graph_->neighbours(v)) {
        left += left_[w] != 0 ? 1U : 0U;
        is_key |= within && w - first >= size;
      }
      bits |= std::uint64_t{is_key || left != 2} << v % 64;
    }
    keys_[word] = bits;
    rank_[word] = static_cast<VertexId>(std::popcount(bits));
  }
}

ReducedGraphView::ReducedGraphView(KeyCoverView cover, const std::vector<Part>& parts, RawVector<EdgeEnd> degrees,
                                   const Execution& execution)
    : cover_(std::move(cover)) {
  std::vector<std::size_t> begins(parts.size() + 1, 0);
  for (std::size_t p = 0; p < parts.size(); ++p) begins[p + 1] = begins[p] + parts[p].chains.size();
  for (const Part& part : parts) cycles_ += part.cycles;
  const Execution quiet = execution.quiet();
  execution.reserve(begins.back() * (2 * sizeof(VertexId) + sizeof(double)));
  exclusive_scan(degrees, quiet);
  RawVector<VertexId> targets(begins.back());
  RawVector<double> lengths(begins.back());
  via_.resize(begins.back());
  vertices_.resize(cover_.key_count());
  for_each_index(parts.size(), 16, quiet, [&](std::size_t p) {
    std::size_t at = begins[p];
    for (const Chain& chain : parts[p].chains) {
      targets[at] = chain.target;
      lengths[at] = chain.length;
      via_[at++] = chain.via;
    }
  });
  for_each_index<VertexId>(cover_.graph().vertex_count(), detail::reduce_grain, quiet, [&](VertexId v) {
    if (cover_.is_key(v)) vertices_[cover_.rank(v)] = v;
  });
  reduced_ = Graph(std::move(degrees), std::move(targets), std::move(lengths));
}

RawVector<VertexId> ReducedGraphView::expand(std::span<const VertexId> keys, const Execution& execution) const {
  if (keys.empty()) return {};
  constexpr std::size_t keys_a_part = 1024;
  const Execution quiet = execution.quiet();
  const auto parts = parts_of_chunks(keys.size(), keys_a_part, quiet, [&](Range r) {
    RawVector<VertexId> part;
    if (r.first == 0) part.push_back(vertex_of(keys.front()));
    for (std::size_t i = std::max<std::size_t>(r.first, 1); i < r.last; ++i) {
      const std::span<const VertexId> row = reduced_.neighbours(keys[i - 1]);
      const auto at = static_cast<std::size_t>(std::lower_bound(row.begin(), row.end(), keys[i]) - row.begin());
      VertexId before = vertex_of(keys[i - 1]);
      VertexId v = via_[reduced_.first_end(keys[i - 1]) + at];
      while (!cover_.is_key(v)) {
        if (part.size() % detail::steps_per_poll == 0) execution.check();
        part.push_back(v);
        v = cover_.next_on_chain(std::exchange(before, v), v);
      }
      part.push_back(v);
    }
    return part;
  });
  return joined_parts(parts, quiet);
}

}  // namespace warren
