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

#include <cstddef>
#include <span>
#include <utility>

#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"

namespace warren {

/// Parts: any edges (duplicates are kept), ends below vertex_count and different; fastest when `from` ascends over the
/// concatenation, from < to, and each `to` ascends within its `from`. Extra edges, of a start and goal say, follow as a
/// last part. Throws InputError for an end out of range, a loop, or more than 2^32 - 1 edge ends (before allocating).
Graph assemble_graph(std::size_t vertex_count, std::span<const RawVector<Edge>> parts, const Execution& execution);
/// The same of one list of edges.
Graph assemble_graph(std::size_t vertex_count, std::span<const Edge> edges, const Execution& execution);

/// The graph with lengths: length(v, w) is called once an edge end, by several threads at once. Throws Stopped.
template <class Length>
Graph with_lengths(Graph graph, const Execution& execution, const Length& length) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  execution.reserve(graph.targets().size() * sizeof(double));
  RawVector<double> lengths(graph.targets().size());
  for_each_index<VertexId>(graph.vertex_count(), grain, execution, [&](VertexId v) {
    std::size_t end = graph.first_end(v);
    for (const VertexId w : graph.neighbours(v)) lengths[end++] = length(v, w);
  });
  return std::move(graph).with_lengths(std::move(lengths));
}

}  // namespace warren
