// SPDX-License-Identifier: BSD-3-Clause
#include "tools/verbs/compare_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/picture_words.hpp"
#include "tools/words/planner_words.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

// Which options of `solve` take lists in `warren compare`, and the contenders' deal that words make with them.

/// An option of `solve` that takes a list here, apart by commas.
struct ListOption {
  Option option;
  std::string_view name;
  std::string_view list = {};  ///< another name of it; empty: none
};

/// May planners take turns with several values of an option each, or is one graph searched, which has one value each
/// and leaves searches and queues to others?
enum class DealKind : std::uint8_t { planners, graph };

/// In the order in which they are dealt.
constexpr ListOption listed[] = {
    {Option::search, "--search", "--searches"},
    {Option::queue, "--queue", "--queues"},
    {Option::heuristic, "--heuristic"},
    {Option::sampler, "--sampler", "--samplers"},
    {Option::samples, "--samples"},
    {Option::neighbours, "--neighbours"},
    {Option::radius, "--radius"},
    {Option::neighbour_index, "--neighbour-index"},
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

/// Throws UsageError where one of these is given; `why` says what takes them.
void refuse(const Arguments& arguments, std::initializer_list<std::string_view> options, std::string_view why) {
  for (const std::string_view option : options) {
    if (arguments.has(option)) throw UsageError(fmt::format("{}: {}", option, why));
  }
}
std::span<const ListOption> list_options() { return listed; }
/// Options with one value go to all contenders, those with several are dealt. Throws UsageError.
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

constexpr std::array<std::string_view, 1> peer_words{"boost"};
constexpr std::uint64_t most_runs = 1'000'000;
constexpr std::uint64_t usual_seeds = 10;
constexpr std::uint64_t usual_graphs = 3;

constexpr OptionSpec own_specs[] = {
    {"--planners", "LIST",
     "planners of 'solve', apart by commas; each runs with every combination of what its options list, apart by "
     "commas; "
     "without it searches are compared"},
    {"--searches", "LIST", "searches, apart by commas (default: all four; with --planners: as 'solve' chooses)",
     "astar dijkstra bfs dfs"},
    {"--queues", "LIST", "queues, apart by commas (default: all five; with --planners: as 'solve' chooses)",
     "heap lazy-heap sorted-array resorted-array linear-scan"},
    {"--trials", "N|auto",
     "how often each search is timed (default: auto, 5 to 10000 times, about 0.25 s each); with --planners as --seeds, "
     "and those whose answer no seed changes run as often"},
    {"--peer", "NAME", "the searches of another library on the same graph, too", "boost"},
    {"--graph", "NAME", "the planner of 'solve' whose graph is searched (default: prm; among polygons visibility)"},
    {"--sizes", "LIST", "search random geometric graphs of so many vertices, apart by commas; needs no WORLD"},
    {"--degree", "D", "neighbours of a vertex of those graphs, on average (default: 20)"},
    {"--seeds", "N",
     "with --planners: runs of each planner, with seeds from --seed on (default: 10), but one of those whose answer no "
     "seed changes; with --sizes: graphs of each size (default: 3)"},
    {"--samplers", "LIST", "samplers of 'solve', apart by commas, as --sampler",
     "uniform lattice halton random gaussian bridge mixture corridor cell-centres"},
    {"--samples", "LIST", "numbers of samples, or auto, apart by commas"},
    {"--seed", "N", "the first seed (default: 1)"},
    {"--parallel", "",
     "with --planners: runs beside each other on the threads, each on one; all figures but the times stay the same"},
    {"--pictures", "FOLDER",
     "draw the graph with the path of each search in one figure; with --planners each planner's path of median length, "
     "the body along it, the layers of the grid, and all paths in one"},
};

/// The options of `solve` that compare takes as they are.
std::vector<OptionSpec> passed_specs() {
  std::vector<OptionSpec> specs;
  add_options(specs, solve_option_specs(), {"--planner", "--seed", "--samples"});
  add_options(specs, question_option_specs());
  return specs;
}

std::uint64_t count_or(const Arguments& arguments, std::string_view option, std::uint64_t usual) {
  return given_value(arguments, option, count_value, std::uint64_t{1}, most_runs).value_or(usual);
}

std::uint64_t first_seed(const Arguments& arguments) {
  constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max() - most_runs;
  return given_value(arguments, "--seed", count_value, std::uint64_t{0}, last).value_or(1);
}

studies::PlannerContestOptions contest_options(const Arguments& arguments) {
  refuse(arguments, {"--sizes", "--degree", "--peer", "--graph"},
         "compares searches, and --planners compares planners; give one of the two");
  if (arguments.has("--trials") && arguments.has("--seeds")) {
    throw UsageError("--trials: with --planners the same as --seeds; give one of the two");
  }
  const auto planners = given_values(arguments, "--planners", "--planner", choice_value<PlannerKind>);
  studies::PlannerContestOptions options;
  options.contenders = studies::deal_planners(deal_words(arguments, planners, DealKind::planners));
  options.pictures = arguments.value("--pictures").value_or("");
  options.look = picture_words(arguments, arguments.has("--pictures"), "--pictures FOLDER");
  options.first_seed = first_seed(arguments);
  options.repeat_all = arguments.has("--trials");
  options.runs = count_or(arguments, options.repeat_all ? "--trials" : "--seeds", usual_seeds);
  options.parallel = arguments.has("--parallel");
  return options;
}

template <class E>
std::vector<E> choices(const Arguments& arguments, std::string_view list, std::vector<E> usual) {
  const std::vector<E> given = given_values(arguments, list, list, choice_value<E>);
  return given.empty() ? usual : given;
}

std::vector<studies::SearchVariant> variants_of(const Arguments& arguments) {
  const auto searches = choices<SearchKind>(
      arguments, "--searches", {SearchKind::bfs, SearchKind::dfs, SearchKind::dijkstra, SearchKind::astar});
  const auto queues = choices<studies::QueuePolicy>(
      arguments, "--queues",
      {studies::QueuePolicy::heap, studies::QueuePolicy::lazy_heap, studies::QueuePolicy::sorted_array,
       studies::QueuePolicy::resorted_array, studies::QueuePolicy::linear_scan});
  const auto peer = arguments.value("--peer");
  if (peer) choice_value("--peer", *peer, peer_words);
  std::vector<studies::SearchVariant> variants;
  bool any_queue = false;
  for (const SearchKind search : searches) {
    any_queue = any_queue || studies::has_queue(search);
    if (!studies::has_queue(search)) variants.push_back({search, std::nullopt, studies::SearchLibrary::warren});
    for (const studies::QueuePolicy queue : queues) {
      if (studies::has_queue(search)) variants.push_back({search, queue, studies::SearchLibrary::warren});
    }
    if (peer) variants.push_back({search, std::nullopt, studies::SearchLibrary::boost});
  }
  if (!any_queue) refuse(arguments, {"--queues"}, "bfs and dfs have no priority queue; astar and dijkstra take one");
  if (peer && !studies::has_boost_graph())
    studies::graph_search({}, {SearchKind::bfs, std::nullopt, studies::SearchLibrary::boost});  // says so
  return variants;
}

std::optional<studies::SizeSweepOptions> sweep_options(const Arguments& arguments) {
  constexpr double most_degree = 1e6;
  constexpr std::uint64_t most_size = std::uint64_t{1} << 31;
  if (!arguments.has("--sizes")) {
    refuse(arguments, {"--degree"}, "is about the random graphs of --sizes");
    refuse(arguments, {"--seeds"}, "counts the runs of --planners, or the random graphs of --sizes");
    return std::nullopt;
  }
  studies::SizeSweepOptions options;
  options.sizes = given_values(arguments, "--sizes", "--sizes", [](std::string_view option, std::string_view word) {
    return static_cast<std::uint32_t>(count_value(option, word, 2, most_size));
  });
  std::sort(options.sizes.begin(), options.sizes.end());
  options.degree = given_value(arguments, "--degree", number_value, 0.1, most_degree).value_or(options.degree);
  options.seeds = count_or(arguments, "--seeds", usual_graphs);
  options.first_seed = first_seed(arguments);
  return options;
}

/// What a world would take is refused where there is none.
void refuse_world_options(const Arguments& arguments) {
  constexpr std::string_view why = "is about a world; give WORLD, too";
  for (const OptionSpec& spec : passed_specs()) refuse(arguments, {spec.name}, why);
  refuse(arguments, {"--graph", "--samplers", "--samples", "--map-rules", "--pictures"}, why);
}

/// Options of the world's graph; checked for the planners that may make it, so far as that needs no world.
void take_graph_options(const Arguments& arguments, CompareOptions& options) {
  refuse(arguments, {"--optimise", "--pipeline", "--lazy"}, "changes no graph; --planners compares planners with it");
  refuse(arguments, {"--search"}, "searches are compared; say --searches");
  refuse(arguments, {"--heuristic"}, "is compared by --planners prm --heuristic euclidean,manhattan");
  refuse(arguments, {"--queue"}, "queues are compared; say --queues");
  options.graph = given_choice<PlannerKind>(arguments, "--graph");
  studies::PlannerDeal& deal = options.graph_deal;
  deal = deal_words(arguments, options.graph ? std::vector{*options.graph} : planners_there_are(), DealKind::graph);
  deal.common.seed = first_seed(arguments);
  studies::deal_planners(deal);
}

}  // namespace

