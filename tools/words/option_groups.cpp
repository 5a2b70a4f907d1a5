// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/option_groups.hpp"

#include <algorithm>
#include <string>

namespace warren::tools {
namespace {

struct NamedGroup {
  std::string_view title;
  std::string_view names;
};

/// What stands in none is the verb's own.
constexpr std::string_view own = "Options";
constexpr NamedGroup option_groups[] = {
    {"Question", "--robot --start --goal --via --clearance --contact --map-rules"},
    {"Planner", "--planner --planners --seed"},
    {"Roadmaps of samples",
     "--sampler --samplers --samples --neighbours --radius --neighbour-index --attach --lazy --pipeline"},
    {"Trees", "--step --goal-bias --nodes --trees"},
    {"Grids", "--cell --angles --face-motion --step-cost --turn-cost --diagonal --layers"},
    {"Visibility graph, cells, medial axis", "--full --sampled-edges --doors --objective"},
    {"Cars", "--steering --turning-radius"},
    {"Search", "--search --searches --heuristic --queue --queues"},
    {"Shortening", "--optimise --cusp-cost --reverse-cost"},
    {"Mazes", "--algorithm --loops"},
    {"Outputs",
     "--output --picture --figures --table --json --no-path --csv --runs --log --html --pictures --report "
     "--save-roadmap --keep "
     "--explain --show "
     "--heading --size --dpi --title"},
    {"Path as a file",
     "--path --every --speed --acceleration --lateral-acceleration --joint-speed --joint-acceleration --frame"},
    {"Run", "--threads --budget --memory --quiet --progress --color --trace --resume"},
};

constexpr NamedGroup command_groups[] = {
    {"Paths", "solve verify render compare"},
    {"Roadmaps that are kept", "build query update export"},
    {"In the browser", "serve"},
    {"Worlds", "example generate info convert"},
    {"Measuring", "profile largest scale bench-scen"},
    {"Words", "help man completion"},
};

bool is_among(std::string_view name, std::string_view names) {
  const std::vector<std::string> words = words_of(names);
  return std::find(words.begin(), words.end(), name) != words.end();
}

std::string_view group_of(const OptionSpec& option) {
  if (!option.group.empty()) return option.group;
  for (const NamedGroup& group : option_groups) {
    if (is_among(option.name, group.names)) return group.title;
  }
  return own;
}

}  // namespace

std::vector<OptionGroup> grouped_options(const Command& command) {
  std::vector<OptionGroup> groups{{own, {}}};
  for (const NamedGroup& group : option_groups) groups.push_back({group.title, {}});
  for (const OptionSpec& option : command.options) {
    const std::string_view title = group_of(option);
    std::find_if(groups.begin(), groups.end(), [&](const OptionGroup& group) {
      return group.title == title;
    })->options.push_back(&option);
  }
  std::erase_if(groups, [](const OptionGroup& group) { return group.options.empty(); });
  return groups;
}

std::vector<std::pair<std::string_view, std::vector<const Command*>>> grouped_commands() {
  std::vector<std::pair<std::string_view, std::vector<const Command*>>> groups;
  for (const NamedGroup& group : command_groups) {
    groups.push_back({group.title, {}});
    for (const Command& command : command_table()) {
      if (is_among(command.name, group.names)) groups.back().second.push_back(&command);
    }
  }
  return groups;
}

}  // namespace warren::tools
