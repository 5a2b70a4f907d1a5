// SPDX-License-Identifier: BSD-3-Clause
// One measured run of the same code as `warren solve`: a maze of this size and seed, solved under its own budget. What
// `largest` and `scale` are made of.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/run/execution.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::studies {

/// An answer without its path. Its stop_reason is time or memory, and only of stopped; its peak of memory is that from
/// walls in memory on, walls included.
struct MazeTrial : Answer {
  std::uint32_t rows = 0;
  std::uint32_t cols = 0;
  double clearance = 0.0;
  double generate_s = 0.0;

  double cells() const { return static_cast<double>(rows) * static_cast<double>(cols); }
};

/// Makes the maze, whose walls are left out where they are to be streamed and can be; `seconds` receives the time.
/// Throws Stopped.
Scene generate_trial(const MazeOptions& maze, const SolveOptions& options, const Execution& execution, double& seconds);

/// Solves it by prm or lazy-prm, as `options` say, with the maze's seed, and at most budget_s of solve_s; the memory
/// limit is the execution's. Throws Stopped only for signals; other stops are outcomes. Throws UsageError.
MazeTrial solve_trial(const Scene& scene, const MazeOptions& maze, const Question& question,
                      const SolveOptions& options, double budget_s, const Execution& execution);

/// "prm, tiled, lattice sampler"
std::string planner_text(const MazeTrial& trial);
/// "solved", or why not: "cut by the budget", "too little memory", "not_connected", …
std::string_view verdict_of(const MazeTrial& trial);
/// The keys that largest and scale share: rows cols seed threads planner sampler status verified solve_s stages_s …
nlohmann::ordered_json trial_json(const MazeTrial& trial);

}  // namespace warren::studies
