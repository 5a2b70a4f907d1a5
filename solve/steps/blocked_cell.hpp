// SPDX-License-Identifier: BSD-3-Clause
// Why a point or disc does not fit at a place of a maze whose walls are looked up cell by cell: as
// explain_blocked_end() says it where walls are held, by a few looks, for in the middle of each cell the body fits.
#pragma once

#include <functional>
#include <optional>

#include "core/base/types.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

/// What the judge meets at a place, with the margin of ends; nothing where the body fits.
using MetAt = std::function<std::optional<Violation>(Vec2)>;

/// Fills in answer.blocked where an end is blocked. The problem's reach is below half a cell.
void explain_blocked_cell(const WallProblem& problem, MazeHint maze, Answer& answer, const MetAt& met_at);

}  // namespace warren
