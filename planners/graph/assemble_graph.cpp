// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/assemble_graph.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/items_by_key.hpp"
#include "core/search/search.hpp"
#include "parallel/asked_memory.hpp"

namespace warren {
namespace {

using Parts = std::span<const std::span<const Edge>>;

constexpr unsigned smallest_block_bits = 14;  // a block's rows stay in a second-level cache
constexpr std::size_t most_blocks = 2048;     // bounds the table of counts
constexpr std::size_t smallest_run = std::size_t{1} << 17;

/// Is the part in order: from ascending, from < to? Checks its ends.
bool is_ordered(std::size_t vertex_count, std::span<const Edge> part) {
  bool ordered = true;
  VertexId largest = 0;
  VertexId before = 0;
  bool loop = false;
  for (const Edge& e : part) {
    largest = std::max(largest, std::max(e.from, e.to));
    loop |= e.from == e.to;
    ordered &= e.from >= before && e.from < e.to;
    before = e.from;
  }
  if (loop) throw InputError("graph", "an edge joins a vertex to itself");
  if (!part.empty() && largest >= vertex_count) {
    throw InputError("graph", "an edge's end is not a vertex", std::to_string(largest));
  }
  return ordered;
}

/// Place of the edge in front of which a block begins: part and position in it.
struct Cut {
  std::size_t part;
  std::size_t at;
};

class Assembly {
 public:
  Assembly(std::size_t vertex_count, Parts parts, const Execution& execution)
      : vertex_count_(vertex_count), parts_(parts), execution_(execution) {
    while (chunk_count(vertex_count_, std::size_t{1} << bits_) > most_blocks) ++bits_;
    blocks_ = chunk_count(vertex_count_, std::size_t{1} << bits_);
  }

  Graph run() {
    check_parts();
    if (vertex_count_ == 0) return {};
    cut_ordered_parts();
    cut_loose_parts();
    count_halves();
    place_routed_halves();
    return fill_rows();
  }

 private:
  std::size_t block_of(VertexId v) const { return v >> bits_; }
  VertexId begin_of(std::size_t block) const { return static_cast<VertexId>(block << bits_); }

  void check_parts() {
    std::size_t edges = 0;
    for (const auto& part : parts_) edges += part.size();
    if (edges > std::numeric_limits<EdgeEnd>::max() / 2) {
      throw InputError("graph", "too many edges for 32-bit positions; use fewer samples or neighbours",
                       std::to_string(edges));
    }
    if (vertex_count_ > no_vertex) throw InputError("graph", "too many vertices", std::to_string(vertex_count_));
    edge_count_ = edges;
    std::vector<std::uint8_t> ordered(parts_.size());
    const std::size_t grain = std::max<std::size_t>(1, parts_.size() / 1024);
    for_each_index(parts_.size(), grain, execution_.quiet(),
                   [&](std::size_t p) { ordered[p] = is_ordered(vertex_count_, parts_[p]) ? 1 : 0; });
    VertexId last = 0;
    for (ordered_ = 0; ordered_ < parts_.size(); ++ordered_) {
      if (parts_[ordered_].empty()) continue;
      if (ordered[ordered_] == 0 || parts_[ordered_].front().from < last) break;
      last = parts_[ordered_].back().from;
    }
  }

  void cut_ordered_parts() {
    cuts_.resize(blocks_ + 1, {ordered_, 0});
    std::size_t block = 0;  // the first one whose cut is not known
    for (std::size_t p = 0; p < ordered_ && block < blocks_; ++p) {
      const auto& part = parts_[p];
      for (; block < blocks_ && !part.empty() && begin_of(block) <= part.back().from; ++block) {
        const auto at = std::ranges::lower_bound(part, begin_of(block), {}, &Edge::from);
        cuts_[block] = {p, static_cast<std::size_t>(at - part.begin())};
      }
    }
  }
  /// Calls visit(edge) for each edge from one cut to another.
  template <class Visit>
  void for_edges(Cut at, Cut end, const Visit& visit) const {
    for (; at.part < parts_.size() && at.part <= end.part; at = {at.part + 1, 0}) {
      const auto& part = parts_[at.part];
      const std::size_t last = at.part == end.part ? end.at : part.size();
      for (std::size_t i = at.at; i < last; ++i) visit(part[i]);
    }
  }
  template <class Visit>
  void for_block_edges(std::size_t block, const Visit& visit) const {
    for_edges(cuts_[block], cuts_[block + 1], visit);
  }

  /// Cuts the unordered parts into at most most_blocks runs of about the same size.
  void cut_loose_parts() {
    std::size_t edges = 0;
    for (std::size_t p = ordered_; p < parts_.size(); ++p) edges += parts_[p].size();
    const std::size_t grain = std::max(smallest_run, edges / most_blocks + 1);
    std::size_t taken = 0;
    loose_.push_back({ordered_, 0});
    for (std::size_t p = ordered_; p < parts_.size(); ++p) {
      for (std::size_t at = 0; at < parts_[p].size();) {
        const std::size_t step = std::min(parts_[p].size() - at, grain - taken);
        at += step;
        taken = (taken + step) % grain;
        if (taken == 0) loose_.push_back({p, at});
      }
    }
    if (taken > 0) loose_.push_back({parts_.size(), 0});
  }

