// SPDX-License-Identifier: BSD-3-Clause
// What is in a robot that files describe, line by line.
#pragma once

#include <vector>

#include "scenes/scene/arm_model.hpp"
#include "solve/answer/world_account.hpp"

namespace warren {

/// Its joints with limits and speeds, links, solids, pairs that are kept apart, and what is taken for granted.
std::vector<Fact> facts_of(const ArmModel& model);

}  // namespace warren
