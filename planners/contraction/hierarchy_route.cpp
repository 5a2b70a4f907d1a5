// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/hierarchy_route.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace warren {
namespace {

const HierarchyEnd* end_at(const std::vector<HierarchyEnd>& ends, VertexId vertex) {
  const auto found = std::find_if(ends.begin(), ends.end(), [&](const HierarchyEnd& e) { return e.vertex == vertex; });
  return found == ends.end() ? nullptr : &*found;
}

/// Where an end stands on a vertex, is the next one joined to it, too? Then a search goes there at once.
bool is_detour(const std::vector<HierarchyEnd>& ends, VertexId vertex, VertexId next) {
  const HierarchyEnd* first = end_at(ends, vertex);
  return first != nullptr && first->length == 0.0 && end_at(ends, next) != nullptr;
}

}  // namespace

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
    const RawVector<VertexId> way = query.path();
    std::size_t first = 0;
    std::size_t last = way.size() - 1;
    if (first < last && is_detour(joined[0], way[first], way[first + 1])) ++first;
    if (first < last && is_detour(joined[1], way[last], way[last - 1])) --last;
    found.path.reserve(way.size() + 2);
    found.path.push_back(start);
    found.path.insert(found.path.end(), way.begin() + static_cast<std::ptrdiff_t>(first),
                      way.begin() + static_cast<std::ptrdiff_t>(last + 1));
    found.path.push_back(start + 1);
  } else if (direct < nowhere) {
    found.path = {start, start + 1};
  }
  found.status = found.path.empty() ? SearchStatus::exhausted : SearchStatus::found;
  found.expanded = query.settled();
  return found;
}

}  // namespace warren
