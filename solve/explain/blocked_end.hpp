// SPDX-License-Identifier: BSD-3-Clause
// Why a body does not fit where it shall start or end: what is in the way by the judge's word, how far it is to a place
// nearby where it fits, and what may have been meant. Costs one pass over the obstacles and some thousand poses among
// those nearby, where only a pocket far away is free up to 20,000 and a pass over a map's cells: for one question, not
// for studies.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

/// Fills in answer.blocked where start or goal is blocked. What stops meanwhile leaves it as far as it has come. `own`:
/// of a scene whose map has more cells closed, by areas and masks, the map without these.
void explain_blocked_end(const Scene& scene, Answer& answer, const Execution& execution,
                         const OccupancyMap* own = nullptr);

/// How far the straight segment from a to b must go to be out of a closed box; 0 or less: it is.
double depth_in_box(const Vec3& a, const Vec3& b, const SolidBox& box);

/// What the judge meets at a place, with the margin of ends; nothing where the body fits.
using MetAt = std::function<std::optional<Violation>(Vec2)>;

/// Why a point or disc does not fit at a place of a maze whose walls are looked up cell by cell: as
/// explain_blocked_end() says it where walls are held, by a few looks, for in the middle of each cell the body fits.
/// The problem's reach is below half a cell.
void explain_blocked_cell(const WallProblem& problem, MazeHint maze, Answer& answer, const MetAt& met_at);

/// The part of a scene that a judge needs for what is near a path, so that asking many times costs little: the scene
/// without the walls and polygons whose boxes are farther than `reach` from those of all legs. Those that the
/// box of all obstacles rests on stay, since it confines bodies where there are no bounds; maps and solids stay whole.
/// `path`: one point or more. One pass over the obstacles, about log(legs) each. Throws Stopped.
Scene obstacles_near(const Scene& scene, std::span<const Vec2> path, double reach, const Execution& execution);

}  // namespace warren
