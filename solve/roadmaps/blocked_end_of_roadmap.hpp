// SPDX-License-Identifier: BSD-3-Clause
// Why a body does not fit where it shall start or end, in the world of a roadmap: where that is a large maze whose
// walls can be looked up, they are not made for it.
#pragma once

#include "parallel/execution.hpp"
#include "solve/answer/answer.hpp"
#include "solve/roadmaps/roadmap.hpp"

namespace warren {

/// As explain_blocked_end() of a scene. Throws InputError for a world that is not what its file promises.
void explain_blocked_end(const Roadmap& roadmap, Answer& answer, const Execution& execution);

}  // namespace warren
