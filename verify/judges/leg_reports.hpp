// SPDX-License-Identifier: BSD-3-Clause
// The loop that all judges share: the legs of a path one by one, by all threads, and what they come to. The result is
// that of the legs in their order, whatever the threads.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "parallel/chunks.hpp"
#include "parallel/execution.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

/// What is known of a leg, or of several.
struct LegReport {
  double least = std::numeric_limits<double>::infinity();  ///< proved
  double met = std::numeric_limits<double>::infinity();    ///< where it was looked: never less than the truth
  std::size_t looks = 0;                                   ///< how often a piece was halved
  std::optional<Violation> violation = {};

  /// Of two violations on one leg the one that was added first is kept.
  void add(const LegReport& more);
};

/// All legs: report_of(range) says what those of a range come to, and may be called by any thread.
template <class ReportOf>
LegReport report_legs(std::size_t count, std::size_t legs_a_chunk, const Execution& execution,
                      const ReportOf& report_of) {
  std::vector<LegReport> parts(chunk_count(count, legs_a_chunk));
  for_chunks(count, legs_a_chunk, execution, [&](Range r) { parts[r.first / legs_a_chunk] = report_of(r); });
  LegReport whole;
  for (const LegReport& part : parts) whole.add(part);
  return whole;
}

/// Legs of a path of so many states; a single state is a leg of length zero.
constexpr std::size_t legs_of(std::size_t states) { return states > 1 ? states - 1 : 1; }

/// The violation of a path that begins or ends elsewhere, `distance` away. `which`: "start" or "goal"; `wanted`: the
/// state that was asked for.
Violation elsewhere(std::string_view which, std::span<const double> wanted, double distance, std::size_t leg);

/// Start before all legs, the goal after them. Leaves it to the caller to measure the path.
Verification verdict_on(const LegReport& legs, const std::optional<Violation>& start,
                        const std::optional<Violation>& goal);

}  // namespace warren
