// SPDX-License-Identifier: BSD-3-Clause
// An arm's path in a picture: three orthogonal projections side by side (from above, from the front, from the side)
// with the obstacles, the links' outlines at intervals along the path, and the tool's trace; beside them the same in
// perspective.
#pragma once

#include <span>
#include <vector>

#include "core/run/execution.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Edges between places of the tool, in one colour.
struct ToolLines {
  std::string id;     ///< the layer's
  std::string label;  ///< in the legend
  Rgb color;
  double width;  ///< as widths say
  std::vector<Edge> edges;
};

/// A picture with a stage, without words. A path of one state shows the arm as it stands; none is empty. Throws
/// Stopped.
Picture arm_views(const Scene& scene, const ArmModel& model, std::span<const JointState> path,
                  const Execution& execution);

/// The same of the arm as it stands at `start`, the tool's places at `states` and lines between these.
Picture arm_roadmap_views(const Scene& scene, const ArmModel& model, const JointState& start,
                          std::span<const JointState> states, std::span<const ToolLines> lines,
                          const Execution& execution);

}  // namespace warren
