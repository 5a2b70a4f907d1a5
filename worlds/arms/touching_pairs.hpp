// SPDX-License-Identifier: BSD-3-Clause
// Pairs of links that are no use to keep apart: nothing moves one against the other, or they touch whatever the arm
// does, as far as 1,000 states tell (MoveIt's assistant finds its pairs that way, too).
#pragma once

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"

namespace warren {

/// Takes both kinds from the model's pairs; `assumed` tells each of the second. A pair is a suspect until the first
/// state where it is apart: some ms in all. Throws InputError as ArmKinematics, Stopped.
void leave_out_touching(ArmModel& model, const Execution& execution = {});

}  // namespace warren
