// SPDX-License-Identifier: BSD-3-Clause
#include "python/kept_roadmap.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "solve/roadmaps/export_of_roadmap.hpp"

namespace warren::python {
namespace {

std::vector<double> row(const NumberRows& rows, std::size_t i) {
  const double* first = rows.numbers + i * rows.columns;
  return {first, first + rows.columns};
}

}  // namespace

const RoadmapQuery& KeptRoadmap::query(const Execution& execution) const {
  return query_.get([&] { return std::make_unique<RoadmapQuery>(roadmap_, execution, Questions::many); });
}

const RoadmapArrays& KeptRoadmap::arrays(const Execution& execution) const {
  if (roadmap_.lattice == nullptr) return roadmap_.arrays;
  return lattice_.get(
      [&] { return std::make_unique<RoadmapArrays>(arrays_of(roadmap_.lattice->passages(), execution)); });
}

const RawVector<double>& KeptRoadmap::lengths(const Execution& execution) const {
  return lengths_.get([&] {
    constexpr std::size_t grain = 1024;
    const Graph& graph = arrays(execution).candidates;
    execution.reserve(graph.targets().size() * sizeof(double));
    auto lengths = std::make_unique<RawVector<double>>(graph.targets().size());
    const RoadmapQuery* asked = roadmap_.lattice == nullptr ? &query(execution) : nullptr;
    for_chunks(graph.vertex_count(), grain, execution, [&](Range r) {
      for (std::size_t v = r.first; v < r.last; ++v) {
        const auto from = static_cast<VertexId>(v);
        std::size_t end = graph.first_end(from);
        for (const VertexId to : graph.neighbours(from)) {
          // Of an edge that leads both ways, from its smaller vertex: as exports have it.
          const bool turned = !roadmap_.arrays.directed && to < from;
          (*lengths)[end++] = asked == nullptr ? 1.0 : turned ? asked->distance(to, from) : asked->distance(from, to);
        }
      }
    });
    return lengths;
  });
}

void KeptRoadmap::learn(const Execution& execution) {
  if (roadmap_.lattice == nullptr) warren::learn(roadmap_, query(execution), execution);
}

void ask_lengths(const KeptRoadmap& kept, const NumberRows& starts, const NumberRows& goals, bool each_to_each,
                 const RoadmapSearchFields& how, const Execution& execution, double* lengths) {
  const RoadmapQuery& query = kept.query(execution);
  const std::size_t n = each_to_each ? starts.rows * goals.rows : std::max(starts.rows, goals.rows);
  Execution one_thread = execution;
  one_thread.threads = 1;
  one_thread.progress = nullptr;
  const auto ask = [&](std::size_t i, QuestionScratch& scratch) {
    const std::size_t start = each_to_each ? i / goals.rows : starts.rows == 1 ? 0 : i;
    const std::size_t goal = each_to_each ? i % goals.rows : goals.rows == 1 ? 0 : i;
    try {
      const LengthAnswer answer = query.length_within(row(starts, start), row(goals, goal), how, one_thread, scratch);
      lengths[i] = answer.outcome == Outcome::solved ? answer.length : std::numeric_limits<double>::infinity();
    } catch (const UsageError& error) {
      throw InputError(fmt::format("starts[{}], goals[{}]", start, goal), error.what());
    }
  };
  // A chunk a thread: each has a scratch as large as the roadmap.
  const std::size_t share =
      std::max<std::size_t>(1, (n + thread_count(execution.threads) - 1) / thread_count(execution.threads));
  for_chunks(n, share, execution, [&](Range r) {
    QuestionScratch scratch;
    for (std::size_t i = r.first; i < r.last; ++i) {
      one_thread.check();
      ask(i, scratch);
    }
  });
}

}  // namespace warren::python
