// SPDX-License-Identifier: BSD-3-Clause
// Why a body does not fit where it shall start or end: what is in the way by the judge's word, how far it is to a place
// nearby where it fits, and what may have been meant. Costs one pass over the obstacles and some thousand poses among
// those nearby, where only a pocket far away is free up to 20,000 and a pass over a map's cells: for one question, not
// for studies.
#pragma once

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// Fills in answer.blocked where start or goal is blocked. What stops meanwhile leaves it as far as it has come.
void explain_blocked_end(const Scene& scene, Answer& answer, const Execution& execution);

/// The box in which reference points of bodies of the plane may be: map, bounds, or what the obstacles fill. Throws
/// Stopped.
Box room_of(const Scene& scene, const Execution& execution);

}  // namespace warren
