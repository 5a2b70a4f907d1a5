// SPDX-License-Identifier: BSD-3-Clause
// Searches a roadmap from start and goal at once (NBA*, core/search/bidirectional_search.hpp), a thread an end. Whether
// that pays follows from the number of vertices alone, so that path and counters are the same for any number of
// threads: two threads do not repay their start on small roadmaps. 17 bytes a vertex and end, and the queues.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/search/search.hpp"
#include "parallel/bidirectional_search.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/queue_choice.hpp"

namespace warren {

/// Vertices from which on a search runs from both ends.
inline constexpr std::size_t fewest_for_both_ends = 50'000;

/// neighbours[i]: of the side that begins at roots[i]; the two are called from two threads at once. estimate_to(root)
/// gives a consistent estimate of the way to a root. states[i] keeps what side i has reached. Throws Stopped at the
/// deadline.
template <class Neighbours, class EstimateTo>
SearchResult search_from_both_ends(QueueKind kind, std::size_t vertex_count, const std::array<VertexId, 2>& roots,
                                   const std::array<Neighbours, 2>& neighbours, const EstimateTo& estimate_to,
                                   const std::array<SearchState*, 2>& states, const Execution& execution) {
  using Estimate = decltype(estimate_to(no_vertex));
  const std::array<Estimate, 2> to_root{estimate_to(roots[0]), estimate_to(roots[1])};
  const SearchResult found = with_queue(kind, 0, execution, [&](const auto& empty_queue) {
    using Queue = std::remove_cvref_t<decltype(empty_queue)>;
    struct alignas(apart) Side {
      Queue queue;
      std::optional<SearchSide<Queue, Neighbours, Estimate, Estimate>> search;
    };
    std::array<Side, 2> sides{Side{empty_queue, {}}, Side{empty_queue, {}}};
    // Both at once: the first touch of their memory is half of the cost. Few vertices do not repay a thread's start.
    const std::size_t grain = vertex_count < fewest_for_both_ends ? 2 : 1;
    for_chunks(2, grain, execution, [&](Range r) {
      for (std::size_t i = r.first; i < r.last; ++i) {
        sides[i].search.emplace(roots[i], vertex_count, neighbours[i], to_root[1 - i], to_root[i], sides[i].queue,
                                *states[i], [&] { execution.check(); });
      }
    });
    return bidirectional(*sides[0].search, *sides[1].search, execution);
  });
  if (found.status == SearchStatus::stopped) execution.check();
  return found;
}

}  // namespace warren
