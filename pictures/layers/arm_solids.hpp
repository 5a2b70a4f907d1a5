// SPDX-License-Identifier: BSD-3-Clause
// An arm and its obstacles as solids, seen in perspective.
#pragma once

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/layers/arm_path.hpp"
#include "pictures/model/solids.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// The obstacles alone, seen from the front, the right and above, in `box`. low, high: of all that is to be seen.
SolidView solids_of(const Scene& scene, const Box& box, const Vec3& low, const Vec3& high, const Execution& execution);

/// The arm at start and goal and, paler, between them; and the tool's way. radius: of the links.
void add_arm(SolidView& view, const ArmPath& path, double radius, const Execution& execution);

}  // namespace warren
