// SPDX-License-Identifier: BSD-3-Clause
#include "solve/explain/heuristic_price.hpp"

#include "parallel/execution.hpp"

namespace warren {

void price_heuristic(Answer& answer, std::optional<HeuristicKind> asked,
                     const std::function<Answer(HeuristicKind)>& ask) {
  if (!asked || asked == HeuristicKind::euclidean || !answer.verified) return;
  try {
    const Answer exact = ask(HeuristicKind::euclidean);
    if (!exact.verified) return;
    answer.path_figures.push_back({"searched_length", answer.raw_length.value_or(answer.length)});
    answer.path_figures.push_back({"shortest_length", exact.length});
    answer.path_figures.push_back({"shortest_expanded", exact.counters.expanded});
  } catch (const Stopped&) {
  }
}

}  // namespace warren
