// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/start_distances.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "core/search/indexed_heap.hpp"
#include "core/search/search.hpp"

namespace warren::serve {
namespace {

/// The free edges, with the start as the last but one: a question from a place to itself links it, and hands them out.
PlannedRoadmap<Vec2> linked(const RoadmapQuery& query, const std::vector<double>& start, const Execution& execution) {
  const RoadmapParts parts = query.roadmap().arrays.parts();
  execution.reserve(parts.to.size_bytes() + (parts.first.size() * (sizeof(Vec2) + sizeof(EdgeEnd))));
  QuestionScratch scratch;
  ByProducts kept;
  const Answer answer = query.ask_within(start, start, {}, execution, scratch, &kept);
  if (answer.outcome == Outcome::stopped) throw Stopped(answer.stop_reason.value_or(StopReason::time));
  if (answer.outcome == Outcome::start_blocked) throw UsageError("from: the body does not fit there");
  if (kept.roadmap.states.size() != count_states(query.roadmap()) + 2) {
    throw UsageError("from: a roadmap of this kind does not say how the start is linked");
  }
  return std::move(kept.roadmap);
}

SearchState searched(const PlannedRoadmap<Vec2>& roadmap, const Execution& execution) {
  const std::size_t count = roadmap.states.size();
  const auto poll = [&] { execution.check(); };
  execution.reserve(count * (sizeof(double) + 2 * sizeof(VertexId) + sizeof(QueueEntry)));
  SearchState state;
  state.resize(count, poll);
  IndexedHeap<4> queue;
  queue.resize(count, poll);
  const auto next = [&](VertexId v, const auto& visit) {
    for (const VertexId w : roadmap.graph.neighbours(v)) visit(w, distance(roadmap.states[v], roadmap.states[w]));
  };
  best_first(
      static_cast<VertexId>(count - 2), no_vertex, next, [](VertexId) { return 0.0; }, queue, state,
      [&] { return execution.should_stop(); });
  execution.check();
  return state;
}

}  // namespace

StartDistances start_distances(const RoadmapQuery& query, const std::vector<double>& start,
                               const Execution& execution) {
  const PlannedRoadmap<Vec2> roadmap = linked(query, start, execution);
  const SearchState state = searched(roadmap, execution);
  constexpr VertexId polled = VertexId{1} << 16U;
  StartDistances found;
  execution.reserve(roadmap.states.size());
  found.inks.assign(roadmap.states.size() - 2, unreached_ink);
  for (VertexId v = 0; v < found.inks.size(); ++v) {
    if (v % polled == 0) execution.check();
    if (!state.reached(v)) continue;
    ++found.reached;
    found.farthest = std::max(found.farthest, state.g(v));
  }
  found.steps = Steps::up_to(found.farthest, found.farthest);
  for (VertexId v = 0; v < found.inks.size(); ++v) {
    if (v % polled == 0) execution.check();
    if (state.reached(v)) found.inks[v] = static_cast<std::uint8_t>(found.steps.of(state.g(v)));
  }
  return found;
}

}  // namespace warren::serve
