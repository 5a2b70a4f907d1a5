// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/scaling_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "apps/studies/study_report.hpp"
#include "pictures/plots/plot.hpp"

namespace warren::studies {
namespace {

class ScalingStudy {
 public:
  ScalingStudy(const ScalingOptions& options, const Execution& execution,
               const std::function<void(std::string_view)>& note)
      : options_(options), execution_(execution), note_(note) {
    result_.no_hardware_counts = counters_.refusal();
  }

  ScalingResult run_all() {
    try {
      for (const auto& [rows, cols] : options_.sizes) {
        for (const std::uint64_t seed : options_.seeds) run_maze(rows, cols, seed);
      }
    } catch (const Stopped& stopped) {
      result_.signal = stopped.reason;
    }
    return std::move(result_);
  }

 private:
  void run_maze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed) {
    MazeOptions maze = options_.maze;
    maze.rows = rows;
    maze.cols = cols;
    maze.seed = seed;
    double generate_s = 0.0;
    const std::optional<Scene> scene = generated(maze, generate_s);
    if (!scene) return;
    const std::size_t first_run = result_.runs.size();
    for (unsigned repeat = 0; repeat < options_.repeats; ++repeat) run_once(*scene, maze, generate_s, repeat);
    say(maze, first_run);
  }
  std::optional<Scene> generated(const MazeOptions& maze, double& seconds) {
    const bool alone = options_.planners.size() == 1;
    const SolveOptions& planner = alone ? options_.planners.front() : SolveOptions{};
    std::optional<Scene> scene;
    if (memory_holds([&] { scene = generate_trial(maze, planner, execution_, seconds); })) return scene;
    result_.ungenerated.emplace_back(maze.rows, maze.cols);
    note_(fmt::format("{:>6} x {:<6} too little memory to generate it", maze.rows, maze.cols));
    return std::nullopt;
  }
  void run_once(const Scene& scene, const MazeOptions& maze, double generate_s, unsigned repeat) {
    for (const SolveOptions& planner : options_.planners) {
      for (const unsigned threads : options_.threads) {
        Execution execution = execution_;
        execution.threads = threads;
        const double arithmetic_before = arithmetic_per_second(execution);
        const RunCounts before = counters_.read();
        MazeTrial trial = solve_trial(scene, maze, options_.question, planner, options_.budget_s, execution);
        const RunCounts counts = counters_.read() - before;
        trial.generate_s = generate_s;
        result_.runs.push_back({std::move(trial), repeat, counts});
        result_.runs.back().arithmetic_per_s = 0.5 * (arithmetic_before + arithmetic_per_second(execution));
      }
    }
  }
  void say(const MazeOptions& maze, std::size_t first_run) const {
    const MazeTrial* fastest = nullptr;
    for (std::size_t i = first_run; i < result_.runs.size(); ++i) {
      const MazeTrial& t = result_.runs[i].trial;
      if (t.verified && (fastest == nullptr || t.solve_s < fastest->solve_s)) fastest = &t;
    }
    note_(fmt::format("{:>6} x {:<6} seed {}: {} runs, {}", maze.rows, maze.cols, maze.seed,
                      result_.runs.size() - first_run,
                      fastest == nullptr ? "none solved" : "fastest " + human_seconds(fastest->solve_s)));
  }

