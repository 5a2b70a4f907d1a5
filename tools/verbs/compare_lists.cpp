// SPDX-License-Identifier: BSD-3-Clause
#include "tools/verbs/compare_lists.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/planner_words.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

/// In the order in which they are dealt.
constexpr ListOption listed[] = {
    {Option::search, "--search", "--searches"},
    {Option::queue, "--queue", "--queues"},
    {Option::heuristic, "--heuristic"},
    {Option::sampler, "--sampler", "--samplers"},
    {Option::samples, "--samples"},
    {Option::neighbours, "--neighbours"},
    {Option::radius, "--radius"},
    {Option::pipeline, "--pipeline"},
    {Option::cell, "--cell"},
    {Option::angles, "--angles"},
    {Option::step_cost, "--step-cost"},
    {Option::turn_cost, "--turn-cost"},
    {Option::diagonal, "--diagonal"},
    {Option::layers, "--layers"},
    {Option::sampled_edges, "--sampled-edges"},
    {Option::doors, "--doors"},
    {Option::objective, "--objective"},
    {Option::step, "--step"},
    {Option::goal_bias, "--goal-bias"},
    {Option::nodes, "--nodes"},
    {Option::trees, "--trees"},
    {Option::steering, "--steering"},
    {Option::turning_radius, "--turning-radius"},
    {Option::cusp_cost, "--cusp-cost"},
    {Option::reverse_cost, "--reverse-cost"},
};
constexpr std::string_view clearance = "--clearance";

bool is_list(const Arguments& arguments, std::string_view option) {
  return arguments.value(option).value_or("").find(',') != std::string::npos;
}

studies::DealtOption dealt_words(const ListOption& option, std::string_view name, const std::string& text) {
  studies::DealtOption dealt{option.option, {}};
  for (const std::string& word : list_value(name, text)) {
    dealt.values.push_back({word, solve_words(Arguments::of(option.name, word))});
  }
  return dealt;
}

/// Milestones are joined by one of them, so both can't be dealt.
void check_joining(const Arguments& arguments) {
  if (!arguments.has("--neighbours") || !arguments.has("--radius")) return;
  for (const std::string_view option : {"--neighbours", "--radius"}) {
    if (!is_list(arguments, option)) continue;
    throw UsageError(fmt::format("{}: milestones are joined by --neighbours or by --radius; give one of them", option));
  }
}

}  // namespace

void refuse(const Arguments& arguments, std::initializer_list<std::string_view> options, std::string_view why) {
  for (const std::string_view option : options) {
    if (arguments.has(option)) throw UsageError(fmt::format("{}: {}", option, why));
  }
}

std::span<const ListOption> list_options() { return listed; }

studies::PlannerDeal deal_words(const Arguments& arguments, std::vector<PlannerKind> planners, DealKind kind) {
  check_joining(arguments);
  studies::PlannerDeal deal;
  deal.planners = std::move(planners);
  std::vector<std::string_view> taken{"--seed"};
  for (const ListOption& option : listed) {
    const bool left_to_others = option.option == Option::search || option.option == Option::queue;
    if (kind == DealKind::graph && left_to_others) continue;
    const bool named_list = !option.list.empty() && arguments.has(option.list);
    if (named_list) refuse(arguments, {option.name}, fmt::format("{} gives it, too", option.list));
    const std::string_view name = named_list ? option.list : option.name;
    const auto text = arguments.value(name);
    const bool always = named_list || option.option == Option::samples;  // which "auto" is no option of, but a value
    if (!text || (!always && !is_list(arguments, name))) continue;
    deal.lists.push_back(dealt_words(option, name, *text));
    taken.push_back(option.name);
    if (kind == DealKind::graph && deal.lists.back().values.size() > 1) {
      throw UsageError(fmt::format("{}: searches run on one graph; give one value", option.name));
    }
  }
  if (is_list(arguments, clearance)) {
    if (kind == DealKind::graph) throw UsageError("--clearance: searches run on one graph; give one value");
    deal.clearances = given_values(arguments, clearance, clearance, [](std::string_view option, std::string_view word) {
      return number_value(option, word, 0.0, largest_coordinate);
    });
    taken.push_back(clearance);
  }
  const Arguments shared = arguments.without(taken);
  deal.question = question_words(shared);
  deal.common = solve_words(shared);
  check_not_written(arguments, deal.question.robot);
  return deal;
}

}  // namespace warren::tools
