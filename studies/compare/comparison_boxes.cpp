// SPDX-License-Identifier: BSD-3-Clause
// Box plots of a comparison: how lengths, times and clearances of each contender's runs are spread, how many runs there
// were and how many of them found a path.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scenes/scene/unit_of.hpp"
#include "scenes/text/human_units.hpp"
#include "studies/compare/comparison_report.hpp"
#include "studies/measure/statistics.hpp"

namespace warren::studies {
namespace {

/// One of the figures that are drawn.
struct BoxedFigure {
  std::string_view name;
  std::string_view label;  ///< of its axis
  bool is_time;            ///< may be logarithmic; the others are lengths
  std::optional<double> (*value)(const ComparedRun& run);
  std::string (*text)(double value);
};

constexpr BoxedFigure boxed_figures[] = {
    {"length", "length of the paths", false,
     [](const ComparedRun& r) { return r.solved() ? std::optional(r.length) : std::nullopt; }, human_number},
    {"time", "seconds, of all runs", true, [](const ComparedRun& r) { return std::optional(r.time_s); },
     precise_seconds},
    {"clearance", "clearance of the paths", false,
     [](const ComparedRun& r) { return r.solved() ? r.min_clearance : std::nullopt; }, human_number},
};

std::optional<BoxFigures> figures_of(const Contender& contender, const BoxedFigure& figure) {
  std::vector<double> values;
  for (const ComparedRun& run : contender.runs) {
    if (const auto value = figure.value(run)) values.push_back(*value);
  }
  return box_figures_of(std::move(values));
}

std::string solved_text(const Contender& contender) {
  const auto solved =
      std::count_if(contender.runs.begin(), contender.runs.end(), [](const ComparedRun& run) { return run.solved(); });
  return fmt::format("{} of {}", solved == 0 ? "none" : std::to_string(solved), contender.runs.size());
}

/// Do boxes of values that reach over more than a decade leave most of them in a corner?
bool is_spread(const BoxPlot& plot) {
  constexpr double wide = 10.0;
  double low = 0.0;
  double high = 0.0;
  for (const PlottedBox& box : plot.boxes) {
    if (!box.figures) continue;
    const double least =
        box.figures->outliers.empty() ? box.figures->low : std::min(box.figures->low, box.figures->outliers.front());
    low = high > 0.0 ? std::min(low, least) : least;
    high = std::max({high, box.figures->high, box.figures->outliers.empty() ? 0.0 : box.figures->outliers.back()});
  }
  return low > 0.0 && high > wide * low;
}

/// Nothing where no contender's runs differ.
std::optional<BoxPlot> box_plot(const Comparison& comparison, std::size_t problem, const BoxedFigure& figure) {
  const bool planners = comparison.problems[problem].kind.empty();
  const bool is_metres = !metres_behind(comparison.problems[problem].unit).empty();
  BoxPlot plot{.title = fmt::format("{}: {}", comparison.problems[problem].source, figure.name),
               .label = std::string(figure.label).append(is_metres && !figure.is_time ? " (m)" : ""),
               .remarks = "solved",
               .text = figure.text};
  bool any_differ = false;
  const std::vector<const Contender*> contenders = contenders_of(comparison, problem);
  const std::vector<std::string> names = plot_names_of(contenders, planners);
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    PlottedBox& box =
        plot.boxes.emplace_back(PlottedBox{names[i], solved_text(*contenders[i]), figures_of(*contenders[i], figure)});
    any_differ =
        any_differ || (box.figures && (box.figures->low < box.figures->high || !box.figures->outliers.empty()));
  }
  plot.logarithmic = figure.is_time && is_spread(plot);
  return any_differ ? std::optional(std::move(plot)) : std::nullopt;
}

}  // namespace

std::optional<BoxFigures> box_figures_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  BoxFigures box{
      .q1 = sorted_quantile(values, 0.25), .median = sorted_quantile(values, 0.5), .q3 = sorted_quantile(values, 0.75)};
  const double reach = 1.5 * (box.q3 - box.q1);
  const auto first = std::lower_bound(values.begin(), values.end(), box.q1 - reach);
  const auto last = std::upper_bound(first, values.end(), box.q3 + reach);
  box.low = std::min(*first, box.q1);
  box.high = std::max(*(last - 1), box.q3);
  box.outliers.assign(values.begin(), first);
  box.outliers.insert(box.outliers.end(), last, values.end());
  return box;
}

std::vector<PlotSheet> box_panels(const Comparison& comparison) {
  std::vector<PlotSheet> panels;
  for (std::size_t problem = 0; problem < comparison.problems.size(); ++problem) {
    if (contenders_of(comparison, problem).size() > most_boxes) continue;
    for (const BoxedFigure& figure : boxed_figures) {
      if (const auto plot = box_plot(comparison, problem, figure)) panels.push_back(sheet_of(*plot));
    }
  }
  return panels;
}

std::string note_on_box_plots(const Comparison& comparison) {
  if (!sweep_tables(comparison).empty()) return {};
  for (std::size_t problem = 0; problem < comparison.problems.size(); ++problem) {
    const std::size_t count = contenders_of(comparison, problem).size();
    if (count > most_boxes) {
      return fmt::format("no box plots: they show at most {} planners or searches, and here are {}", most_boxes, count);
    }
  }
  return {};
}

}  // namespace warren::studies
