// SPDX-License-Identifier: BSD-3-Clause
// Asks the world about every edge of a roadmap, on all cores. An edge that leads both ways is asked from its smaller
// vertex, as prm does; its other end copies what was answered. One byte an edge end while it runs, since threads share
// words of two bits.
#pragma once

#include <algorithm>
#include <bit>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/counters.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/world.hpp"
#include "core/search/edge_states.hpp"
#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/connection.hpp"

namespace warren {

enum class EdgeDirections : std::uint8_t { both, one };

/// What is known of a motion without asking the world; nothing: it must be asked. Called by several threads at once.
template <class State>
using KnownMotions = std::function<std::optional<bool>(const State& from, const State& to)>;

namespace detail {

/// The edge end of v that leads to w.
inline std::size_t end_of_edge(const Graph& graph, VertexId v, VertexId w) {
  const auto row = graph.neighbours(v);
  return graph.first_end(v) + static_cast<std::size_t>(std::lower_bound(row.begin(), row.end(), w) - row.begin());
}

/// Asks about the edges of one row; `answers` are those of the row's ends.
template <World W>
void check_row(const W& world, std::span<const typename W::State> states, const Graph& graph, VertexId v,
               EdgeDirections directions, const KnownMotions<typename W::State>& known, std::span<std::uint8_t> answers,
               typename W::Query& query, std::uint64_t& checked) {
  std::array<Motion<typename W::State>, bunch_size> motions;
  std::array<std::size_t, bunch_size> ends;
  std::size_t count = 0;
  const auto flush = [&] {
    const std::uint32_t free = free_motions<W>(world, std::span(motions).first(count), query);
    for (std::size_t i = 0; i < count; ++i) {
      answers[ends[i]] = static_cast<std::uint8_t>((free >> i & 1U) != 0 ? EdgeState::free : EdgeState::blocked);
    }
    checked += count;
    count = 0;
  };
  const auto row = graph.neighbours(v);
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (directions == EdgeDirections::both && row[i] < v) continue;
    if (const auto answer = known ? known(states[v], states[row[i]]) : std::nullopt) {
      answers[i] = static_cast<std::uint8_t>(*answer ? EdgeState::free : EdgeState::blocked);
      continue;
    }
    motions[count] = {states[v], states[row[i]]};
    ends[count++] = i;
    if (count == bunch_size) flush();
  }
  if (count > 0) flush();
}

/// An edge's end at the larger vertex gets what stands at the other.
inline void copy_to_other_ends(const Graph& graph, std::span<std::uint8_t> answers, const Execution& execution) {
  constexpr std::size_t grain = 2048;
  for_chunks(graph.vertex_count(), grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto v = static_cast<VertexId>(i);
      std::size_t end = graph.first_end(v);
      for (const VertexId w : graph.neighbours(v)) {
        if (w >= v) break;
        answers[end++] = answers[end_of_edge(graph, w, v)];
      }
    }
  });
}

inline RawVector<std::uint64_t> packed(std::span<const std::uint8_t> states, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  RawVector<std::uint64_t> words(edge_state_words(states.size()));
  for_chunks(words.size(), grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      words[i] = 0;
      const std::size_t first = i * edge_states_in_word;
      const std::size_t last = std::min(first + edge_states_in_word, states.size());
      for (std::size_t end = first; end < last; ++end) words[i] |= std::uint64_t{states[end]} << (2 * (end - first));
    }
  });
  return words;
}

}  // namespace detail

/// The states of all edges, as edge_states.hpp packs them: the same for any number of threads. Throws Stopped.
template <World W>
RawVector<std::uint64_t> check_edges(const W& world, std::span<const typename W::State> states, const Graph& graph,
                                     EdgeDirections directions, const Execution& execution, Counters& counters,
                                     const KnownMotions<typename W::State>& known = {}) {
  constexpr std::size_t grain = detail::connection_grain<W>;
  const std::size_t n = graph.vertex_count();
  const std::size_t ends = graph.targets().size();
  execution.reserve(ends + ends / 4);
  RawVector<std::uint8_t> answers(ends);
  std::vector<Counters> done(chunk_count(n, grain));
  for_chunks(n, grain, execution, [&](Range r) {
    auto query = world.make_query();
    Counters& counts = done[r.first / grain];
    for (std::size_t v = r.first; v < r.last; ++v) {
      const auto vertex = static_cast<VertexId>(v);
      const std::span<std::uint8_t> row(answers.data() + graph.first_end(vertex), graph.degree(vertex));
      detail::check_row(world, states, graph, vertex, directions, known, row, query, counts.edges_checked);
    }
    counts.refused = refused_motions(query);
  });
  for (const Counters& part : done) counters += part;
  if (directions == EdgeDirections::both) detail::copy_to_other_ends(graph, answers, execution);
  return detail::packed(answers, execution);
}

}  // namespace warren
