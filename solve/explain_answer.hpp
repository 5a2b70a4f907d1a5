// SPDX-License-Identifier: BSD-3-Clause
// What --explain tells: the components of the roadmap that gave the answer, the narrowest place of its path by the
// judge's word, and what would likely help where there is none. Costs a pass over the roadmap, one over the obstacles,
// and verifications of ever shorter parts of the path among what is near them: about three times what the judge takes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// How the answer was asked for.
struct AskedWith {
  const SolveOptions& options;  ///< of a kept roadmap: those that it was built with
  std::uint64_t samples = 0;    ///< drawn in the last round; 0: as the answer says
  bool is_kept = false;         ///< of a kept roadmap: another one takes `warren build`
};

/// What would likely help where there is no path, or where more turns may better it: options that this world, body and
/// planner take, with numbers, so that they can be tried as they stand, the likeliest first. O(1) but for the world's
/// box.
std::vector<Hint> hints_for(const Scene& scene, const AskedWith& asked, const Answer& answer);

/// Fills in answer.explained, hints first: what stops it leaves the rest out. `made`: what solve() and
/// make_by_products() have kept. Throws Stopped.
void explain_answer(const Scene& scene, const AskedWith& asked, Answer& answer, const ByProducts& made,
                    const Execution& execution);

/// Where memory ended an answer: the way that holds less, as one line; empty where none is known.
std::string_view what_takes_less_memory(const Answer& answer);

/// Lets `explain` fill it in; what stops it, a limit or memory, leaves the answer, and the explanation says which.
void explain_in_time(Answer& answer, const std::function<void()>& explain);

/// Where the body has least room along a verified path of this length and clearance; nothing where it touches, and of
/// paths of one state. Throws Stopped.
std::optional<NarrowPlace> narrowest_place(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                                           double min_clearance, const Execution& execution);

}  // namespace warren
