// SPDX-License-Identifier: BSD-3-Clause
// An undirected graph in compressed sparse rows (CSR): the neighbours of vertex v are targets[offsets[v] ..
// offsets[v + 1]), ascending. Each edge stands twice. 4 bytes a vertex, 4 an edge end; lengths, 8 an edge end, only
// where they can't be computed from the states at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"

namespace warren {

/// Position in the array of edge ends. 2^32 - 1 ends are the most that a Graph takes; builders throw InputError before.
using EdgeEnd = std::uint32_t;

/// An undirected edge between two different vertices.
struct Edge {
  VertexId from;
  VertexId to;
  friend constexpr auto operator<=>(const Edge&, const Edge&) = default;
};

/// Immutable; any number of threads may read.
class Graph {
 public:
  Graph() : offsets_(1, 0) {}
  /// Takes finished arrays: offsets has vertex_count + 1 entries, rows ascending; lengths is empty or one an edge end.
  Graph(RawVector<EdgeEnd> offsets, RawVector<VertexId> targets, RawVector<double> lengths = {})
      : offsets_(std::move(offsets)), targets_(std::move(targets)), lengths_(std::move(lengths)) {}

  /// This graph with lengths, one an edge end.
  Graph with_lengths(RawVector<double> lengths) && {
    return Graph(std::move(offsets_), std::move(targets_), std::move(lengths));
  }

  std::size_t vertex_count() const { return offsets_.size() - 1; }
  std::size_t edge_count() const { return targets_.size() / 2; }
  std::span<const VertexId> neighbours(VertexId v) const {
    return {targets_.data() + offsets_[v], targets_.data() + offsets_[v + 1]};
  }
  /// Calls visit(v, w) for each edge once, v < w, by ascending v and then w.
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for (VertexId v = 0; v < vertex_count(); ++v) {
      for (const VertexId w : neighbours(v)) {
        if (v < w) visit(v, w);
      }
    }
  }
  std::size_t degree(VertexId v) const { return offsets_[v + 1] - offsets_[v]; }
  /// The edge ends of all rows, one row after the other: those of v are first_end(v) .. first_end(v) + degree(v) - 1.
  std::size_t first_end(VertexId v) const { return offsets_[v]; }
  /// The edge end of v that leads to w, one of its neighbours.
  std::size_t end_to(VertexId v, VertexId w) const {
    const auto row = neighbours(v);
    return first_end(v) + static_cast<std::size_t>(std::lower_bound(row.begin(), row.end(), w) - row.begin());
  }
  std::span<const EdgeEnd> offsets() const { return offsets_; }
  std::span<const VertexId> targets() const { return targets_; }
  bool has_lengths() const { return !lengths_.empty(); }
  /// Lengths of the edges to neighbours(v), in the same order; only if has_lengths().
  std::span<const double> lengths(VertexId v) const {
    return {lengths_.data() + offsets_[v], lengths_.data() + offsets_[v + 1]};
  }
  std::size_t bytes() const {
    return offsets_.size() * sizeof(EdgeEnd) + targets_.size() * sizeof(VertexId) + lengths_.size() * sizeof(double);
  }

 private:
  RawVector<EdgeEnd> offsets_;
  RawVector<VertexId> targets_;
  RawVector<double> lengths_;
};

/// Connected components: label[v] is the smallest vertex of v's component.
struct Components {
  RawVector<VertexId> label;
  std::size_t count = 0;
  bool connected(VertexId a, VertexId b) const { return label[a] == label[b]; }
  /// Vertices in v's component; O(V).
  std::size_t size_of(VertexId v) const {
    return static_cast<std::size_t>(std::count(label.begin(), label.end(), label[v]));
  }
};

/// What is known of each edge of a roadmap, two bits an edge end: the states of an edge's two ends are the same, so
/// that a search looks its edge up where it finds it. unchecked: a candidate that nobody has asked about. free,
/// blocked: the world has answered.
enum class EdgeState : std::uint8_t { unchecked, free, blocked };
constexpr auto enum_names(EdgeState) { return std::array<std::string_view, 3>{"unchecked", "free", "blocked"}; }

/// Edge ends in one word of states: end i has bits 2 (i mod 32) and the next of word i / 32; the bits after the last
/// are zero.
inline constexpr std::size_t edge_states_in_word = 32;

constexpr std::size_t edge_state_words(std::size_t ends) {
  return (ends + edge_states_in_word - 1) / edge_states_in_word;
}

constexpr EdgeState edge_state(std::span<const std::uint64_t> words, std::size_t end) {
  return static_cast<EdgeState>(words[end / edge_states_in_word] >> (2 * (end % edge_states_in_word)) & 3U);
}

constexpr void set_edge_state(std::span<std::uint64_t> words, std::size_t end, EdgeState state) {
  const std::size_t shift = 2 * (end % edge_states_in_word);
  std::uint64_t& word = words[end / edge_states_in_word];
  word = (word & ~(std::uint64_t{3} << shift)) | static_cast<std::uint64_t>(state) << shift;
}

}  // namespace warren
