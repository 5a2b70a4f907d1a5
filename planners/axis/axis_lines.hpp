// SPDX-License-Identifier: BSD-3-Clause
// A medial axis as straight lines, for those who know no curves: what of it is wide enough for a clearance, its
// vertices and between them the corners of its curves' polylines (AxisCurve::append_polyline), which keep the curves'
// clearance and are 1e-4 longer. O(edges log edges).
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/search/graph.hpp"
#include "planners/axis/medial_axis_planner.hpp"

namespace warren {

struct StraightLines {
  std::vector<Vec2> points;
  std::vector<Edge> edges;  ///< ascending, each once, from < to
};

/// `clearance` >= 0. Left out is what rounding may keep from having it. Throws Stopped.
StraightLines axis_lines(const AxisRoadmap& roadmap, double clearance, const Execution& execution);

}  // namespace warren
