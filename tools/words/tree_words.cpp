// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about rrt and rrt-connect.
#include "tools/words/option_values.hpp"
#include "tools/words/planner_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec tree_specs[] = {
    {"--step", "D", "longest motion of a tree, in the body's metric (default: a third of half the space's diagonal)"},
    {"--goal-bias", "F", "share of rrt's samples that are the goal (default: 0.05)"},
    {"--nodes", "N", "most nodes of a tree; a tree that has them gives up (default: 100000)"},
    {"--trees", "N", "trees grown independently at once; the first to arrive answers (default: 1)"},
    {"--via", "STATES",
     "waypoints to pass in this order, apart by semicolons; each X,Y or X,Y,THETA or six joint angles"},
};

std::vector<std::vector<double>> way_points_value(std::string_view option, std::string_view text) {
  std::vector<std::vector<double>> points;
  for (;;) {
    const std::size_t end = text.find(';');
    points.push_back(state_value(option, text.substr(0, end)));
    if (end == std::string_view::npos) return points;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::span<const OptionSpec> tree_option_specs() { return tree_specs; }

TreeFields tree_words(const Arguments& arguments) {
  constexpr std::uint64_t most_nodes = std::uint64_t{1} << 31;
  constexpr std::uint32_t most_trees = 4096;
  TreeFields trees;
  trees.step = given_value(arguments, "--step", positive_value);
  trees.goal_bias = given_value(arguments, "--goal-bias", number_value, 0.0, 1.0);
  trees.nodes = given_value(arguments, "--nodes", count_value, std::uint64_t{2}, most_nodes);
  trees.trees = given_count(arguments, "--trees", 1, most_trees);
  if (const auto text = arguments.value("--via")) trees.via = way_points_value("--via", *text);
  return trees;
}

}  // namespace warren::tools
