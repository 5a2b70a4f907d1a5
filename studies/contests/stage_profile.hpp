// SPDX-License-Identifier: BSD-3-Clause
// What each stage of a solve costs: the same question several times on one thread and on all, in turns, so that
// whatever else the machine does meets both alike. Medians are told.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/plots/plot_sheet.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/palette.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/stage_lines.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::studies {

/// One stage, on all threads.
struct ProfiledStage {
  StageLine line;                      ///< medians
  std::optional<double> one_thread_s;  ///< wall-clock; none where there is one thread alone
  std::optional<double> speed_up() const;
};

struct StageProfile {
  Answer answer;                      ///< of the last run
  std::size_t runs = 0;               ///< that ended, on all threads
  std::vector<ProfiledStage> stages;  ///< in the order of the work, and last "rest": what is in none of them
  ProfiledStage whole;                ///< solve_s
};

/// Ends early, and says so by the answer's outcome, where a run is stopped. Throws UsageError as solve() does.
StageProfile profile_stages(const Scene& scene, const Question& question, const SolveOptions& options, std::size_t runs,
                            const Execution& execution);

std::string profile_summary(const StageProfile& profile, const Palette& palette);
std::string profile_json(const StageProfile& profile);
/// Two bars a stage: one thread, and all.
PlotSheet profile_bars(const StageProfile& profile);

}  // namespace warren::studies
