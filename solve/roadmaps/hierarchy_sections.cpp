// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/hierarchy_sections.hpp"

#include <span>
#include <string_view>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

constexpr std::size_t arc_grain = std::size_t{1} << 16;

}  // namespace

Hierarchy read_hierarchy(const RoadmapFile& file, std::size_t vertex_count, const Execution& execution) {
  if (file.find("up.first") == nullptr) return {};
  const auto first = file.section<EdgeEnd>("up.first", execution);
  const auto to = file.section<VertexId>("up.to", execution);
  const auto middle = file.section<VertexId>("up.middle", execution);
  const auto length = file.section<double>("up.length", execution);
  if (middle.size() != to.size() || length.size() != to.size()) {
    throw InputError(file.name(), "its index contradicts itself; build it anew", "up.middle, up.length");
  }
  execution.reserve(first.size_bytes() + to.size() * sizeof(HierarchyArc));
  Hierarchy hierarchy{.first = {first.begin(), first.end()}, .arcs = {}};
  hierarchy.arcs.resize(to.size());
  for_chunks(to.size(), arc_grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) hierarchy.arcs[i] = {to[i], middle[i], length[i]};
  });
  check_hierarchy(hierarchy, vertex_count, file.name(), execution);
  return hierarchy;
}

HierarchySections::HierarchySections(const Hierarchy& hierarchy, const Execution& execution) : hierarchy_(hierarchy) {
  const std::size_t arcs = hierarchy.arcs.size();
  execution.reserve(arcs * sizeof(HierarchyArc));
  to_.resize(arcs);
  middle_.resize(arcs);
  length_.resize(arcs);
  for_chunks(arcs, arc_grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      to_[i] = hierarchy.arcs[i].to;
      middle_[i] = hierarchy.arcs[i].middle;
      length_[i] = hierarchy.arcs[i].length;
    }
  });
}

void HierarchySections::append_to(std::vector<RoadmapSection>& sections) const {
  if (hierarchy_.empty()) return;
  const auto add = [&]<class T>(std::string_view name, const RawVector<T>& numbers) {
    sections.push_back(roadmap_section(name, std::span<const T>(numbers), true));
  };
  add("up.first", hierarchy_.first);
  add("up.to", to_);
  add("up.middle", middle_);
  add("up.length", length_);
}

}  // namespace warren
