// SPDX-License-Identifier: BSD-3-Clause
#include "apps/python/kept_roadmap.hpp"

#include "parallel/chunks.hpp"
#include "solve/kept/export_roadmap.hpp"

namespace warren::python {

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

void KeptRoadmap::learn(const Execution& execution) {
  if (roadmap_.lattice == nullptr) warren::learn(roadmap_, query(execution), execution);
}

}  // namespace warren::python
