// SPDX-License-Identifier: BSD-3-Clause
// What a planner's runs had at each moment: the median of what their best paths until then cost, its quartiles, and the
// share of the runs that had a path at all. A run costs infinitely much until its first path. Plots show some hundred
// moments, evenly on a logarithmic axis; the figures at each are exact.
// O(moments · runs · log runs).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "apps/studies/comparison_report.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::studies {
namespace {

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

/// Runs of planners that get better, and those that found nothing, take longer than their last path.
CurveTimes times_of(const std::vector<const Contender*>& contenders) {
  CurveTimes times;
  for (const Contender* c : contenders) {
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

/// What happens in all runs of a contender, in the order of time.
struct BetterPath {
  double seconds;
  std::size_t run;
  double cost;
};
std::vector<BetterPath> better_paths(const Contender& contender) {
  std::vector<BetterPath> all;
  for (std::size_t i = 0; i < contender.runs.size(); ++i) {
    for (const Improvement& one : contender.runs[i].improvements) {
      all.push_back({std::max(one.seconds, earliest_s), i, one.cost});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  return all;
}

/// What all costs are measured by, and what it is.
struct CostUnit {
  double cost = 1.0;
  std::string name = {};  ///< empty: nothing is known, or it is 0
};

/// The best bound of all, since all are asked the same; where several clearances were dealt out they are not. A bound
/// so far below that it would press all curves together is told, and the best path taken.
CostUnit unit_of_costs(const std::vector<const Contender*>& contenders) {
  constexpr double far = 2.0;
  double bound = 0.0;
  double best = never;
  bool is_one_question = true;
  for (const Contender* c : contenders) {
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
            .log_x = true,
            .series = {}};
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

bool has_curve(const Contender& contender) {
  const auto planner = enum_named<PlannerKind>(contender.planner);
  return planner && gets_better(*planner);
}

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
  const std::vector<BetterPath> all = better_paths(contender);
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
    const std::vector<const Contender*> contenders = contenders_of(comparison, problem);
    const std::vector<std::string> names = plot_names_of(contenders, true);
    const CurveTimes times = times_of(contenders);
    const CostUnit unit = unit_of_costs(contenders);
    Plot costs = cost_plot(comparison.problems[problem], unit);
    Plot solved = solved_plot(comparison.problems[problem]);
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      CostCurve curve = cost_curve(*contenders[i], times.begin_s, times.end_s);
      for (Vec2& p : curve.median) p.y /= unit.cost;
      for (Vec2& span : curve.quartiles) span = {span.x / unit.cost, span.y / unit.cost};
      costs.series.push_back(
          {.name = names[i], .points = std::move(curve.median), .steps = true, .spans = std::move(curve.quartiles)});
      solved.series.push_back({.name = names[i], .points = std::move(curve.solved), .steps = true});
    }
    costs.log_y = is_wide(costs);
    panels.push_back(sheet_of(costs));
    panels.push_back(sheet_of(solved));
  }
  return panels;
}

}  // namespace warren::studies
