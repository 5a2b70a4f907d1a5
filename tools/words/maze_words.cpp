// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/maze_words.hpp"

#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec maze_specs[] = {
    {"--algorithm", "NAME", "how the mazes are made (default: backtracker)",
     "backtracker kruskal prim wilson course mst"},
    {"--loops", "F", "fraction of the remaining walls taken out, 0 to 1 (default: 0)"},
};

MazeAlgorithm algorithm_value(std::string_view option, std::string_view text) {
  constexpr std::string_view words[] = {"backtracker", "kruskal", "prim", "wilson", "course", "mst"};
  return maze_algorithm_named(words[choice_value(option, text, words)]);
}

}  // namespace

std::span<const OptionSpec> maze_option_specs() { return maze_specs; }

MazeOptions maze_words(const Arguments& arguments, MazeOptions usual) {
  usual.loops = given_value(arguments, "--loops", number_value, 0.0, 1.0).value_or(usual.loops);
  usual.algorithm = given_value(arguments, "--algorithm", algorithm_value).value_or(usual.algorithm);
  return usual;
}

}  // namespace warren::tools
