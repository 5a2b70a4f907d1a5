// SPDX-License-Identifier: BSD-3-Clause
#include "studies/compare/planner_deal.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/base/error.hpp"
#include "solve/steps/kind_of_problem.hpp"

namespace warren {
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
};

void copy_option(Option option, SolveOptions& to, const SolveOptions& from) {
  copies[static_cast<std::size_t>(option)](to, from);
}

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

/// One value of a list, as an option that is given.
struct Dealt {
  Option option;
  SolveOptions value;
};

/// The lists, in the order in which they are dealt out.
std::vector<std::vector<Dealt>> lists_of(const PlannerDeal& deal) {
  std::vector<std::vector<Dealt>> lists(4);
  for (const SearchMethod search : deal.searches) lists[0].push_back({Option::search, {.search = search}});
  for (const QueueKind queue : deal.queues) lists[1].push_back({Option::queue, {.queue = queue}});
  for (const SamplerKind sampler : deal.samplers) lists[2].push_back({Option::sampler, {.sampler = sampler}});
  for (const auto& samples : deal.samples) lists[3].push_back({Option::samples, {.roadmap = {.samples = samples}}});
  return lists;
}

/// Would this queue go unused?
bool idle_queue(const SolveOptions& contender, Option option) {
  return option == Option::queue && (contender.search == SearchMethod::bfs || contender.search == SearchMethod::dfs);
}

/// Every way to give the contenders one of the values each.
std::vector<SolveOptions> dealt(const std::vector<SolveOptions>& contenders, const std::vector<Dealt>& values) {
  std::vector<SolveOptions> all;
  for (const SolveOptions& contender : contenders) {
    if (values.empty() || idle_queue(contender, values.front().option)) {
      all.push_back(contender);
      continue;
    }
    for (const Dealt& value : values) {
      all.push_back(contender);
      copy_option(value.option, all.back(), value.value);
    }
  }
  return all;
}

std::vector<Option> options_of(const SolveOptions& options) {
  const OptionSet set = given(options);
  std::vector<Option> all;
  for (std::size_t i = 0; i < option_count; ++i) {
    if (set.has(static_cast<Option>(i))) all.push_back(static_cast<Option>(i));
  }
  return all;
}

std::vector<SolveOptions> contenders_of(const PlannerDeal& deal, PlannerKind planner) {
  SolveOptions contender{.planner = planner, .seed = deal.common.seed};
  for (const Option option : options_of(deal.common)) {
    if (!refusal(planner, option, deal.common)) copy_option(option, contender, deal.common);
  }
  std::vector<SolveOptions> all{contender};
  for (std::vector<Dealt>& values : lists_of(deal)) {
    std::erase_if(values, [&](const Dealt& v) { return refusal(planner, v.option, v.value).has_value(); });
    all = dealt(all, values);
  }
  return all;
}

}  // namespace

std::vector<SolveOptions> deal_planners(const PlannerDeal& deal) {
  deal.question.validate();
  for (const Option option : options_of(deal.common)) check_taken(deal.planners, option, deal.common);
  for (const std::vector<Dealt>& values : lists_of(deal)) {
    for (const Dealt& value : values) check_taken(deal.planners, value.option, value.value);
  }
  std::vector<SolveOptions> all;
  for (const PlannerKind planner : deal.planners) {
    for (SolveOptions& contender : contenders_of(deal, planner)) {
      check_solver_options(contender);
      all.push_back(std::move(contender));
    }
  }
  return all;
}

}  // namespace warren