  /// Sources of routed halves: the blocks, then the runs of unordered edges.
  std::size_t source_count() const { return blocks_ + loose_.size() - 1; }
  /// Calls visit(row, target) for each half that a source sends to rows of other blocks.
  template <class Visit>
  void for_routed_halves(std::size_t source, const Visit& visit) const {
    if (source < blocks_) {
      const VertexId last = begin_of(source + 1) - 1;
      for_block_edges(source, [&](const Edge& e) {
        if (e.to > last) visit(e.to, e.from);
      });
    } else {
      for_edges(loose_[source - blocks_], loose_[source - blocks_ + 1], [&](const Edge& e) {
        visit(e.from, e.to);
        visit(e.to, e.from);
      });
    }
  }
  std::span<std::uint32_t> counts_of(std::size_t source) { return {counts_.data() + source * blocks_, blocks_}; }

  /// counts_: routed halves by source and block; ends_: of each block, the edge ends of its own edges in its own rows.
  void count_halves() {
    counts_.assign(blocks_ * source_count(), 0);
    ends_.assign(blocks_ + 1, 0);
    for_chunks(source_count(), 1, execution_.quiet(), [&](Range r) {
      const std::span<std::uint32_t> sent = counts_of(r.first);
      for_routed_halves(r.first, [&](VertexId row, VertexId) { ++sent[block_of(row)]; });
      if (r.first >= blocks_) return;
      std::uint64_t halves = 0;
      for_block_edges(r.first, [&](const Edge&) { halves += 2; });
      ends_[r.first] = halves - std::accumulate(sent.begin(), sent.end(), std::uint64_t{0});
    });
  }

  /// Turns counts into places: routed halves lie block by block, in each in the order of the sources.
  void place_routed_halves() {
    std::vector<std::uint32_t> received(blocks_, 0);
    for (std::size_t s = 0; s < source_count(); ++s) {
      for (std::size_t block = 0; block < blocks_; ++block) received[block] += counts_of(s)[block];
    }
    routed_begin_.assign(blocks_ + 1, 0);
    std::uint64_t ends = 0;
    for (std::size_t block = 0; block < blocks_; ++block) {
      routed_begin_[block + 1] = routed_begin_[block] + received[block];
      ends += std::exchange(ends_[block], ends) + received[block];
    }
    std::vector<std::uint32_t> next(routed_begin_.begin(), routed_begin_.end() - 1);
    for (std::size_t s = 0; s < source_count(); ++s) {
      for (std::size_t block = 0; block < blocks_; ++block) {
        next[block] += std::exchange(counts_of(s)[block], next[block]);
      }
    }
    execution_.reserve(routed_begin_.back() * sizeof(Edge));
    routed_.resize(routed_begin_.back());
    touch_first(routed_, execution_);
    for_chunks(source_count(), 1, execution_.quiet(), [&](Range r) {
      const std::span<std::uint32_t> place = counts_of(r.first);
      for_routed_halves(r.first, [&](VertexId row, VertexId target) {
        routed_[place[block_of(row)]++] = {row, target};
      });
    });
  }
  std::span<const Edge> routed_to(std::size_t block) const {
    return {routed_.data() + routed_begin_[block], routed_.data() + routed_begin_[block + 1]};
  }

  Graph fill_rows() {
    execution_.reserve((vertex_count_ + 2 * edge_count_) * sizeof(VertexId));
    RawVector<EdgeEnd> offsets(vertex_count_ + 1);
    RawVector<VertexId> targets(2 * edge_count_);
    offsets[vertex_count_] = static_cast<EdgeEnd>(2 * edge_count_);
    for_chunks(vertex_count_, std::size_t{1} << bits_, execution_,
               [&](Range r) { fill_block(r.first >> bits_, r, offsets, targets); });
    return {std::move(offsets), std::move(targets)};
  }
  void fill_block(std::size_t block, Range r, std::span<EdgeEnd> offsets, std::span<VertexId> targets) const {
    std::vector<EdgeEnd> next(r.size() + 1, 0);  // row v's cursor is next[v - r.first]
    const auto first = static_cast<VertexId>(r.first);
    const auto size = static_cast<VertexId>(r.size());
    for (const Edge& half : routed_to(block)) ++next[half.from - first];
    for_block_edges(block, [&](const Edge& e) {
      ++next[e.from - first];
      if (e.to - first < size) ++next[e.to - first];
    });
    auto at = static_cast<EdgeEnd>(ends_[block]);
    for (std::size_t i = 0; i < size; ++i) {
      offsets[r.first + i] = at;
      at += std::exchange(next[i], at);
    }
    for (const Edge& half : routed_to(block)) targets[next[half.from - first]++] = half.to;
    for_block_edges(block, [&](const Edge& e) {
      targets[next[e.from - first]++] = e.to;
      if (e.to - first < size) targets[next[e.to - first]++] = e.from;
    });
    EdgeEnd begin = static_cast<EdgeEnd>(ends_[block]);
    for (std::size_t i = 0; i < size; begin = next[i++]) {
      VertexId* const row = targets.data() + begin;
      VertexId* const row_end = targets.data() + next[i];
      if (!std::is_sorted(row, row_end)) std::sort(row, row_end);
    }
  }