  const ScalingOptions& options_;
  const Execution& execution_;
  const std::function<void(std::string_view)>& note_;
  const RunCounters counters_;  // made before any thread that works
  ScalingResult result_;
};

/// The items in groups of one key each; groups and their items are in the order in which they are met.
template <class Items, class KeyOf>
auto in_groups(const Items& items, const KeyOf& key_of) {
  using Item = typename Items::value_type;
  std::map<decltype(key_of(items.front())), std::size_t> places;
  std::vector<std::vector<Item>> groups;
  for (const Item& item : items) {
    const auto [at, is_new] = places.try_emplace(key_of(item), groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back(item);
  }
  return groups;
}

std::vector<std::string> stage_names() {
  StageTimes all{0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1};  // what is zero may go unnamed: reading and generating do
  std::vector<std::string> names;
  for (const auto& [name, seconds] : named_stages(all)) names.emplace_back(name);
  return names;
}

/// Of the links of the chain that these stages are sums of.
std::vector<std::string> link_names() { return {"queries", "checks", "rows", "components", "reduction", "expansion"}; }

/// Both, and "solve": whatever seconds_of() knows.
std::vector<std::string> all_stages() {
  std::vector<std::string> stages = stage_names();
  for (std::string& link : link_names()) stages.push_back(std::move(link));
  stages.emplace_back("solve");
  return stages;
}

double seconds_of(const MazeTrial& trial, std::string_view stage) {
  if (stage == "solve") return trial.solve_s;
  for (const auto& [name, seconds] : named_stages(trial.seconds)) {
    if (stage == name) return seconds;
  }
  for (const StageCost& cost : trial.costs) {
    if (stage == cost.name) return cost.wall_s;
  }
  return 0.0;
}

void take_least(MazeTrial& least, const MazeTrial& other) {
  for (double StageTimes::*stage :
       {&StageTimes::index, &StageTimes::sample, &StageTimes::neighbours, &StageTimes::connect, &StageTimes::graph,
        &StageTimes::reduce, &StageTimes::search, &StageTimes::optimise, &StageTimes::verify}) {
    least.seconds.*stage = std::min(least.seconds.*stage, other.seconds.*stage);
  }
  for (StageCost& cost : least.costs) {
    for (const StageCost& o : other.costs) {
      if (std::string_view(o.name) == cost.name) cost.wall_s = std::min(cost.wall_s, o.wall_s);
    }
  }
}

ScalingRow row_of(const std::vector<const ScalingRun*>& runs) {
  const ScalingRun& fastest =
      **std::ranges::min_element(runs, {}, [](const ScalingRun* run) { return run->trial.solve_s; });
  ScalingRow row{.fastest = fastest.trial, .runs = runs.size(), .counts = fastest.counts};
  row.fastest.seconds = runs.front()->trial.seconds;
  row.fastest.costs = runs.front()->trial.costs;
  std::vector<double> seconds;
  std::map<std::uint64_t, std::pair<double, double>> extremes;  // by seed
  for (const ScalingRun* run : runs) {
    const MazeTrial* t = &run->trial;
    seconds.push_back(t->solve_s);
    take_least(row.fastest, *t);
    row.peak_memory_bytes = std::max(row.peak_memory_bytes, t->peak_memory_bytes);
    auto& [low, high] = extremes.try_emplace(t->seed, t->solve_s, t->solve_s).first->second;
    low = std::min(low, t->solve_s);
    high = std::max(high, t->solve_s);
  }
  for (const auto& [seed, extreme] : extremes) row.spread = std::max(row.spread, extreme.second / extreme.first - 1.0);
  row.median_s = median_of(seconds);
  return row;
}

void add_speed_ups(std::vector<ScalingRow>& rows) {
  for (ScalingRow& row : rows) {
    const ScalingRow* base = &row;
    for (const ScalingRow& other : rows) {
      const MazeTrial& a = other.fastest;
      const MazeTrial& b = row.fastest;
      const bool same_problem =
          a.planner == b.planner && a.sampler == b.sampler && a.rows == b.rows && a.cols == b.cols;
      if (same_problem && a.threads < base->fastest.threads) base = &other;
    }
    row.speed_up = base->fastest.threads * base->fastest.solve_s / row.fastest.solve_s;
  }
}

struct Pair {
  const ScalingRun* fewer;
  const ScalingRun* more;

  double scaled(double ratio) const { return ratio * fewer->trial.threads; }
  double gain() const { return scaled(fewer->trial.solve_s / more->trial.solve_s); }
  double arithmetic() const { return scaled(more->arithmetic_per_s / fewer->arithmetic_per_s); }
  bool is_quiet(unsigned cores) const {
    const double all = std::min(more->trial.threads, cores);
    return std::abs(arithmetic() - all) <= 0.05 * all;  // more: the other run was disturbed
  }
};

std::vector<const ScalingRun*> solved_runs(const ScalingResult& result) {
  std::vector<const ScalingRun*> solved;
  for (const ScalingRun& run : result.runs) {
    if (run.trial.verified) solved.push_back(&run);
  }
  return solved;
}

template <class Value>
double median(const std::vector<Pair>& pairs, const Value& value) {
  std::vector<double> values;
  for (const Pair& pair : pairs) values.push_back(value(pair));
  return median_of(values);
}

std::vector<std::pair<std::string, double>> stage_gains(const std::vector<Pair>& pairs) {
  constexpr double least_s = 2e-4;
  std::vector<std::pair<std::string, double>> gains;
  for (const std::string& stage : stage_names()) {
    const auto fewer = [&](const Pair& p) { return seconds_of(p.fewer->trial, stage); };
    if (median(pairs, fewer) < least_s) continue;
    const auto gain = [&](const Pair& p) { return p.scaled(fewer(p) / seconds_of(p.more->trial, stage)); };
    gains.emplace_back(stage, median(pairs, gain));
  }
  return gains;
}

ThreadGain gain_of(const std::vector<Pair>& pairs, unsigned cores) {
  ThreadGain gain{.first = pairs.front().more->trial, .pairs = pairs.size()};
  gain.gain = median(pairs, [](const Pair& p) { return p.gain(); });
  gain.arithmetic = median(pairs, [](const Pair& p) { return p.arithmetic(); });
  std::vector<Pair> quiet = pairs;
  std::erase_if(quiet, [&](const Pair& p) { return !p.is_quiet(cores); });
  gain.quiet_pairs = quiet.size();
  if (quiet.empty()) return gain;
  gain.quiet_gain = median(quiet, [](const Pair& p) { return p.gain(); });
  gain.quiet_stages = stage_gains(quiet);
  return gain;
}

using Json = nlohmann::ordered_json;

Json row_key_json(const MazeTrial& t) {
  return {{"rows", t.rows}, {"cols", t.cols}, {"threads", t.threads}, {"planner", t.planner}, {"sampler", t.sampler}};
}

Json gain_json(const ThreadGain& gain) {
  Json json = row_key_json(gain.first);
  json["pipeline"] = gain.first.pipeline;
  json["pairs"] = gain.pairs;
  json["gain"] = gain.gain;
  json["arithmetic"] = gain.arithmetic;
  json["quiet_pairs"] = gain.quiet_pairs;
  json["quiet_gain"] = gain.quiet_gain ? Json(*gain.quiet_gain) : Json(nullptr);
  json["quiet_stage_gains"] = Json::object();
  for (const auto& [name, value] : gain.quiet_stages) json["quiet_stage_gains"][name] = value;
  return json;
}

std::string side_text(const MazeTrial& t) { return fmt::format("{} x {}", t.rows, t.cols); }

std::string unsolved_text(const ScalingResult& result) {
  std::string text;
  std::set<std::string> said;
  for (const ScalingRun& run : result.runs) {
    if (run.trial.verified) continue;
    const std::string what = fmt::format("  {}, {}, {}: {}\n", side_text(run.trial), planner_text(run.trial),
                                         counted(run.trial.threads, "thread", "threads"), verdict_of(run.trial));
    if (said.insert(what).second) text += what;
  }
  for (const auto& [rows, cols] : result.ungenerated) {
    text += fmt::format("  {} x {}: too little memory to generate it\n", rows, cols);
  }
  return text;
}

/// Planner and sampler.
using Way = std::pair<std::string, std::string>;
Way way_of(const ScalingRow& row) { return {row.fastest.planner, row.fastest.sampler}; }
std::string text_of(const Way& way) { return way.first + " " + way.second; }
std::string threads_text(unsigned threads) { return fmt::format("{} thread{}", threads, threads == 1 ? "" : "s"); }

std::set<Way> ways_of(std::span<const ScalingRow> rows) {
  std::set<Way> ways;
  for (const ScalingRow& row : rows) ways.insert(way_of(row));
  return ways;
}

/// The rows of one way at its most threads.
std::vector<ScalingRow> widest(std::span<const ScalingRow> rows, const Way& way) {
  std::vector<ScalingRow> wide;
  for (const ScalingRow& row : rows) {
    if (way_of(row) != way) continue;
    if (!wide.empty() && row.fastest.threads > wide.front().fastest.threads) wide.clear();
    if (wide.empty() || row.fastest.threads == wide.front().fastest.threads) wide.push_back(row);
  }
  return wide;
}

constexpr double least_shown_s = 1e-6;

/// Stages that some row shows, and the whole: each has the colour of its place here in all plots.
std::vector<std::string> shown_stages(std::span<const ScalingRow> rows) {
  std::vector<std::string> stages{"solve"};
  for (const std::string& stage : stage_names()) {
    const auto shows = [&](const ScalingRow& row) { return seconds_of(row.fastest, stage) >= least_shown_s; };
    if (std::any_of(rows.begin(), rows.end(), shows)) stages.push_back(stage);
  }
  return stages;
}

/// Log-log time of each stage, its fitted exponent in the legend.
Plot stage_plot(std::span<const ScalingRow> rows, const Way& way, const std::vector<std::string>& stages) {
  const std::vector<ScalingRow> wide = widest(rows, way);
  Plot plot{.title = fmt::format("Stages of {}, {}", text_of(way), threads_text(wide.front().fastest.threads)),
            .x_label = "cells",
            .y_label = "seconds (least of the repeats)",
            .log_x = true,
            .log_y = true};
  const auto fitted = stage_exponents(wide);
  const std::map<std::string, double> exponents(fitted.begin(), fitted.end());
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const std::string& stage = stages[i];
    PlotSeries series{.name = stage, .color = i};
    for (const ScalingRow& row : wide) {
      const double seconds = seconds_of(row.fastest, stage);
      if (seconds >= least_shown_s) series.points.push_back({row.fastest.cells(), seconds});
    }
    if (exponents.contains(stage)) series.name += fmt::format(": cells^{:.2f}", exponents.at(stage));
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

enum class Axes : std::uint8_t { log_over_cells, over_cells, over_threads };  // y is logarithmic, or from zero on

/// Any figure of a row: one series a way and thread count against cells, or a way and size against threads.
template <class Figure>
Plot plot_of(std::span<const ScalingRow> rows, Axes axes, std::string title, std::string y_label,
             const Figure& figure) {
  const bool over_threads = axes == Axes::over_threads;
  const bool several_ways = ways_of(rows).size() > 1;
  std::map<std::tuple<Way, double, std::uint32_t>, PlotSeries> by_way;
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    const double threads = t.threads;
    PlotSeries& series = by_way[over_threads ? std::tuple(way_of(row), t.cells(), t.rows)  // sorted by it
                                             : std::tuple(way_of(row), threads, 0U)];
    series.name =
        (several_ways ? text_of(way_of(row)) + ", " : "") + (over_threads ? side_text(t) : threads_text(t.threads));
    series.points.push_back({over_threads ? threads : t.cells(), figure(row)});
  }
  Plot plot{.title = std::move(title),
            .x_label = over_threads ? "threads" : "cells",
            .y_label = std::move(y_label),
            .log_x = !over_threads,
            .log_y = axes == Axes::log_over_cells,
            .from_zero = axes != Axes::log_over_cells,
            .whole_x = over_threads};
  for (auto& [way, series] : by_way) plot.series.push_back(std::move(series));
  return plot;
}

std::vector<Plot> thread_plots(std::span<const ScalingRow> rows) {
  std::set<unsigned> threads;
  for (const ScalingRow& row : rows) threads.insert(row.fastest.threads);
  if (threads.size() < 2) return {};
  Plot speed_up =
      plot_of(rows, Axes::over_threads, "Speed-up", "times as fast", [](const auto& row) { return row.speed_up; });
  PlotSeries& ideal = speed_up.series.emplace_back(PlotSeries{.name = "ideal", .dashed = true});
  for (const unsigned n : threads) ideal.points.push_back({static_cast<double>(n), static_cast<double>(n)});
  Plot efficiency = plot_of(rows, Axes::over_threads, "Efficiency", "speed-up a thread",
                            [](const auto& row) { return row.speed_up / row.fastest.threads; });
  efficiency.level = 1.0;
  efficiency.level_name = "ideal";
  return {speed_up, efficiency};
}

std::vector<Plot> plots_of(std::span<const ScalingRow> rows) {
  std::vector<Plot> plots;
  const std::vector<std::string> stages = shown_stages(rows);
  for (const Way& way : ways_of(rows)) plots.push_back(stage_plot(rows, way, stages));
  plots.push_back(plot_of(rows, Axes::log_over_cells, "Whole solve", "seconds (least)",
                          [](const auto& row) { return row.fastest.solve_s; }));
  plots.push_back(plot_of(rows, Axes::over_cells, "Time a cell", "nanoseconds a cell",
                          [](const auto& row) { return row.fastest.solve_s * 1e9 / row.fastest.cells(); }));
  for (Plot& plot : thread_plots(rows)) plots.push_back(std::move(plot));
  plots.push_back(plot_of(rows, Axes::log_over_cells, "Memory at the peak, walls included", "MiB", [](const auto& row) {
    return static_cast<double>(row.peak_memory_bytes) / (1024.0 * 1024.0);
  }));
  return plots;
}

std::vector<std::string> hardware_cells(const RunCounts& counts, double cells) {
  const auto per = [&](std::string_view name, std::optional<double> unit) -> std::string {
    const auto count = counts.hardware_count(name);
    if (!count || !unit || !std::isfinite(*count / *unit)) return "-";
    return fmt::format("{:.3g}", *count / *unit);
  };
  return {per("cycles", cells), per("instructions", cells), per("instructions", counts.hardware_count("cycles")),
          per("cache_misses", cells), per("branch_misses", cells)};
}

TextTable table_of(std::span<const ScalingRow> rows) {
  TextTable table{{"planner", "size", "threads", "runs", "minimum", "median", "spread", "ns a cell", "speed-up",
                   "efficiency", "memory", "bytes a cell"},
                  1,
                  "Runs"};
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    const auto bytes = static_cast<double>(row.peak_memory_bytes);
    table.rows.push_back({planner_text(t), side_text(t), std::to_string(t.threads), std::to_string(row.runs),
                          human_seconds(t.solve_s), human_seconds(row.median_s),
                          fmt::format("{:.1f} %", 100.0 * row.spread),
                          fmt::format("{:.1f}", t.solve_s * 1e9 / t.cells()), fmt::format("{:.2f}", row.speed_up),
                          fmt::format("{:.0f} %", 100.0 * row.speed_up / t.threads), human_bytes(bytes),
                          fmt::format("{:.1f}", bytes / t.cells())});
  }
  return table;
}

TextTable gains_of(const ScalingResult& result) {
  TextTable table{{"planner", "size", "threads", "pairs", "gain", "arithmetic", "quiet pairs", "quiet gain"},
                  1,
                  "What threads gain, and what arithmetic alone gained in the same moments"};
  for (const ThreadGain& gain : thread_gains(result, thread_count(0))) {
    table.rows.push_back({planner_text(gain.first), side_text(gain.first), std::to_string(gain.first.threads),
                          std::to_string(gain.pairs), fmt::format("{:.2f}", gain.gain),
                          fmt::format("{:.2f}", gain.arithmetic), std::to_string(gain.quiet_pairs),
                          gain.quiet_gain ? fmt::format("{:.2f}", *gain.quiet_gain) : ""});
  }
  return table;
}

TextTable counts_of(const ScalingResult& result, std::span<const ScalingRow> rows) {
  TextTable table{
      {"planner", "size", "threads", "CPU", "page faults", "switched away"}, 1, "Counts of the fastest runs"};
  const bool counted = result.no_hardware_counts.empty();
  if (counted) {
    table.head.insert(table.head.end(), {"cycles a cell", "instructions a cell", "a cycle", "cache misses a cell",
                                         "branch misses a cell"});
  }
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    table.rows.push_back({planner_text(t), side_text(t), std::to_string(t.threads), human_seconds(row.counts.cpu_s),
                          std::to_string(row.counts.page_faults), std::to_string(row.counts.involuntary_switches)});
    if (counted) std::ranges::copy(hardware_cells(row.counts, t.cells()), std::back_inserter(table.rows.back()));
  }
  return table;
}

