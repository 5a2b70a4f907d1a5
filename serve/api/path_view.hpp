// SPDX-License-Identifier: BSD-3-Clause
// A path as it can be seen: its pieces in a box, without points that lie in the same pixel as the one before. Of a path
// of millions of points that is what a screen shows of it.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/base/path.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "serve/api/kept_curve.hpp"
#include "solve/answer/answer.hpp"

namespace warren::serve {

/// The curve of a car's reference point as straight pieces: arcs as chords that turn by at most five degrees. Throws
/// Stopped.
Path<Vec2> curve_of(const Answer& answer, const Execution& execution);

struct PathView {
  Box box = {};        ///< legs that don't meet it are left out
  double pixel = 0.0;  ///< points nearer than that to the last one that was kept are, too; 0: none
  std::size_t most_points = std::numeric_limits<std::size_t>::max();  ///< of all that are left
};

/// Chains of at least two points, in the path's order; a path of one point is one chain of it. The ends of the path and
/// of each chain are kept, and the last point of each block. Memory: of those that are left, and of 64 blocks; the rest
/// of a path that has too many is not looked at. Throws HttpError for more than view.most_points, Stopped.
std::vector<std::vector<Vec2>> seen_of(const KeptCurve& curve, const PathView& view, const Execution& execution);

}  // namespace warren::serve
