// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/export_of_roadmap.hpp"

#include "solve/roadmaps/roadmap_query.hpp"

namespace warren {

ExportAccount export_of_roadmap(const Roadmap& roadmap, const std::string& path, const ExportOptions& options,
                                const Execution& execution) {
  const RoadmapQuery query(roadmap, execution);
  const auto length = [&](VertexId v, VertexId w) { return query.distance(v, w); };
  return export_roadmap(path, roadmap.arrays.parts(), VertexDistance(length), options, execution);
}

}  // namespace warren
