// SPDX-License-Identifier: BSD-3-Clause
#include "tools/verbs/compare_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/base/error.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/question.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 4> search_words{"astar", "dijkstra", "bfs", "dfs"};
constexpr std::array<std::string_view, 5> queue_words{"heap", "lazy-heap", "sorted-array", "resorted-array",
                                                      "linear-scan"};
constexpr std::array<std::string_view, 1> peer_words{"boost"};
constexpr std::uint64_t most_runs = 1'000'000;
constexpr std::uint64_t usual_seeds = 10;
constexpr std::uint64_t usual_graphs = 3;

constexpr OptionSpec own_specs[] = {
    {"--planners", "LIST", "planners of 'solve', apart by commas; without it searches are compared"},
    {"--searches", "LIST",
     "of astar, dijkstra, bfs, dfs, apart by commas (default: all four; with --planners: as 'solve' chooses)"},
    {"--queues", "LIST",
     "of heap, lazy-heap, sorted-array, resorted-array, linear-scan, apart by commas (default: all five; with "
     "--planners: as 'solve' chooses)"},
    {"--trials", "N|auto",
     "how often each search is timed (default: auto, 5 to 10000 times, about 0.25 s each); with --planners the same "
     "as --seeds"},
    {"--peer", "NAME", "the searches of another library on the same graph, too", "boost"},
    {"--graph", "NAME", "the planner of 'solve' whose graph is searched (default: prm; among polygons visibility)"},
    {"--sizes", "LIST", "search random geometric graphs of so many vertices, apart by commas; needs no WORLD"},
    {"--degree", "D", "neighbours of a vertex of those graphs, on average (default: 20)"},
    {"--seeds", "N",
     "with --planners: runs of each planner, with seeds from --seed on (default: 10); with --sizes: graphs of each "
     "size (default: 3)"},
    {"--samplers", "LIST", "samplers of 'solve', apart by commas; with --planners each takes each"},
    {"--samples", "LIST", "numbers of samples, or auto, apart by commas; with --planners each takes each"},
    {"--seed", "N", "the first seed (default: 1)"},
    {"--pictures", "FOLDER",
     "with --planners: draw each planner's path of median length, the body along it, and the layers of the grid"},
};

/// Of all planners of this version, blank-separated.
std::string_view planner_names() { return solver_option_specs().front().choices; }

/// Options of `solve` that are dealt out by lists, and the lists' names.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> lists{
    {{"--search", "--searches"}, {"--queue", "--queues"}, {"--sampler", "--samplers"}, {"--samples", "--samples"}}};
/// Options of `solve` that a graph, or the searches of it, would ignore.
constexpr std::array<std::string_view, 3> not_of_graphs{"--optimise", "--pipeline", "--lazy"};

