// SPDX-License-Identifier: BSD-3-Clause
// What `warren scale` says: a table, warren.scale/1, CSV with a run a line, and a page with plots.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/studies/scaling_study.hpp"
#include "apps/studies/study_report.hpp"
#include "pictures/plots/plot.hpp"

namespace warren::studies {
namespace {

using Json = nlohmann::ordered_json;

Json gain_json(const ThreadGain& gain) {
  const MazeTrial& t = gain.first;
  Json stages = Json::object();
  for (const auto& [name, value] : gain.quiet_stages) stages[name] = value;
  return {{"rows", t.rows},
          {"cols", t.cols},
          {"threads", t.threads},
          {"planner", t.planner},
          {"sampler", t.sampler},
          {"pipeline", t.pipeline},
          {"pairs", gain.pairs},
          {"gain", gain.gain},
          {"arithmetic", gain.arithmetic},
          {"quiet_pairs", gain.quiet_pairs},
          {"quiet_gain", gain.quiet_gain ? Json(*gain.quiet_gain) : Json(nullptr)},
          {"quiet_stage_gains", std::move(stages)}};
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
  unsigned most = 0;
  for (const ScalingRow& row : rows) {
    if (way_of(row) == way) most = std::max(most, row.fastest.threads);
  }
  std::vector<ScalingRow> wide;
  for (const ScalingRow& row : rows) {
    if (way_of(row) == way && row.fastest.threads == most) wide.push_back(row);
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

enum class Against : std::uint8_t { cells, threads };

/// One series a way and thread count against cells, or a way and size against threads: of any figure of a row.
template <class Figure>
std::vector<PlotSeries> series_by_way(std::span<const ScalingRow> rows, Against what, const Figure& figure) {
  const bool over_threads = what == Against::threads;
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
  std::vector<PlotSeries> all;
  for (auto& [way, series] : by_way) all.push_back(std::move(series));
  return all;
}

std::vector<Plot> thread_plots(std::span<const ScalingRow> rows) {
  std::set<unsigned> threads;
  for (const ScalingRow& row : rows) threads.insert(row.fastest.threads);
  if (threads.size() < 2) return {};
  Plot speed_up{.title = "Speed-up",
                .x_label = "threads",
                .y_label = "times as fast",
                .from_zero = true,
                .whole_x = true,
                .series = series_by_way(rows, Against::threads, [](const auto& row) { return row.speed_up; })};
  PlotSeries ideal{.name = "ideal", .dashed = true};
  for (const unsigned n : threads) ideal.points.push_back({static_cast<double>(n), static_cast<double>(n)});
  speed_up.series.push_back(std::move(ideal));
  Plot efficiency{.title = "Efficiency",
                  .x_label = "threads",
                  .y_label = "speed-up a thread",
                  .from_zero = true,
                  .whole_x = true,
                  .series = series_by_way(rows, Against::threads,
                                          [](const auto& row) { return row.speed_up / row.fastest.threads; }),
                  .level = 1.0,
                  .level_name = "ideal"};
  return {speed_up, efficiency};
}

std::vector<Plot> plots_of(std::span<const ScalingRow> rows) {
  std::vector<Plot> plots;
  const std::vector<std::string> stages = shown_stages(rows);
  for (const Way& way : ways_of(rows)) plots.push_back(stage_plot(rows, way, stages));
  plots.push_back({.title = "Whole solve",
                   .x_label = "cells",
                   .y_label = "seconds (least)",
                   .log_x = true,
                   .log_y = true,
                   .series = series_by_way(rows, Against::cells, [](const auto& row) { return row.fastest.solve_s; })});
  plots.push_back({.title = "Time a cell",
                   .x_label = "cells",
                   .y_label = "nanoseconds a cell",
                   .log_x = true,
                   .from_zero = true,
                   .series = series_by_way(rows, Against::cells, [](const ScalingRow& row) {
                     return row.fastest.solve_s * 1e9 / row.fastest.cells();
                   })});
  for (Plot& plot : thread_plots(rows)) plots.push_back(std::move(plot));
  plots.push_back({.title = "Memory at the peak, walls included",
                   .x_label = "cells",
                   .y_label = "MiB",
                   .log_x = true,
                   .log_y = true,
                   .series = series_by_way(rows, Against::cells, [](const ScalingRow& row) {
                     return static_cast<double>(row.peak_memory_bytes) / (1024.0 * 1024.0);
                   })});
  return plots;
}

/// Cycles and instructions a cell of the maze, instructions a cycle, misses a cell.
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

/// A line each, for they are many.
TextTable gains_of(const ScalingResult& result) {
  TextTable table{{"planner", "size", "threads", "pairs", "gain", "arithmetic", "quiet pairs", "quiet gain"},
                  1,
                  "What threads gain, and what arithmetic alone gained in the same moments"};
  for (const ThreadGain& gain : thread_gains(result, this_machine().cores)) {
    table.rows.push_back({planner_text(gain.first), side_text(gain.first), std::to_string(gain.first.threads),
                          std::to_string(gain.pairs), fmt::format("{:.2f}", gain.gain),
                          fmt::format("{:.2f}", gain.arithmetic), std::to_string(gain.quiet_pairs),
                          gain.quiet_gain ? fmt::format("{:.2f}", *gain.quiet_gain) : ""});
  }
  return table;
}

/// What the fastest run of each row cost beside its time.
TextTable counts_of(const ScalingResult& result, std::span<const ScalingRow> rows) {
  TextTable table{
      {"planner", "size", "threads", "CPU", "page faults", "switched away"}, 1, "Counts of the fastest runs"};
  const bool counted = result.no_hardware_counts.empty();
  if (counted) {
    for (const char* head :
         {"cycles a cell", "instructions a cell", "a cycle", "cache misses a cell", "branch misses a cell"}) {
      table.head.emplace_back(head);
    }
  }
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    table.rows.push_back({planner_text(t), side_text(t), std::to_string(t.threads), human_seconds(row.counts.cpu_s),
                          std::to_string(row.counts.page_faults), std::to_string(row.counts.involuntary_switches)});
    if (!counted) continue;
    for (std::string& cell : hardware_cells(row.counts, t.cells())) table.rows.back().push_back(std::move(cell));
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
  const auto line = [&](std::string_view name, const std::string& what) {
    text += fmt::format("{}{}\n", palette.faint(fmt::format("{:<11}", name)), what);
  };
  if (const TextTable exponents = exponent_table(rows); !exponents.rows.empty()) {
    line("exponents", "of least times against cells");
    text += exponents.text(palette);
  }
  for (const ThreadGain& gain : thread_gains(result, this_machine().cores)) line("threads", text_of(gain));
  line("noise", noise_text(rows));
  line("machine", text_of(this_machine()));
  if (result.signal) text += palette.doubtful("interrupted") + ": these are the runs so far\n";
  return text;
}

std::string scaling_json(const ScalingOptions& options, const ScalingResult& result) {
  const std::vector<ScalingRow> rows = scaling_rows(result);
  Json json{{"schema", "warren.scale/1"}, {"warren_version", WARREN_VERSION}, {"repeats", options.repeats}};
  json["algorithm"] = name_of(options.maze.algorithm);
  json["loops"] = options.maze.loops;
  json["machine"] = machine_json(this_machine());
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
    json["rows"].push_back({{"rows", t.rows},
                            {"cols", t.cols},
                            {"threads", t.threads},
                            {"planner", t.planner},
                            {"sampler", t.sampler},
                            {"runs", row.runs},
                            {"min_s", t.solve_s},
                            {"median_s", row.median_s},
                            {"spread", row.spread},
                            {"ns_per_cell", t.solve_s * 1e9 / t.cells()},
                            {"speed_up", row.speed_up},
                            {"efficiency", row.speed_up / t.threads},
                            {"bytes_per_cell", static_cast<double>(row.peak_memory_bytes) / t.cells()}});
  }
  json["thread_gains"] = Json::array();
  for (const ThreadGain& gain : thread_gains(result, this_machine().cores))
    json["thread_gains"].push_back(gain_json(gain));
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
  page.notes.push_back(
      fmt::format("Machine: {}. Noise: {}. Times run from walls in memory to path verified; every path was verified.{}",
                  text_of(this_machine()), noise_text(rows),
                  result.signal ? " The study was interrupted: these are the runs so far." : ""));
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
