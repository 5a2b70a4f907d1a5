// SPDX-License-Identifier: BSD-3-Clause
// The body at places along a kept path, as far as they can be seen: what the page draws as its sweep.
#pragma once

#include <cstddef>
#include <vector>

#include "parallel/execution.hpp"
#include "serve/api/kept_curve.hpp"
#include "serve/api/path_view.hpp"
#include "solve/answer/answer.hpp"
#include "solve/paths/path_legs.hpp"

namespace warren::serve {

/// No more are told at once; where there were more, they are farther apart.
inline constexpr std::size_t most_swept_bodies = 1000;

struct SweptBodies {
  double apart = 0.0;  ///< by PathLegs::length(), half the body's reach at least
  std::vector<PathState> places;
};

/// The farthest point of a body of the plane from its reference point; 0 of a point.
double reach_of(const RobotSpec& robot);

/// Those that may touch the view's box, in the path's order, start and goal among them. way: body and states, which may
/// be none: then the curve is the path. Of a curve of several blocks, only those near the box are looked at. Throws
/// UsageError where the body is a point, Stopped.
SweptBodies swept_bodies(const Answer& way, const KeptCurve& curve, const PathView& view, const Execution& execution);

}  // namespace warren::serve
