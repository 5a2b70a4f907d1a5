// SPDX-License-Identifier: BSD-3-Clause
// Lower bounds, proved: no path of a problem is shorter, whoever plans it. What is proved of which body, why, and what
// rounding is allowed for: docs/algorithms.md, "Lower bounds"; beside it 1e-12 for lengths of car's curves and 1e-9 for
// the reach of an arm, which have longer formulae. Beyond largest_bounded_corners, and where time or memory end, the
// simple bound is left.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// What is bounded: the length that answers tell, or what planners that get better tell as cost, the body's metric:
/// they differ for polygons that turn alone (worlds/poses/se2_world.hpp, with the usual weight of a turn).
enum class BoundOf : std::uint8_t { length, metric };

/// simple: costs nothing. exact: milliseconds, and seconds where there are many corners.
enum class BoundEffort : std::uint8_t { simple, exact };

/// Above, shortest ways take too long for what they tell.
inline constexpr std::size_t largest_bounded_corners = 100'000;

/// What no path of the problem can be shorter than; >= 0. `scene`: as it is planned in, with a map's borders as walls
/// or without. Never throws Stopped. Throws as table_of() where an arm's table can't be read.
double proved_bound(const Scene& scene, const Problem& problem, BoundOf of, BoundEffort effort,
                    const Execution& execution);

/// The bound of a verified answer, and whether that proves its path the shortest. One that has a bound, or was found
/// to be optimal, keeps that. None is told of paths through way-points, nor where the cost is in units of the planner's
/// own.
void tell_bound(Answer& answer, const Scene& scene, const SolveOptions& options, const Execution& execution);

/// Where a bound, a gap or a certificate is asked of a verified answer of grid on a map: the best bound of all paths
/// that is found until the gap is reached; of a certificate that is asked for, what it proves. `scene`: as it is
/// planned in. Stops leave the bound that there is.
void prove_on_map(Answer& answer, const Scene& scene, const SolveOptions& options, ByProducts* keep,
                  const Execution& execution);

}  // namespace warren
