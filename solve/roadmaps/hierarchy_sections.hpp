// SPDX-License-Identifier: BSD-3-Clause
// The index of a roadmap of states in its file: an array for each number of an arc, whatever the memory has.
#pragma once

#include <vector>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "planners/graph/hierarchy.hpp"
#include "roadmaps/file/roadmap_file.hpp"
#include "roadmaps/file/write_roadmap_file.hpp"

namespace warren {

/// Empty where the file has none. Throws InputError where it is not whole, and Stopped.
Hierarchy read_hierarchy(const RoadmapFile& file, std::size_t vertex_count, const Execution& execution);

/// Refers to the hierarchy; what is written lives as long as this: 16 bytes an arc.
class HierarchySections {
 public:
  /// Throws Stopped.
  HierarchySections(const Hierarchy& hierarchy, const Execution& execution);
  void append_to(std::vector<RoadmapSection>& sections) const;

 private:
  const Hierarchy& hierarchy_;
  RawVector<VertexId> to_;
  RawVector<VertexId> middle_;
  RawVector<double> length_;
};

}  // namespace warren