/// A line a contender and number of threads, a column a stage: exponents of its least times against cells.
TextTable exponent_table(std::span<const ScalingRow> rows) {
  const auto name_of_row = [](const ScalingRow& row) {
    return fmt::format("{}, {}", planner_text(row.fastest), counted(row.fastest.threads, "thread", "threads"));
  };
  TextTable table{{"contender"}, 1, "Exponents of time against cells"};
  const std::vector<std::string> stages = all_stages();
  table.head.insert(table.head.end(), stages.begin(), stages.end());
  for (const std::vector<ScalingRow>& own : in_groups(rows, name_of_row)) {
    const auto fitted = stage_exponents(own);
    const std::map<std::string, double> exponents(fitted.begin(), fitted.end());
    if (exponents.empty()) continue;
    table.rows.push_back({name_of_row(own.front())});
    for (const std::string& stage : stages) {
      table.rows.back().push_back(exponents.contains(stage) ? fmt::format("{:.2f}", exponents.at(stage)) : "");
    }
  }
  return table;
}

/// "repeats of one maze differ by 3 % in the median, by 12 % at most"
std::string noise_text(std::span<const ScalingRow> rows) {
  std::vector<double> spreads;
  for (const ScalingRow& row : rows) {
    if (row.runs > 1) spreads.push_back(100.0 * row.spread);
  }
  if (spreads.empty()) return "not known: nothing was repeated";
  std::sort(spreads.begin(), spreads.end());
  return fmt::format("repeats of one maze differ by {:.1f} % in the median, by {:.1f} % at most",
                     spreads[spreads.size() / 2], spreads.back());
}

}  // namespace

