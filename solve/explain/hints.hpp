// SPDX-License-Identifier: BSD-3-Clause
// What would likely help where there is no path: options that this world, body and planner take, with numbers, so that
// they can be tried as they stand.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// How the answer was asked for.
struct AskedWith {
  const SolveOptions& options;  ///< of a kept roadmap: those that it was built with
  std::uint64_t samples = 0;    ///< drawn in the last round; 0: as the answer says
  bool is_kept = false;         ///< of a kept roadmap: another one takes `warren build`
};

/// Hints for an answer without a path, the likeliest first. O(1) but for the world's box.
std::vector<Hint> hints_for(const Scene& scene, const AskedWith& asked, const Answer& answer);

}  // namespace warren
