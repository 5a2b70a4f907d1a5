// SPDX-License-Identifier: BSD-3-Clause
#include "studies/contests/planner_deal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "core/base/error.hpp"
#include "solve/steps/kind_of_problem.hpp"

namespace warren::studies {
namespace {

/// Gives one option the value that it has in `from`.
using Copy = void (*)(SolveOptions& to, const SolveOptions& from);

template <auto Field>
void whole(SolveOptions& to, const SolveOptions& from) {
  to.*Field = from.*Field;
}
template <auto Part, auto Field>
void part(SolveOptions& to, const SolveOptions& from) {
  to.*Part.*Field = from.*Part.*Field;
}
template <auto Field, StarRule Rule>
void joining(SolveOptions& to, const SolveOptions& from) {
  to.roadmap.*Field = from.roadmap.*Field;
  if (from.roadmap.star == Rule) to.roadmap.star = Rule;
}
void lazy(SolveOptions& to, const SolveOptions& from) {
  to.roadmap.lazy = from.roadmap.lazy;
  to.visibility.lazy = from.visibility.lazy;
}

/// In the order of Option.
constexpr std::array<Copy, option_count> copies{
    whole<&SolveOptions::sampler>,
    part<&SolveOptions::roadmap, &RoadmapFields::samples>,
    joining<&RoadmapFields::neighbours, StarRule::neighbours>,
    joining<&RoadmapFields::radius, StarRule::radius>,
    whole<&SolveOptions::search>,
    whole<&SolveOptions::queue>,
    lazy,
    part<&SolveOptions::roadmap, &RoadmapFields::pipeline>,
    whole<&SolveOptions::optimise>,
    part<&SolveOptions::grid, &GridFields::cell>,
    part<&SolveOptions::grid, &GridFields::angles>,
    part<&SolveOptions::grid, &GridFields::face_motion>,
    part<&SolveOptions::grid, &GridFields::step_cost>,
    part<&SolveOptions::grid, &GridFields::turn_cost>,
    part<&SolveOptions::grid, &GridFields::diagonal>,
    part<&SolveOptions::grid, &GridFields::layers>,
    part<&SolveOptions::visibility, &VisibilityFields::full>,
    part<&SolveOptions::visibility, &VisibilityFields::sampled_edges>,
    part<&SolveOptions::cells, &CellFields::doors>,
    part<&SolveOptions::axis, &AxisFields::objective>,
    part<&SolveOptions::trees, &TreeFields::step>,
    part<&SolveOptions::trees, &TreeFields::goal_bias>,
    part<&SolveOptions::trees, &TreeFields::nodes>,
    part<&SolveOptions::trees, &TreeFields::trees>,
    part<&SolveOptions::trees, &TreeFields::via>,
    part<&SolveOptions::car, &CarFields::steering>,
    part<&SolveOptions::car, &CarFields::turning_radius>,
    part<&SolveOptions::car, &CarFields::cusp_cost>,
    part<&SolveOptions::car, &CarFields::reverse_cost>,
    part<&SolveOptions::roadmap, &RoadmapFields::attach>,
    whole<&SolveOptions::heuristic>,
    part<&SolveOptions::roadmap, &RoadmapFields::neighbour_index>,
};

/// Why the planner does not take this option as it is in `from`; nothing where it does.
std::optional<UsageError> refusal(PlannerKind planner, Option option, const SolveOptions& from) {
  SolveOptions alone{.planner = planner};
  copy_option(option, alone, from);
  if (option == Option::samples && !alone.roadmap.samples) alone.roadmap.samples = 1;  // what takes a number takes none
  try {
    check_solver_options(alone);
    return std::nullopt;
  } catch (const UsageError& error) {
    return error;
  }
}

/// The first that would know the option tells best what is wrong with its value.
void check_taken(const std::vector<PlannerKind>& planners, Option option, const SolveOptions& from) {
  std::optional<UsageError> refused;
  for (const PlannerKind planner : planners) {
    const std::optional<UsageError> why = refusal(planner, option, from);
    if (!why) return;
    const bool knows_it = std::string_view(why->what()).find("would ignore it") == std::string_view::npos;
    if (!refused || knows_it) refused.emplace(*why);
  }
  if (refused) throw UsageError(*refused);
}

/// Would this queue, or this estimate, go unused?
bool idles(const SolveOptions& contender, Option option) {
  const SearchMethod search = contender.search.value_or(SearchMethod::astar);
  if (option == Option::heuristic) return search != SearchMethod::astar;
  return option == Option::queue && (search == SearchMethod::bfs || search == SearchMethod::dfs);
}

/// Throws where another `times` as many contenders would be too many.
void check_count(std::size_t contenders, std::size_t times) {
  constexpr std::size_t most_contenders = 10'000;
  if (contenders * std::max<std::size_t>(times, 1) <= most_contenders) return;
  throw UsageError(fmt::format("@planners: more than {} contenders come of these lists; shorten one", most_contenders));
}

/// Every way to give the contenders one of the values each.
std::vector<PlannerContender> dealt(const std::vector<PlannerContender>& contenders, const DealtOption& list) {
  check_count(contenders.size(), list.values.size());
  std::vector<PlannerContender> all;
  for (const PlannerContender& contender : contenders) {
    if (list.values.empty() || idles(contender.options, list.option)) {
      all.push_back(contender);
      continue;
    }
    for (const DealtValue& value : list.values) {
      all.push_back(contender);
      copy_option(list.option, all.back().options, value.value);
      if (list.values.size() > 1) all.back().dealt.emplace_back(name_of(list.option), value.word);
    }
  }
  return all;
}

std::vector<PlannerContender> with_clearances(const std::vector<PlannerContender>& contenders,
                                              const std::vector<double>& clearances) {
  check_count(contenders.size(), clearances.size());
  std::vector<PlannerContender> all;
  for (const PlannerContender& contender : contenders) {
    for (const double clearance : clearances) {
      all.push_back(contender);
      all.back().question.clearance = clearance;
      all.back().question.validate();
      if (clearances.size() > 1) all.back().dealt.emplace_back("clearance", fmt::format("{}", clearance));
    }
  }
  return clearances.empty() ? contenders : all;
}

std::vector<Option> options_of(const SolveOptions& options) {
  const OptionSet set = given(options);
  std::vector<Option> all;
  for (std::size_t i = 0; i < option_count; ++i) {
    if (set.has(static_cast<Option>(i))) all.push_back(static_cast<Option>(i));
  }
  return all;
}

std::vector<PlannerContender> contenders_of(const PlannerDeal& deal, PlannerKind planner) {
  SolveOptions usual{.planner = planner, .seed = deal.common.seed};
  for (const Option option : options_of(deal.common)) {
    if (!refusal(planner, option, deal.common)) copy_option(option, usual, deal.common);
  }
  std::vector<PlannerContender> all{{usual, deal.question, {}}};
  for (DealtOption list : deal.lists) {
    std::erase_if(list.values, [&](const DealtValue& v) { return refusal(planner, list.option, v.value).has_value(); });
    all = dealt(all, list);
  }
  return with_clearances(all, deal.clearances);
}

}  // namespace

void copy_option(Option option, SolveOptions& to, const SolveOptions& from) {
  copies[static_cast<std::size_t>(option)](to, from);
}

std::vector<PlannerContender> deal_planners(const PlannerDeal& deal) {
  deal.question.validate();
  for (const Option option : options_of(deal.common)) check_taken(deal.planners, option, deal.common);
  for (const DealtOption& list : deal.lists) {
    for (const DealtValue& value : list.values) check_taken(deal.planners, list.option, value.value);
  }
  std::vector<PlannerContender> all;
  for (const PlannerKind planner : deal.planners) {
    for (PlannerContender& contender : contenders_of(deal, planner)) {
      check_solver_options(contender.options);
      all.push_back(std::move(contender));
    }
  }
  check_count(all.size(), 1);
  return all;
}

}  // namespace warren::studies
