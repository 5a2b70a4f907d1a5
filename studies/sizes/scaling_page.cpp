// SPDX-License-Identifier: BSD-3-Clause
// The page of `warren scale`: what was measured as a table, and plots of it.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "pictures/plot_svg.hpp"
#include "scenes/text/human_units.hpp"
#include "studies/measure/machine_memory.hpp"
#include "studies/sizes/scaling_report.hpp"
#include "studies/sizes/thread_gains.hpp"

namespace warren {
namespace {

constexpr std::string_view page_head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>warren scale</title>
<style>
body { font-family: sans-serif; color: #222222; background: #ffffff; margin: 2em auto; max-width: 1560px; padding: 0 1em; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 0.25em 0.8em; text-align: right; border-bottom: 1px solid #e2e2e2; }
th { border-bottom: 2px solid #888888; }
td.word, th.word { text-align: left; }
.plots { display: flex; flex-wrap: wrap; gap: 1em; }
.plots svg { max-width: 100%; height: auto; border: 1px solid #e2e2e2; }
code { background: #f3f3f3; padding: 0.1em 0.3em; overflow-wrap: anywhere; }
</style>
</head>
<body>
)";

/// Planner and sampler.
using Way = std::pair<std::string, std::string>;
Way way_of(const ScalingRow& row) { return {row.fastest.planner, row.fastest.sampler}; }
std::string text_of(const Way& way) { return way.first + " " + way.second; }
/// The words before a series' own name: the way, where there is more than one.
std::string prefix_of(const Way& way, const std::set<Way>& ways) { return ways.size() > 1 ? text_of(way) + ", " : ""; }
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

/// Log-log time of each stage, its fitted exponent in the legend.
Plot stage_plot(std::span<const ScalingRow> rows, const Way& way) {
  const std::vector<ScalingRow> wide = widest(rows, way);
  Plot plot{.title = fmt::format("Stages of {}, {}", text_of(way), threads_text(wide.front().fastest.threads)),
            .x_label = "cells",
            .y_label = "seconds (least of the repeats)",
            .log_x = true,
            .log_y = true,
            .series = {}};
  std::map<std::string, double> exponents;
  for (const auto& [stage, exponent] : stage_exponents(wide)) exponents[stage] = exponent;
  std::vector<std::string> stages = stage_names();
  stages.emplace_back("solve");
  for (const std::string& stage : stages) {
    constexpr double least_shown_s = 1e-6;
    PlotSeries series{.name = stage, .points = {}};
    for (const ScalingRow& row : wide) {
      const double seconds = seconds_of(row.fastest, stage);
      if (seconds >= least_shown_s) series.points.push_back({row.fastest.cells(), seconds});
    }
    if (const auto fitted = exponents.find(stage); fitted != exponents.end()) {
      series.name += fmt::format(": cells^{:.2f}", fitted->second);
    }
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

/// One series a way and thread count, of any figure of a row.
template <class Figure>
std::vector<PlotSeries> series_by_cells(std::span<const ScalingRow> rows, const Figure& figure) {
  const std::set<Way> ways = ways_of(rows);
  std::map<std::pair<Way, unsigned>, PlotSeries> by_way;
  for (const ScalingRow& row : rows) {
    PlotSeries& series = by_way[{way_of(row), row.fastest.threads}];
    series.name = prefix_of(way_of(row), ways) + threads_text(row.fastest.threads);
    series.points.push_back({row.fastest.cells(), figure(row)});
  }
  std::vector<PlotSeries> all;
  for (auto& [way, series] : by_way) all.push_back(std::move(series));
  return all;
}

/// One series a way and size, over threads.
template <class Figure>
std::vector<PlotSeries> series_by_threads(std::span<const ScalingRow> rows, const Figure& figure) {
  const std::set<Way> ways = ways_of(rows);
  std::map<std::tuple<Way, double, std::uint32_t>, PlotSeries> by_size;
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    PlotSeries& series = by_size[{way_of(row), t.cells(), t.rows}];
    series.name = fmt::format("{}{} x {}", prefix_of(way_of(row), ways), t.rows, t.cols);
    series.points.push_back({static_cast<double>(t.threads), figure(row)});
  }
  std::vector<PlotSeries> all;
  for (auto& [size, series] : by_size) all.push_back(std::move(series));
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
                .series = {}};
  speed_up.series = series_by_threads(rows, [](const ScalingRow& row) { return row.speed_up; });
  PlotSeries ideal{.name = "ideal", .points = {}, .dashed = true};
  for (const unsigned n : threads) ideal.points.push_back({static_cast<double>(n), static_cast<double>(n)});
  speed_up.series.push_back(std::move(ideal));
  Plot efficiency{.title = "Efficiency",
                  .x_label = "threads",
                  .y_label = "speed-up a thread",
                  .from_zero = true,
                  .whole_x = true,
                  .series = {},
                  .level = 1.0,
                  .level_name = "ideal"};
  efficiency.series = series_by_threads(rows, [](const ScalingRow& row) { return row.speed_up / row.fastest.threads; });
  return {speed_up, efficiency};
}

std::vector<Plot> plots_of(std::span<const ScalingRow> rows) {
  std::vector<Plot> plots;
  for (const Way& way : ways_of(rows)) plots.push_back(stage_plot(rows, way));
  plots.push_back({.title = "Whole solve",
                   .x_label = "cells",
                   .y_label = "seconds (least)",
                   .log_x = true,
                   .log_y = true,
                   .series = series_by_cells(rows, [](const auto& row) { return row.fastest.solve_s; })});
  plots.push_back({.title = "Time a cell",
                   .x_label = "cells",
                   .y_label = "nanoseconds a cell",
                   .log_x = true,
                   .from_zero = true,
                   .series = series_by_cells(
                       rows, [](const ScalingRow& row) { return row.fastest.solve_s * 1e9 / row.fastest.cells(); })});
  for (Plot& plot : thread_plots(rows)) plots.push_back(std::move(plot));
  plots.push_back({.title = "Memory at the peak, walls included",
                   .x_label = "cells",
                   .y_label = "MiB",
                   .log_x = true,
                   .log_y = true,
                   .series = series_by_cells(rows, [](const ScalingRow& row) {
                     return static_cast<double>(row.peak_memory_bytes) / (1024.0 * 1024.0);
                   })});
  return plots;
}

/// Five cells: cycles and instructions a cell of the maze, instructions a cycle, misses a cell.
std::string hardware_cells(const RunCounts& counts, double cells) {
  const auto cell = [](std::optional<double> value) {
    return value && std::isfinite(*value) ? fmt::format("<td>{:.3g}</td>", *value) : std::string("<td>-</td>");
  };
  const auto per_cell = [&](std::string_view name) {
    const auto count = counts.hardware_count(name);
    return count ? std::optional(*count / cells) : std::nullopt;
  };
  const auto cycles = counts.hardware_count("cycles");
  const auto instructions = counts.hardware_count("instructions");
  const auto a_cycle = cycles && instructions ? std::optional(*instructions / *cycles) : std::nullopt;
  return cell(per_cell("cycles")) + cell(per_cell("instructions")) + cell(a_cycle) + cell(per_cell("cache_misses")) +
         cell(per_cell("branch_misses"));
}

std::string table_of(std::span<const ScalingRow> rows) {
  std::string text =
      "<table>\n<tr><th>size</th><th class=\"word\">planner</th><th>threads</th><th>runs</th><th>minimum</th>"
      "<th>median</th><th>spread</th><th>ns a cell</th><th>speed-up</th><th>efficiency</th><th>memory</th>"
      "<th>bytes a cell</th></tr>\n";
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    const auto bytes = static_cast<double>(row.peak_memory_bytes);
    text += fmt::format(
        "<tr><td>{} &times; {}</td><td class=\"word\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{:.1f} %</td><td>{:.1f}</td><td>{:.2f}</td><td>{:.0f} %</td><td>{}</td><td>{:.1f}</td></tr>\n",
        t.rows, t.cols, xml_text(planner_text(t)), t.threads, row.runs, human_seconds(t.solve_s),
        human_seconds(row.median_s), 100.0 * row.spread, t.solve_s * 1e9 / t.cells(), row.speed_up,
        100.0 * row.speed_up / t.threads, human_bytes(bytes), bytes / t.cells());
  }
  return text + "</table>\n";
}

/// What the fastest run of each row cost beside its time.
std::string counts_of(const ScalingResult& result, std::span<const ScalingRow> rows) {
  std::string text =
      "<h2>Counts of the fastest runs</h2>\n<table>\n<tr><th>size</th><th class=\"word\">planner</th><th>threads</th>"
      "<th>CPU</th><th>page faults</th><th>switched away</th>";
  const bool counted = result.no_hardware_counts.empty();
  if (counted) {
    text +=
        "<th>cycles a cell</th><th>instructions a cell</th><th>a cycle</th><th>cache misses a cell</th>"
        "<th>branch misses a cell</th>";
  }
  text += "</tr>\n";
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    text +=
        fmt::format("<tr><td>{} &times; {}</td><td class=\"word\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
                    t.rows, t.cols, xml_text(planner_text(t)), t.threads, human_seconds(row.counts.cpu_s),
                    row.counts.page_faults, row.counts.involuntary_switches);
    if (counted) text += hardware_cells(row.counts, t.cells());
    text += "</tr>\n";
  }
  text += "</table>\n";
  if (!counted) {
    text += fmt::format("<p>The processor's own counters are not to be had here (perf_event_open: {}).</p>\n",
                        xml_text(result.no_hardware_counts));
  }
  return text;
}

}  // namespace

std::string scaling_page(const ScalingResult& result, const std::string& command_line) {
  const std::vector<ScalingRow> rows = scaling_rows(result);
  std::string page{page_head};
  page += "<h1>Time, memory and work against size and threads</h1>\n";
  page += fmt::format(
      "<p><code>{}</code></p>\n<p>Machine: {}. Noise: {}. Times run from walls in memory to path verified; every path "
      "was verified.{}</p>\n",
      xml_text(command_line), xml_text(text_of(this_machine())), xml_text(noise_text(rows)),
      result.signal ? " The study was interrupted: these are the runs so far." : "");
  if (rows.empty()) return page + "<p>No run was solved.</p>\n</body>\n</html>\n";
  page += "<div class=\"plots\">\n";
  for (const Plot& plot : plots_of(rows)) page += plot_svg(plot);
  page += "</div>\n<h2>Runs</h2>\n";
  for (const ThreadGain& gain : thread_gains(result, this_machine().cores)) {
    page += "<p>" + xml_text(text_of(gain)) + ".</p>\n";
  }
  return page + table_of(rows) + counts_of(result, rows) + "</body>\n</html>\n";
}

}  // namespace warren
