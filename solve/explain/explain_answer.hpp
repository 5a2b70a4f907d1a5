// SPDX-License-Identifier: BSD-3-Clause
// What --explain tells: the components of the roadmap that gave the answer, the narrowest place of its path by the
// judge's word, and what would likely help where there is none. Costs a pass over the roadmap, one over the obstacles,
// and verifications of ever shorter parts of the path among what is near them: about three times what the judge takes.
#pragma once

#include <functional>
#include <optional>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/explain/hints.hpp"

namespace warren {

/// Fills in answer.explained, hints first: what stops it leaves the rest out. `made`: what solve() and
/// make_by_products() have kept. Throws Stopped.
void explain_answer(const Scene& scene, const AskedWith& asked, Answer& answer, const ByProducts& made,
                    const Execution& execution);

/// The same of an answer that was stopped before its world was read.
void explain_stop(Answer& answer);

/// Lets `explain` do so; what stops it, a limit or memory, leaves the answer as it is, and the explanation says which.
void explain_in_time(Answer& answer, const std::function<void()>& explain);

/// Where the body has least room along a verified path of this length and clearance; nothing where it touches, and of
/// paths of one state. Throws Stopped.
std::optional<NarrowPlace> narrowest_place(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                                           double min_clearance, const Execution& execution);

}  // namespace warren
