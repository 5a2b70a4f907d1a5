// SPDX-License-Identifier: BSD-3-Clause
// One comparison from beginning to end, as options ask for it: of planners in a world, of searches on its graph, of
// searches on random graphs.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/base/solution.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "studies/compare/comparison.hpp"
#include "tools/verbs/compare_options.hpp"

namespace warren::tools {

/// Runs them and adds what they say; what a signal cuts is there until then, and comparison.stopped names it. `scene`:
/// the world, nullptr where only random graphs are asked for. `note` is told how far it is. Gives back why the world
/// has no graph to search, if it has none. Throws UsageError.
std::optional<Outcome> run_comparison(const CompareOptions& options, const Scene* scene, const Execution& execution,
                                      studies::Comparison& comparison,
                                      const std::function<void(std::string_view)>& note);

}  // namespace warren::tools
