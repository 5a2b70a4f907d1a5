// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <span>
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
    require(all_.first.back() == all_.to.size() && std::is_sorted(all_.first.begin(), all_.first.end()), "up.first");
    require(all_.middle.size() == all_.to.size(), "up.middle");
    require(all_.length.size() == all_.to.size(), "up.length");
  }
  void heads(VertexId v) const {
    for (EdgeEnd arc = all_.first[v]; arc < all_.first[v + 1]; ++arc) {
      const bool ascends = arc == all_.first[v] || all_.to[arc - 1] < all_.to[arc];
      require(all_.to[arc] != v && all_.to[arc] < all_.vertex_count() && ascends, "up.to");
      require(std::isfinite(all_.length[arc]) && !std::signbit(all_.length[arc]), "up.length");
    }
  }
  /// After all heads.
  void shortcuts(VertexId v) const {
    for (EdgeEnd arc = all_.first[v]; arc < all_.first[v + 1]; ++arc) {
      const VertexId middle = all_.middle[arc];
      if (middle == no_vertex) continue;
      require(middle < all_.vertex_count() && has(middle, v) && has(middle, all_.to[arc]), "up.middle");
    }
  }

 private:
  bool has(VertexId low, VertexId high) const { return all_.arc_to(low, high) < all_.to.size(); }
  void require(bool holds, std::string_view array) const {
    if (!holds) throw InputError(where_, "its index contradicts itself; build it anew", array);
  }

  const Hierarchy& all_;
  const std::string& where_;
};

}  // namespace

std::size_t Hierarchy::arc_to(VertexId low, VertexId high) const {
  constexpr std::size_t short_row = 16;  // counted without a branch an arc
  const std::span<const VertexId> row(to.data() + first[low], to.data() + first[low + 1]);
  std::size_t before = 0;
  if (row.size() <= short_row) {
    for (const VertexId other : row) before += static_cast<std::size_t>(other < high);
  } else {
    before = static_cast<std::size_t>(std::lower_bound(row.begin(), row.end(), high) - row.begin());
  }
  return before < row.size() && row[before] == high ? first[low] + before : to.size();
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
