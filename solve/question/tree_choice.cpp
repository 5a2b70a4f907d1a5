// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/tree_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>

#include "core/base/error.hpp"

namespace warren {
namespace {

/// "1,2;3,4,0.5"
std::string way_points_text(const std::vector<std::vector<double>>& via) {
  std::string text;
  for (const std::vector<double>& state : via)
    text += fmt::format("{}{}", text.empty() ? "" : ";", fmt::join(state, ","));
  return text;
}

}  // namespace

RrtOptions tree_options(const SolveOptions& asked) {
  RrtOptions options;
  if (asked.sampler && takes_all_places(*asked.sampler)) {
    throw UsageError(fmt::format("@sampler: {} is for roadmaps; trees take the others", name_of(*asked.sampler)));
  }
  options.sampler = asked.sampler;
  options.places = !asked.optimise;  // trees find ways of more kinds, of which the best is wanted
  options.step = asked.trees.step;
  options.goal_bias = asked.trees.goal_bias.value_or(options.goal_bias);
  options.nodes = asked.trees.nodes.value_or(options.nodes);
  options.trees = asked.trees.trees.value_or(options.trees);
  options.seed = asked.seed;
  return options;
}

std::string_view sampler_name(const RrtOptions& options) {
  return options.sampler ? name_of(*options.sampler) : "uniform-gaussian";
}

std::vector<NamedFigure> given_tree_options(const SolveOptions& asked) {
  std::vector<NamedFigure> given;
  const auto add = [&](const char* name, auto value) { given.push_back({name, Figure(std::move(value))}); };
  const TreeFields& trees = asked.trees;
  if (trees.step) add("step", *trees.step);
  if (trees.goal_bias) add("goal_bias", *trees.goal_bias);
  if (trees.nodes) add("nodes", *trees.nodes);
  if (trees.trees) add("trees", std::uint64_t{*trees.trees});
  if (!trees.via.empty()) add("via", way_points_text(trees.via));
  if (asked.optimise) add("optimise", true);
  return given;
}

}  // namespace warren
