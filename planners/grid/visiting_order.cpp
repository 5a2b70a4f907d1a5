// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/visiting_order.hpp"

#include <algorithm>
#include <cassert>

namespace warren {

std::optional<VisitingOrder> best_order(const TourCosts& costs) {
  const std::size_t count = costs.from_start.size();
  assert(count >= 1 && count <= most_visited);
  const std::size_t all = (std::size_t{1} << count) - 1;
  // least[left * count + at]: from a place over those that are left to the end. A set is after its subsets.
  std::vector<std::uint64_t> least((all + 1) * count, no_leg);
  const auto over = [&](std::size_t left, std::size_t next, std::uint64_t leg) {
    return std::min(no_leg, leg + least[(left & ~(std::size_t{1} << next)) * count + next]);
  };
  const auto holds = [](std::size_t set, std::size_t place) { return (set >> place & 1U) != 0; };
  for (std::size_t left = 0; left < all; ++left) {
    for (std::size_t at = 0; at < count; ++at) {
      std::uint64_t& best = least[left * count + at];
      if (holds(left, at)) continue;
      if (left == 0) best = costs.to_end[at];
      for (std::size_t next = 0; next < count; ++next) {
        if (holds(left, next)) best = std::min(best, over(left, next, costs.between[at][next]));
      }
    }
  }
  VisitingOrder found;
  for (std::size_t left = all; left != 0;) {
    std::uint64_t best = no_leg;
    std::size_t chosen = 0;
    for (std::size_t next = 0; next < count; ++next) {
      if (!holds(left, next)) continue;
      const std::uint64_t leg = found.order.empty() ? costs.from_start[next] : costs.between[found.order.back()][next];
      const std::uint64_t cost = over(left, next, leg);
      if (cost >= best) continue;
      best = cost;
      chosen = next;
    }
    if (best == no_leg) return std::nullopt;
    if (found.order.empty()) found.cost = best;
    found.order.push_back(chosen);
    left &= ~(std::size_t{1} << chosen);
  }
  return found;
}

}  // namespace warren
