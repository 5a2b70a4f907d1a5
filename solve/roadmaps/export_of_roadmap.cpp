// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/export_of_roadmap.hpp"

#include <algorithm>
#include <utility>

#include "planners/graph/roadmap_arrays.hpp"
#include "planners/roadmap/milestones.hpp"
#include "solve/roadmaps/roadmap_query.hpp"

namespace warren {

RoadmapArrays arrays_of(const LatticePassages& passages, const Execution& execution) {
  constexpr std::size_t polled = std::size_t{1} << 16;
  constexpr std::size_t most_ends = 4;
  const std::uint64_t cells = passages.cell_count();
  execution.reserve(cells * (2 * sizeof(double) + sizeof(EdgeEnd) + (most_ends + 1) * sizeof(VertexId)));
  RoadmapArrays arrays;
  arrays.states.reserve(2 * cells);
  RawVector<EdgeEnd> offsets;
  offsets.reserve(cells + 1);
  RawVector<VertexId> targets;
  for (std::uint64_t i = 0; i < cells; ++i) {
    if (i % polled == 0) execution.check();
    const Vec2 p = lattice_point(passages.size(), i);
    arrays.states.insert(arrays.states.end(), {p.x, p.y});
    offsets.push_back(static_cast<EdgeEnd>(targets.size()));
    passages.for_each_neighbour(static_cast<CellId>(i), [&](CellId to) { targets.push_back(to); });
    std::sort(targets.begin() + offsets.back(), targets.end());
  }
  offsets.push_back(static_cast<EdgeEnd>(targets.size()));
  arrays.edge_states.assign(edge_state_words(targets.size()), 0);
  for (std::size_t end = 0; end < targets.size(); ++end) {
    if (end % polled == 0) execution.check();
    set_edge_state(arrays.edge_states, end, EdgeState::free);
  }
  arrays.candidates = Graph(std::move(offsets), std::move(targets));
  arrays.component = free_components(arrays.parts(), execution);
  return arrays;
}

ExportAccount export_of_roadmap(const Roadmap& roadmap, const std::string& path, const ExportOptions& options,
                                const Execution& execution) {
  if (roadmap.lattice != nullptr) {
    const RoadmapArrays arrays = arrays_of(roadmap.lattice->passages(), execution);
    const auto one_step = [](VertexId, VertexId) { return 1.0; };
    ExportAccount account = export_roadmap(path, arrays.parts(), VertexDistance(one_step), options, execution);
    account.blocked_left_out = count_edges(roadmap, execution).blocked;
    return account;
  }
  const RoadmapQuery query(roadmap, execution, Questions::one);
  const auto length = [&](VertexId v, VertexId w) { return query.distance(v, w); };
  return export_roadmap(path, roadmap.arrays.parts(), VertexDistance(length), options, execution);
}

}  // namespace warren
