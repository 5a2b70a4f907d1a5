// SPDX-License-Identifier: BSD-3-Clause
// A question in, a verified answer out: solve() for every kind of problem, and verify() for answers of anybody. What a
// program links for; the other headers are the parts that this one joins.
#pragma once

#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/question/limits.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

struct Roadmap;  // solve/kept/roadmap.hpp
class KeptWays;  // solve/kinds/kept_ways.hpp

/// Finds a path and verifies it, by code that shares nothing with the planner. What neither question nor options say is
/// as the world's file says, and else what is fastest and most honest for the problem. No path is an answer, and so is
/// a stop: see Answer::outcome. `keep`, where given, receives what the planner made on its way; what of it the limits
/// don't allow is missing there. The answer is the same for any number of threads. Throws UsageError for what can't be
/// asked of this world, InputError for a world that contradicts itself. Any number of threads may call at once.
Answer solve(const Scene& scene, const Question& question = {}, const SolveOptions& options = {},
             const Limits& limits = {}, ByProducts* keep = nullptr);

/// Judges the path of an answer against every obstacle of the scene, for the whole body and the whole question; and
/// what it claims of its path: length, cost and price, goal, order, other ways, bound. Throws UsageError, InputError
/// for states that are none of this body, Stopped.
Verdict verify(const Scene& scene, const Answer& answer, const Limits& limits = {});
/// The same for an answer that was read from a file; what the question says goes before what the file says.
Verdict verify(const Scene& scene, const RecordedAnswer& answer, const Question& question = {},
               const Limits& limits = {});

/// The answer alone, with an execution that goes on: its deadline is running already. `taker`, where given, may receive
/// the path's points while they are made, before they are verified; the answer then has `handed` instead of them.
/// `kept`: of solves of the same question before (solve/replanner.hpp).
Answer solve_within(const Scene& scene, const Question& question, const SolveOptions& options,
                    const Execution& execution, ByProducts* keep = nullptr, PathTaker* taker = nullptr,
                    KeptWays* kept = nullptr);
/// verify() with an execution that goes on.
Verdict verify_within(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                      const Execution& execution);

/// solve_within(), and what solve() says beside the path: where a blocked end is free, and what an estimate of options
/// cost where it is not the straight line.
Answer solve_explained(const Scene& scene, const Question& question, const SolveOptions& options,
                       const Execution& execution, ByProducts* keep = nullptr, PathTaker* taker = nullptr,
                       KeptWays* kept = nullptr);

/// Adds the by-products that solving leaves out because they cost: the roadmap of tiles. Throws Stopped.
void make_by_products(const Scene& scene, const Question& question, const SolveOptions& options,
                      const Execution& execution, ByProducts& keep);

/// A question whose roadmap outlives it: the roadmap that build() makes by the same options, and the answer by it.
/// Where the samples are left open, solve() grows them until start and goal connect: then the answer is solve()'s and
/// the roadmap has as many samples as its last round. A lazy roadmap keeps what the question has learnt of its edges.
/// Asked the question again, it gives the same path. Takes the scene. `roadmap` is whole unless the answer is
/// `stopped`. `keep`: as for solve_explained(). Throws as that and build_within() do, UsageError where the planner
/// makes no roadmap that is kept, Stopped. Cost: one build and one search; where the samples grow, solve() too.
Answer solve_and_keep(Scene scene, const Question& question, const SolveOptions& options, const Execution& execution,
                      Roadmap& roadmap, ByProducts* keep = nullptr);

}  // namespace warren
