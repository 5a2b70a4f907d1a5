// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/leg_reports.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace warren {

void LegReport::add(const LegReport& more) {
  least = std::min(least, more.least);
  met = std::min(met, more.met);
  looks += more.looks;
  if (more.violation && (!violation || more.violation->leg < violation->leg)) violation = more.violation;
}

Violation elsewhere(std::string_view which, std::span<const double> wanted, double distance, std::size_t leg) {
  return {leg, distance, fmt::format("{}: {}", which, fmt::join(wanted, " "))};
}

Verification verdict_on(const LegReport& legs, const std::optional<Violation>& start,
                        const std::optional<Violation>& goal) {
  Verification verdict;
  verdict.min_clearance = legs.least;
  verdict.first_violation = start ? start : legs.violation ? legs.violation : goal;
  verdict.verified = !verdict.first_violation;
  return verdict;
}

}  // namespace warren