ScalingResult run_scaling_study(const ScalingOptions& options, const Execution& execution,
                                const std::function<void(std::string_view)>& note) {
  return ScalingStudy(options, execution, note).run_all();
}

std::vector<ScalingRow> scaling_rows(const ScalingResult& result) {
  const auto in_common = [](const ScalingRun* run) {
    const MazeTrial& t = run->trial;
    return std::tuple(t.planner, t.sampler, t.rows, t.cols, t.threads);
  };
  std::vector<ScalingRow> rows;
  for (const auto& group : in_groups(solved_runs(result), in_common)) rows.push_back(row_of(group));
  std::ranges::stable_sort(rows, {}, way_of);
  add_speed_ups(rows);
  return rows;
}

std::vector<std::pair<std::string, double>> stage_exponents(std::span<const ScalingRow> rows) {
  constexpr double least_s = 20e-6;
  std::vector<std::pair<std::string, double>> exponents;
  for (const std::string& stage : all_stages()) {
    std::map<std::tuple<std::string, std::string, unsigned>, std::vector<Vec2>> by_way;
    for (const ScalingRow& row : rows) {
      const MazeTrial& t = row.fastest;
      const double seconds = seconds_of(t, stage);
      if (seconds >= least_s) by_way[{t.planner, t.sampler, t.threads}].push_back({t.cells(), seconds});
    }
    std::vector<std::vector<Vec2>> groups;
    for (auto& [way, points] : by_way) groups.push_back(std::move(points));
    if (const auto exponent = common_exponent(groups)) exponents.emplace_back(stage, *exponent);
  }
  return exponents;
}

