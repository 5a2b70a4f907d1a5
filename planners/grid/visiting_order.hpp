// SPDX-License-Identifier: BSD-3-Clause
// The cheapest order in which to visit places between a start and an end (Held, Karp, A dynamic programming approach to
// sequencing problems, J. SIAM 10, 1962): proved, over whole numbers, and of equally cheap orders the lexicographically
// least. 2^n n^2 steps, 2^n n numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace warren {

/// Places whose order is proved: half a million steps.
inline constexpr std::size_t most_visited = 12;
/// There is no way; sums of 14 of them fit.
inline constexpr std::uint64_t no_leg = std::uint64_t{1} << 60;

/// Costs between places, all of one unit, below no_leg or no_leg.
struct TourCosts {
  std::vector<std::uint64_t> from_start;            ///< to each place
  std::vector<std::vector<std::uint64_t>> between;  ///< from row to column
  std::vector<std::uint64_t> to_end;                ///< from each place
};

/// An order of all places.
struct VisitingOrder {
  std::vector<std::uint64_t> order;  ///< numbers of the places
  std::uint64_t cost = 0;            ///< of the whole way
};

/// At least one place, at most most_visited; none: no order has a way.
std::optional<VisitingOrder> best_order(const TourCosts& costs);

}  // namespace warren
