// SPDX-License-Identifier: BSD-3-Clause
// The arm of a Denavit-Hartenberg table as a model: its joints, a capsule between any two consecutive points of the
// chain that are apart, the tool. And of any model the pairs of links that are no use to keep apart: nothing moves one
// against the other, or they touch whatever the arm does, as far as 1,000 states tell (MoveIt's assistant finds its
// pairs that way, too).
#pragma once

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Six variables always: those that the table lacks are 0 and have no joint. Capsules have the radius. self_collision:
/// no two may touch, but neighbours and those that what is between them keeps nearer than their radii and the
/// clearance. Throws InputError as SerialChain, for an arm without any link, and for lengths that are not from 0 to
/// 1e60.
ArmModel model_of(const DhTable& table, double radius, bool self_collision, double clearance = 0.0);

/// Takes both kinds from the model's pairs; `assumed` tells each of the second. A pair is a suspect until the first
/// state where it is apart: some ms in all. Throws InputError as ArmKinematics, Stopped.
void leave_out_touching(ArmModel& model, const Execution& execution = {});

}  // namespace warren