std::vector<ThreadGain> thread_gains(const ScalingResult& result, unsigned cores) {
  std::vector<const ScalingRun*> timed = solved_runs(result);
  std::erase_if(timed, [](const ScalingRun* run) { return !(run->arithmetic_per_s > 0.0); });
  const auto repeat_of = [](const ScalingRun* run) {
    const MazeTrial& t = run->trial;
    return std::tuple(t.planner, t.sampler, t.pipeline, t.rows, t.cols, t.seed, run->repeat);
  };
  const auto threads = [](const ScalingRun* run) { return run->trial.threads; };
  std::vector<Pair> pairs;
  for (const auto& repeat : in_groups(timed, repeat_of)) {
    const ScalingRun* const base = *std::ranges::min_element(repeat, {}, threads);
    for (const ScalingRun* run : repeat) {
      if (threads(run) != threads(base)) pairs.push_back({base, run});
    }
  }
  const auto in_common = [](const Pair& pair) {
    const MazeTrial& t = pair.more->trial;
    return std::tuple(t.planner, t.sampler, t.pipeline, t.rows, t.cols, t.threads);
  };
  std::vector<ThreadGain> gains;
  for (const std::vector<Pair>& group : in_groups(pairs, in_common)) gains.push_back(gain_of(group, cores));
  return gains;
}

