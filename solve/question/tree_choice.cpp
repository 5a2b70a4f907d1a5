// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/tree_choice.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/write_answer_io.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr std::uint64_t most_nodes = std::uint64_t{1} << 31;
constexpr std::uint64_t most_trees = 4096;

constexpr OptionSpec tree_specs[] = {
    {"--step", "D", "longest motion of a tree, in the body's metric (default: a third of half the space's diagonal)"},
    {"--goal-bias", "F", "share of rrt's samples that are the goal (default: 0.05)"},
    {"--nodes", "N", "a tree of so many nodes gives up (default: 100000)"},
    {"--trees", "N", "trees grown independently at once; the first to arrive answers (default: 1)"},
    {"--via", "STATES",
     "way-points to be passed in this order: X,Y or X,Y,THETA or six joint angles each, apart by semicolons"},
};

}  // namespace

std::span<const OptionSpec> tree_option_specs() { return tree_specs; }

RrtOptions tree_options(const Arguments& arguments) {
  RrtOptions options;
  const auto sampler = sampler_asked(arguments);
  if (sampler && takes_all_places(*sampler)) {
    throw UsageError(fmt::format("--sampler: {} is for roadmaps; trees take the others", name_of(*sampler)));
  }
  options.sampler = sampler;
  options.places = !arguments.has("--optimise");  // trees find ways of more kinds, of which the best is wanted
  if (const auto text = arguments.value("--step")) options.step = positive_value("--step", *text);
  if (const auto text = arguments.value("--goal-bias"))
    options.goal_bias = number_value("--goal-bias", *text, 0.0, 1.0);
  if (const auto text = arguments.value("--nodes")) options.nodes = count_value("--nodes", *text, 2, most_nodes);
  if (const auto text = arguments.value("--trees")) {
    options.trees = static_cast<std::uint32_t>(count_value("--trees", *text, 1, most_trees));
  }
  options.seed = seed_of(arguments);
  return options;
}

std::string_view sampler_name(const RrtOptions& options) {
  return options.sampler ? name_of(*options.sampler) : "uniform-gaussian";
}

std::vector<std::vector<double>> way_points(const Arguments& arguments) {
  std::vector<std::vector<double>> points;
  const auto text = arguments.value("--via");
  if (!text) return points;
  std::string_view rest = *text;
  for (;;) {
    const std::size_t end = rest.find(';');
    points.push_back(state_value("--via", rest.substr(0, end)));
    if (end == std::string_view::npos) return points;
    rest.remove_prefix(end + 1);
  }
}

std::vector<std::pair<std::string, std::string>> given_tree_options(const Arguments& arguments) {
  std::vector<std::pair<std::string, std::string>> given;
  const RrtOptions options = tree_options(arguments);
  if (options.step) given.emplace_back("step", json_number(*options.step));
  if (arguments.has("--goal-bias")) given.emplace_back("goal_bias", json_number(options.goal_bias));
  if (arguments.has("--nodes")) given.emplace_back("nodes", std::to_string(options.nodes));
  if (arguments.has("--trees")) given.emplace_back("trees", std::to_string(options.trees));
  if (const auto via = arguments.value("--via")) given.emplace_back("via", json_string(*via));
  if (arguments.has("--optimise")) given.emplace_back("optimise", "true");
  return given;
}

}  // namespace warren
