// SPDX-License-Identifier: BSD-3-Clause
// Plots of a comparison.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "apps/studies/comparison_report.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::studies {
namespace {

Plot solved_plot(const ComparedProblem& problem) {
  return {.title = problem.source + ": solved",
          .x_label = "seconds",
          .y_label = "per cent of the runs solved within",
          .log_x = true,
          .from_zero = true,
          .all_y = 100.0};
}

/// Its place among all names: the same in the plots of all searches.
std::size_t color_of(const std::vector<SweepCurve>& curves, const std::string& name) {
  std::vector<std::string> names;
  for (const SweepCurve& curve : curves) add_once(names, curve.name(curve.search));
  return add_once(names, name);
}

Plot time_plot(const std::vector<SweepCurve>& curves, const std::string& search) {
  Plot plot{.title = search + " on random geometric graphs",
            .x_label = "vertices",
            .y_label = "seconds a search (median)",
            .log_x = true,
            .log_y = true};
  for (const SweepCurve& curve : curves) {
    if (curve.search != search) continue;
    const std::string name = curve.name(search);
    plot.series.push_back({.name = name, .points = curve.points, .color = color_of(curves, name)});
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
    if (run.solved()) times.push_back(run.improvements.empty() ? run.time_s : run.improvements.front().seconds);
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
    Plot plot = solved_plot(comparison.problems[problem]);
    for (const auto& [name, contender] : named_contenders(comparison, problem)) {
      plot.series.push_back({name, solved_shares(*contender)});
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

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

std::size_t contender_count(const Comparison& comparison, std::size_t problem) {
  const auto is_its = [&](const Contender& c) { return c.problem == problem; };
  return static_cast<std::size_t>(std::ranges::count_if(comparison.contenders, is_its));
}

/// Nothing where no contender's runs differ.
std::optional<BoxPlot> box_plot(const Comparison& comparison, std::size_t problem, const BoxedFigure& figure) {
  const bool is_metres = !metres_behind(comparison.problems[problem].unit).empty();
  BoxPlot plot{.title = fmt::format("{}: {}", comparison.problems[problem].source, figure.name),
               .label = std::string(figure.label).append(is_metres && !figure.is_time ? " (m)" : ""),
               .remarks = "solved",
               .text = figure.text};
  bool any_differ = false;
  for (const auto& [name, contender] : named_contenders(comparison, problem)) {
    std::vector<double> values;
    std::size_t solved = 0;
    for (const ComparedRun& run : contender->runs) {
      if (const auto value = figure.value(run)) values.push_back(*value);
      solved += run.solved() ? 1 : 0;
    }
    const std::string remark =
        fmt::format("{} of {}", solved == 0 ? "none" : std::to_string(solved), contender->runs.size());
    PlottedBox& box = plot.boxes.emplace_back(PlottedBox{name, remark, box_figures_of(std::move(values))});
    any_differ =
        any_differ || (box.figures && (box.figures->low < box.figures->high || !box.figures->outliers.empty()));
  }
  plot.logarithmic = figure.is_time && is_spread(plot);
  return any_differ ? std::optional(std::move(plot)) : std::nullopt;
}

// Plots of what options that were dealt out do. Where a planner takes the values of more than one, they are heat maps
// over the two options with most values, one row of maps for each way to take the others.

using Words = std::vector<std::pair<std::string, std::string>>;

struct ShownValue {
  double value;
  Vec2 span;  ///< its interval or quartiles
};

struct ShownFigure {
  std::string_view name;
  std::string_view label;  ///< of its axis
  std::optional<ShownValue> (*of)(const ComparisonRow& row);
  std::string (*text)(double value);
};

template <auto Field>
std::optional<ShownValue> median(const ComparisonRow& row) {
  if (!(row.*Field)) return std::nullopt;
  return ShownValue{(row.*Field)->median, {(row.*Field)->q1, (row.*Field)->q3}};
}
std::optional<ShownValue> success(const ComparisonRow& row) {
  if (row.runs == 0) return std::nullopt;
  return ShownValue{100.0 * static_cast<double>(row.solved) / static_cast<double>(row.runs),
                    {100.0 * row.success.low, 100.0 * row.success.high}};
}
std::string per_cent(double value) { return fmt::format("{:.0f} %", value); }

constexpr std::size_t most_panels = 60;

constexpr ShownFigure figures[] = {
    {"runs solved", "per cent of the runs, 95 % interval", success, per_cent},
    {"median length", "length, with quartiles", median<&ComparisonRow::length>, human_number},
    {"median time", "seconds, with quartiles", median<&ComparisonRow::time_s>, precise_seconds},
};

const std::string& word_of(const Words& dealt, const std::string& name) {
  static const std::string none;
  for (const auto& [option, word] : dealt) {
    if (option == name) return word;
  }
  return none;
}

/// As the command line has it: goal-bias.
std::string spelled(std::string option) {
  std::ranges::replace(option, '_', '-');
  return option;
}

/// Contenders that differ in nothing but the values on the axes.
struct Family {
  std::string name;                       ///< the planner, and what its contenders share of what was dealt
  std::vector<std::string> axes;          ///< names of options, one or two
  std::vector<const Contender*> members;  ///< all that take the axes' options
};

/// Of what the planner's contenders were dealt, the names of the two options with most values.
std::vector<std::string> axes_of(const Comparison& comparison, const Contender& like) {
  std::vector<std::pair<std::size_t, std::string>> by_count;
  for (const auto& [name, word] : like.dealt) {
    std::vector<std::string> words;
    for (const Contender& c : comparison.contenders) {
      if (c.planner == like.planner && c.problem == like.problem) add_once(words, word_of(c.dealt, name));
    }
    by_count.emplace_back(words.size(), name);
  }
  std::stable_sort(by_count.begin(), by_count.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> axes;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, by_count.size()); ++i) axes.push_back(by_count[i].second);
  return axes;
}

std::vector<Family> families_of(const Comparison& comparison) {
  std::vector<Family> families;
  for (const Contender& c : comparison.contenders) {
    if (c.dealt.empty()) continue;
    Family family{c.planner, axes_of(comparison, c), {}};
    for (const auto& [name, word] : c.dealt) {
      const bool on_axis = std::find(family.axes.begin(), family.axes.end(), name) != family.axes.end();
      if (!on_axis) family.name += fmt::format(", {} {}", spelled(name), word);
    }
    const auto same = std::find_if(families.begin(), families.end(),
                                   [&](const Family& f) { return f.name == family.name && f.axes == family.axes; });
    Family& of = same == families.end() ? families.emplace_back(std::move(family)) : *same;
    of.members.push_back(&c);
  }
  return families;
}

HeatMap heat_map(const Family& family, const ShownFigure& figure) {
  HeatMap map{.title = fmt::format("{}: {}", family.name, figure.name),
              .x_label = spelled(family.axes[0]),
              .y_label = spelled(family.axes[1])};
  if (figure.text == per_cent) map.low = 0.0, map.high = 100.0;
  map.less_is_better = figure.text != per_cent;
  for (const Contender* c : family.members) {
    add_once(map.columns, word_of(c->dealt, family.axes[0]));
    add_once(map.rows, word_of(c->dealt, family.axes[1]));
  }
  map.cells.resize(map.columns.size() * map.rows.size());
  for (const Contender* c : family.members) {
    const std::size_t column = add_once(map.columns, word_of(c->dealt, family.axes[0]));
    const std::size_t row = add_once(map.rows, word_of(c->dealt, family.axes[1]));
    HeatMap::Cell& cell = map.cells[row * map.columns.size() + column];
    const auto shown = figure.of(row_of(*c));
    cell.value = shown ? std::optional(shown->value) : std::nullopt;
    cell.text = cell.value ? figure.text(*cell.value) : "none";
  }
  return map;
}

/// Over the values of an option. Nothing of an option whose values are no numbers.
void add_series(Plot& plot, const Family& family, const std::string& option, const ShownFigure& figure,
                std::size_t color) {
  PlotSeries series{.name = family.name, .color = color};
  std::map<double, const Contender*> by_value;
  for (const Contender* c : family.members) {
    if (const auto x = number_in_word(word_of(c->dealt, option))) by_value[*x] = c;
  }
  for (const auto& [x, c] : by_value) {
    const auto y = figure.of(row_of(*c));
    if (!y) continue;
    series.points.push_back({x, y->value});
    series.spans.push_back(y->span);
  }
  if (by_value.size() > 1 && !series.points.empty()) plot.series.push_back(std::move(series));
}

Plot plot_over(const std::string& option, const ShownFigure& figure) {
  return {.title = fmt::format("{} against {}", figure.name, spelled(option)),
          .x_label = spelled(option),
          .y_label = std::string(figure.label),
          .from_zero = figure.text == per_cent};
}

/// What a heat map shows, as lines with intervals over one of its options, one a value of the other; nothing where
/// neither option's values are numbers, or where there are more lines than colours.
std::optional<Plot> sweep_plot(const Family& family, const ShownFigure& figure) {
  for (const std::size_t x : {0U, 1U}) {
    const std::string& other = family.axes[1 - x];
    std::vector<std::string> values;
    for (const Contender* c : family.members) add_once(values, word_of(c->dealt, other));
    Plot plot = plot_over(family.axes[x], figure);
    plot.title = fmt::format("{}: {}", family.name, plot.title);
    for (const std::string& value : values) {
      Family line{fmt::format("{} {}", spelled(other), value), {}, {}};
      std::ranges::copy_if(family.members, std::back_inserter(line.members),
                           [&](const Contender* c) { return word_of(c->dealt, other) == value; });
      add_series(plot, line, family.axes[x], figure, static_cast<std::size_t>(&value - values.data()));
    }
    if (!plot.series.empty() && plot.series.size() <= colors::series.size()) return plot;
  }
  return std::nullopt;
}

/// Planners that take the values of the same option are in one plot.
std::vector<PlotSheet> line_panels(const std::vector<Family>& families) {
  std::vector<std::string> options;
  std::vector<const Family*> lines;
  for (const Family& family : families) {
    if (family.axes.size() != 1) continue;
    add_once(options, family.axes[0]);
    lines.push_back(&family);
  }
  std::vector<PlotSheet> panels;
  for (const std::string& option : options) {
    for (const ShownFigure& figure : figures) {
      Plot plot = plot_over(option, figure);
      for (std::size_t i = 0; i < lines.size(); ++i) {  // a family's colour is the same in all plots
        if (lines[i]->axes[0] == option) add_series(plot, *lines[i], option, figure, i);
      }
      if (!plot.series.empty()) panels.push_back(sheet_of(plot));
    }
  }
  return panels;
}

// Curves of cost show some hundred moments, evenly on a logarithmic axis. O(moments · runs · log runs).

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double earliest_s = 1e-6;  // a logarithmic axis has no zero

/// The moments that plots show, from the first path of all to the end of the longest run.
struct CurveTimes {
  double begin_s = never;
  double end_s = 0.0;
  void include(double seconds) {
    begin_s = std::min(begin_s, std::max(seconds, earliest_s));
    end_s = std::max(end_s, std::max(seconds, earliest_s));
  }
};

bool has_curve(const Contender& contender) {
  const auto planner = enum_named<PlannerKind>(contender.planner);
  return planner && gets_better(*planner);
}

/// Runs of planners that get better, and those that found nothing, take longer than their last path.
CurveTimes times_of(const std::vector<NamedContender>& contenders) {
  CurveTimes times;
  for (const auto& [name, c] : contenders) {
    for (const ComparedRun& run : c->runs) {
      for (const Improvement& one : run.improvements) times.include(one.seconds);
      if (has_curve(*c) || run.improvements.empty()) times.end_s = std::max(times.end_s, run.time_s);
    }
  }
  times.begin_s = std::min(times.begin_s, times.end_s);
  return times;
}

/// By the order statistics around it; infinite where one that counts is.
double quantile_or_never(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const double part = at - static_cast<double>(below);
  if (part == 0.0) return sorted[below];
  return sorted[below + 1] == never ? never : std::lerp(sorted[below], sorted[below + 1], part);
}

/// What all costs are measured by, and what it is.
struct CostUnit {
  double cost = 1.0;
  std::string name = {};  ///< empty: nothing is known, or it is 0
};

/// The best bound of all, since all are asked the same; where several clearances were dealt out they are not. A bound
/// so far below that it would press all curves together is told, and the best path taken.
CostUnit unit_of_costs(const std::vector<NamedContender>& contenders) {
  constexpr double far = 2.0;
  double bound = 0.0;
  double best = never;
  bool is_one_question = true;
  for (const auto& [name, c] : contenders) {
    for (const auto& [option, word] : c->dealt) is_one_question = is_one_question && option != "clearance";
    for (const ComparedRun& run : c->runs) {
      bound = std::max(bound, run.lower_bound.value_or(0.0));
      for (const Improvement& one : run.improvements) best = std::min(best, one.cost);
    }
  }
  const bool has_bound = is_one_question && bound > 0.0;
  if (!(best > 0.0 && best < never)) return {};
  if (has_bound && best <= far * bound) return {bound, fmt::format("lower bound: {}", human_number(bound))};
  std::string name = fmt::format("best of all: {}", human_number(best));
  if (has_bound) name += fmt::format(", bound {}", human_number(bound));
  return {best, std::move(name)};
}

Plot cost_plot(const ComparedProblem& problem, const CostUnit& unit) {
  Plot plot{.title = problem.source + ": cost against time",
            .x_label = "seconds",
            .y_label = "cost, median and quartiles of the runs",
            .log_x = true};
  if (unit.name.empty()) return plot;
  plot.y_label = fmt::format("cost over the {}, median and quartiles", unit.name.substr(0, unit.name.find(':')));
  plot.level = 1.0;
  plot.level_name = unit.name;
  return plot;
}

/// Do costs reach over so much that a linear axis hides what is near the best?
bool is_wide(const Plot& plot) {
  constexpr double wide = 4.0;
  double high = 0.0;
  double low = never;
  for (const PlotSeries& series : plot.series) {
    for (const Vec2 p : series.points) {
      if (p.y < never) low = std::min(low, p.y), high = std::max(high, p.y);
    }
  }
  return low > 0.0 && high > wide * low;
}

}  // namespace

CostCurve cost_curve(const Contender& contender, double begin_s, double end_s) {
  constexpr double most_moments = 500.0;
  const double step = std::pow(end_s / begin_s, 1.0 / most_moments);
  CostCurve curve;
  std::vector<double> costs(contender.runs.size(), never);
  const auto tell = [&](double seconds) {
    std::vector<double> sorted = costs;
    std::sort(sorted.begin(), sorted.end());
    curve.median.push_back({seconds, quantile_or_never(sorted, 0.5)});
    curve.quartiles.push_back({quantile_or_never(sorted, 0.25), quantile_or_never(sorted, 0.75)});
    const auto solved = std::lower_bound(sorted.begin(), sorted.end(), never) - sorted.begin();
    curve.solved.push_back({seconds, 100.0 * static_cast<double>(solved) / static_cast<double>(costs.size())});
  };
  if (costs.empty()) return curve;
  curve.solved.push_back({begin_s, 0.0});
  struct BetterPath {
    double seconds;
    std::size_t run;
    double cost;
  };
  std::vector<BetterPath> all;  // of all runs, in the order of time
  for (std::size_t i = 0; i < contender.runs.size(); ++i) {
    for (const Improvement& one : contender.runs[i].improvements) {
      all.push_back({std::max(one.seconds, earliest_s), i, one.cost});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  double told_s = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    costs[all[i].run] = std::min(costs[all[i].run], all[i].cost);
    const bool is_last = i + 1 == all.size();
    if (!is_last && all[i + 1].seconds <= std::max(told_s * step, all[i].seconds)) continue;
    told_s = all[i].seconds;
    tell(told_s);
  }
  tell(end_s);
  return curve;
}

std::vector<PlotSheet> curve_panels(const Comparison& comparison) {
  std::vector<PlotSheet> panels;
  for (std::size_t problem = 0; problem < comparison.problems.size(); ++problem) {
    const std::vector<NamedContender> contenders = named_contenders(comparison, problem);
    const CurveTimes times = times_of(contenders);
    const CostUnit unit = unit_of_costs(contenders);
    Plot costs = cost_plot(comparison.problems[problem], unit);
    Plot solved = solved_plot(comparison.problems[problem]);
    for (const auto& [name, contender] : contenders) {
      CostCurve curve = cost_curve(*contender, times.begin_s, times.end_s);
      for (Vec2& p : curve.median) p.y /= unit.cost;
      for (Vec2& span : curve.quartiles) span = {span.x / unit.cost, span.y / unit.cost};
      costs.series.push_back(
          {.name = name, .points = std::move(curve.median), .steps = true, .spans = std::move(curve.quartiles)});
      solved.series.push_back({.name = name, .points = std::move(curve.solved), .steps = true});
    }
    costs.log_y = is_wide(costs);
    panels.push_back(sheet_of(costs));
    panels.push_back(sheet_of(solved));
  }
  return panels;
}

std::vector<PlotSheet> comparison_panels(const Comparison& comparison) {
  const bool get_better = std::ranges::any_of(comparison.contenders, has_curve);
  std::vector<PlotSheet> panels = get_better ? curve_panels(comparison) : std::vector<PlotSheet>();
  const auto add = [&](std::vector<PlotSheet> more) { std::ranges::move(more, std::back_inserter(panels)); };
  add(list_panels(comparison));
  const std::vector<SweepCurve> sizes = get_better ? std::vector<SweepCurve>() : sweep_curves(comparison);
  std::vector<Plot> plots;
  if (!get_better) plots = sizes.empty() ? share_plots(comparison) : sweep_plots(sizes);
  const bool is_alone = panels.empty();
  for (const Plot& plot : plots) {
    const bool fits = !sizes.empty() || is_alone || plot.series.size() <= colors::series.size();
    if (fits) panels.push_back(sheet_of(plot));
  }
  if (sizes.empty()) add(box_panels(comparison));
  return panels;
}

PlotsPage comparison_plots(const Comparison& comparison) {
  constexpr std::size_t side_by_side = 2;
  constexpr std::size_t figures = 3;
  return {comparison_panels(comparison), list_panels(comparison).empty() ? side_by_side : figures};
}

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
    if (contender_count(comparison, problem) > most_boxes) continue;
    for (const BoxedFigure& figure : boxed_figures) {
      if (const auto plot = box_plot(comparison, problem, figure)) panels.push_back(sheet_of(*plot));
    }
  }
  return panels;
}

std::string note_on_box_plots(const Comparison& comparison) {
  if (!sweep_curves(comparison).empty()) return {};
  for (std::size_t problem = 0; problem < comparison.problems.size(); ++problem) {
    const std::size_t count = contender_count(comparison, problem);
    if (count > most_boxes) {
      return fmt::format("no box plots: they show at most {} planners or searches, and here are {}", most_boxes, count);
    }
  }
  return {};
}

std::string note_on_heat_maps(const Comparison& comparison) {
  const std::vector<Family> families = families_of(comparison);
  const auto has_map = [](const Family& family) { return family.axes.size() == 2; };
  const auto maps =
      std::size(figures) * static_cast<std::size_t>(std::count_if(families.begin(), families.end(), has_map));
  const std::size_t drawn = most_panels - std::min(most_panels, line_panels(families).size());
  if (maps <= drawn) return {};
  return fmt::format("{} of {} heat maps are drawn: shorten a list, or take the figures from --csv FILE", drawn, maps);
}

std::vector<PlotSheet> list_panels(const Comparison& comparison) {
  const std::vector<Family> families = families_of(comparison);
  std::vector<PlotSheet> panels = line_panels(families);
  const auto add = [&](const auto& plot_of) {
    for (const Family& family : families) {
      for (const ShownFigure& figure : figures) {
        if (family.axes.size() != 2 || panels.size() >= most_panels) continue;
        if (const auto plot = plot_of(family, figure)) panels.push_back(sheet_of(*plot));
      }
    }
  };
  add([](const Family& family, const ShownFigure& figure) { return std::optional(heat_map(family, figure)); });
  add(sweep_plot);
  return panels;
}

}  // namespace warren::studies