std::vector<OptionSpec> compare_option_specs() {
  std::vector<OptionSpec> specs(std::begin(own_specs), std::end(own_specs));
  for (OptionSpec& spec : specs) {
    if (spec.name == "--graph" || spec.name == "--planners") spec.choices = planner_names();
    spec.is_list = spec.value == "LIST";
  }
  add_options(specs, picture_option_specs());
  add_options(specs, passed_specs());
  for (const ListOption& option : list_options()) {
    const auto same = [&](const OptionSpec& spec) { return spec.name == option.name; };
    std::find_if(specs.begin(), specs.end(), same)->is_list = true;
  }
  return specs;
}

CompareOptions compare_options(const Arguments& arguments) {
  CompareOptions options;
  if (arguments.operand_count() > 0) options.world = arguments.operand(0);
  if (!options.world && (arguments.has("--planners") || !arguments.has("--sizes"))) {
    throw UsageError("WORLD is missing; only --sizes, on random graphs, needs none");
  }
  options.budget_s = given_value(arguments, "--budget", duration_value).value_or(options.budget_s);
  first_seed(arguments);
  if (arguments.has("--planners")) {
    options.planners = contest_options(arguments);
    options.planners->budget_s = options.budget_s;
    return options;
  }
  options.pictures = arguments.value("--pictures").value_or("");
  options.look = picture_words(arguments, arguments.has("--pictures"), "--pictures FOLDER");
  refuse(arguments, {"--parallel"}, "runs --planners beside each other; searches are timed one by one");
  options.searches.variants = variants_of(arguments);
  options.searches.trials = given_value(arguments, "--trials", auto_or_count_value, std::uint64_t{1}, most_runs);
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

}  // namespace warren::tools
