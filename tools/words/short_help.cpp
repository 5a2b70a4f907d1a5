// SPDX-License-Identifier: BSD-3-Clause
// What help has of all verbs beside their options: examples and what is used most, one table, since they share both.
#include <fmt/format.h>

#include <string>
#include <utility>

#include "tools/words/help.hpp"

namespace warren::tools {
namespace {

constexpr std::string_view example_lines = R"(warren example # the worlds that there are
warren example flat # a map of three rooms
warren example parking-lot # a car
warren generate maze 41x41 --algorithm wilson -o maze.npy # a maze as an array
warren generate polygons 50 --seed 7 -o town.scene # a town of polygons
warren solve maze:41x41 --picture maze.svg --json answer.json # a maze, solved and drawn
warren solve flat.yaml --robot "disc 0.2" --start 0.5,0.5 --goal 4.3,0.5 # a disc on a map
warren solve town.scene --planner prm --neighbours star --samples 2000 # PRM*
warren solve parking-lot.scene --optimise --json drive.json # a car
warren solve parking-lot.scene --path drive.yaml --speed 1.5 # its path with times, for ROS
warren verify maze:41x41 answer.json # an answer of 'warren solve --json'
warren render maze:41x41 --answer answer.json -o path.png # an answer as a picture
warren render parking-lot.scene --answer drive.json --animate -o drive.svg # the car drives
warren build maze:100x100,loops=0.01 -o maze.roadmap # the roadmap of a maze
warren build flat.yaml --planner voronoi -o axis.roadmap # the middles of a map's corridors
warren query maze.roadmap --start 1,1 --goal 80,80 # one question
warren query maze.roadmap --batch questions.csv --lengths-only # start_x,start_y,goal_x,goal_y a line
warren update maze.roadmap maze:100x100,loops=0.02 -o new.roadmap # the maze has more loops now
warren export axis.roadmap -o route.geojson # a route graph for Nav2
warren export maze.roadmap -o maze.graphml # for NetworkX and others
warren info flat.yaml # a world
warren info maze.roadmap --check all # every byte of a roadmap
warren convert maze.npy -o maze.walls # walls as text
warren convert town.scene --cell 0.2 -o town.map # polygons as cells
warren serve flat.yaml --robot "disc 0.2" # click start and goal in the browser
warren serve empty:20x10 --writable # draw a world of your own
warren compare maze:41x41 --planners prm,lazy-prm --seeds 20 # two planners
warren compare town.scene --planners prm --samples 100,250 --picture k.svg # plots of two numbers of samples
warren compare maze:41x41,loops=0.2 --searches dijkstra,astar # searches alone
warren profile maze:99x99 --planner prm --picture stages.svg # what each stage costs
warren largest --budget 1s --max-size 500 # mazes that are solved within a second each
warren scale --sizes 50,100,200 --threads 1,2 --html scale.html # time against size and threads
warren bench-scen arena.map.scen # beside its arena.map
warren help solve # what is used most
warren help solve all # all of its options
warren help --clearance # one option
warren help footprint # a word that you know from elsewhere
warren man solve # the page of 'warren solve'
warren completion bash # the script for bash
)";

constexpr std::pair<std::string_view, std::string_view> most_used[] = {
    {"solve", "--robot --start --goal --clearance --planner --samples --optimise --explain --picture --json"},
    {"render", "--output --answer --animate --show --heading --size --dpi --title --world --budget"},
    {"export", "--output --unchecked --frame --world --show --heading --size --dpi --title --budget"},
    {"generate", "--output --algorithm --loops --unit-walls --corners --seed --show --size --title --budget"},
    {"build", "--output --planner --sampler --samples --neighbours --radius --robot --clearance --index --budget"},
    {"query", "--start --goal --batch --matrix --lengths-only --csv --optimise --explain --picture --json"},
    {"compare", "--planners --sampler --samples --neighbours --seeds --searches --queues --picture --html --table"},
    {"largest", "--budget --precision --max-size --seeds --planner --sampler --pipeline --threads --json --picture"},
    {"profile", "--runs --planner --sampler --samples --neighbour-index --start --goal --threads --json --picture"},
    {"scale", "--sizes --threads --planners --samplers --seeds --repeats --budget --json --csv --html"}};

}  // namespace

std::vector<HelpExample> help_examples(std::string_view verb) {
  const std::string begins = verb.empty() ? "warren " : fmt::format("warren {} ", verb);
  std::vector<HelpExample> some;
  for (std::string_view left = example_lines; !left.empty();) {
    const std::string_view line = left.substr(0, left.find('\n'));
    left.remove_prefix(line.size() + 1);
    const std::size_t mark = line.find(" # ");
    if (line.starts_with(begins)) some.push_back({line.substr(0, mark), line.substr(mark + 3)});
  }
  return some;
}

std::string_view most_used_options(std::string_view verb) {
  for (const auto& [name, options] : most_used) {
    if (name == verb) return options;
  }
  return {};
}

}  // namespace warren::tools
