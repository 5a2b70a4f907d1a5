// SPDX-License-Identifier: BSD-3-Clause
// The arm of a Denavit-Hartenberg table as a model: its joints, a capsule between any two consecutive points of the
// chain that are apart, the tool.
#pragma once

#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Six variables always: those that the table lacks are 0 and have no joint. Capsules have the radius. self_collision:
/// no two may touch, but neighbours and those that what is between them keeps nearer than their radii and the
/// clearance. Throws InputError as SerialChain, for an arm without any link, and for lengths that are not from 0 to
/// 1e60.
ArmModel model_of(const DhTable& table, double radius, bool self_collision, double clearance = 0.0);

}  // namespace warren