std::string text_of(const ThreadGain& gain) {
  const MazeTrial& t = gain.first;
  std::string text = fmt::format(
      "{} x {}, {}, {} threads: {:.2f} times as fast as one (median of {} {}), arithmetic alone {:.2f} times", t.rows,
      t.cols, planner_text(t), t.threads, gain.gain, gain.pairs, gain.pairs == 1 ? "pair of runs" : "pairs of runs",
      gain.arithmetic);
  if (!gain.quiet_gain) return text + "; the machine was quiet in none of them";
  text += fmt::format("; while the machine was quiet, in {} of them, {:.2f} times", gain.quiet_pairs, *gain.quiet_gain);
  std::string stages;
  for (const auto& [name, value] : gain.quiet_stages) {
    stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", name, value);
  }
  return stages.empty() ? text : text + " (" + stages + ")";
}

std::string scaling_summary(const ScalingResult& result, const Palette& palette) {
  const std::vector<ScalingRow> rows = scaling_rows(result);
  std::string text = palette.strong(fmt::format("{:>15}  {:<30} {:>7}  {:>9}  {:>9}  {:>7}  {:>8}  {:>8}  {:>9}  {:>8}",
                                                "size", "planner", "threads", "minimum", "median", "spread", "ns/cell",
                                                "speed-up", "memory", "B/cell"));
  text += '\n';
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    const auto bytes = static_cast<double>(row.peak_memory_bytes);
    text += fmt::format("{:>15}  {:<30} {:>7}  {:>9}  {:>9}  {:>5.1f} %  {:>8.1f}  {:>8.2f}  {:>9}  {:>8.1f}\n",
                        side_text(t), planner_text(t), t.threads, human_seconds(t.solve_s), human_seconds(row.median_s),
                        100.0 * row.spread, t.solve_s * 1e9 / t.cells(), row.speed_up, human_bytes(bytes),
                        bytes / t.cells());
  }
  text += unsolved_text(result);
  if (const TextTable exponents = exponent_table(rows); !exponents.rows.empty()) {
    text += named_line(palette, "exponents", "of least times against cells");
    text += exponents.text(palette);
  }
  for (const ThreadGain& gain : thread_gains(result, thread_count(0)))
    text += named_line(palette, "threads", text_of(gain));
  text += named_line(palette, "noise", noise_text(rows));
  text += named_line(palette, "machine", machine_text());
  if (result.signal) text += palette.doubtful("interrupted") + ": these are the runs so far\n";
  return text;
}