  std::size_t vertex_count_;
  Parts parts_;
  const Execution& execution_;
  unsigned bits_ = smallest_block_bits;
  std::size_t blocks_ = 0;
  std::size_t edge_count_ = 0;
  std::size_t ordered_ = 0;                  // leading parts that are in order
  std::vector<Cut> cuts_;                    // one a block, and the end
  std::vector<Cut> loose_;                   // borders of the runs of unordered edges
  std::vector<std::uint32_t> counts_;        // by source, then block: halves sent; later the place of the next
  std::vector<std::uint64_t> ends_;          // edge ends of each block's rows; later the position of the first
  std::vector<std::uint32_t> routed_begin_;  // of each block in routed_
  RawVector<Edge> routed_;                   // halves, from their row to their target
};

}  // namespace

Graph assemble_graph(std::size_t vertex_count, std::span<const RawVector<Edge>> parts, const Execution& execution) {
  const std::vector<std::span<const Edge>> spans(parts.begin(), parts.end());
  return Assembly(vertex_count, spans, execution).run();
}

Graph assemble_graph(std::size_t vertex_count, std::span<const Edge> edges, const Execution& execution) {
  std::vector<std::span<const Edge>> parts;
  for (std::size_t i = 0; i < edges.size(); i += smallest_run) {
    parts.push_back(edges.subspan(i, std::min(smallest_run, edges.size() - i)));
  }
  return Assembly(vertex_count, parts, execution).run();
}

Components components(const Graph& graph, const Execution& execution) {
  Components result{joined_labels(graph.vertex_count(), execution, [&](VertexId v, const auto& join) {
    for (const VertexId w : graph.neighbours(v)) {
      if (w > v) break;  // each edge once, from its larger end
      join(w);
    }
  })};
  result.count = sum_of_chunks(result.label.size(), std::size_t{1} << 14, execution.quiet(), [&](Range r) {
    std::size_t count = 0;
    for (std::size_t v = r.first; v < r.last; ++v) count += result.label[v] == v ? 1 : 0;
    return count;
  });
  return result;
}

Components reached_and_reaching(const Graph& graph, VertexId from, VertexId to, const Execution& execution) {
  Components parts;
  execution.reserve(graph.vertex_count() * (sizeof(VertexId) + sizeof(double) + 2 * sizeof(VertexId)));
  parts.label.assign(graph.vertex_count(), no_vertex);
  const auto mark = [&](const Graph& along, VertexId root) {
    SearchState state;
    state.resize(along.vertex_count(), [&] { execution.check(); });
    breadth_first(along, root, no_vertex, state, [&] { return execution.should_stop(); });
    execution.check();
    for (VertexId v = 0; v < along.vertex_count(); ++v) {
      if (state.reached(v)) parts.label[v] = root;
    }
  };
  mark(graph, from);
  execution.reserve((graph.vertex_count() + 1) * 2 * sizeof(EdgeEnd) + graph.targets().size() * sizeof(VertexId));
  const auto each_reversed = [&](const auto& visit) {
    for (VertexId v = 0; v < graph.vertex_count(); ++v) {
      execution.poll(v);
      for (const VertexId w : graph.neighbours(v)) visit(w, v);
    }
  };
  ItemsByKey rows = items_by_key(graph.vertex_count(), each_reversed, [&] { execution.check(); });
  mark(Graph(std::move(rows.first), std::move(rows.items)), to);
  return parts;
}

Graph one_way_graph(std::size_t vertex_count, std::span<const RawVector<Edge>> edges, const Execution& execution) {
  std::uint64_t ends = 0;
  for (const RawVector<Edge>& part : edges) ends += part.size();
  if (ends >= std::numeric_limits<EdgeEnd>::max())
    throw InputError("roadmap", "more than 2^32 - 1 edges; ask for fewer samples or neighbours");
  execution.reserve((vertex_count + 1) * 2 * sizeof(EdgeEnd) + ends * sizeof(VertexId));
  const auto each = [&](const auto& visit) {
    for (const RawVector<Edge>& part : edges) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        execution.poll(i);
        visit(part[i].from, part[i].to);
      }
    }
  };
  ItemsByKey rows = items_by_key(vertex_count, each, [&] { execution.check(); });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    execution.poll(v);
    std::sort(rows.items.begin() + rows.first[v], rows.items.begin() + rows.first[v + 1]);
  }
  return {std::move(rows.first), std::move(rows.items)};
}

Graph free_part(const Graph& candidates, std::span<const std::uint64_t> edge_states, const Execution& execution) {
  execution.reserve((candidates.vertex_count() + 1) * sizeof(EdgeEnd) + candidates.targets().size() * sizeof(VertexId));
  const auto is_free = [&](std::size_t end) { return edge_state(edge_states, end) == EdgeState::free; };
  return part_with_edges(candidates, is_free, candidates.vertex_count(), {}, execution);
}

}  // namespace warren
