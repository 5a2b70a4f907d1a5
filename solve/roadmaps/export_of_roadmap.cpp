// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/export_of_roadmap.hpp"

#include "core/base/error.hpp"
#include "solve/roadmaps/roadmap_query.hpp"

namespace warren {

ExportAccount export_of_roadmap(const Roadmap& roadmap, const std::string& path, const ExportOptions& options,
                                const Execution& execution) {
  if (roadmap.lattice != nullptr) {
    throw UsageError("this roadmap is held as an index, without states and edges; build it with @index none");
  }
  const RoadmapQuery query(roadmap, execution, Questions::one);
  const auto length = [&](VertexId v, VertexId w) { return query.distance(v, w); };
  return export_roadmap(path, roadmap.arrays.parts(), VertexDistance(length), options, execution);
}

}  // namespace warren
