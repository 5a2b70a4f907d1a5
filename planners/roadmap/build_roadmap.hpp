// SPDX-License-Identifier: BSD-3-Clause
// A roadmap without a question: the milestones and candidate edges of prm, lazy_prm or one_way_prm, and what is known
// of each edge. A question asked of it (ask_roadmap.hpp) is answered as the planner answers it with as many samples.
//
// Where nobody says how many samples: rounds grow as a planner's do, and after each one a hundred fresh random free
// states are attached to the roadmap. The roadmap is done when a round has joined the same of them as the round before.
// Growing asks the world about every edge, of lazy roadmaps too: what is joined is known of nothing else.
// Cost: that of prm's last round, 8/3 times as much where it grows by 1.6. The same bits for any number of threads.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "planners/roadmap/connection.hpp"
#include "planners/roadmap/sampler.hpp"

namespace warren {

/// What is known of a motion without asking the world; nothing: it must be asked. Called by several threads at once.
template <class State>
using KnownMotions = std::function<std::optional<bool>(const State& from, const State& to)>;

namespace detail {

/// What the world says of the edge from v with this end; where it leads both ways its other end says the same.
template <World W>
void learn_edge(const SharedEdgeStates& states, const Graph& graph, VertexId v, std::size_t end, bool free) {
  const EdgeState answer = free ? EdgeState::free : EdgeState::blocked;
  states.learn(end, answer);
  if (!W::one_way) states.learn(graph.end_to(graph.targets()[end], v), answer);
}

/// Asks about the edges of one row that are not known.
template <World W>
void check_row(const W& world, std::span<const typename W::State> states, const Graph& graph, VertexId v,
               const KnownMotions<typename W::State>& known, const SharedEdgeStates& answers, typename W::Query& query,
               std::uint64_t& checked) {
  std::array<Motion<typename W::State>, bunch_size> motions;
  std::array<std::size_t, bunch_size> ends;
  std::size_t count = 0;
  const auto flush = [&] {
    const std::uint32_t free = world.free_motions(std::span(motions).first(count), query);
    for (std::size_t i = 0; i < count; ++i) learn_edge<W>(answers, graph, v, ends[i], (free >> i & 1U) != 0);
    checked += count;
    count = 0;
  };
  std::size_t end = graph.first_end(v);
  for (const VertexId w : graph.neighbours(v)) {
    const std::size_t its_end = end++;
    if ((!W::one_way && w < v) || answers[its_end] != EdgeState::unchecked) continue;
    if (const auto answer = known ? known(states[v], states[w]) : std::nullopt) {
      learn_edge<W>(answers, graph, v, its_end, *answer);
      continue;
    }
    motions[count] = {states[v], states[w]};
    ends[count++] = its_end;
    if (count == bunch_size) flush();
  }
  if (count > 0) flush();
}

}  // namespace detail

/// Asks the world about every edge of a roadmap, on all cores. An edge that leads both ways is asked from its smaller
/// vertex, as prm does. The states of all edges, as graph.hpp packs them: the same for any number of threads. `known`,
/// and what `before` says where it is given, is not asked. Throws Stopped.
template <World W>
RawVector<std::uint64_t> check_edges(const W& world, std::span<const typename W::State> states, const Graph& graph,
                                     const Execution& execution, Counters& counters,
                                     const KnownMotions<typename W::State>& known = {},
                                     std::span<const std::uint64_t> before = {}) {
  constexpr std::size_t grain = detail::connection_grain<W>;
  constexpr std::size_t rows_per_poll = grain / 64;
  const std::size_t n = graph.vertex_count();
  const std::size_t words = edge_state_words(graph.targets().size());
  execution.reserve(words * sizeof(std::uint64_t));
  RawVector<std::uint64_t> first(words);
  for (std::size_t i = 0; i < words; ++i) {
    execution.poll(i);
    first[i] = before.empty() ? 0 : before[i];
  }
  SharedEdgeStates answers(std::move(first));
  std::vector<Counters> done(chunk_count(n, grain));
  for_chunks(n, grain, execution, [&](Range r) {
    auto query = world.make_query();
    Counters& counts = done[r.first / grain];
    for (std::size_t v = r.first; v < r.last; ++v) {
      const auto vertex = static_cast<VertexId>(v);
      if (v % rows_per_poll == 0) execution.check();
      detail::check_row(world, states, graph, vertex, known, answers, query, counts.edges_checked);
    }
    counts.refused = refused_motions(query);
  });
  for (const Counters& part : done) counters += part;
  return std::move(answers).taken();
}

template <class State>
struct BuiltRoadmap {
  RawVector<State> states;               ///< milestones in tile order
  Graph candidates;                      ///< all edges; where edges lead one way: w in the row of v, from v to w
  RawVector<std::uint64_t> edge_states;  ///< core/search/graph.hpp
  std::uint64_t samples = 0;             ///< drawn in the last round
  ConnectionRule rule;                   ///< by which the milestones were joined, and start and goal will be
  Counters counters;
  StageTimes seconds;
};

namespace detail {

/// The candidate edges from each of the first `begins` states, milestones before others.
template <World W>
EdgeParts one_way_edges(const W& world, std::span<const typename W::State> states, std::size_t begins,
                        const StateIndex<W>& index, const ConnectionRule& rule, const Execution& execution) {
  constexpr std::size_t grain = 64;
  return parts_of_chunks(begins, grain, execution, [&](Range r) {
    RawVector<Edge> edges;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto v = static_cast<VertexId>(i);
      const VertexId except = v < index.size() ? v : no_vertex;
      for (const Neighbour& c : one_way_candidates<W>(world, states, index, rule, states[v], except, Heading::out)) {
        push_asked(edges, {v, c.id}, execution);
      }
    }
    return edges;
  });
}

template <World W>
class RoadmapBuild {
 public:
  using State = typename W::State;
  RoadmapBuild(const W& world, const RoadmapOptions& options, bool lazy, const Execution& execution,
               const KnownMotions<State>& known)
      : world_(world), options_(options), lazy_(lazy), execution_(execution), known_(known) {}

