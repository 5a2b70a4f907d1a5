// SPDX-License-Identifier: BSD-3-Clause
#include "apps/python/kept_roadmap.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "solve/kept/export_roadmap.hpp"

namespace warren::python {
namespace {

/// Of what is wrong with a start or a goal its row; an option that is wrong has none.
[[noreturn]] void refuse_row(const UsageError& error, std::size_t start, std::size_t goal) {
  constexpr std::string_view of_start = "start: ";
  constexpr std::string_view of_goal = "goal: ";
  const std::string_view said = error.what();
  if (said.starts_with(of_start)) throw InputError(fmt::format("starts[{}]", start), said.substr(of_start.size()));
  if (said.starts_with(of_goal)) throw InputError(fmt::format("goals[{}]", goal), said.substr(of_goal.size()));
  throw error;
}

}  // namespace

const RoadmapQuery& KeptRoadmap::query(const Execution& execution) const {
  return query_.get(execution, [&] { return std::make_unique<RoadmapQuery>(roadmap_, execution, Questions::many); });
}

const RoadmapArrays& KeptRoadmap::arrays(const Execution& execution) const {
  if (roadmap_.lattice == nullptr) return roadmap_.arrays;
  return lattice_.get(
      execution, [&] { return std::make_unique<RoadmapArrays>(arrays_of(roadmap_.lattice->passages(), execution)); });
}

const RawVector<double>& KeptRoadmap::lengths(const Execution& execution) const {
  return lengths_.get(execution, [&] {
    constexpr std::size_t grain = 1024;
    const Graph& graph = arrays(execution).candidates;
    execution.reserve(graph.targets().size() * sizeof(double));
    auto lengths = std::make_unique<RawVector<double>>(graph.targets().size());
    const RoadmapQuery* asked = roadmap_.lattice == nullptr ? &query(execution) : nullptr;
    for_chunks(graph.vertex_count(), grain, execution, [&](Range r) {
      for (std::size_t v = r.first; v < r.last; ++v) {
        const auto from = static_cast<VertexId>(v);
        std::size_t end = graph.first_end(from);
        for (const VertexId to : graph.neighbours(from)) (*lengths)[end++] = length(from, to, asked);
      }
    });
    return lengths;
  });
}

/// Of an edge that leads both ways from its smaller vertex, as exports have it. `query`: nullptr for a lattice.
double KeptRoadmap::length(VertexId from, VertexId to, const RoadmapQuery* query) const {
  if (query == nullptr) return 1.0;
  const bool turned = !roadmap_.arrays.directed && to < from;
  return turned ? query->distance(to, from) : query->distance(from, to);
}

EdgeRows free_rows(const KeptRoadmap& kept, const Execution& execution) {
  constexpr std::size_t polled = 4096;
  const RoadmapArrays& arrays = kept.arrays(execution);
  const RoadmapParts parts = arrays.parts();
  const RoadmapQuery* asked = kept.roadmap().lattice == nullptr ? &kept.query(execution) : nullptr;
  execution.reserve(parts.first.size_bytes() + parts.to.size() * (sizeof(VertexId) + sizeof(double)));
  EdgeRows rows;
  rows.first.reserve(parts.first.size());
  rows.first.push_back(0);
  for (std::size_t v = 0; v < parts.vertex_count(); ++v) {
    if (v % polled == 0) execution.check();
    for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
      if (parts.state_of_end(end) != EdgeState::free) continue;
      rows.to.push_back(parts.to[end]);
      rows.lengths.push_back(kept.length(static_cast<VertexId>(v), parts.to[end], asked));
    }
    rows.first.push_back(static_cast<EdgeEnd>(rows.to.size()));
  }
  return rows;
}

void KeptRoadmap::learn(const Execution& execution) {
  if (roadmap_.lattice == nullptr) warren::learn(roadmap_, query(execution), execution);
}

void ask_lengths(const KeptRoadmap& kept, const NumberRows& starts, const NumberRows& goals, bool each_to_each,
                 const RoadmapSearchFields& how, const Execution& execution, double* lengths) {
  const RoadmapQuery& query = kept.query(execution);
  const std::size_t n = each_to_each ? starts.rows * goals.rows : std::max(starts.rows, goals.rows);
  Execution one_thread = execution.quiet();
  one_thread.threads = 1;
  const auto ask = [&](std::size_t i, QuestionScratch& scratch) {
    const std::size_t start = each_to_each ? i / goals.rows : starts.rows == 1 ? 0 : i;
    const std::size_t goal = each_to_each ? i % goals.rows : goals.rows == 1 ? 0 : i;
    try {
      const LengthAnswer answer = query.length_within(starts.row(start), goals.row(goal), how, one_thread, scratch);
      lengths[i] = answer.outcome == Outcome::solved ? answer.length : std::numeric_limits<double>::infinity();
    } catch (const UsageError& error) {
      refuse_row(error, start, goal);
    }
  };
  // A chunk a thread: each has a scratch as large as the roadmap.
  const std::size_t threads = thread_count(execution.threads);
  const std::size_t share = std::max<std::size_t>(1, (n + threads - 1) / threads);
  for_chunks(n, share, execution, [&](Range r) {
    QuestionScratch scratch;
    for (std::size_t i = r.first; i < r.last; ++i) {
      one_thread.check();
      ask(i, scratch);
    }
  });
}

}  // namespace warren::python