template <std::size_t N>
bool is_one_of(std::string_view name, const std::array<std::string_view, N>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The options of `solve` that compare takes as they are.
std::vector<OptionSpec> passed_specs() {
  std::vector<OptionSpec> specs = solver_option_specs();
  add_options(specs, problem_option_specs());
  std::erase_if(specs, [](const OptionSpec& spec) {
    const auto is_list = [&](const auto& list) { return spec.name == list.second; };
    return spec.name == "--planner" || spec.name == "--seed" || std::any_of(lists.begin(), lists.end(), is_list);
  });
  return specs;
}

std::vector<std::string> words_of(const Arguments& arguments, std::string_view option) {
  const auto text = arguments.value(option);
  return text ? list_value(option, *text) : std::vector<std::string>{};
}

std::uint64_t count_or(const Arguments& arguments, std::string_view option, std::uint64_t usual) {
  const auto text = arguments.value(option);
  return text ? count_value(option, *text, 1, most_runs) : usual;
}

std::uint64_t first_seed(const Arguments& arguments) {
  const auto text = arguments.value("--seed");
  return text ? count_value("--seed", *text, 0, std::numeric_limits<std::uint64_t>::max() - most_runs) : 1;
}

/// Throws where one of these is given; `why` says what takes them.
void refuse(const Arguments& arguments, std::initializer_list<std::string_view> options, std::string_view why) {
  for (const std::string_view option : options) {
    if (arguments.has(option)) throw UsageError(fmt::format("{}: {}", option, why));
  }
}

/// What is passed on to a `solve`; lists[i] becomes its singular, --searches and --queues only where `with_searches`.
PlannerDeal deal_of(const Arguments& arguments, bool with_searches) {
  PlannerDeal deal;
  for (const auto& [singular, list] : lists) {
    if (singular != list && arguments.has(list)) refuse(arguments, {singular}, fmt::format("{} gives it, too", list));
  }
  for (const OptionSpec& spec : passed_specs()) {
    if (const auto value = arguments.value(spec.name)) deal.common.emplace_back(spec.name, *value);
  }
  for (const auto& [singular, list] : lists) {
    const bool of_searches = singular == "--search" || singular == "--queue";
    if (!of_searches || with_searches) deal.lists.emplace_back(singular, words_of(arguments, list));
  }
  return deal;
}

PlannerContestOptions planner_options_of(const Arguments& arguments) {
  refuse(arguments, {"--sizes", "--degree", "--peer", "--graph"},
         "compares searches, and --planners compares planners; give one of the two");
  if (arguments.has("--trials") && arguments.has("--seeds")) {
    throw UsageError("--trials: with --planners the same as --seeds; give one of the two");
  }
  PlannerDeal deal = deal_of(arguments, true);
  deal.planners = words_of(arguments, "--planners");
  PlannerContestOptions options;
  options.contenders = deal_planners(deal);
  options.pictures = arguments.value("--pictures").value_or("");
  options.first_seed = first_seed(arguments);
  options.runs = count_or(arguments, arguments.has("--trials") ? "--trials" : "--seeds", usual_seeds);
  return options;
}

std::vector<std::uint64_t> choices(const Arguments& arguments, std::string_view option,
                                   std::span<const std::string_view> words, std::vector<std::uint64_t> usual) {
  const std::vector<std::string> given = words_of(arguments, option);
  if (given.empty()) return usual;
  std::vector<std::uint64_t> chosen;
  for (const std::string& word : given) chosen.push_back(choice_value(option, word, words));
  return chosen;
}

std::vector<SearchVariant> variants_of(const Arguments& arguments) {
  const auto searches = choices(arguments, "--searches", search_words, {2, 3, 1, 0});
  const auto queues = choices(arguments, "--queues", queue_words, {0, 1, 2, 3, 4});
  const auto peer = arguments.value("--peer");
  if (peer) choice_value("--peer", *peer, peer_words);
  std::vector<SearchVariant> variants;
  bool any_queue = false;
  for (const std::uint64_t search : searches) {
    const auto kind = static_cast<SearchKind>(search);
    any_queue = any_queue || has_queue(kind);
    if (!has_queue(kind)) variants.push_back({kind, std::nullopt, SearchLibrary::warren});
    for (const std::uint64_t queue : queues) {
      if (has_queue(kind)) variants.push_back({kind, static_cast<QueuePolicy>(queue), SearchLibrary::warren});
    }
    if (peer) variants.push_back({kind, std::nullopt, SearchLibrary::boost});
  }
  if (!any_queue) refuse(arguments, {"--queues"}, "bfs and dfs have no priority queue; astar and dijkstra take one");
  if (peer && !has_boost_graph()) graph_search({}, {SearchKind::bfs, std::nullopt, SearchLibrary::boost});  // says so
  return variants;
}

SearchContestOptions search_options(const Arguments& arguments) {
  SearchContestOptions options;
  options.variants = variants_of(arguments);
  if (const auto trials = arguments.value("--trials")) {
    options.trials = auto_or_count_value("--trials", *trials, 1, most_runs);
  }
  return options;
}

std::optional<SizeSweepOptions> sweep_options(const Arguments& arguments) {
  constexpr double most_degree = 1e6;
  constexpr std::uint64_t most_size = std::uint64_t{1} << 31;
  if (!arguments.has("--sizes")) {
    refuse(arguments, {"--degree"}, "is about the random graphs of --sizes");
    refuse(arguments, {"--seeds"}, "counts the runs of --planners, or the random graphs of --sizes");
    return std::nullopt;
  }
  SizeSweepOptions options;
  for (const std::string& word : words_of(arguments, "--sizes")) {
    options.sizes.push_back(static_cast<std::uint32_t>(count_value("--sizes", word, 2, most_size)));
  }
  std::sort(options.sizes.begin(), options.sizes.end());
  if (const auto text = arguments.value("--degree")) options.degree = number_value("--degree", *text, 0.1, most_degree);
  options.seeds = count_or(arguments, "--seeds", usual_graphs);
  options.first_seed = first_seed(arguments);
  return options;
}

/// What a world would take is refused where there is none.
void refuse_world_options(const Arguments& arguments) {
  constexpr std::string_view why = "is about a world; give WORLD, too";
  for (const OptionSpec& spec : passed_specs()) refuse(arguments, {spec.name}, why);
  refuse(arguments, {"--graph", "--samplers", "--samples", "--map-rules"}, why);
}

std::vector<std::string_view> blank_separated(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

/// Options of the world's graph; checked for the planners that may make it, so far as that needs no world.
void take_graph_options(const Arguments& arguments, CompareOptions& options) {
  for (const std::string_view option : not_of_graphs) {
    refuse(arguments, {option}, "changes no graph; --planners compares planners with it");
  }
  refuse(arguments, {"--search"}, "searches are compared; say --searches");
  refuse(arguments, {"--queue"}, "queues are compared; say --queues");
  std::vector<std::string_view> words = blank_separated(planner_names());
  if (const auto graph = arguments.value("--graph")) {
    options.graph = words[choice_value("--graph", *graph, words)];
    words = {options.graph};
  }
  options.graph_deal = deal_of(arguments, false);
  for (const auto& [option, values] : options.graph_deal.lists) {
    if (values.size() > 1) throw UsageError(fmt::format("{}: searches run on one graph; give one value", option));
  }
  options.graph_deal.planners.assign(words.begin(), words.end());
  if (const auto seed = arguments.value("--seed")) options.graph_deal.common.emplace_back("--seed", *seed);
  deal_planners(options.graph_deal);
}

}  // namespace

std::vector<OptionSpec> compare_option_specs() {
  std::vector<OptionSpec> specs(std::begin(own_specs), std::end(own_specs));
  for (OptionSpec& spec : specs) {
    if (spec.name == "--graph") spec.choices = planner_names();
  }
  add_options(specs, passed_specs());
  return specs;
}

CompareOptions compare_options(const Arguments& arguments) {
  CompareOptions options;
  if (arguments.operand_count() > 0) options.world = arguments.operand(0);
  if (!options.world && (arguments.has("--planners") || !arguments.has("--sizes"))) {
    throw UsageError("WORLD is missing; only --sizes, on random graphs, needs none");
  }
  if (const auto budget = arguments.value("--budget")) options.budget_s = duration_value("--budget", *budget);
  first_seed(arguments);
  if (arguments.has("--planners")) {
    options.planners = planner_options_of(arguments);
    options.planners->budget_s = options.budget_s;
    return options;
  }
  refuse(arguments, {"--pictures"}, "draws the paths of --planners");
  options.searches = search_options(arguments);
  options.searches.budget_s = options.budget_s;
  options.sweep = sweep_options(arguments);
  if (options.sweep) options.sweep->contest = options.searches;
  if (options.world) {
    take_graph_options(arguments, options);
  } else {
    refuse_world_options(arguments);
  }
  return options;
}

}  // namespace warren
