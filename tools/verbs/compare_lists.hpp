// SPDX-License-Identifier: BSD-3-Clause
// Which options of `solve` take lists in `warren compare`, and the contenders' deal that words make with them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "studies/contests/planner_deal.hpp"
#include "tools/words/arguments.hpp"

namespace warren::tools {

/// Throws UsageError where one of these is given; `why` says what takes them.
void refuse(const Arguments& arguments, std::initializer_list<std::string_view> options, std::string_view why);

/// An option of `solve` that takes a list here, apart by commas.
struct ListOption {
  Option option;
  std::string_view name;
  std::string_view list = {};  ///< another name of it; empty: none
};
std::span<const ListOption> list_options();

/// May planners take turns with several values of an option each, or is one graph searched, which has one value each
/// and leaves searches and queues to others?
enum class DealKind : std::uint8_t { planners, graph };

/// Options with one value go to all contenders, those with several are dealt. Throws UsageError.
studies::PlannerDeal deal_words(const Arguments& arguments, std::vector<PlannerKind> planners, DealKind kind);

}  // namespace warren::tools
