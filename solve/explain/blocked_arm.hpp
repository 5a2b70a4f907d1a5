// SPDX-License-Identifier: BSD-3-Clause
// Why an arm does not fit where it shall start or end: the limit, solid or link in the way by the judge's word, how
// deep a link stands in it, and a free posture nearby; of a place of the tool, a place nearby that some posture
// reaches.
#pragma once

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// Fills in answer.blocked; the answer's outcome is about an end. Some ten thousand postures, each judged by itself.
/// Throws Stopped.
void explain_blocked_arm(const Scene& scene, Answer& answer, const Execution& execution);

/// How far the straight segment from a to b must go to be out of a closed box; 0 or less: it is.
double depth_in_box(const Vec3& a, const Vec3& b, const SolidBox& box);

}  // namespace warren
