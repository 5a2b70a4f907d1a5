// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

class HierarchyCheck {
 public:
  HierarchyCheck(const Hierarchy& hierarchy, const std::string& where) : all_(hierarchy), where_(where) {}

  void sizes(std::size_t vertex_count) const {
    require(all_.first.size() == vertex_count + 1 && all_.first[0] == 0, "up.first");
    require(all_.first.back() == all_.arcs.size() && std::is_sorted(all_.first.begin(), all_.first.end()), "up.first");
  }
  void heads(VertexId v) const {
    VertexId least = 0;
    for (const HierarchyArc& arc : all_.row(v)) {
      require(arc.to != v && arc.to >= least && arc.to < all_.vertex_count(), "up.to");
      require(std::isfinite(arc.length) && !std::signbit(arc.length), "up.length");
      least = arc.to + 1;
    }
  }
  /// After all heads.
  void shortcuts(VertexId v) const {
    for (const HierarchyArc& arc : all_.row(v)) {
      if (arc.middle == no_vertex) continue;
      require(arc.middle < all_.vertex_count() && has(arc.middle, v) && has(arc.middle, arc.to), "up.middle");
    }
  }

 private:
  bool has(VertexId low, VertexId high) const { return all_.arc_to(low, high) < all_.arcs.size(); }
  void require(bool holds, std::string_view array) const {
    if (!holds) throw InputError(where_, "its index contradicts itself; build it anew", array);
  }

  const Hierarchy& all_;
  const std::string& where_;
};

}  // namespace

std::size_t Hierarchy::arc_to(VertexId low, VertexId high) const {
  constexpr std::size_t short_row = 16;  // counted without a branch an arc
  const std::span<const HierarchyArc> arcs_up = row(low);
  std::size_t before = 0;
  if (arcs_up.size() <= short_row) {
    for (const HierarchyArc& arc : arcs_up) before += static_cast<std::size_t>(arc.to < high);
  } else {
    const auto leads_below = [](const HierarchyArc& arc, VertexId other) { return arc.to < other; };
    const auto found = std::lower_bound(arcs_up.begin(), arcs_up.end(), high, leads_below);
    before = static_cast<std::size_t>(found - arcs_up.begin());
  }
  return before < arcs_up.size() && arcs_up[before].to == high ? first[low] + before : arcs.size();
}

void check_hierarchy(const Hierarchy& hierarchy, std::size_t vertex_count, const std::string& where,
                     const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const HierarchyCheck check(hierarchy, where);
  check.sizes(vertex_count);
  for_chunks(vertex_count, grain, execution, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) check.heads(static_cast<VertexId>(v));
  });
  for_chunks(vertex_count, grain, execution, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) check.shortcuts(static_cast<VertexId>(v));
  });
}

}  // namespace warren
