// SPDX-License-Identifier: BSD-3-Clause
#include "studies/contests/random_graph_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace warren::studies {
namespace {

constexpr double longest_search_s = 2.0;

/// Drops the variants of which one of the contenders from `first` on took too long in the median.
void drop_slow_variants(std::vector<SearchVariant>& variants, std::size_t first, std::uint32_t size,
                        Comparison& comparison) {
  for (std::size_t i = variants.size(); i-- > 0;) {
    const Contender& contender = comparison.contenders[first + i];
    const ComparisonRow row = row_of(contender);
    if (!row.time_s || row.time_s->median <= longest_search_s) continue;
    const std::string note = fmt::format("{}: left out beyond {} vertices, where a search takes {:.1f} s",
                                         contender_name(contender, false), size, row.time_s->median);
    comparison.notes.push_back(note);
    variants.erase(variants.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

void run_size_sweep(const SizeSweepOptions& options, const Execution& execution, Comparison& comparison,
                    const std::function<void(std::string_view)>& say) {
  SearchContestOptions contest = options.contest;
  for (const std::uint32_t size : options.sizes) {
    for (std::uint64_t seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
      if (contest.variants.empty()) return;
      const SearchGraph graph = geometric_graph(size, options.degree, seed, execution);
      const std::size_t first = comparison.contenders.size();
      run_search_contest(graph, contest, execution, comparison);
      say(fmt::format("{} vertices, seed {}: {} edges, {} searches", size, seed, graph.graph.edge_count(),
                      contest.variants.size()));
      if (!contest.trials) drop_slow_variants(contest.variants, first, size, comparison);
    }
  }
}

}  // namespace warren::studies
