// SPDX-License-Identifier: BSD-3-Clause
// How answers of a polygon that may turn are verified, whichever planner found them.
#pragma once

#include <string_view>

#include "solve/answer/answer.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/kinds/question_of_pose.hpp"

namespace warren {

inline constexpr std::string_view turning_body = "a turning body";

/// Does the body stand free at the pose as an end, with its clearance? `judged`, here and below: of the scene, or
/// nullptr.
bool turning_stands_free(const Scene& scene, const PoseProblem& problem, const Se2& pose, const Execution& execution,
                         const ObstacleIndex* judged = nullptr);

/// Verifies the path and fills it into the answer with what is said of it. A leg of about half a turn, which could be
/// read either way, gets a pose in its middle. A path that fails is a bug: throws std::logic_error.
void judge_turning(const Scene& scene, const PoseProblem& problem, const Path<Se2>& path, const Execution& execution,
                   Answer& answer, const ObstacleIndex* judged = nullptr);

/// SolveKind::verify for it.
Verdict recheck_turning(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                        const Execution& execution);

}  // namespace warren