  BuiltRoadmap<State> run() {
    const std::uint64_t usual = usual_samples(world_, options_, execution_);
    const bool grows = next_samples(options_, usual, usual) != 0;
    std::vector<VertexId> before;
    for (std::uint64_t samples = usual; samples != 0; samples = next_samples(options_, usual, samples)) {
      round(samples, grows || !lazy_);
      if (!grows) break;
      std::vector<VertexId> joined = joined_probes();
      if (joined == before) break;
      before = std::move(joined);
    }
    return std::move(built_);
  }

 private:
  static constexpr std::size_t probes = 100;

  void round(std::uint64_t samples, bool check) {
    ++built_.counters.rounds;
    built_.samples = samples;
    {
      const StageTimer timer(execution_, "sample", built_.seconds.sample, samples);
      index_ = {};
      built_.states = draw_milestones(world_, options_, samples, execution_);
      built_.counters.samples += samples;
      built_.counters.kept += built_.states.size();
    }
    {
      const StageTimer timer(execution_, "neighbours", built_.seconds.neighbours, built_.states.size());
      index_ = index_of_states(world_, built_.states, execution_);
    }
    const StageTimer timer(execution_, "connect", built_.seconds.connect, built_.states.size());
    built_.rule = connection_rule_for(world_, options_, samples);
    find_candidates();
    if (check) {
      built_.edge_states = check_edges(world_, built_.states, built_.candidates, execution_, built_.counters, known_);
    } else {
      const std::size_t words = edge_state_words(built_.candidates.targets().size());
      execution_.reserve(words * sizeof(std::uint64_t));
      assign_polled(built_.edge_states, words, std::uint64_t{0}, [&] { execution_.check(); });
    }
  }
  void find_candidates() {
    const RawVector<State>& states = built_.states;
    if constexpr (W::one_way) {
      const EdgeParts parts = one_way_edges(world_, states, states.size(), index_, built_.rule, execution_);
      built_.candidates = one_way_graph(states.size(), parts, execution_);
      built_.counters.neighbour_queries += states.size();
    } else {
      const EdgeParts parts = candidate_edges(world_, states, index_, built_.rule, execution_, built_.counters);
      built_.candidates = assemble_graph(states.size(), parts, execution_);
    }
  }
  /// From milestones that a free motion joins the state with, to no vertex.
  RawVector<Edge> attached(const State& state) const {
    if constexpr (!W::one_way) {
      Counters counters;
      return attach(world_, built_.states, index_, built_.rule, state, no_vertex, counters, execution_);
    } else {
      auto query = world_.make_query();
      RawVector<Edge> edges;
      for (const Neighbour& c :
           one_way_candidates<W>(world_, built_.states, index_, built_.rule, state, no_vertex, Heading::out)) {
        if (world_.is_free_motion(state, built_.states[c.id], query)) edges.push_back({c.id, no_vertex});
      }
      return edges;
    }
  }
  /// For each probe the first one that it is joined with, whatever the direction: the same partition as before says
  /// that the last round has joined nothing more.
  std::vector<VertexId> joined_probes() {
    constexpr std::uint64_t probe_stream = 0x70726f6265;  // apart from the seeds that people choose
    const StageTimer timer(execution_, "probe", built_.seconds.search, probes);
    const auto n = static_cast<VertexId>(built_.states.size());
    EdgeParts edges(probes);
    for_chunks(probes, 1, execution_, [&](Range r) {
      const State state = uniform_state(world_, options_.seed ^ probe_stream, r.first);
      auto own = world_.make_query();
      if (world_.is_free(state, own)) edges[r.first] = attached(state);
    });
    const RawVector<VertexId> label = joined_labels(n + probes, execution_, [&](VertexId v, const auto& join) {
      if (v >= n) {
        for (const Edge& e : edges[v - n]) join(e.from);
        return;
      }
      std::size_t end = built_.candidates.first_end(v);
      for (const VertexId w : built_.candidates.neighbours(v)) {
        if (edge_state(built_.edge_states, end++) == EdgeState::free) join(w);
      }
    });
    execution_.reserve((n + probes) * sizeof(VertexId));
    std::vector<VertexId> first_with(n + probes, no_vertex);
    std::vector<VertexId> joined;
    for (std::size_t i = 0; i < probes; ++i) {
      VertexId& first = first_with[label[n + i]];
      if (first == no_vertex) first = static_cast<VertexId>(i);
      joined.push_back(edges[i].empty() ? no_vertex : first);
    }
    return joined;
  }

  const W& world_;
  const RoadmapOptions& options_;
  bool lazy_;
  const Execution& execution_;
  const KnownMotions<State>& known_;
  BuiltRoadmap<State> built_;
  StateIndex<W> index_;
};

}  // namespace detail

/// Throws Stopped, and InputError for options out of range. `lazy`: no edge is asked about where the samples are said.
/// `known`: motions that need no asking.
template <class State, bool one_way>
BuiltRoadmap<State> build_roadmap(const AnyWorld<State, one_way>& world, const RoadmapOptions& options, bool lazy,
                                  const Execution& execution, const KnownMotions<State>& known = {}) {
  options.validate();
  return detail::RoadmapBuild<AnyWorld<State, one_way>>(world, options, lazy, execution, known).run();
}

}  // namespace warren
