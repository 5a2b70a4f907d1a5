// SPDX-License-Identifier: BSD-3-Clause
// Plots of a comparison. Random graphs: for each search that takes a queue, times against size, and beside them the
// ratios to the heap, whose crossing of 1 is where array and heap cross. Else: what options that were dealt out do
// (comparison_lists.cpp), for each contender the share of its runs that had found a path, against time, and how its
// lengths, times and clearances are spread (comparison_boxes.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "pictures/plots/plot.hpp"
#include "studies/compare/comparison_report.hpp"
#include "studies/compare/queue_crossings.hpp"

namespace warren::studies {
namespace {

std::string series_name(const SweepCurve& curve) {
  if (curve.library != "warren") return curve.library;
  return curve.queue.empty() ? curve.search : curve.queue;
}

/// Its place among all names: the same in the plots of all searches.
std::size_t color_of(const std::vector<SweepCurve>& curves, const std::string& name) {
  std::vector<std::string> names;
  for (const SweepCurve& curve : curves) add_once(names, series_name(curve));
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

Plot time_plot(const std::vector<SweepCurve>& curves, const std::string& search) {
  Plot plot{.title = search + " on random geometric graphs",
            .x_label = "vertices",
            .y_label = "seconds a search (median)",
            .log_x = true,
            .log_y = true,
            .series = {}};
  for (const SweepCurve& curve : curves) {
    if (curve.search != search) continue;
    plot.series.push_back(
        {.name = series_name(curve), .points = curve.points, .color = color_of(curves, series_name(curve))});
  }
  return plot;
}

/// Against the first heap of the search.
Plot ratio_plot(const std::vector<SweepCurve>& curves, const std::string& search) {
  Plot plot{.title = search + ": where array and heap cross",
            .x_label = "vertices",
            .y_label = "time of the array over the heap's",
            .log_x = true,
            .log_y = true,
            .series = {},
            .level = 1.0};
  std::string heap;
  for (const QueueCrossing& c : queue_crossings(curves)) {
    if (c.search != search || (!heap.empty() && c.heap != heap)) continue;
    heap = c.heap;
    plot.series.push_back({.name = c.array, .points = c.ratios, .color = color_of(curves, c.array)});
    if (c.crossing) plot.series.back().name += fmt::format(", crosses at {:.0f}", *c.crossing);
  }
  plot.level_name = "as fast as the " + heap;
  return plot;
}

std::vector<Plot> sweep_plots(const std::vector<SweepCurve>& curves) {
  std::vector<Plot> plots;
  for (const std::string search : {"dijkstra", "astar", "bfs", "dfs"}) {
    Plot times = time_plot(curves, search);
    if (times.series.empty()) continue;
    plots.push_back(std::move(times));
    Plot ratios = ratio_plot(curves, search);
    if (!ratios.series.empty()) plots.push_back(std::move(ratios));
  }
  return plots;
}

/// The share of the runs that were solved within each of their times, thinned to what a plot can show.
std::vector<Vec2> solved_shares(const Contender& contender) {
  constexpr std::size_t most_points = 40;
  std::vector<double> times;
  for (const ComparedRun& run : contender.runs) {
    if (run.solved()) times.push_back(run.time_s);
  }
  std::sort(times.begin(), times.end());
  const std::size_t step = times.size() / most_points + 1;
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < times.size(); i += step) {
    points.push_back({times[i], 100.0 * static_cast<double>(i + 1) / static_cast<double>(contender.runs.size())});
  }
  return points;
}

std::vector<Plot> share_plots(const Comparison& comparison) {
  std::vector<Plot> plots;
  for (std::size_t problem = 0; problem < comparison.problems.size(); ++problem) {
    const bool planners = comparison.problems[problem].kind.empty();
    Plot plot{.title = comparison.problems[problem].source + ": solved",
              .x_label = "seconds",
              .y_label = "per cent of the runs solved within",
              .log_x = true,
              .from_zero = true,
              .series = {}};
    const std::vector<const Contender*> contenders = contenders_of(comparison, problem);
    const std::vector<std::string> names = plot_names_of(contenders, planners);
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      plot.series.push_back({names[i], solved_shares(*contenders[i])});
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace

std::vector<PlotSheet> comparison_panels(const Comparison& comparison) {
  std::vector<PlotSheet> panels = list_panels(comparison);
  const std::vector<SweepCurve> curves = sweep_curves(comparison);
  const bool is_alone = panels.empty();
  for (const Plot& plot : curves.empty() ? share_plots(comparison) : sweep_plots(curves)) {
    if (!curves.empty() || is_alone || plot.series.size() <= colors::series.size()) panels.push_back(sheet_of(plot));
  }
  if (curves.empty()) {
    for (PlotSheet& panel : box_panels(comparison)) panels.push_back(std::move(panel));
  }
  return panels;
}

PlotsPage comparison_plots(const Comparison& comparison) {
  constexpr std::size_t side_by_side = 2;
  constexpr std::size_t figures = 3;
  return {comparison_panels(comparison), list_panels(comparison).empty() ? side_by_side : figures};
}

}  // namespace warren::studies
