// SPDX-License-Identifier: BSD-3-Clause
// warren compare: planners side by side on a world over many seeds, or searches and queues side by side on a world's
// graph and on random graphs of many sizes.

#include "tools/verbs/cmd_compare.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>

#include "apps/studies/comparison_report.hpp"
#include "apps/studies/contest_pictures.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/layers/draw_bodies.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec compare_output_specs[] = {
    {"--budget", "TIME", "most time for each run of a planner or a search (default: none)"},
    {"--json", "FILE", "write all figures as JSON; - is standard output"},
    {"--csv", "FILE", "write a line for each planner or search, as CSV; - is standard output"},
    {"--html", "FILE", "write a page of tables and plots that needs no network; - is standard output"},
    {"--runs", "FILE", "write a line for each run, as CSV; - is standard output"},
    {"--picture", "FILE",
     "plot times against size, or the share solved against time and box plots, as .svg, .png or .pdf by ending; - is "
     "standard output"},
    {"--curves", "FILE",
     "plot what planners' best paths cost against time, and the share solved, as .svg, .png or .pdf by ending; .csv: "
     "write each path that was the best so far"},
    {"--figures", "FILE", "write each plot of --picture as its own file: k.pdf gives k-length.pdf and others"},
    {"--table", "FILE", "write the table for a document, as LaTeX (.tex) or else Markdown; - is standard output"},
    {"--log", "FILE", "write every run as OMPL's benchmarks do; - is standard output"},
};

/// Throws unless every output can be written.
void check_outputs_of_compare(const Arguments& arguments) {
  check_reports(arguments,
                {"--json", "--csv", "--runs", "--picture", "--html", "--log", "--table", "--figures", "--curves"});
  check_plots(arguments);
  if (arguments.has("--curves") && !arguments.has("--planners")) {
    throw UsageError("--curves: shows how planners get better with time; say --planners, too");
  }
  if (const auto folder = arguments.value("--pictures")) studies::make_folder(*folder);
  if (arguments.has("--log") && arguments.has("--sizes")) {
    throw UsageError("--log: holds the runs on one world; --sizes has many graphs");
  }
}

std::optional<Outcome> compare_within(const Arguments& arguments, CompareOptions& options, const Run& run,
                                      studies::Comparison& comparison) {
  std::optional<Scene> scene;
  try {
    if (options.world) scene = load_world(*options.world, arguments, run.execution());
    if (options.planners) {
      for (studies::PlannerContender& asked : options.planners->contenders) {
        read_asked_files(asked.question, arguments, run.execution());
      }
    }
  } catch (const Stopped& stopped) {
    comparison.stopped = stopped.reason;
    return std::nullopt;
  }
  return run_comparison(options, scene ? &*scene : nullptr, run.execution(), comparison,
                        [&](std::string_view line) { run.note(line); });
}

studies::OmplExperiment experiment_of(const Arguments& arguments, const CompareOptions& options,
                                      const Execution& execution, std::chrono::system_clock::time_point begin) {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host.fill('\0');
  std::string name = "compare_" + options.world.value_or("");
  for (char& c : name) c = c == ' ' || c == '\t' ? '_' : c;
  return {.name = std::move(name),
          .hostname = host[0] == '\0' ? "unknown" : std::string(host.data()),
          .date = fmt::format("{:%Y-%b-%d %H:%M:%S}", fmt::localtime(std::chrono::system_clock::to_time_t(begin))),
          .setup = arguments.command_line(),
          .seed = options.planners ? options.planners->first_seed : 1,
          .budget_s = std::isfinite(options.searches.budget_s) ? options.searches.budget_s : 0.0,
          .memory_mb = execution.deadline->memory_bytes() >> 20,
          .total_s = std::chrono::duration<double>(std::chrono::system_clock::now() - begin).count()};
}

/// A comparison in which nobody found a path has no answer; one whose planners succeed now and then is what was asked.
int exit_code(const studies::Comparison& comparison, bool has_graph) {
  if (comparison.stopped) return exit_code_of(*comparison.stopped);
  bool any_solved = false;
  for (const studies::Contender& contender : comparison.contenders) {
    for (const studies::ComparedRun& run : contender.runs) {
      if (run.outcome == Outcome::stopped) return exit_code::budget;
      any_solved = any_solved || run.solved();
    }
  }
  return any_solved && has_graph ? exit_code::success : exit_code::no_path;
}