std::string scaling_json(const ScalingOptions& options, const ScalingResult& result) {
  const std::vector<ScalingRow> rows = scaling_rows(result);
  Json json{{"schema", "warren.scale/1"}, {"warren_version", WARREN_VERSION}, {"repeats", options.repeats}};
  json["algorithm"] = name_of(options.maze.algorithm);
  json["loops"] = options.maze.loops;
  json["machine"] = machine_json();
  const bool counted = result.no_hardware_counts.empty();
  json["hardware_counts"] = counted ? Json(RunCounts::hardware_names) : Json(nullptr);
  if (!counted) json["no_hardware_counts"] = result.no_hardware_counts;
  if (result.signal) json["stopped_by"] = name_of(*result.signal);
  json["runs"] = Json::array();
  for (const ScalingRun& run : result.runs) {
    Json entry = trial_json(run.trial);
    entry["repeat"] = run.repeat;
    entry["arithmetic_per_s"] = run.arithmetic_per_s;
    entry.update(counts_json(run.counts));
    json["runs"].push_back(std::move(entry));
  }
  json["rows"] = Json::array();
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    Json& entry = json["rows"].emplace_back(row_key_json(t));
    entry["runs"] = row.runs;
    entry["min_s"] = t.solve_s;
    entry["median_s"] = row.median_s;
    entry["spread"] = row.spread;
    entry["ns_per_cell"] = t.solve_s * 1e9 / t.cells();
    entry["speed_up"] = row.speed_up;
    entry["efficiency"] = row.speed_up / t.threads;
    entry["bytes_per_cell"] = static_cast<double>(row.peak_memory_bytes) / t.cells();
  }
  json["thread_gains"] = Json::array();
  for (const ThreadGain& gain : thread_gains(result, thread_count(0))) json["thread_gains"].push_back(gain_json(gain));
  json["exponents"] = Json::object();
  for (const auto& [stage, exponent] : stage_exponents(rows)) json["exponents"][stage] = exponent;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string scaling_csv(const ScalingResult& result) {
  const std::vector<std::string> stages = stage_names();
  std::string text = "rows,cols,cells,planner,sampler,pipeline,threads,seed,repeat,status,verified,solve_s";
  for (const std::string& stage : stages) text += "," + stage + "_s";
  text += ",generate_s,length,peak_memory_bytes,cpu_s,page_faults,involuntary_switches";
  for (const std::string_view name : RunCounts::hardware_names) text += fmt::format(",{}", name);
  for (const std::string& link : link_names()) text += "," + link + "_s";
  text += '\n';
  for (const ScalingRun& run : result.runs) {
    const MazeTrial& t = run.trial;
    text += fmt::format("{},{},{:.0f},{},{},{},{},{},{},{},{},{}", t.rows, t.cols, t.cells(), t.planner, t.sampler,
                        t.pipeline, t.threads, t.seed, run.repeat, name_of(t.outcome), t.verified, t.solve_s);
    for (const std::string& stage : stages) text += fmt::format(",{}", seconds_of(t, stage));
    text += fmt::format(",{},{},{},{},{},{}", t.generate_s, t.verified ? fmt::format("{}", t.length) : "",
                        t.peak_memory_bytes, run.counts.cpu_s, run.counts.page_faults, run.counts.involuntary_switches);
    for (const std::string_view name : RunCounts::hardware_names) {
      const auto count = run.counts.hardware_count(name);
      text += count ? fmt::format(",{:.0f}", *count) : ",";
    }
    for (const std::string& link : link_names()) text += fmt::format(",{}", seconds_of(t, link));
    text += '\n';
  }
  return text;
}

std::string scaling_page(const ScalingResult& result, const std::string& command_line) {
  const std::vector<ScalingRow> rows = scaling_rows(result);
  ReportPage page{.title = "Time, memory and work against size and threads", .command_line = command_line};
  page.notes.push_back(fmt::format(
      "Machine: {}. Noise: {}. Times run from walls in memory to path verified; every path was verified.{}",
      machine_text(), noise_text(rows), result.signal ? " The study was interrupted: these are the runs so far." : ""));
  if (rows.empty()) {
    page.notes.emplace_back("No run was solved.");
    return page.html();
  }
  for (const Plot& plot : plots_of(rows)) page.plots.push_back(sheet_of(plot).svg());
  page.tables = {table_of(rows), exponent_table(rows), gains_of(result), counts_of(result, rows)};
  if (!result.no_hardware_counts.empty()) {
    page.remarks.push_back(fmt::format("The processor's own counters are not to be had here (perf_event_open: {}).",
                                       result.no_hardware_counts));
  }
  return page.html();
}

}  // namespace warren::studies
