// SPDX-License-Identifier: BSD-3-Clause
#include "planners/cells/cell_separation.hpp"

#include <vector>

#include "parallel/components.hpp"
#include "planners/cells/door_points.hpp"
#include "planners/roadmap/separation.hpp"

namespace warren {

Separation cell_separation(const CellDecomposition& cells, const Components& parts, Vec2 start, Vec2 goal,
                           const Execution& execution) {
  const auto start_vertex = static_cast<VertexId>(cells.cells.size());
  const VertexId goal_vertex = start_vertex + 1;
  const DoorPoints doors(cells, execution);
  const auto points_of = [&](VertexId vertex, Vec2 end) {
    std::vector<Vec2> points{end};
    for (std::uint32_t d = 0; d < cells.doors.size(); ++d) {
      const Door& door = cells.doors[d];
      if (!door.shut && parts.connected(door.left, vertex)) points.push_back(doors.middle(d));
    }
    return points;
  };
  Separation result = separation_between<2>(points_of(start_vertex, start), points_of(goal_vertex, goal), execution);
  result.start_size = component_size(parts, start_vertex, execution) - 1;
  result.goal_size = component_size(parts, goal_vertex, execution) - 1;
  return result;
}

}  // namespace warren