int compare(const Arguments& arguments) {
  CompareOptions options = compare_options(arguments);
  check_outputs_of_compare(arguments);
  const auto begin = std::chrono::system_clock::now();
  // The runs are counted, and those of all take turns; of graphs of several sizes, and of pictures, nobody knows.
  static constexpr ExpectedStage runs[] = {{"compare", 1.0}};
  const bool more_follows = arguments.has("--sizes") || arguments.has("--pictures");
  Run run(arguments, RunScope::each_run, more_follows ? ExpectedStages{} : ExpectedStages(runs));
  studies::Comparison comparison;
  const auto no_graph = compare_within(arguments, options, run, comparison);
  run.end();
  if (arguments.has("--picture") || arguments.has("--figures") || arguments.has("--html")) {
    for (std::string note : {studies::note_on_heat_maps(comparison), studies::note_on_box_plots(comparison)}) {
      if (!note.empty()) comparison.notes.push_back(std::move(note));
    }
  }
  const bool was_stopped = comparison.stopped.has_value();
  write_report(arguments, "--json", [&] { return studies::comparison_json(comparison); });
  write_report(arguments, "--csv", [&] { return studies::comparison_csv(comparison); });
  write_report(arguments, "--runs", [&] { return studies::comparison_runs(comparison); });
  write_plots(arguments, run.execution(), was_stopped, [&] { return studies::comparison_plots(comparison); });
  if (arguments.value("--curves").value_or("").ends_with(".csv")) {
    write_report(arguments, "--curves", [&] { return studies::comparison_curves(comparison); });
  } else {
    const auto curves = [&] { return PlotsPage{studies::curve_panels(comparison), 2}; };
    write_plots(arguments, run.execution(), was_stopped, curves, "--curves");
  }
  write_report(arguments, "--html", [&] { return studies::comparison_page(comparison, arguments.command_line()); });
  write_report(arguments, "--table",
               [&] { return studies::comparison_document(comparison, ending_of(*arguments.value("--table"))); });
  write_report(arguments, "--log", [&] {
    return studies::ompl_log(comparison, experiment_of(arguments, options, run.execution(), begin));
  });
  run.conclude([&] { return studies::comparison_summary(comparison, run.palette()); }, comparison.stopped);
  return exit_code(comparison, !no_graph);
}

/// The options of `solve` that take a list here, apart by commas, in the order in which they are dealt.
constexpr Option listed[] = {Option::search,    Option::queue,       Option::heuristic, Option::sampler,
                             Option::samples,   Option::neighbours,  Option::radius,    Option::neighbour_index,
                             Option::pipeline,  Option::cell,        Option::angles,    Option::step_cost,
                             Option::turn_cost, Option::diagonal,    Option::layers,    Option::sampled_edges,
                             Option::doors,     Option::objective,   Option::step,      Option::goal_bias,
                             Option::nodes,     Option::trees,       Option::steering,  Option::turning_radius,
                             Option::cusp_cost, Option::reverse_cost};

/// Another flag that gives the list; empty: none.
std::string_view list_flag(Option option) {
  return option == Option::search    ? "--searches"
         : option == Option::queue   ? "--queues"
         : option == Option::sampler ? "--samplers"
                                     : "";
}
constexpr std::string_view clearance = "--clearance";

bool is_list(const Arguments& arguments, std::string_view option) {
  return arguments.value(option).value_or("").find(',') != std::string::npos;
}

/// Options with one value go to all contenders, those with several are dealt. Without --planners one graph is searched,
/// which has one value each and leaves searches and queues to others. Throws UsageError.
studies::PlannerDeal deal_words(const Arguments& arguments, std::vector<PlannerKind> planners) {
  const bool is_one_graph = !arguments.has("--planners");
  for (const std::string_view option : {"--neighbours", "--radius"}) {
    if (!arguments.has("--neighbours") || !arguments.has("--radius") || !is_list(arguments, option)) continue;
    throw UsageError(fmt::format("{}: milestones are joined by --neighbours or by --radius; give one of them", option));
  }
  studies::PlannerDeal deal;
  deal.planners = std::move(planners);
  std::vector<std::string_view> taken{"--seed"};
  for (const Option option : listed) {
    const bool left_to_others = option == Option::search || option == Option::queue;
    if (is_one_graph && left_to_others) continue;
    const std::string_view flag = option_flag(option);
    const bool named_list = arguments.has(list_flag(option));
    if (named_list) arguments.refuse({flag}, fmt::format("{} gives it, too", list_flag(option)));
    const std::string_view name = named_list ? list_flag(option) : flag;
    const auto text = arguments.value(name);
    const bool always = named_list || option == Option::samples;  // which "auto" is no option of, but a value
    if (!text || (!always && !is_list(arguments, name))) continue;
    studies::DealtOption& dealt = deal.lists.emplace_back(studies::DealtOption{option, {}});
    for (const std::string& word : list_value(name, *text)) {
      dealt.values.push_back({word, solve_words(Arguments::of(flag, word))});
    }
    taken.push_back(flag);
    if (is_one_graph && dealt.values.size() > 1) {
      throw UsageError(fmt::format("{}: searches run on one graph; give one value", flag));
    }
  }
  if (is_list(arguments, clearance)) {
    if (is_one_graph) throw UsageError("--clearance: searches run on one graph; give one value");
    deal.clearances = given_values(arguments, clearance, clearance, [](std::string_view option, std::string_view word) {
      return number_value(option, word, 0.0, largest_coordinate);
    });
    taken.push_back(clearance);
  }
  const Arguments shared = arguments.without(taken);
  deal.question = question_words(shared);
  deal.common = solve_words(shared);
  check_not_written(arguments, deal.question.robot, deal.question.prices);
  return deal;
}

