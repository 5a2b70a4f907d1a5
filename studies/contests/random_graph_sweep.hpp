// SPDX-License-Identifier: BSD-3-Clause
// The same searches on random geometric graphs of several sizes: what `warren compare --sizes` measures.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "studies/compare/comparison.hpp"
#include "studies/contests/search_contest.hpp"

namespace warren::studies {

struct SizeSweepOptions {
  std::vector<std::uint32_t> sizes;  ///< ascending, each >= 2
  double degree = 20.0;              ///< of a vertex, on average
  std::uint64_t first_seed = 1;
  std::uint64_t seeds = 1;  ///< graphs of each size
  SearchContestOptions contest;
};

/// Runs the contest on every graph. Where the number of trials is left to it, a search that took longer than two
/// seconds is left out of all larger graphs, with a note. `say` is told a line a graph. Throws as run_search_contest.
void run_size_sweep(const SizeSweepOptions& options, const Execution& execution, Comparison& comparison,
                    const std::function<void(std::string_view)>& say);

}  // namespace warren::studies
