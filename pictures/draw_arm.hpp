// SPDX-License-Identifier: BSD-3-Clause
// An arm's path in a picture: three orthogonal projections side by side (from above, from the front, from the side)
// with the obstacles, the links' capsules at intervals along the path, and the tool's trace.
#pragma once

#include <span>

#include "pictures/picture.hpp"
#include "solve/question/question_of_arm.hpp"
#include "solve/question/read_answer_io.hpp"

namespace warren {

/// A drawing that is shown instead of the world. An empty path shows the arm at its start.
Drawing arm_drawing(const Scene& scene, const ArmProblem& problem, std::span<const JointState> path);

/// The same for the path of an answer, which may be none. Throws InputError for states that are no arm's.
Drawing recorded_arm_drawing(const Scene& scene, const RecordedAnswer& answer, const Execution& execution);

}  // namespace warren