constexpr std::array<std::string_view, 1> peer_words{"boost"};
constexpr std::uint64_t most_runs = 1'000'000;
constexpr std::uint64_t usual_seeds = 10;
constexpr std::uint64_t usual_graphs = 3;

constexpr OptionSpec own_specs[] = {
    {"--planners", "LIST",
     "planners to compare, separated by commas. Their options may list values, too, and each combination runs. Without "
     "it searches are compared"},
    {"--searches", "LIST",
     "searches to compare, separated by commas (default: all four; with --planners: as 'solve' chooses)",
     choices_of<SearchKind>},
    {"--queues", "LIST",
     "queues to compare, separated by commas (default: all five; with --planners: as 'solve' chooses)",
     choices_of<studies::QueuePolicy>},
    {"--trials", "N|auto",
     "how often each search is timed (default: auto, 5 to 10000 times, about 0.25 s each). With --planners: as "
     "--seeds, but planners that use no seed run as often"},
    {"--peer", "NAME", "time the searches of another library, too, on the same graph", "boost"},
    {"--graph", "NAME", "the planner whose graph is searched (default: prm; among polygons visibility)"},
    {"--sizes", "LIST", "search random geometric graphs with so many vertices, separated by commas; needs no WORLD"},
    {"--degree", "D", "with --sizes: how many neighbours a vertex has on average (default: 20)"},
    {"--seeds", "N",
     "with --planners: how often each runs, each time with the next seed (default: 10); a planner that uses no seed "
     "runs once. With --sizes: how many graphs of each size (default: 3)"},
    {"--samplers", "LIST", "the same as --sampler with a list", choices_of<SamplerKind>},
    {"--samples", "LIST", "numbers of samples, or auto, separated by commas"},
    {"--seed", "N", "the first seed (default: 1)"},
    {"--parallel", "",
     "with --planners: several runs at once, each on one thread; all figures but the times stay the same"},
    {"--pictures", "FOLDER",
     "draw into this folder: of searches the graph with all their paths; of planners each one's path of median length "
     "with the body along it, all these paths in one picture, and the layers of grid"},
};

std::vector<OptionSpec> passed_specs() {
  return joined_options({options_but(solve_option_specs(), {"--planner", "--seed", "--samples"}),
                         question_option_specs(), price_option_specs()});
}

std::uint64_t count_or(const Arguments& arguments, std::string_view option, std::uint64_t usual) {
  return given_value(arguments, option, count_value, std::uint64_t{1}, most_runs).value_or(usual);
}

std::uint64_t first_seed(const Arguments& arguments) {
  constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max() - most_runs;
  return given_value(arguments, "--seed", count_value, std::uint64_t{0}, last).value_or(1);
}

studies::PlannerContestOptions contest_options(const Arguments& arguments) {
  arguments.refuse({"--sizes", "--degree", "--peer", "--graph"},
                   "compares searches, and --planners compares planners; give one of the two");
  if (arguments.has("--trials") && arguments.has("--seeds")) {
    throw UsageError("--trials: with --planners the same as --seeds; give one of the two");
  }
  const auto planners = given_values(arguments, "--planners", "--planner", choice_value<PlannerKind>);
  studies::PlannerContestOptions options;
  options.contenders = studies::deal_planners(deal_words(arguments, planners));
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
  const auto queues = choices(arguments, "--queues", EnumSet<studies::QueuePolicy>::all().members());
  const auto peer = arguments.value("--peer");
  if (peer) choice_value("--peer", *peer, peer_words);
  std::vector<studies::SearchVariant> variants;
  for (const SearchKind search : searches) {
    if (!has_queue(search)) variants.push_back({search, std::nullopt, studies::SearchLibrary::warren});
    for (const studies::QueuePolicy queue : queues) {
      if (has_queue(search)) variants.push_back({search, queue, studies::SearchLibrary::warren});
    }
    if (peer) variants.push_back({search, std::nullopt, studies::SearchLibrary::boost});
  }
  if (std::ranges::none_of(searches, has_queue)) {
    arguments.refuse({"--queues"}, "bfs and dfs have no priority queue; astar and dijkstra take one");
  }
  return variants;
}

