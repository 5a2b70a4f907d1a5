// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/hierarchy_route.hpp"

#include <array>
#include <limits>
#include <vector>

namespace warren {

SearchResult route_by_hierarchy(const Hierarchy& hierarchy, std::span<const Edge> ends, std::span<const double> lengths,
                                HierarchyScratch& scratch, const Execution& execution) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  const auto start = static_cast<VertexId>(hierarchy.vertex_count());
  std::array<std::vector<HierarchyEnd>, 2> joined;
  double direct = nowhere;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].from == start) {
      direct = lengths[i];
    } else {
      joined[ends[i].to - start].push_back({ends[i].from, lengths[i]});
    }
  }
  HierarchyQuery query(hierarchy, scratch, execution);
  SearchResult found;
  if (query.search(joined[0], joined[1], direct)) {
    found.path = query.path();
    found.path.insert(found.path.begin(), start);
    found.path.push_back(start + 1);
  } else if (direct < nowhere) {
    found.path = {start, start + 1};
  }
  found.status = found.path.empty() ? SearchStatus::exhausted : SearchStatus::found;
  found.expanded = query.settled();
  return found;
}

}  // namespace warren
