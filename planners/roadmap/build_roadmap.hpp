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
#include <utility>
#include <vector>

#include "core/base/solution.hpp"
#include "parallel/assemble_graph.hpp"
#include "parallel/components.hpp"
#include "planners/roadmap/check_edges.hpp"
#include "planners/roadmap/connection.hpp"
#include "planners/roadmap/milestones.hpp"
#include "planners/roadmap/one_way_candidates.hpp"
#include "planners/roadmap/roadmap_growth.hpp"
#include "planners/roadmap/roadmap_options.hpp"
#include "planners/roadmap/roadmap_search.hpp"

namespace warren {

/// Motions that can be driven both ways make undirected roadmaps.
template <World W>
constexpr EdgeDirections edge_directions() {
  if constexpr (requires { requires W::one_way; }) return EdgeDirections::one;
  return EdgeDirections::both;
}

template <class State>
struct BuiltRoadmap {
  RawVector<State> states;               ///< milestones in tile order
  Graph candidates;                      ///< all edges; where edges lead one way: w in the row of v, from v to w
  RawVector<std::uint64_t> edge_states;  ///< core/search/edge_states.hpp
  std::uint64_t samples = 0;             ///< drawn in the last round
  ConnectionRule rule;                   ///< by which the milestones were joined, and start and goal will be
  Counters counters;
  StageTimes seconds;
};

RawVector<std::uint64_t> unchecked_edges(const Graph& candidates);
/// The graph of edges that lead one way: each stands in the row of its begin alone. The edges come row by row.
Graph one_way_graph(std::size_t vertex_count, const EdgeParts& edges, const Execution& execution);
/// The edges of a graph that are free.
Graph free_part(const Graph& candidates, std::span<const std::uint64_t> edge_states, const Execution& execution);

/// The same with the lengths of the edges.
Graph free_part_with_lengths(const Graph& candidates, std::span<const std::uint64_t> edge_states,
                             const VertexDistance& length, const Execution& execution);

/// Of a graph whose edges lead from a row to its targets: what `from` reaches has its label, and what reaches `to` has
/// that of `to`.
Components reached_and_reaching(const Graph& graph, VertexId from, VertexId to, const Execution& execution);

namespace detail {

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

  void round(std::uint64_t samples, bool check);
  void find_candidates(const StateIndex<W>& index);
  RawVector<Edge> attached(const State& state, VertexId vertex) const;
  std::vector<VertexId> joined_probes();

  const W& world_;
  const RoadmapOptions& options_;
  bool lazy_;
  const Execution& execution_;
  const KnownMotions<State>& known_;
  BuiltRoadmap<State> built_;
  StateIndex<W> index_;
};

template <World W>
void RoadmapBuild<W>::round(std::uint64_t samples, bool check) {
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
    index_ = index_of_states(world_, std::span<const State>(built_.states), execution_);
  }
  const StageTimer timer(execution_, "connect", built_.seconds.connect, built_.states.size());
  built_.rule = connection_rule_for(world_, options_, samples);
  find_candidates(index_);
  const std::span<const State> states(built_.states);
  if (check) {
    built_.edge_states =
        check_edges(world_, states, built_.candidates, edge_directions<W>(), execution_, built_.counters, known_);
  } else {
    built_.edge_states = unchecked_edges(built_.candidates);
  }
}

/// The candidate edges from each milestone.
template <World W>
EdgeParts one_way_edges(const W& world, std::span<const typename W::State> states, const StateIndex<W>& index,
                        const ConnectionRule& rule, const Execution& execution) {
  constexpr std::size_t grain = 64;
  EdgeParts parts(chunk_count(states.size(), grain));
  for_chunks(states.size(), grain, execution, [&](Range r) {
    std::vector<Neighbour> near;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto v = static_cast<VertexId>(i);
      for (const OneWayCandidate& c :
           one_way_candidates<W>(world, states, index, rule, states[v], v, Heading::out, near)) {
        parts[r.first / grain].push_back({v, c.to});
      }
    }
  });
  return parts;
}

template <World W>
void RoadmapBuild<W>::find_candidates(const StateIndex<W>& index) {
  const std::span<const State> states(built_.states);
  if constexpr (edge_directions<W>() == EdgeDirections::one) {
    const EdgeParts parts = one_way_edges(world_, states, index, built_.rule, execution_);
    built_.candidates = one_way_graph(states.size(), parts, execution_);
    built_.counters.neighbour_queries += states.size();
  } else {
    const EdgeParts parts = candidate_edges(world_, states, index, built_.rule, execution_, built_.counters);
    built_.candidates = assemble_graph(states.size(), parts, execution_);
  }
}

template <World W>
RawVector<Edge> RoadmapBuild<W>::attached(const State& state, VertexId vertex) const {
  Counters counters;
  const std::span<const State> states(built_.states);
  if constexpr (edge_directions<W>() == EdgeDirections::both) {
    return attach(world_, states, index_, built_.rule, state, vertex, counters);
  } else {
    auto query = world_.make_query();
    std::vector<Neighbour> near;
    RawVector<Edge> edges;
    for (const OneWayCandidate& c :
         one_way_candidates<W>(world_, states, index_, built_.rule, state, no_vertex, Heading::out, near)) {
      if (world_.is_free_motion(state, states[c.to], query)) edges.push_back({c.to, vertex});
    }
    return edges;
  }
}

/// For each probe the first one that it is joined with, whatever the direction: the same partition as before says that
/// the last round has joined nothing more.
template <World W>
std::vector<VertexId> RoadmapBuild<W>::joined_probes() {
  constexpr std::uint64_t probe_stream = 0x70726f6265;  // apart from the seeds that people choose
  const StageTimer timer(execution_, "probe", built_.seconds.search, probes);
  const Graph free = free_part(built_.candidates, built_.edge_states, execution_);
  const auto n = static_cast<VertexId>(built_.states.size());
  std::vector<RawVector<Edge>> edges(probes + 1);
  execution_.reserve(free.targets().size() * sizeof(Edge));
  edges[0].reserve(free.targets().size());
  for (VertexId v = 0; v < n; ++v) {
    if (v % (1U << 14) == 0) execution_.check();
    for (const VertexId w : free.neighbours(v)) edges[0].push_back({v, w});
  }
  for_chunks(probes, 1, execution_, [&](Range r) {
    const State state = uniform_state(world_, options_.seed ^ probe_stream, r.first);
    auto own = world_.make_query();
    if (world_.is_free(state, own)) edges[r.first + 1] = attached(state, n + static_cast<VertexId>(r.first));
  });
  const Components parts = components(assemble_graph(n + probes, edges, execution_), execution_);
  std::vector<VertexId> first_with(n + probes, no_vertex);
  std::vector<VertexId> joined;
  for (std::size_t i = 0; i < probes; ++i) {
    VertexId& first = first_with[parts.label[n + i]];
    if (first == no_vertex) first = static_cast<VertexId>(i);
    joined.push_back(edges[i + 1].empty() ? no_vertex : first);
  }
  return joined;
}

}  // namespace detail

/// Throws Stopped, and InputError for options out of range. `lazy`: no edge is asked about where the samples are said.
/// `known`: motions that need no asking.
template <World W>
BuiltRoadmap<typename W::State> build_roadmap(const W& world, const RoadmapOptions& options, bool lazy,
                                              const Execution& execution,
                                              const KnownMotions<typename W::State>& known = {}) {
  options.validate();
  return detail::RoadmapBuild<W>(world, options, lazy, execution, known).run();
}

}  // namespace warren