std::optional<studies::SizeSweepOptions> sweep_options(const Arguments& arguments) {
  constexpr double most_degree = 1e6;
  constexpr std::uint64_t most_size = std::uint64_t{1} << 31;
  if (!arguments.has("--sizes")) {
    arguments.refuse({"--degree"}, "is about the random graphs of --sizes");
    arguments.refuse({"--seeds"}, "counts the runs of --planners, or the random graphs of --sizes");
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

/// Options of the world's graph; checked for the planners that may make it, so far as that needs no world.
void take_graph_options(const Arguments& arguments, CompareOptions& options) {
  arguments.refuse({"--optimise", "--pipeline", "--lazy"}, "changes no graph; --planners compares planners with it");
  arguments.refuse({"--search"}, "searches are compared; say --searches");
  arguments.refuse({"--heuristic"}, "is compared by --planners prm --heuristic euclidean,manhattan");
  arguments.refuse({"--queue"}, "queues are compared; say --queues");
  options.graph = given_choice<PlannerKind>(arguments, "--graph");
  studies::PlannerDeal& deal = options.graph_deal;
  deal = deal_words(arguments, options.graph ? std::vector{*options.graph} : planners_there_are());
  deal.common.seed = first_seed(arguments);
  studies::deal_planners(deal);
}

/// What is wrong with the planner of one run is wrong with the list.
std::string about_planners(const UsageError& error) {
  std::string text = error.spelled("@", '_');
  constexpr std::string_view one = "@planner:";
  if (text.starts_with(one)) text.replace(0, one.size(), "@planners:");
  return text;
}

void add_pictures(studies::Comparison& comparison, const std::string& folder, std::vector<std::string> notes) {
  comparison.notes.push_back("pictures: " + folder);
  std::move(notes.begin(), notes.end(), std::back_inserter(comparison.notes));
}

/// Planners that take no prices are left out where others take them, and a note says why.
studies::PlannerContestOptions priced_contest(const Scene& scene, studies::PlannerContestOptions contest,
                                              studies::Comparison& comparison) {
  std::optional<UsageError> refused;
  std::erase_if(contest.contenders, [&](studies::PlannerContender& asked) {
    if (asked.question.prices.empty()) return false;
    try {
      choose_solver(asked.options, scene, asked.question);
      return false;
    } catch (const UsageError& error) {
      refused.emplace(error);
      comparison.notes.push_back(fmt::format("left out: {}", error.what()));
      return true;
    }
  });
  if (contest.contenders.empty()) throw UsageError(about_planners(*refused));
  return contest;
}

void compare_planners(const Scene& scene, const CompareOptions& options, const Execution& execution,
                      studies::Comparison& comparison) {
  const studies::PlannerContestOptions contest = priced_contest(scene, *options.planners, comparison);
  std::optional<Scene> copy;
  const RobotKind body = robot_of(scene, contest.contenders.front().question).kind;
  // Bodies that turn plan among a map's borders, and pictures show them.
  const bool shows_borders = !options.pictures.empty() || (body != RobotKind::point && body != RobotKind::disc);
  const Scene& world = scene.map && shows_borders ? with_map_walls(scene, copy, execution) : scene;
  try {
    studies::run_planner_contest(world, contest, execution, comparison);
  } catch (const UsageError& error) {
    throw UsageError(about_planners(error));
  }
  if (options.pictures.empty()) return;
  add_pictures(comparison, options.pictures,
               studies::draw_contest(world, contest, comparison, options.pictures, options.look, execution));
}

/// The planner that was asked for, else the one that `solve` would take (prm for lazy-prm), with those of the options
/// that it takes.
SolveOptions graph_options(const CompareOptions& options, const Scene& scene) {
  studies::PlannerDeal deal = options.graph_deal;
  if (!options.graph) {
    SolveOptions all = deal.common;
    for (const studies::DealtOption& list : deal.lists) copy_option(list.option, all, list.values.front().value);
    const PlannerKind usual = choose_solver(all, scene, deal.question).planner;
    deal.planners = {usual == PlannerKind::lazy_prm ? PlannerKind::prm : usual};
  }
  SolveOptions graph = studies::deal_planners(deal).front().options;
  if (graph.planner == PlannerKind::prm) graph.roadmap.pipeline = PipelineKind::plain;  // tiles leave no roadmap
  return graph;
}

std::optional<Outcome> compare_searches(const CompareOptions& options, const Scene& scene, const Execution& execution,
                                        studies::Comparison& comparison,
                                        const std::function<void(std::string_view)>& note) {
  const Deadline deadline(execution.deadline, options.searches.budget_s);
  Execution within = execution;
  within.deadline = &deadline;
  const studies::WorldGraph made =
      studies::world_graph(scene, options.graph_deal.question, graph_options(options, scene), within);
  if (made.graph.at.empty()) {
    comparison.notes.push_back(fmt::format("{}: {}", scene.source, name_of(made.outcome)));
    return made.outcome;
  }
  note(fmt::format("{}: {} vertices, {} edges, {} searches", scene.source, made.graph.graph.vertex_count(),
                   made.graph.graph.edge_count(), options.searches.variants.size()));
  studies::run_search_contest(made.graph, options.searches, execution, comparison);
  if (options.pictures.empty()) return std::nullopt;
  add_pictures(comparison, options.pictures,
               studies::draw_searches(scene, made.graph, options.searches, options.pictures, options.look, execution));
  return std::nullopt;
}

}  // namespace

Command compare_command() {
  return {"compare", "[WORLD]", "measure planners, or searches and their queues, side by side",
          joined_options({compare_option_specs(), world_option_specs(), compare_output_specs,
                          options_but(run_option_specs(), {"--budget"})}),
          compare};
}

std::vector<OptionSpec> compare_option_specs() {
  std::vector<OptionSpec> specs(std::begin(own_specs), std::end(own_specs));
  for (OptionSpec& spec : specs) {
    if (spec.name == "--graph" || spec.name == "--planners") spec.choices = planner_names();
    spec.is_list = spec.value == "LIST";
  }
  specs = joined_options({specs, picture_option_specs(), passed_specs()});
  for (const Option option : listed) std::ranges::find(specs, option_flag(option), &OptionSpec::name)->is_list = true;
  return specs;
}

CompareOptions compare_options(const Arguments& arguments) {
  CompareOptions options;
  if (arguments.operand_count() > 0) options.world = arguments.operand(0);
  if (!options.world && (arguments.has("--planners") || !arguments.has("--sizes"))) {
    throw UsageError("WORLD is missing; only --sizes, on random graphs, needs none");
  }
  options.searches.budget_s = given_value(arguments, "--budget", duration_value).value_or(options.searches.budget_s);
  first_seed(arguments);
  if (arguments.has("--planners")) {
    options.planners = contest_options(arguments);
    options.planners->budget_s = options.searches.budget_s;
  }
  options.pictures = arguments.value("--pictures").value_or("");
  options.look = picture_words(arguments, arguments.has("--pictures"), "--pictures FOLDER");
  if (options.planners) return options;
  arguments.refuse({"--parallel"}, "runs --planners beside each other; searches are timed one by one");
  options.searches.variants = variants_of(arguments);
  options.searches.trials = given_value(arguments, "--trials", auto_or_count_value, std::uint64_t{1}, most_runs);
  options.sweep = sweep_options(arguments);
  if (options.sweep) options.sweep->contest = options.searches;
  if (options.world) {
    take_graph_options(arguments, options);
  } else {
    constexpr std::string_view why = "is about a world; give WORLD, too";
    arguments.refuse(passed_specs(), why);
    arguments.refuse({"--graph", "--samplers", "--samples", "--map-rules", "--request", "--pictures"}, why);
  }
  return options;
}

std::optional<Outcome> run_comparison(const CompareOptions& options, const Scene* scene, const Execution& execution,
                                      studies::Comparison& comparison,
                                      const std::function<void(std::string_view)>& note) {
  std::optional<Outcome> no_graph;
  if (scene != nullptr && options.look.heading) {
    check_has_headings(robot_of(
        *scene, options.planners ? options.planners->contenders.front().question : options.graph_deal.question));
  }
  try {
    if (scene != nullptr && options.planners) compare_planners(*scene, options, execution, comparison);
    if (scene != nullptr && !options.planners) {
      no_graph = compare_searches(options, *scene, execution, comparison, note);
    }
    if (options.sweep) studies::run_size_sweep(*options.sweep, execution, comparison, note);
  } catch (const Stopped& stopped) {
    comparison.stopped = stopped.reason;
  }
  return no_graph;
}

}  // namespace warren::tools
