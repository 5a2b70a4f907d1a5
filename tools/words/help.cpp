// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"

namespace warren::tools {
namespace {

constexpr std::size_t left_width = 30;  // of options and verbs
constexpr std::size_t narrowest = 60;

/// Broken at blanks into lines from `indent` on, but for the first, which goes on where the text stands.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
  const std::size_t room = std::max(width, indent + 30) - indent;
  std::string out;
  std::size_t column = 0;
  for (const std::string& word : words_of(text)) {
    if (column > 0 && column + 1 + word.size() > room) {
      out.append("\n").append(indent, ' ');
      column = 0;
    }
    out.append(column > 0 ? " " : "").append(word);
    column += (column > 0 ? 1 : 0) + word.size();
  }
  return out + '\n';
}

/// Two columns; what is too wide for the left one has a line of its own.
std::string entry(std::string_view left, std::string_view right, std::size_t width) {
  std::string text = fmt::format("  {:<{}}", left, left_width - 2);
  if (left.size() + 4 > left_width) text.append("\n").append(left_width, ' ');
  return text + wrapped(right, left_width, width);
}

std::string option_entry(const OptionSpec& option, std::size_t width) {
  std::string text{option.help};
  if (!option.choices.empty()) text.append(option.is_list ? "; of: " : "; one of: ").append(option.choices);
  return entry(option_usage(option), text, width);
}

/// The options that are wanted, a text each with the verbs that have it so.
template <class IsWanted>
std::string options_with_verbs(std::span<const Command> commands, std::size_t width, const IsWanted& is_wanted) {
  std::vector<std::pair<std::string, std::string>> entries;  // text, verbs
  for (const Command& command : commands) {
    for (const OptionSpec& option : command.options) {
      if (!is_wanted(command, option)) continue;
      const std::string text = option_entry(option, width);
      auto known = std::find_if(entries.begin(), entries.end(), [&](const auto& each) { return each.first == text; });
      if (known == entries.end()) known = entries.insert(known, {text, "in: warren"});
      known->second.append(" ").append(command.name);
    }
  }
  std::string text;
  for (const auto& [option, verbs] : entries) text += option + entry("", verbs, width);
  return text;
}

/// Options of that name, then those that take it as a value, in any letter case. Blanks and _ are as good as -.
std::string options_about(std::string_view asked, std::span<const Command> commands, std::size_t width) {
  std::string word{asked};
  for (char& c : word) c = c == ' ' || c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string name = word.starts_with('-') ? word : "--" + word;
  const auto has_name = [&](const Command& command, const OptionSpec& option) {
    return &option == option_named(command, name);
  };
  const auto takes_it = [&](const Command& command, const OptionSpec& option) {
    return !has_name(command, option) && is_among(word, option.choices);
  };
  return options_with_verbs(commands, width, has_name) + options_with_verbs(commands, width, takes_it);
}

std::string build_compiler() {
#ifdef __clang__
  const std::string compiler = fmt::format("clang++ {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  const std::string compiler = fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
  return fmt::format("{}, {}", compiler, WARREN_BUILD_TYPE);
}

/// "x86-64; used here: avx2": what the code needs, and what it takes beside that where the processor has it.
std::string build_instruction_sets() {
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  std::string text = "x86-64";
#if defined(__AVX512F__)
  text += " with avx512";
#elif defined(__AVX2__)
  text += " with avx2";
#endif
  const bool avx2 = __builtin_cpu_supports("avx2") != 0;
  const bool avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0;
  return text + fmt::format("; used on this processor: sse2{}{}", avx2 ? ", avx2" : "", avx512 ? ", avx512" : "");
#elif defined(__x86_64__)
  return "x86-64, plain code alone";
#elif defined(__aarch64__)
  return "arm64, plain code alone";
#else
  return "plain code alone";
#endif
}

/// What stands in none is the verb's own.
constexpr std::string_view own = "Options";
constexpr std::pair<std::string_view, std::string_view> option_groups[] = {
    {"Question",
     "--robot --start --goal --goal-pose --via --clearance --contact --map-rules --request --goal-tolerance "
     "--goal-region --visit --return --alternatives --stretch --keep-to --unless-gain"},
    {"Prices and areas", "--clearance-price --area --areas --speed-zones --keep-out --unknown"},
    {"Planner", "--planner --planners --seed"},
    {"Roadmaps of samples",
     "--sampler --samplers --samples --neighbours --radius --neighbour-index --attach --lazy --pipeline"},
    {"Trees", "--step --goal-bias --nodes --trees"},
    {"Better with time", "--iterations --gap --parts --bound"},
    {"Grids", "--cell --angles --headings --face-motion --step-cost --turn-cost --diagonal --layers"},
    {"Visibility graph, cells, medial axis", "--full --sampled-edges --doors --objective"},
    {"Cars", "--steering --turning-radius"},
    {"Search", "--search --searches --heuristic --queue --queues"},
    {"Shortening", "--optimise --cusp-cost --reverse-cost"},
    {"Mazes", "--algorithm --loops"},
    {"Outputs",
     "--output --picture --figures --curves --table --json --no-path --csv --runs --log --html --pictures --report "
     "--save-roadmap --keep --explain --show --heading --size --dpi --title"},
    {"Path as a file",
     "--path --every --speed --acceleration --lateral-acceleration --joint-speed --joint-acceleration --frame"},
    {"Run", "--threads --budget --memory --quiet --progress --color --trace --resume"},
};

constexpr std::pair<std::string_view, std::string_view> command_groups[] = {
    {"Paths", "solve verify render compare"},
    {"Roadmaps that are kept", "build query update export"},
    {"In the browser", "serve"},
    {"Worlds", "example generate info convert"},
    {"Measuring", "profile largest scale bench-scen"},
    {"Help", "help man completion"},
};

// What help has of all verbs beside their options: examples and what is used most, one table, since they share both.

constexpr std::string_view example_lines = R"(warren example # the worlds that there are
warren example flat # a map of three rooms
warren example parking-lot # a car
warren generate maze 41x41 --algorithm wilson -o maze.npy # a maze as an array
warren generate polygons 50 --seed 7 -o town.scene # a town of polygons
warren solve maze:41x41 --picture maze.svg --json answer.json # a maze, solved and drawn
warren solve flat.yaml --robot "disc 0.2" --start 0.5,0.5 --goal 4.3,0.5 # a disc on a map
warren solve town.scene --planner prm --neighbours star --samples 2000 # PRM* among polygons
warren solve parking-lot.scene --optimise --json drive.json # a car that parks
warren solve parking-lot.scene --path drive.yaml --speed 1.5 # the same path with times, for ROS
warren verify maze:41x41 answer.json # checks an answer that 'warren solve --json' wrote
warren render maze:41x41 --answer answer.json -o path.png # an answer as a picture
warren render parking-lot.scene --answer drive.json --animate -o drive.svg # the car drives
warren build maze:100x100,loops=0.01 -o maze.roadmap # a roadmap, to be asked by 'warren query'
warren build flat.yaml --planner voronoi -o axis.roadmap # the middles of a map's corridors
warren query maze.roadmap --start 1,1 --goal 80,80 # one question
warren query maze.roadmap --batch questions.csv --lengths-only # a file of questions: start_x,start_y,goal_x,goal_y on each line
warren update maze.roadmap maze:100x100,loops=0.02 -o new.roadmap # the maze has more loops now
warren export axis.roadmap -o route.geojson # a route graph for Nav2
warren export maze.roadmap -o maze.graphml # for NetworkX and others
warren info flat.yaml # what is in a map
warren info maze.roadmap --check all # checks every byte of a roadmap
warren convert maze.npy -o maze.walls # walls as text
warren convert town.scene --cell 0.2 -o town.map # polygons as cells
warren serve flat.yaml --robot "disc 0.2" # click start and goal in the browser
warren serve empty:20x10 --writable # draw a world of your own
warren compare maze:41x41 --planners prm,lazy-prm --seeds 20 # two planners, 20 runs each
warren compare town.scene --planners prm --samples 100,250 --picture k.svg # plots for two numbers of samples
warren compare maze:41x41,loops=0.2 --searches dijkstra,astar # two searches on the same graph
warren profile maze:99x99 --planner prm --picture stages.svg # what each stage costs
warren largest --budget 1s --max-size 500 # mazes that are solved within a second each
warren scale --sizes 50,100,200 --threads 1,2 --html scale.html # time against size and threads
warren bench-scen arena.map.scen # its map, arena.map, lies beside it
warren help solve # its options that are used most
warren help solve all # all of its options
warren help --clearance # one option, wherever it is
warren help footprint # a word that you know from elsewhere
warren man solve # the page of 'warren solve'
warren completion bash # the script for bash
)";

constexpr std::pair<std::string_view, std::string_view> most_used[] = {
    {"solve", "--robot --start --goal --clearance --planner --samples --optimise --explain --picture --json"},
    {"verify", "--robot --start --goal --clearance --contact --explain --json --budget"},
    {"convert", "--cell --request --map-rules --simplify --show --heading --size --title --budget"},
    {"render", "--output --answer --animate --show --heading --size --dpi --title --world --budget"},
    {"export", "--output --unchecked --frame --world --show --heading --size --dpi --title --budget"},
    {"generate", "--output --algorithm --loops --unit-walls --corners --seed --show --size --title --budget"},
    {"build", "--output --planner --sampler --samples --neighbours --radius --robot --clearance --index --budget"},
    {"query", "--start --goal --batch --matrix --lengths-only --csv --optimise --explain --picture --json"},
    {"compare", "--planners --sampler --samples --neighbours --seeds --searches --queues --picture --html --table"},
    {"largest", "--budget --precision --max-size --seeds --planner --sampler --pipeline --threads --json --picture"},
    {"profile", "--runs --planner --sampler --samples --neighbour-index --start --goal --threads --json --picture"},
    {"serve",
     "--port --listen --public-url --budget --writable --token-file --robot --clearance --clearance-price --keep-out"},
    {"scale", "--sizes --threads --planners --samplers --seeds --repeats --budget --json --csv --html"}};

// Words that nobody knows.

std::string small_letters(std::string_view word) {
  std::string letters{word.substr(std::min(word.find_first_not_of('-'), word.size()))};
  for (char& c : letters) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

constexpr std::pair<std::string_view, std::string_view> spellings[] = {
    {"--svg", "--picture"}, {"--optimize", "--optimise"}, {"--neighbors", "--neighbours"}, {"--colour", "--color"}};

/// Without what differs from one writer to the next.
std::string letters_of(std::string_view word) {
  std::string letters = small_letters(word);
  std::erase_if(letters, [](char c) { return std::string_view("-_ \\").find(c) != std::string_view::npos; });
  if (letters.ends_with("star")) letters.replace(letters.size() - 4, 4, "*");
  constexpr std::size_t shortest_plural = 4;
  if (letters.size() >= shortest_plural && letters.ends_with('s')) letters.pop_back();
  return letters;
}

struct NearRow {
  const OtherName* row = nullptr;
  std::string_view name;  ///< the one of its names that is meant
};

/// The first of the rows with the closest name that differs from the word in at most `most` letters.
NearRow row_near(std::string_view word, std::size_t most) {
  const std::string letters = letters_of(word);
  NearRow near;
  for (const OtherName& row : other_names()) {
    for (const std::string_view name : split(row.names, ", ")) {
      const std::string its = letters_of(name);
      const std::size_t distance = most == 0 ? its != letters : edit_distance(letters, its);
      if (distance > most || (near.row != nullptr && distance == most)) continue;
      near = {&row, name};
      most = distance;
      if (most == 0) return near;
    }
  }
  return near;
}

std::string plain(std::string_view text) {
  std::string words{text};
  std::erase_if(words, [](char c) { return c == '`' || c == '\\'; });
  return words;
}

}  // namespace

std::vector<OptionSpec> joined_options(std::initializer_list<std::span<const OptionSpec>> tables) {
  std::vector<OptionSpec> all;
  for (const std::span<const OptionSpec> table : tables) all.insert(all.end(), table.begin(), table.end());
  return all;
}

std::vector<OptionSpec> options_but(std::span<const OptionSpec> options,
                                    std::initializer_list<std::string_view> names) {
  std::vector<OptionSpec> others(options.begin(), options.end());
  std::erase_if(others, [&](const OptionSpec& option) { return std::ranges::count(names, option.name) > 0; });
  return others;
}

std::string option_usage(const OptionSpec& option) {
  std::string text = option.short_name.empty() ? "" : fmt::format("{}, ", option.short_name);
  text += option.name;
  if (!option.value.empty()) text.append(" ").append(option.value);
  return text + (option.is_list && option.value != "LIST" ? "[,...]" : "");
}

std::string_view meaning_of(std::string_view operand) {
  if (operand == "WORLD" || operand == "[WORLD]") {
    return "a file with walls, polygons, a map or a maze (its content decides), - for standard input, "
           "empty:WIDTHxHEIGHT, or maze:ROWSxCOLS[,seed=N][,algorithm=NAME][,loops=F]";
  }
  if (operand == "ROADMAP") return "a file that 'warren build' or 'warren solve --save-roadmap' has written";
  if (operand == "ANSWER.json") return "what 'warren solve --json' has written";
  if (operand == "FILE.scen") return "a scenario file of Moving AI";
  if (operand == "SHELL") return "bash, zsh or fish";
  if (operand == "FILE") return "a world or a roadmap";
  if (operand == "[COMMAND]") return "one of the commands of 'warren help'";
  if (operand == "[COMMAND|WORD]") return "a command, an option, or a word such as prm, footprint or timeout";
  if (operand == "[all|OPTION]") return "after a command: all of its options, or one of them";
  return {};
}

std::string program_help() {
  std::string text =
      "warren: finds paths among obstacles; each path that it prints has been checked by separate code\n"
      "\nUsage: warren COMMAND [operands] [options]\n";
  for (const auto& [title, commands] : grouped_commands()) {
    text += fmt::format("\n{}:\n", title);
    for (const Command* command : commands) text += fmt::format("  {:<12} {}\n", command->name, command->summary);
  }
  return text +
         "\n'warren help COMMAND' lists the options of a command, 'warren help WORD' explains an option, or a word\n"
         "that you know from elsewhere, and 'warren help all' prints everything. Try:\n\n"
         "  warren example parking-lot                  writes a world to try things on\n"
         "  warren solve maze:41x41 --picture maze.svg  makes a maze, solves it and draws it\n\n"
         "Exit codes: 0 success, 1 no path or refuted, 2 wrong options, 65 bad data, 66 unreadable input, 70 bug,\n"
         "73 unwritable output, 124 budget of time or memory reached, 129, 130 and 143 interrupted.\n";
}

std::string command_help(const Command& command, std::size_t width, bool all) {
  width = std::max(width, narrowest);
  const std::string_view used = all ? "" : most_used_options(command.name);
  const std::string operands = command.operands.empty() ? "" : fmt::format(" {}", command.operands);
  std::string text = fmt::format("warren {}: {}\n\nUsage: warren {}{} [options]\n", command.name, command.summary,
                                 command.name, operands);
  for (const std::string& operand : words_of(command.operands)) {
    if (const auto meaning = meaning_of(operand); !meaning.empty()) text += '\n' + entry(operand, meaning, width);
  }
  for (const auto& [title, options] : grouped_options(command)) {
    if (!used.empty()) break;
    text += fmt::format("\n{}:\n", title);
    for (const OptionSpec* option : options) text += option_entry(*option, width);
  }
  if (!used.empty()) text += fmt::format("\nMost used, of {} options:\n", command.options.size());
  for (const std::string& name : words_of(used)) {  // a command of warren-mpi may lack some of them
    if (const OptionSpec* option = option_named(command, name)) text += option_entry(*option, width);
  }
  text += '\n' + entry("--help [all]", used.empty() ? "this text" : "this text, or all options", width);
  text += "\nExamples:\n";
  for (const HelpExample& example : help_examples(command.name)) {
    text += fmt::format("  {}\n      {}\n", example.command, example.does);
  }
  return text;
}

std::string word_help(std::string_view word, std::span<const Command> commands, std::size_t width) {
  std::string text = options_about(word, commands, std::max(width, narrowest));
  if (const std::string here = other_name(word); !here.empty()) {
    text += wrapped(fmt::format("{}: {}.", word, here), 2, std::max(width, narrowest));
  }
  if (!text.empty()) return text;
  std::vector<std::string_view> known;
  std::set<std::string> choices;
  for (const Command& command : commands) {
    known.push_back(command.name);
    for (const OptionSpec& option : command.options) {
      known.push_back(option.name);
      for (const std::string& choice : words_of(option.choices)) choices.insert(choice);
    }
  }
  known.insert(known.end(), choices.begin(), choices.end());
  const std::string near = suggestion(word, known);
  throw UsageError(
      fmt::format("nothing is called {}{}", word, near.empty() ? "; docs/other_names.md lists words" : near));
}

std::string version_text(std::string_view commit) {
  return fmt::format(
      "warren " WARREN_VERSION
      "\ncommit {}\nbuilt by {}\nfor {}\nLicense BSD-3-Clause. There is no warranty, to the extent permitted by law.\n",
      commit, build_compiler(), build_instruction_sets());
}

Groups<OptionSpec> grouped_options(const Command& command) {
  Groups<OptionSpec> groups{{own, {}}};
  for (const auto& [title, names] : option_groups) groups.push_back({title, {}});
  for (const OptionSpec& option : command.options) {
    std::string_view title = option.group.empty() ? own : option.group;
    for (const auto& [of, names] : option_groups) {
      if (option.group.empty() && is_among(option.name, names)) title = of;
    }
    std::ranges::find(groups, title, [](const auto& group) { return group.first; })->second.push_back(&option);
  }
  std::erase_if(groups, [](const auto& group) { return group.second.empty(); });
  return groups;
}

Groups<Command> grouped_commands() {
  Groups<Command> groups;
  for (const auto& [title, names] : command_groups) {
    groups.push_back({title, {}});
    for (const Command& command : command_table()) {
      if (is_among(command.name, names)) groups.back().second.push_back(&command);
    }
  }
  return groups;
}

std::vector<HelpExample> help_examples(std::string_view verb) {
  const std::string begins = verb.empty() ? "warren " : fmt::format("warren {} ", verb);
  std::vector<HelpExample> some;
  for (const std::string_view line : split(example_lines, "\n")) {
    const std::size_t mark = line.find(" # ");
    if (line.starts_with(begins)) some.push_back({line.substr(0, mark), line.substr(mark + 3)});
  }
  return some;
}

std::string_view most_used_options(std::string_view verb) {
  const auto found = std::ranges::find(most_used, verb, [](const auto& each) { return each.first; });
  return found == std::end(most_used) ? std::string_view{} : found->second;
}

const std::vector<OtherName>& other_names() {
  static const std::vector<OtherName> rows = [] {  // "| NAMES | HERE. |" each, below the head
    std::vector<OtherName> all;
    for (const std::string_view row : split(other_names_page().front().bytes, "\n")) {
      const std::size_t bar = row.find(" | ");
      if (!row.starts_with("| ")) continue;
      all.push_back({row.substr(2, bar - 2), row.substr(bar + 3, row.rfind(". |") - bar - 3)});
    }
    all.erase(all.begin());
    return all;
  }();
  return rows;
}

std::string other_name(std::string_view word) {
  const NearRow found = row_near(word, 0);
  return found.row == nullptr ? std::string{} : plain(found.row->here);
}

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
  if (const std::string here = other_name(word); !here.empty()) return "; " + here;
  constexpr std::size_t longest = 64;  // nobody misspells an option at greater length
  const std::string letters = small_letters(word.substr(0, longest));
  std::string_view best;
  std::size_t best_distance = letters.size() / 3 + 1;
  for (const std::string_view candidate : known) {
    const std::string its = small_letters(candidate);
    const bool is_begun = letters.size() > 2 && its.starts_with(letters);
    const std::size_t distance = is_begun ? 1 : edit_distance(letters, its);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  if (!best.empty()) return "; did you mean " + std::string{best} + "?";
  const NearRow near = row_near(word.substr(0, longest), letters.size() / 4);
  return near.row == nullptr ? "" : "; did you mean " + plain(near.name) + "? " + plain(near.row->here);
}

std::string_view own_spelling(std::string_view option) {
  for (const auto& [other, ours] : spellings) {
    if (option == other) return ours;
  }
  return option;
}

}  // namespace warren::tools
