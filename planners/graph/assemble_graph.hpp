// SPDX-License-Identifier: BSD-3-Clause
// Builds a Graph in parallel from the parts that the chunks of an earlier loop left behind. Rows are ascending and the
// arrays are the same bits for any thread count.
//
// Vertices are cut into blocks (a power of two, at most 2048 blocks). The longest run of leading parts in which `from`
// ascends and from < to is cut at the block borders, so that a block's upper halves (from -> to) are its own run of
// edges. A lower half (to -> from) that stays in its block is found there too; the few that leave it, and both halves
// of all edges in the remaining, unordered parts, are routed to their block by two passes over the edges (count,
// place). Each block then counts and fills its rows in cache with one cursor a row: routed lower halves come first,
// then those of the block, then the upper halves, so that ordered input needs no sort; rows found out of order are
// sorted.
//
// No atomics. O(E + V), one sort of each unordered row. Memory: offsets and targets (4 bytes a vertex, 8 an edge), 8
// bytes a routed half while building, at most 16 MiB of counts; the parts stay with the caller. Cost on a lattice in
// tile order: see docs/performance.md and bench/graph_bench.cpp.
#pragma once

#include <span>

#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"

namespace warren {

/// Parts: any edges (duplicates are kept), ends below vertex_count and different; fastest when `from` ascends over the
/// concatenation, from < to, and each `to` ascends within its `from`. Extra edges, of a start and goal say, follow as a
/// last part. Throws InputError for an end out of range, a loop, or more than 2^32 - 1 edge ends (before allocating).
Graph assemble_graph(std::size_t vertex_count, std::span<const RawVector<Edge>> parts, const Execution& execution);
/// The same of one list of edges.
Graph assemble_graph(std::size_t vertex_count, std::span<const Edge> edges, const Execution& execution);

/// The arrays of a graph before they become one.
struct GraphRows {
  RawVector<EdgeEnd> offsets;
  RawVector<VertexId> targets;
};
GraphRows assemble_rows(std::size_t vertex_count, std::span<const RawVector<Edge>> parts, const Execution& execution);

/// The same with lengths: length(v, w) is called once an edge end, by several threads at once.
template <class Length>
Graph assemble_graph(std::size_t vertex_count, std::span<const RawVector<Edge>> parts, const Execution& execution,
                     const Length& length) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  GraphRows rows = assemble_rows(vertex_count, parts, execution);
  execution.reserve(rows.targets.size() * sizeof(double));
  RawVector<double> lengths(rows.targets.size());
  for_chunks(vertex_count, grain, execution, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) {
      for (EdgeEnd e = rows.offsets[v]; e < rows.offsets[v + 1]; ++e) {
        lengths[e] = length(static_cast<VertexId>(v), rows.targets[e]);
      }
    }
  });
  return Graph(std::move(rows.offsets), std::move(rows.targets), std::move(lengths));
}

}  // namespace warren
